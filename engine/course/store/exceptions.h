#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "course/store/assignments.h"

namespace dynlab::inline course {

// What the instructor allowed or kept from a group besides what holds for all. Corrections make such entries
// (corrections/corrections.h), each with a reason; the newest holds.

/// Throws InvalidArgument for an empty reason.
void refuse_without_reason(const std::string& reason);

/// The deadline of a group, extended or not. Throws InvalidArgument for a stage that the assignment does not have.
Instant due_for(Course& course, const Assignment& assignment, std::int64_t group, const std::string& stage);

/// Whether a group's report, or its review of a pair, is held back.
bool is_held(Course& course, const Assignment& assignment, std::int64_t group, std::optional<std::int64_t> pair);

}  // namespace dynlab::inline course
