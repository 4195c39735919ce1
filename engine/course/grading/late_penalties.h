#pragma once
#include "course/grading/work_item.h"

namespace dynlab::inline course {

/// A deadline, and what missing it costs.
struct LatePolicy {
    std::int64_t deadline = 0, grace = 0;  ///< seconds since 1970; seconds
    double percent_per_day = 10, max_percent = 100;
};
/// Of what was received then; times are shown in the process's time zone.
Lateness lateness_of(const LatePolicy& policy, std::int64_t received);

/// A penalty of half the points or more is more often a wrong time (a file that was saved again, a wrong zone) than a
/// late student.
bool needs_confirmation(const Lateness& lateness);
/// Such a penalty is not applied yet: its percentage is 0, and the reason says so.
Lateness unconfirmed(const Lateness& lateness);

/// Adds to the work a clause for each late item, a sentence for each penalty that is not applied, and the question
/// whether the time zone is right.
void conclude_lateness(ClassWork& work);

}  // namespace dynlab::inline course
