#pragma once
#include <optional>
#include <string>

#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// The pseudonym under which the answers of a group are marked, "answer-k7m2qd". It never changes. It follows from the
/// course's secret key, so that neither the name nor the order of names reveals the group.
std::string answer_name(const Course& course, const Assignment& assignment, std::int64_t group);

/// The group with this answer_name; nothing for any other text.
std::optional<Group> group_of_answers(Course& course, const Assignment& assignment, const std::string& name);

}  // namespace dynlab::inline course
