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
    std::int64_t id = 0, group = 0, number = 0, late = 0;
    std::optional<std::vector<CheckPoints>> checks;
};

/// In the order in which they were received.
std::vector<GradedVersion> graded_versions(Course& course, const Assignment& assignment) {
    std::vector<GradedVersion> versions;
    for (Rows rows = course.database().query(
             "SELECT s.id, s.group_id, s.number, s.late, (SELECT r.checks FROM results r WHERE r.version = s.id ORDER "
             "BY "
             "r.id "
             "DESC LIMIT 1) FROM standing s WHERE s.assignment = ? AND s.stage = 'first' AND s.part IN ('script', "
             "'pack') ORDER BY s.received_at, s.id",
             assignment.id);
         rows.next();) {
        GradedVersion version{rows.integer(0), rows.integer(1), rows.integer(2), rows.integer(3), {}};
        if (!rows.isColumnNull(4)) version.checks = checks_in(rows.text(4));
        versions.push_back(std::move(version));
    }
    return versions;
}

using MarksByItem = std::map<std::string, GivenMark>;

LabMark whole_mark(std::int64_t group, std::int64_t number, double possible, const GivenMark& given) {
    return {group, number, given.points, possible, 0, true, given.reason};
}

/// With what the instructor gave, and with the penalty.
LabMark mark_of(const Assignment& assignment, const GradedVersion& version, const MarksByItem& given) {
    LabMark mark{version.group, version.number, {}, 0, 0, false, ""};
    double earned = 0;
    bool whole = version.checks && !version.checks->empty();
    for (const CheckPoints& check : version.checks.value_or(std::vector<CheckPoints>())) {
        const auto own = given.find(check.id);
        mark.possible += check.points;
        whole = whole && (check.graded || own != given.end());
        earned += own != given.end() ? *own->second.points : check.graded ? check.earned : 0;
    }
    if (const auto own = given.find(kWholeItem); own != given.end())
        return whole_mark(version.group, version.number, mark.possible, own->second);
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
    for (Rows rows = course.database().query("SELECT group_id, ifnull(student, ''), item, points, reason, "
                                             "ifnull(version, 0), id FROM marks WHERE assignment = ? ORDER BY id",
                                             assignment.id);
         rows.next();)
        marks.push_back({rows.integer(0), rows.text(1), rows.text(2),
                         rows.isColumnNull(3) ? std::nullopt : std::optional(rows.number(3)), rows.text(4),
                         rows.integer(5), rows.integer(6)});
    return marks;
}

std::vector<GivenMark> marks_in_force(Course& course, const Assignment& assignment, std::optional<std::int64_t> until) {
    std::map<std::tuple<std::int64_t, std::string, std::string>, std::map<std::int64_t, GivenMark>> newest;
    for (const GivenMark& mark : marks_ever_given(course, assignment)) {
        if (until && mark.id > *until) break;
        auto& by_version = newest[{mark.group, mark.student, mark.item}];
        if (mark.version == 0) by_version.clear();
        by_version[mark.version] = mark;
    }
    std::vector<GivenMark> marks;
    for (const auto& [key, by_version] : newest)
        for (const auto& [version, mark] : by_version)
            if (mark.points) marks.push_back(mark);
    return marks;
}

bool give_mark(Course& course, const Assignment& assignment, const GivenMark& mark, Instant now) {
    for (const GivenMark& known : marks_in_force(course, assignment))
        if (known.group == mark.group && known.student == mark.student && known.item == mark.item &&
            known.version == mark.version && known.points == mark.points && known.reason == mark.reason)
            return false;
    std::optional<std::string> student;
    if (!mark.student.empty()) student = mark.student;
    course.database().run(
        "INSERT INTO marks (assignment, group_id, student, item, points, reason, made_at, version) VALUES (?, ?, ?, ?, "
        "?, ?, ?, nullif(?, 0))",
        assignment.id, mark.group, student, mark.item, mark.points, mark.reason, now, mark.version);
    const std::string who = mark.student.empty() ? name_of(course, mark.group) : mark.student,
                      what = mark.item == kWholeItem ? "the whole" : mark.item,
                      why = mark.reason.empty() ? "" : "; reason: " + mark.reason;
    course.note(mark.points
                    ? fmt::format("{}: {} has {} points for {}{}", assignment.name, who, *mark.points, what, why)
                    : fmt::format("{}: the points of {} for {} are taken back{}", assignment.name, who, what, why),
                now);
    return true;
}

bool record_result(Course& course, const VersionResult& result, Instant now) {
    const std::string checks = json_of(result.checks);
    Rows newest = course.database().query(
        "SELECT checks, fingerprint FROM results WHERE version = ? ORDER BY id DESC LIMIT 1", result.version);
    if (newest.next() && newest.text(0) == checks && newest.text(1) == result.fingerprint) return false;
    double possible = 0;
    for (const CheckPoints& check : result.checks) possible += check.points;
    course.database().run(
        "INSERT INTO results (version, possible, checks, fingerprint, made_at) VALUES (?, ?, ?, ?, ?)", result.version,
        possible, checks, result.fingerprint, now);
    return true;
}

std::optional<double> LabMark::percent() const {
    if (!earned || possible <= 0) return {};
    return 100 * *earned / possible;
}

std::vector<LabMark> lab_marks(Course& course, const Assignment& assignment, const std::string& student) {
    // Marks of a version go before those of all, and a student's own before those of the group.
    std::map<std::int64_t, MarksByItem> of_group, of_version, own;
    for (const GivenMark& mark : marks_in_force(course, assignment)) {
        if (!mark.student.empty() && mark.student != student) continue;
        auto& place = !mark.student.empty() ? own[mark.group]
                      : mark.version > 0    ? of_version[mark.version]
                                            : of_group[mark.group];
        place[mark.item] = mark;
    }
    const auto given_to = [&](std::int64_t group, std::int64_t version) {
        MarksByItem given = own[group];
        given.insert(of_version[version].begin(), of_version[version].end());
        given.insert(of_group[group].begin(), of_group[group].end());
        return given;
    };
    std::map<std::int64_t, LabMark> marks;
    double possible = 0;
    for (const GradedVersion& version : graded_versions(course, assignment)) {
        const LabMark mark = mark_of(assignment, version, given_to(version.group, version.id));
        possible = std::max(possible, mark.possible);
        const auto [known, fresh] = marks.emplace(version.group, mark);
        const bool better = mark.earned.value_or(-1) >= known->second.earned.value_or(-1);
        if (!fresh && (assignment.keep == "newest" || better)) known->second = mark;
    }
    for (const auto* with_marks : {&of_group, &own})
        for (const auto& [group, items] : *with_marks) {
            const MarksByItem given = given_to(group, 0);
            if (const auto whole = given.find(kWholeItem); whole != given.end())
                marks.try_emplace(group, whole_mark(group, 0, 0, whole->second));
        }
    for (auto& [group, mark] : marks)
        if (mark.by_hand && mark.possible == 0) mark.possible = possible;
    std::vector<LabMark> all;
    for (const auto& [group, mark] : marks) all.push_back(mark);
    return all;
}

}  // namespace dynlab::inline course
