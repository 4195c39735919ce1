#pragma once
#include <map>
#include <string>

#include "course/intake/submission.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// Moodle numbers participants for each assignment: the number is in the names of submissions and is kept with
/// the assignment, beside the one in the roster.

/// Within a transaction: keeps the number in the name that Moodle gave a sender of this group, for the member of that
/// name, or the only one. Names of other platforms have none.
void keep_participant(Course& course, std::int64_t assignment, const Submission& sender, const Group& group);

/// Numbers of students in this assignment, by id.
std::map<std::string, std::string> participants_of(Course& course, std::int64_t assignment);

}  // namespace dynlab::inline course
