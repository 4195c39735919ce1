#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/intake/roster.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

struct BundleOptions {
    std::optional<std::uint32_t> group_seed = {};  ///< for group-specific data sets (variant_data.h)
    std::string language = {};                     ///< "en" or "fr"; the lesson's when empty
    std::filesystem::path sheet = {};              ///< the task sheet; may be empty
};

/// The zip of a lesson that students get: starter, report template, visible checks, the data sets that the lesson
/// loads, and, beside the folder, the task sheet and how to start; no solution. Returns the names in it.
std::vector<std::string> bundle_lesson(const Lesson& lesson, const std::filesystem::path& file,
                                       const BundleOptions& options);

/// A group, or a student without one, who gets a bundle.
struct BundleOwner {
    std::string name, language;
    std::uint32_t seed = 0;
};

/// All of the roster, in its order. Whose seed is neither there nor in `earlier`, the roster that a former call gave
/// seeds, gets one at random, which is entered into `students`. Throws EnvironmentError where members of a group have
/// different seeds, or a name cannot be a file's.
std::vector<BundleOwner> bundle_owners(std::vector<Student>& students, const std::vector<Student>& earlier);

/// A roster as a file that dynlab reads.
std::string roster_text(const std::vector<Student>& students);

}  // namespace dynlab::inline course
