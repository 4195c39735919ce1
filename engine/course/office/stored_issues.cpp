#include "course/office/stored_issues.h"

#include <algorithm>

#include "course/issues/issues_report.h"
#include "course/review/review_pairs.h"

namespace dynlab::inline course {

std::vector<StoredIssues> loaded_issues(Course& course, const Assignment& assignment, const Group& group,
                                        const std::string& stage, std::optional<std::int64_t> number) {
    const std::vector<ReviewPair> pairs = review_pairs(course, assignment);
    Rows rows = course.database().query(
        "SELECT part, ifnull(pair, 0), number, received_at, findings FROM standing v WHERE assignment = ? AND "
        "group_id = ? AND stage = ? AND number = ifnull(?, (SELECT max(number) FROM standing w WHERE "
        "w.assignment = v.assignment AND w.group_id = v.group_id AND w.stage = v.stage AND w.part = v.part AND "
        "ifnull(w.pair, 0) = ifnull(v.pair, 0))) ORDER BY part, pair",
        assignment.id, group.id, stage, number);
    std::vector<StoredIssues> found;
    while (rows.next()) {
        StoredIssues& one = found.emplace_back();
        one.part = rows.text(0), one.version = rows.integer(2), one.received_at = rows.integer(3);
        const auto pair = std::ranges::find(pairs, rows.integer(1), &ReviewPair::id);
        if (pair != pairs.end()) one.about = pair->report_pseudonym();
        if (!rows.text(4).empty()) one.result = issues_from_json(rows.text(4));
    }
    return found;
}

}  // namespace dynlab::inline course
