#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/issues/document_issues.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// What was found in a version when it was received.
struct StoredIssues {
    std::string part;   ///< report, slides, script, pack, review
    std::string about;  ///< of a review: the pseudonym of the report
    std::int64_t version = 0;
    Instant received_at = 0;
    std::optional<CheckResult> result;  ///< nothing when it was not looked at
};

/// Of a group's files for a stage ("first", "review", "final"): the newest version of each, or version `number` where
/// that is given.
std::vector<StoredIssues> loaded_issues(Course& course, const Assignment& assignment, const Group& group,
                                        const std::string& stage, std::optional<std::int64_t> number = {});

}  // namespace dynlab::inline course
