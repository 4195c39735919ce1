#pragma once
#include <map>
#include <string>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// The newest version of a part that a group handed in.
struct HandedIn {
    std::int64_t version = 0, late = 0;
    Instant received_at = 0;
    std::int64_t in_time = 0;  ///< of a late one: the newest earlier version that was in time and can be read, or 0
    int rules_broken = 0;
    std::string trouble;  ///< why it cannot be read; else empty
    bool is_late() const { return late > 0 && in_time == 0; }
};
using HandedInParts = std::map<std::string, HandedIn>;  ///< by part: report, slides, script, pack

/// By group and stage ("first", "final").
std::map<std::int64_t, std::map<std::string, HandedInParts>> newest_versions(Course& course,
                                                                             const Assignment& assignment);

}  // namespace dynlab::inline course
