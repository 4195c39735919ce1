#include "course/office/course_work.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/grading/feedback.h"
#include "course/grading/late_penalties.h"
#include "course/store/inspection.h"
#include "course/store/newest_versions.h"
#include "numerics/error.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// "group-07", "group-07 v2", "group-07 pack", "group-07 unreadable".
std::string name_of(const Group& group, const std::string& part, std::int64_t number) {
    return group.name + (part == "script" ? "" : " " + part) + (number > 1 ? fmt::format(" v{}", number) : "");
}

}  // namespace

std::vector<CourseWork::Stored> CourseWork::read(Course& course, const Assignment& assignment) {
    work_.students = lone_students_of(course);
    work_.roster = !work_.students.empty();
    work_.newest_counts = assignment.keep == "newest";
    for (const Group& group : groups_of_authors(course, assignment)) groups_.emplace(group.id, group);
    std::vector<Stored> versions;
    for (Rows rows = course.database().query(
             "SELECT id, group_id, number, part, hash, name, received_at, first_at, due_at, EXISTS (SELECT 1 FROM "
             "arrivals a WHERE a.version = s.id), findings FROM standing s WHERE assignment = ?1 AND stage = 'first' "
             "AND group_id IS NOT NULL AND (part <> ?2 OR NOT EXISTS (SELECT 1 FROM standing r WHERE r.assignment = ?1 "
             "AND r.group_id = s.group_id AND r.part <> ?2 AND r.received_at >= s.received_at)) ORDER BY group_id, "
             "number, part",
             assignment.id, kUnreadable);
         rows.next();) {
        const Inspection seen = inspection_from(rows.text(10));
        if (seen.error_reason == kBeside) continue;
        versions.push_back({rows.integer(0), rows.integer(1), rows.integer(2), rows.text(3), rows.text(4), rows.text(5),
                            rows.integer(6), rows.integer(7), rows.integer(8), rows.integer(9) != 0, seen.reason});
    }
    say_what_a_mark_covers(course, assignment, versions);
    work_.deadlines = assignment.first_due != kNoDeadline ||
                      std::ranges::any_of(versions, [](const Stored& v) { return v.due != kNoDeadline; });
    return versions;
}

/// A mark for the complete submission also holds for a version that came later.
void CourseWork::say_what_a_mark_covers(Course& course, const Assignment& assignment,
                                        const std::vector<Stored>& versions) {
    for (const GivenMark& mark : marks_in_force(course, assignment)) {
        if (mark.item != kWholeItem || mark.version != 0 || !mark.student.empty()) continue;
        Rows made = course.database().query("SELECT made_at FROM marks WHERE id = ?", mark.id);
        if (!made.next()) continue;
        for (const Stored& version : versions)
            if (version.group == mark.group && version.received > made.integer(0) && version.part != kUnreadable)
                work_.attention.push_back(
                    Message("\"{}\" arrived after you marked the complete submission; your mark of {} still counts. To "
                            "count the new submission instead, withdraw your mark (dynlab course withdraw {} {} --mark "
                            "\"*\" --reason \"...\")",
                            name_of(groups_.at(version.group), version.part, version.number), points_text(*mark.points),
                            assignment.name, groups_.at(version.group).name));
    }
}

CourseWork::CourseWork(Course& course, const Assignment& assignment) {
    for (const Stored& version : read(course, assignment)) add(course, version, assignment);
    take_marks(course, assignment);
    conclude_lateness(work_);
}

CourseWork::CourseWork(Course& course, const Assignment& assignment, const ReceivedClass& received) {
    std::map<std::int64_t, Stored> versions;
    for (Stored& version : read(course, assignment)) versions.emplace(version.id, std::move(version));
    for (WorkItem item : received.items) {
        const auto version = versions.find(item.version);
        if (version != versions.end()) {
            date(item, version->second, assignment);
        } else if (item.version != 0) {
            work_.notes.push_back(Message("\"{}\" is withdrawn and left out", item.submission.name));
            continue;
        }
        item.addressee = item.submission.person;
        address(item);
        work_.items.push_back(std::move(item));
    }
    take_marks(course, assignment, received.complaints);
    conclude_lateness(work_);
}

void CourseWork::take_marks(Course& course, const Assignment& assignment, std::vector<Message> complaints) {
    std::ranges::move(complaints, std::back_inserter(work_.complaints));
    const std::vector<GivenMark> marks = marks_in_force(course, assignment);
    for (WorkItem& item : work_.items) {
        item.given.clear();
        for (const GivenMark& mark : marks) {
            if (!mark.student.empty() || mark.group != item.group_id) continue;
            // A mark of this version goes before that of all versions.
            if (mark.version == item.version || (mark.version == 0 && !item.given.contains(mark.item)))
                item.given[mark.item] = {*mark.points, mark.reason};
        }
    }
}

