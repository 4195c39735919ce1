#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "workflow/lesson_catalogue.h"

namespace dynlab::inline course {

struct Pack {
    std::vector<std::string> files;     ///< in the pack, MANIFEST.json aside
    std::vector<std::string> left_out;  ///< links, and what is neither file nor folder
    std::string hash;                   ///< SHA-256 of the pack
};

/// Packs a student's folder into one zip to hand in: its files without the data link, hidden entries and earlier packs,
/// and MANIFEST.json with the SHA-256 of each. Equal folders give equal packs. Throws EnvironmentError for a folder
/// without analysis.lua, or one that is too large.
Pack pack_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The zip of a lesson that students get: starter, report template, visible checks and the data sets that the lesson
/// loads, with a group's seed its own records (specimen_record.h) of what is simulated; no solution. Returns the names
/// in it.
std::vector<std::string> bundle_lesson(const Lesson& lesson, const std::filesystem::path& file,
                                       std::optional<std::uint32_t> group_seed = {});

}  // namespace dynlab::inline course
