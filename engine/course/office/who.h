#pragma once
#include <string>

#include "course/store/course_store.h"

namespace dynlab::inline course {

/// All that the course knows of one group, or of the group of one student: members now and before, every version with
/// its receipt, extensions, files that were not taken, marks, and its lines of the history. `name` as group_named takes
/// it, or a student's. Throws InvalidArgument.
std::string who_text(Course& course, const std::string& name, Instant now);

}  // namespace dynlab::inline course
