#include "course/store/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "data_io/values/json_values.h"

namespace dynlab::inline course {

DYNLAB_DESCRIBE(CheckPoints, id, points, earned, graded)

namespace {

std::string name_of(Course& course, std::int64_t group) {
    Rows rows = course.database().query("SELECT name FROM groups WHERE id = ?", group);
    return rows.next() ? rows.text(0) : "";
}

/// One version of a lab with its newest result.
struct GradedVersion {
    std::int64_t group = 0, number = 0, late = 0;
    std::optional<std::vector<CheckPoints>> checks;
};

/// In the order in which they were received.
std::vector<GradedVersion> graded_versions(Course& course, const Assignment& assignment) {
    std::vector<GradedVersion> versions;
    for (Rows rows = course.database().query(
             "SELECT s.group_id, s.number, s.late, (SELECT r.checks FROM results r WHERE r.version = s.id ORDER BY "
             "r.id "
             "DESC LIMIT 1) FROM standing s WHERE s.assignment = ? AND s.stage = 'first' AND s.part IN ('script', "
             "'pack') ORDER BY s.received_at, s.id",
             assignment.id);
         rows.next();) {
        GradedVersion version{rows.integer(0), rows.integer(1), rows.integer(2), {}};
        if (!rows.isColumnNull(3)) version.checks = checks_in(rows.text(3));
        versions.push_back(std::move(version));
    }
    return versions;
}

using MarksByItem = std::map<std::string, GivenMark>;

/// With what the instructor gave for single checks, and with the penalty.
LabMark mark_of(const Assignment& assignment, const GradedVersion& version, const MarksByItem& given) {
    LabMark mark{version.group, version.number, {}, 0, 0, false, ""};
    if (!version.checks) return mark;
    double earned = 0;
    bool whole = !version.checks->empty();
    for (const CheckPoints& check : *version.checks) {
        const auto own = given.find(check.id);
        mark.possible += check.points;
        whole = whole && (check.graded || own != given.end());
        earned += own != given.end() ? *own->second.points : check.graded ? check.earned : 0;
    }
    mark.penalty = earned * late_percent(assignment.costs, version.late) / 100;
    if (whole) mark.earned = earned - mark.penalty;
    return mark;
}

}  // namespace

std::vector<CheckPoints> checks_in(const std::string& json) {
    return from_json<std::vector<CheckPoints>>(json);
}

std::vector<GivenMark> marks_ever_given(Course& course, const Assignment& assignment) {
    std::vector<GivenMark> marks;
    for (Rows rows = course.database().query("SELECT group_id, ifnull(student, ''), item, points, reason FROM marks "
                                             "WHERE assignment = ? ORDER BY id",
                                             assignment.id);
         rows.next();)
        marks.push_back({rows.integer(0), rows.text(1), rows.text(2),
                         rows.isColumnNull(3) ? std::nullopt : std::optional(rows.number(3)), rows.text(4)});
    return marks;
}

std::vector<GivenMark> marks_in_force(Course& course, const Assignment& assignment) {
    std::map<std::tuple<std::int64_t, std::string, std::string>, GivenMark> newest;
    for (const GivenMark& mark : marks_ever_given(course, assignment))
        newest[{mark.group, mark.student, mark.item}] = mark;
    std::vector<GivenMark> marks;
    for (const auto& [key, mark] : newest)
        if (mark.points) marks.push_back(mark);
    return marks;
}

bool give_mark(Course& course, const Assignment& assignment, const GivenMark& mark, Instant now) {
    for (const GivenMark& known : marks_in_force(course, assignment))
        if (known.group == mark.group && known.student == mark.student && known.item == mark.item &&
            known.points == mark.points && known.reason == mark.reason)
            return false;
    std::optional<std::string> student;
    if (!mark.student.empty()) student = mark.student;
    course.database().run(
        "INSERT INTO marks (assignment, group_id, student, item, points, reason, made_at) VALUES (?, ?, ?, ?, ?, ?, ?)",
        assignment.id, mark.group, student, mark.item, mark.points, mark.reason, now);
    const std::string who = mark.student.empty() ? name_of(course, mark.group) : mark.student,
                      what = mark.item == kWholeItem ? "the whole" : mark.item,
                      why = mark.reason.empty() ? "" : "; reason: " + mark.reason;
    course.note(mark.points
                    ? fmt::format("{}: {} has {} points for {}{}", assignment.name, who, *mark.points, what, why)
                    : fmt::format("{}: the points of {} for {} are taken back{}", assignment.name, who, what, why),
                now);
    return true;
}

void record_result(Course& course, const VersionResult& result, Instant now) {
    const std::string checks = json_of(result.checks);
    Rows newest = course.database().query(
        "SELECT checks, fingerprint FROM results WHERE version = ? ORDER BY id DESC LIMIT 1", result.version);
    if (newest.next() && newest.text(0) == checks && newest.text(1) == result.fingerprint) return;
    double earned = 0, possible = 0;
    bool whole = !result.checks.empty();
    for (const CheckPoints& check : result.checks)
        earned += check.earned, possible += check.points, whole = whole && check.graded;
    course.database().run(
        "INSERT INTO results (version, earned, possible, checks, fingerprint, made_at) VALUES (?, ?, ?, ?, ?, ?)",
        result.version, whole ? std::optional(earned) : std::nullopt, possible, checks, result.fingerprint, now);
}

std::optional<double> LabMark::percent() const {
    if (!earned || possible <= 0) return {};
    return 100 * *earned / possible;
}

std::vector<LabMark> lab_marks(Course& course, const Assignment& assignment, const std::string& student) {
    std::map<std::int64_t, MarksByItem> given;
    for (const bool own : {false, true})  // a student's own marks go before those of the group
        for (const GivenMark& mark : marks_in_force(course, assignment))
            if (own ? !student.empty() && mark.student == student : mark.student.empty())
                given[mark.group][mark.item] = mark;
    std::map<std::int64_t, LabMark> marks;
    double possible = 0;
    for (const GradedVersion& version : graded_versions(course, assignment)) {
        const LabMark mark = mark_of(assignment, version, given[version.group]);
        possible = std::max(possible, mark.possible);
        const auto [known, fresh] = marks.emplace(version.group, mark);
        const bool better = mark.earned.value_or(-1) >= known->second.earned.value_or(-1);
        if (!fresh && (assignment.keep == "newest" || better)) known->second = mark;
    }
    for (const auto& [group, items] : given) {
        const auto whole = items.find(kWholeItem);
        if (whole == items.end()) continue;
        LabMark& mark = marks[group];
        mark.group = group, mark.earned = whole->second.points, mark.penalty = 0;
        mark.possible = mark.possible > 0 ? mark.possible : possible;
        mark.by_hand = true, mark.reason = whole->second.reason;
    }
    std::vector<LabMark> all;
    for (const auto& [group, mark] : marks) all.push_back(mark);
    return all;
}

}  // namespace dynlab::inline course
