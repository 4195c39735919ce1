#include "course/store/marks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "data_io/values/json_values.h"
#include "numerics/error.h"

namespace dynlab::inline course {

DYNLAB_DESCRIBE(CheckPoints, id, points, earned, graded)

namespace {

std::string name_of(Course& course, std::int64_t group) {
    Rows rows = course.database().query("SELECT name FROM groups WHERE id = ?", group);
    return rows.next() ? rows.text(0) : "";
}

/// Whose mark it is, by whom, and for what.
using MarkKey = std::tuple<std::int64_t, std::string, std::string, std::int64_t, std::string>;
MarkKey key_of(const GivenMark& mark) {
    return {mark.group, mark.student, mark.stage, mark.pair, mark.item};
}

std::vector<CheckPoints> checks_in(const std::string& json) {
    return from_json<std::vector<CheckPoints>>(json);
}

/// One version of a lab with its newest result.
struct GradedVersion {
    std::int64_t id = 0, group = 0, number = 0, late = 0;
    bool confirmed = false;  ///< the time of receipt was corrected or confirmed
    std::optional<std::vector<CheckPoints>> checks;
};

/// In the order in which they were received.
std::vector<GradedVersion> graded_versions(Course& course, const Assignment& assignment) {
    std::vector<GradedVersion> versions;
    for (Rows rows = course.database().query(
             "SELECT s.id, s.group_id, s.number, s.late, (SELECT r.checks FROM results r WHERE r.version = s.id ORDER "
             "BY r.id DESC LIMIT 1), EXISTS (SELECT 1 FROM arrivals a WHERE a.version = s.id) FROM standing s WHERE "
             "s.assignment = ? AND s.stage = 'first' AND s.part IN ('script', 'pack', 'unreadable') AND s.group_id IS "
             "NOT NULL "
             "ORDER BY s.received_at, s.id",
             assignment.id);
         rows.next();) {
        GradedVersion version{rows.integer(0), rows.integer(1),      rows.integer(2),
                              rows.integer(3), rows.integer(5) != 0, {}};
        if (!rows.isColumnNull(4)) version.checks = checks_in(rows.text(4));
        versions.push_back(std::move(version));
    }
    return versions;
}

using MarksByItem = std::map<std::string, GivenMark>;

/// With what the instructor gave, and with the penalty.
LabMark mark_of(const Assignment& assignment, const GradedVersion& version, const MarksByItem& given) {
    LabMark mark;
    mark.group = version.group, mark.number = version.number, mark.version = version.id;
    mark.checks = version.checks.value_or(std::vector<CheckPoints>());
    std::vector<std::string> own_reasons;
    for (const auto& [item, own] : given)
        if (!own.student.empty() && !own.reason.empty()) own_reasons.push_back(own.reason);
    mark.own_reasons = fmt::format("{}", fmt::join(own_reasons, "; "));
    double earned = 0;
    for (CheckPoints& check : mark.checks) {
        if (const auto own = given.find(check.id); own != given.end())
            check.earned = *own->second.points, check.graded = true;
        mark.possible += check.points;
        if (check.graded) earned += check.earned;
    }
    const double penalty = earned * late_percent(assignment.costs, version.late) / 100;
    if (std::ranges::any_of(mark.checks, &CheckPoints::graded)) mark.by_checks = earned - penalty;
    if (const auto own = given.find(kWholeItem); own != given.end()) {
        mark.earned = own->second.points, mark.by_hand = true, mark.reason = own->second.reason;
        return mark;
    }
    if (!waits_for_confirmation(assignment.costs, version.late, version.confirmed)) mark.penalty = penalty;
    if (mark.by_checks && std::ranges::all_of(mark.checks, &CheckPoints::graded)) mark.earned = earned - mark.penalty;
    return mark;
}

/// Withdrawn or not.
bool submitted_anything(Course& course, const Assignment& assignment, std::int64_t group) {
    return course.database()
        .query("SELECT 1 FROM versions WHERE assignment = ? AND group_id = ? AND stage = 'first'", assignment.id, group)
        .next();
}

/// Whether a version counts instead of one that came before. One without marks never counts before one with marks.
bool counts_before(const LabMark& later, const LabMark& earlier, bool newest_counts) {
    const auto merit = [](const LabMark& one) {
        const double by_checks = one.by_checks.value_or(-1);
        return std::pair(one.by_hand ? *one.earned : by_checks, by_checks);
    };
    const double none = -1;
    if (newest_counts && merit(later).first > none && merit(earlier).first > none) return true;
    return merit(later) >= merit(earlier);
}

}  // namespace

std::string item_called(const Assignment& assignment, const std::string& name) {
    return !assignment.is_lab() && name == "work" ? kWholeItem : name;
}

std::vector<GivenMark> marks_in_force(Course& course, const Assignment& assignment, std::optional<std::int64_t> until) {
    std::map<MarkKey, std::map<std::int64_t, GivenMark>> newest;  // by version
    for (Rows rows = course.database().query(
             "SELECT group_id, ifnull(student, ''), item, points, reason, ifnull(version, 0), id, ifnull(pair, 0), "
             "stage FROM marks m WHERE assignment = ? AND id <= ? AND item <> 'comment' AND (version IS NULL OR EXISTS "
             "(SELECT 1 FROM standing s WHERE s.id = m.version)) ORDER BY id",
             assignment.id, until.value_or(std::numeric_limits<std::int64_t>::max()));
         rows.next();) {
        GivenMark mark{rows.integer(0), rows.text(1),    rows.text(2),    {},          rows.text(4),
                       rows.integer(5), rows.integer(6), rows.integer(7), rows.text(8)};
        if (!rows.isColumnNull(3)) mark.points = rows.number(3);
        auto& by_version = newest[key_of(mark)];
        if (mark.version == 0 || mark.pair != 0) by_version.clear();  // a reviewer's is of the review as it is now
        by_version[mark.version] = std::move(mark);
    }
    std::vector<GivenMark> marks;
    for (const auto& [key, by_version] : newest)
        for (const auto& [version, mark] : by_version)
            if (mark.points) marks.push_back(mark);
    std::ranges::sort(marks, {}, &GivenMark::id);
    return marks;
}

int enter_marks(Course& course, const Assignment& assignment, const std::vector<GivenMark>& marks, Instant now) {
    std::map<std::pair<MarkKey, std::int64_t>, GivenMark> known;
    const auto place_of = [](const GivenMark& mark) {
        return std::pair(key_of(mark), mark.pair != 0 ? std::int64_t{0} : mark.version);
    };
    for (GivenMark& mark : marks_in_force(course, assignment)) known[place_of(mark)] = std::move(mark);
    int fresh = 0;
    for (const GivenMark& mark : marks) {
        GivenMark& before = known[place_of(mark)];
        if (before.points == mark.points && (before.reason == mark.reason || !mark.points)) continue;
        before = mark;
        ++fresh;
        course.database().run(
            "INSERT INTO marks (assignment, group_id, student, stage, pair, version, item, points, reason, made_at) "
            "VALUES (?, ?, nullif(?, ''), ?, nullif(?, 0), nullif(?, 0), ?, ?, ?, ?)",
            assignment.id, mark.group, mark.student, mark.stage, mark.pair, mark.version, mark.item, mark.points,
            mark.reason, now);
    }
    return fresh;
}

bool give_mark(Course& course, const Assignment& assignment, const GivenMark& mark, Instant now) {
    if (enter_marks(course, assignment, {mark}, now) == 0) return false;
    const std::string who = mark.student.empty() ? name_of(course, mark.group) : mark.student,
                      what = mark.item == kWholeItem ? "the whole" : mark.item,
                      why = mark.reason.empty() ? "" : "; reason: " + mark.reason;
    const char* const unit = assignment.is_lab() ? "points" : "percent";
    course.note(mark.points
                    ? fmt::format("{}: {} has {} {} for {}{}", assignment.name, who, *mark.points, unit, what, why)
                    : fmt::format("{}: the {} of {} for {} are withdrawn{}", assignment.name, unit, who, what, why),
                now);
    return true;
}

void take_back_mark(Course& course, const Assignment& assignment, const std::string& who, bool alone,
                    const std::string& item, const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    const std::string student = alone ? student_named(course, who).id : "";
    const Group group = alone ? Group() : group_named(course, who);
    bool any = false;
    for (const GivenMark& mark : marks_in_force(course, assignment))
        if (mark.pair == 0 && mark.stage == "first" && mark.student == student && mark.item == item &&
            (alone || mark.group == group.id))
            any = give_mark(course, assignment, {mark.group, student, item, {}, reason, mark.version}, now) || any;
    if (!any) throw InvalidArgument("{} has no manual mark for {}", alone ? student : group.name, item);
}

std::map<std::int64_t, MarkEntry> newest_entries(Course& course, const Assignment& assignment,
                                                 const std::string& item) {
    std::map<std::int64_t, MarkEntry> newest;
    for (Rows rows = course.database().query(
             "SELECT group_id, id, points, reason, made_at FROM marks WHERE assignment = ? AND item = ? AND student IS "
             "NULL AND pair IS NULL AND stage = 'first' ORDER BY id",
             assignment.id, item);
         rows.next();) {
        MarkEntry& entry = newest[rows.integer(0)] = {rows.integer(1), {}, rows.text(3), rows.integer(4)};
        if (!rows.isColumnNull(2)) entry.points = rows.number(2);
    }
    return newest;
}

void refuse_unseen_entry(Course& course, const Assignment& assignment, std::int64_t group, const std::string& who,
                         const std::string& item, std::int64_t seen) {
    const MarkEntry newest = newest_entries(course, assignment, item)[group];
    if (newest.id == seen) return;
    const std::string at = course.clock().show_exactly(newest.at);
    if (newest.points)
        throw InvalidArgument(
            "the mark was not changed: {} already has the mark {} for {}, entered at {} (\"{}\"). Check this mark, "
            "then try again",
            who, *newest.points, item, at, newest.reason);
    throw InvalidArgument(
        "the mark was not changed: the earlier mark of {} for {} was withdrawn at {} (\"{}\"). Check the history, then "
        "try again",
        who, item, at, newest.reason);
}

std::optional<double> max_points_of(Course& course, const Assignment& assignment, const std::string& item) {
    if (!assignment.is_lab()) {
        if (item == kReviewsItem) refuse_without_reviews(assignment);
        if (item == kReviewsItem || item == kWholeItem) return 100;
        throw InvalidArgument("{} has no mark \"{}\"; the marks are \"work\" and, for a report, \"reviews\"",
                              assignment.name, item);
    }
    const std::vector<CheckPoints> checks = newest_checks(course, assignment);
    if (checks.empty()) return {};
    double whole = 0;
    std::vector<std::string> ids;
    for (const CheckPoints& check : checks) {
        if (check.id == item) return check.points;
        whole += check.points;
        ids.push_back(check.id);
    }
    if (item == kWholeItem) return whole;
    throw InvalidArgument("{} has no check \"{}\"; the checks are {}, and * means the complete submission",
                          assignment.name, item, listed(ids));
}

std::vector<CheckPoints> newest_checks(Course& course, const Assignment& assignment) {
    Rows rows = course.database().query(
        "SELECT r.checks FROM results r JOIN versions v ON v.id = r.version WHERE v.assignment = ? AND r.possible > 0 "
        "ORDER BY r.id DESC LIMIT 1",
        assignment.id);
    return rows.next() ? checks_in(rows.text(0)) : std::vector<CheckPoints>();
}

bool save_result(Course& course, const VersionResult& result, Instant now) {
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

std::vector<LabMark> lab_marks(Course& course, const Assignment& assignment, const std::string& student,
                               const std::set<std::int64_t>* versions) {
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
    std::vector<CheckPoints> without_points = newest_checks(course, assignment);
    for (CheckPoints& check : without_points) check.earned = 0, check.graded = true;
    std::map<std::int64_t, LabMark> marks;
    double possible = 0;
    for (const GradedVersion& version : graded_versions(course, assignment)) {
        if (versions != nullptr && !versions->contains(version.id)) continue;
        const LabMark mark = mark_of(assignment, version, given_to(version.group, version.id));
        possible = std::max(possible, mark.possible);
        const auto [known, fresh] = marks.emplace(version.group, mark);
        if (!fresh && counts_before(mark, known->second, assignment.keep == "newest")) known->second = mark;
    }
    for (const auto* with_marks : {&of_group, &own})
        for (const auto& [group, items] : *with_marks) {
            GradedVersion nothing;
            nothing.group = group;
            const MarksByItem given = given_to(group, 0);
            if (!submitted_anything(course, assignment, group)) nothing.checks = without_points;
            if (nothing.checks || given.contains(kWholeItem))
                marks.try_emplace(group, mark_of(assignment, nothing, given));
        }
    for (auto& [group, mark] : marks)
        if (mark.by_hand && mark.possible == 0) mark.possible = possible;
    std::vector<LabMark> all;
    for (const auto& [group, mark] : marks) all.push_back(mark);
    return all;
}

}  // namespace dynlab::inline course
