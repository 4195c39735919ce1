#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/office/course_work.h"

namespace dynlab::inline course {

/// Brings marks.csv in a folder of results and the marks of the store together. A row that differs from what the two
/// had in common last time was changed by the instructor and goes into the store; at the end all rows say what the
/// store says. An emptied row takes nothing back: it is filled again. Only where marks are given in the file alone,
/// `file_alone`, a mark whose row is not there any more, or is empty, is taken back. `max_points`: by check, and by *
/// for the complete submission. Returns a sentence for each row that cannot be taken. Throws EnvironmentError for a
/// file that cannot be read, and for points that contradict others.
std::vector<Message> join_marks_file(Course& course, const Assignment& assignment, const CourseWork& work,
                                     const std::map<std::string, double>& max_points,
                                     const std::filesystem::path& results, bool file_alone);

/// Id of the newest mark when marks.csv and the store were last brought together; nothing before the first time.
std::optional<std::int64_t> newest_joined_mark(Course& course, const Assignment& assignment);

}  // namespace dynlab::inline course
