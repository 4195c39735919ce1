#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// Makes a folder with a small lesson that runs and passes `dynlab test-lesson`, to be changed into one's own:
/// lesson.lua with a worked solution, its record, checks, a script with a typical mistake and one that is right by
/// another method, hints, and all of it in French as well. The lesson is called like the folder. Returns the files'
/// names, sorted. Throws EnvironmentError where the folder is there and not empty, or its name is not one for a lesson.
std::vector<std::string> make_lesson_skeleton(const std::filesystem::path& folder);

}  // namespace dynlab::inline workflow
