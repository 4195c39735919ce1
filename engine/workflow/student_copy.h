#pragma once
#include <filesystem>

#include "workflow/lesson_catalogue.h"

namespace dynlab {

/// Makes a student's folder for a lesson: analysis.lua (the script without its solutions), report.md, group.toml and a
/// link to the data. The folder appears whole or not at all. Throws EnvironmentError when `folder` exists and is not
/// empty, or cannot be made.
void make_student_copy(const Lesson& lesson, const std::filesystem::path& folder);

}  // namespace dynlab
