#pragma once
#include <filesystem>
#include <optional>

namespace dynlab::inline platform {

/// The folder of an instructor's own course, which DYNLAB_COURSE names; it holds some of lessons/, data/ and
/// report_templates/. Throws EnvironmentError where there is no such folder, or nothing of the kind in it.
std::optional<std::filesystem::path> own_course();

/// Returns one folder with the data sets, lessons and templates of a course and of the installation. Data sets, lessons
/// and files of report_templates/ of the course take precedence over installed ones of the same name. The folder is a
/// cached copy, which is created again when an original file changes; the original folders are not changed.
std::filesystem::path course_home(const std::filesystem::path& course, const std::filesystem::path& installed);

}  // namespace dynlab::inline platform
