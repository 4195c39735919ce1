#pragma once
#include <filesystem>
#include <optional>

namespace dynlab::inline platform {

/// The folder of an instructor's own course, which DYNLAB_COURSE names; it holds some of lessons/, data/ and
/// report_templates/. Throws EnvironmentError where there is no such folder, or nothing of the kind in it.
std::optional<std::filesystem::path> own_course();

/// One folder in which data sets, lessons and templates are found: those of a course, then the installed ones. Of two
/// data sets or lessons of one name the course's counts, and so does a file of report_templates/. It is a copy in the
/// store of what is kept between runs, made anew when a file of either changes; nothing is written into them.
std::filesystem::path course_home(const std::filesystem::path& course, const std::filesystem::path& installed);

}  // namespace dynlab::inline platform
