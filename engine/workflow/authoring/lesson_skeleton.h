#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// Creates a folder with a small lesson that runs and passes `dynlab test-lesson`, as a starting point for a new
/// lesson: lesson.lua with a reference solution, its data, checks, a script with a common mistake and one that is
/// correct by another method, hints, and all of it in French as well. The lesson has the folder's name. Returns the
/// files' names, sorted. Throws EnvironmentError if the folder exists and is not empty, or its name is not valid for a
/// lesson.
std::vector<std::string> make_lesson_skeleton(const std::filesystem::path& folder);

}  // namespace dynlab::inline workflow