void CourseWork::date(WorkItem& item, const Stored& version, const Assignment& assignment) const {
    item.received = version.received;
    const Costs& costs = assignment.costs;
    item.lateness = lateness_of({version.due, assignment.grace, costs.late_day, costs.late_max}, version.first);
    if (needs_confirmation(item.lateness) && !version.confirmed) item.lateness = unconfirmed(item.lateness);
}

/// Adds the file under a name that shows its kind.
void CourseWork::add(Course& course, const Stored& version, const Assignment& assignment) {
    const Group& group = groups_.at(version.group);
    const bool pack = version.part == "pack";
    const auto stem = archive_stem(version.name);
    const std::string ending = stem ? version.name.substr(stem->size()) : ".zip";
    const fs::path copy =
        files_.path() / std::to_string(work_.items.size()) / (pack ? group.name + ending : "analysis.lua");
    fs::create_directories(copy.parent_path());
    fs::copy_file(course.file(version.hash), copy);
    WorkItem item;
    item.content = version.hash, item.version = version.id, item.group_id = version.group;
    date(item, version, assignment);
    item.submission.name = name_of(group, version.part, version.number);
    item.submission.path = copy;
    if (version.part == kUnreadable)
        item.unreadable = version.reason.empty() ? Message("The submitted file cannot be read.") : version.reason;
    item.submission.archive = pack;
    if (!pack) item.submission.loose = {{copy, "analysis.lua"}};
    const std::vector<std::string>& members = group.members;
    for (std::size_t place = 0; place < work_.students.size(); ++place)
        if (std::ranges::find(members, work_.students[place].id) != members.end()) item.students.push_back(place);
    if (item.students.empty())
        item.unmatched = Message("the group {} had no members at the time of submission", group.name);
    const bool alone = item.students.size() == 1 && work_.students[item.students.front()].id == group.name;
    if (!alone) item.group = group.name;
    address(item);
    work_.items.push_back(std::move(item));
}

/// Whom the feedback is for, in which language, and whose data the script had.
void CourseWork::address(WorkItem& item) const {
    if (!item.group.empty()) item.addressee = item.group;
    for (const std::size_t place : item.students) {
        const Student& student = work_.students[place];
        if (item.group.empty()) item.addressee = student.name.empty() ? student.id : student.name;
        if (!student.language.empty()) item.language = student.language;
        if (student.seed) item.seed = student.seed;
    }
}

void CourseWork::choose(Course& course, const std::vector<std::string>& names) {
    std::vector<bool> requested(work_.items.size(), names.empty());
    for (const std::string& name : names) {
        bool found = false;
        const auto take = [&](const auto& fits) {
            for (std::size_t i = 0; i < requested.size(); ++i)
                if (fits(work_.items[i])) requested[i] = found = true;
        };
        take([&](const WorkItem& item) {
            const Submission& s = item.submission;
            return s.name == name || s.lms_id == name || s.person == name || s.path.filename() == name;
        });
        try {
            if (!found) take([id = group_named(course, name).id](const WorkItem& item) { return item.group_id == id; });
        } catch (const InvalidArgument&) {  // the error below says so
        }
        if (!found) throw EnvironmentError("no submission, group or student is named \"{}\"", name);
    }
    for (std::size_t i = 0; i < requested.size(); ++i)
        if (requested[i]) work_.chosen.push_back(i);
}

std::vector<const WorkItem*> CourseWork::waiting() const {
    std::vector<const WorkItem*> items;
    for (const WorkItem& item : work_.items)
        if (item.lateness.waiting_percent > 0) items.push_back(&item);
    return items;
}

std::optional<CourseWork::Marked> CourseWork::marked_by(Course& course, const MarkedItems::Found& found,
                                                        const std::string& who) {
    if (!found.error_reason.empty()) return {};
    if (!found.items.empty()) {
        const WorkItem& item = *found.items.front();
        if (item.group_id == 0) return {};  // it could not be kept, and has no owner
        return Marked{item.group_id, found.by_name ? item.version : 0};
    }
    try {
        return Marked{group_named(course, who).id, 0};
    } catch (const InvalidArgument&) {
        return {};
    }
}

std::vector<std::string> CourseWork::names_of(std::int64_t group, std::int64_t version) const {
    std::vector<std::string> names;
    for (const WorkItem& item : work_.items)
        if (item.group_id == group && (version == 0 || version == item.version)) names.push_back(item.submission.name);
    const auto found = groups_.find(group);
    if (names.empty() && version == 0 && found != groups_.end()) names.push_back(found->second.name);
    return names;
}

}  // namespace dynlab::inline course
