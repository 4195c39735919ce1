// The views of reviews and of marks.
#include <fmt/format.h>

#include <algorithm>

#include "app/office/office_views.h"
#include "course/office/course_totals.h"
#include "course/review/review_marks.h"
#include "course/store/groups.h"
#include "data_io/values/json_values.h"

namespace dynlab::inline app {
namespace {

struct OfficeReview {
    std::string reviewer, report, author, state;
    std::vector<std::optional<double>> points;  ///< by criterion
    std::optional<double> percent;              ///< of these points
    bool outlier = false, retaliation = false, held = false, stopped = false;
    std::int64_t late = 0;
};
DYNLAB_DESCRIBE(OfficeReview, reviewer, report, author, state, points, percent, outlier, retaliation, held, stopped,
                late)

struct OfficeReport {
    std::string author, report;
    std::optional<double> work, reviews;
    int scored = 0, wanted = 0;
    bool held = false;
};
DYNLAB_DESCRIBE(OfficeReport, author, report, work, reviews, scored, wanted, held)

struct OfficeCriterion {
    std::string name;
    double most = 5;
};
DYNLAB_DESCRIBE(OfficeCriterion, name, most)

struct OfficeReviews {
    std::vector<std::string> assignments;
    std::string assignment;
    std::vector<OfficeCriterion> criteria;
    std::vector<OfficeReview> reviews;
    std::vector<OfficeReport> reports;
    bool over = false;  ///< the deadline of the reviews
};
DYNLAB_DESCRIBE(OfficeReviews, assignments, assignment, criteria, reviews, reports, over)

struct OfficeMarksRow {
    std::string id, name, group;
    std::vector<std::optional<double>> percent;  ///< by assignment
    std::vector<std::string> state;              ///< "missing", "open" or empty
    std::optional<double> total;
};
DYNLAB_DESCRIBE(OfficeMarksRow, id, name, group, percent, state, total)

struct OfficeColumn {
    std::string name;
    double weight = 1;
};
DYNLAB_DESCRIBE(OfficeColumn, name, weight)

struct OfficeChange {
    std::string name, column, before, now;
};
DYNLAB_DESCRIBE(OfficeChange, name, column, before, now)

struct OfficeMarks {
    std::vector<OfficeColumn> assignments;
    std::vector<OfficeMarksRow> rows;
    std::string exported;  ///< when; empty: never
    std::vector<OfficeChange> changes;
};
DYNLAB_DESCRIBE(OfficeMarks, assignments, rows, exported, changes)

const char* state_of_pair(const ReviewPair& pair) {
    if (pair.withdrawn) return "withdrawn";
    if (pair.released) return "released";
    if (pair.voluntary()) return "voluntary";
    if (pair.written) return "written";
    if (pair.ended) return "ended";
    return pair.sent ? "sent" : "allotted";
}

}  // namespace

std::string OfficeViews::reviews(const std::string& assignment) {
    const std::lock_guard lock(mutex_);
    const Instant now = CourseClock::now();
    OfficeReviews all;
    std::optional<Assignment> chosen;
    for (const Assignment& a : assignments_of(course_)) {
        if (!a.is_report()) continue;
        all.assignments.push_back(a.name);
        if (!chosen || a.name == assignment) chosen = a;
    }
    if (!chosen) return json_of(all);
    all.assignment = chosen->name;
    all.over = now > chosen->review_due.value_or(kNoDeadline) + chosen->grace;
    for (const Criterion& one : chosen->criteria) all.criteria.push_back({one.name, one.max_points});
    const Marks marks = course_marks(course_, *chosen, now);
    GivenPoints given = points_by_owner(*chosen, marks.given);
    std::map<std::int64_t, const ReviewMark*> reviewed;
    for (const ReviewMark& mark : marks.reviews) reviewed[mark.pair] = &mark;
    std::map<std::int64_t, std::string> pseudonyms;
    std::map<std::int64_t, int> wanted;
    for (const ReviewPair& pair : review_pairs(course_, *chosen)) {
        OfficeReview review;
        review.reviewer = pair.reviewer_name, review.report = pair.report_pseudonym();
        review.author = pair.author_name, review.state = state_of_pair(pair);
        review.points = given.pairs[pair.id];
        review.points.resize(chosen->criteria.size());
        review.percent = percent_of(chosen->criteria, review.points);
        if (const auto mark = reviewed.find(pair.id); mark != reviewed.end())
            review.outlier = mark->second->outlier, review.retaliation = mark->second->retaliation;
        review.held = is_held(course_, *chosen, pair.reviewer, pair.id);
        review.stopped = pair.stopped_review;
        review.late = pair.late;
        pseudonyms[pair.author] = pair.report_pseudonym();
        wanted[pair.author] += !pair.ended;
        all.reviews.push_back(std::move(review));
    }
    std::map<std::int64_t, const GroupMark*> of_group;
    for (const GroupMark& mark : marks.groups) of_group[mark.group] = &mark;
    for (const Group& group : groups_of(course_)) {
        const auto mark = of_group.find(group.id);
        if (mark == of_group.end() || !pseudonyms.contains(group.id)) continue;
        all.reports.push_back({group.name, pseudonyms[group.id], marks.work_of(*mark->second).percent,
                               marks.reviews_of(*mark->second).percent, mark->second->scored, wanted[group.id],
                               is_held(course_, *chosen, group.id, {})});
    }
    return json_of(all);
}

std::string OfficeViews::marks() {
    const std::lock_guard lock(mutex_);
    const Instant now = CourseClock::now();
    const CourseTotals totals = course_totals(course_, now);
    OfficeMarks all;
    for (const Assignment& a : totals.assignments) all.assignments.push_back({a.name, a.weight});
    for (std::size_t i = 0; i < totals.students.size(); ++i) {
        const Student& student = totals.students[i];
        OfficeMarksRow row{student.id, student.name, student.group, {}, {}, {}};
        for (const AssignmentMark& own : totals.marks[i]) {
            row.percent.push_back(own.percent);
            row.state.emplace_back(own.missing ? "missing" : own.open ? "open" : "");
        }
        row.total = weighted_total(totals.assignments, totals.marks[i]);
        all.rows.push_back(std::move(row));
    }
    const ExportChanges changes = changed_since_export(course_, totals_csv(totals));
    if (changes.exported) all.exported = shown(*changes.exported);
    for (const ChangedCell& cell : changes.cells)
        all.changes.push_back({cell.name.empty() ? cell.student : cell.name, cell.column, cell.before, cell.now});
    return json_of(all);
}

}  // namespace dynlab::inline app
