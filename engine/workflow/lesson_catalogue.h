#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "documents/percent_script.h"

namespace dynlab::inline workflow {

/// A lesson of the course: the folder lessons/NN_slug with its master script.
struct Lesson {
    std::string slug;  ///< "02_least_squares"
    std::filesystem::path folder;
    std::filesystem::path script() const { return folder / "lesson.lua"; }
    /// Of lessons that end with a report of its own form: the worked solution's; no such file for others.
    std::filesystem::path report(const std::string& language) const { return folder / ("report." + language + ".md"); }
};

std::vector<Lesson> lessons();  ///< all that are installed, sorted by slug

/// The lesson whose slug starts with `name` ("02", "2", "02_least"), or holds it as a word ("crane"). Throws
/// EnvironmentError that lists the lessons when none or several do.
Lesson find_lesson(const std::string& name);

}  // namespace dynlab::inline workflow
