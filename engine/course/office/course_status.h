#pragma once
#include <string>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// The state of an assignment as a table an instructor can act on: deadlines, a row for each group with what was handed
/// in, what is late, what cannot be read and what is to be done about it, sums, and the next command.
std::string assignment_status(Course& course, const Assignment& assignment, Instant now);

/// The course at a glance: groups, assignments and their deadlines.
std::string course_summary(Course& course, Instant now);

}  // namespace dynlab::inline course
