#pragma once
#include <map>
#include <string>

#include "course/store/course_store.h"

namespace dynlab::inline course {

/// Moodle numbers participants for each assignment: the number stands in the names of submissions and is kept with
/// the assignment, beside the one in the roster.

/// Within a transaction.
void keep_participant(Course& course, std::int64_t assignment, const std::string& student, const std::string& number);

/// Numbers of students in this assignment, by id.
std::map<std::string, std::string> participants_of(Course& course, std::int64_t assignment);

}  // namespace dynlab::inline course
