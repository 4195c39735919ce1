#pragma once
#include <filesystem>
#include <string>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// A row a student: identifiers (id, name, mail, Moodle's and Canvas's), group, when the versions were received and how
/// late, reviews written, marks in percent with the reasons of overrides, remarks on reviews that need the instructor's
/// eye. CSV with formulas neutralized.
std::string marks_csv(Course& course, const Assignment& assignment, Instant now = CourseClock::now());

/// All of the store but the handed-in files, as JSON: tables with their rows.
std::string course_json(Course& course);

/// Creates a course from course_json in `folder`, a new or empty folder. Submitted files and the key come from `from`,
/// the folder of the exported course. The import is atomic.
/// Throws EnvironmentError if there is no such export, if a file is missing, or if a table refuses a row.
void import_course(const std::filesystem::path& json, const std::filesystem::path& from,
                   const std::filesystem::path& folder);

}  // namespace dynlab::inline course
