#include "app/office/office_views.h"

#include <fmt/format.h>

#include "base/languages.h"
#include "course/office/course_status.h"
#include "course/office/who.h"
#include "course/store/groups.h"
#include "data_io/values/json_values.h"

namespace dynlab::inline app {
namespace {

struct OfficeAssignment {
    std::string name, kind, lesson;
    double weight = 1;
};
DYNLAB_DESCRIBE(OfficeAssignment, name, kind, lesson, weight)

/// A group, or a student.
struct OfficePerson {
    std::string name, id, mail, group;
};
DYNLAB_DESCRIBE(OfficePerson, name, id, mail, group)

struct OfficeCourse {
    std::string name, zone, folder;
    std::vector<OfficeAssignment> assignments;
    std::vector<OfficePerson> people;
};
DYNLAB_DESCRIBE(OfficeCourse, name, zone, folder, assignments, people)

struct OfficeDeadline {
    std::string stage, due;
    std::int64_t seconds = 0;  ///< from now on
};
DYNLAB_DESCRIBE(OfficeDeadline, stage, due, seconds)

/// One thing that the instructor may want to do about a group.
struct OfficeTask {
    std::string group, kind, stage, about, text;
    std::string received;   ///< of a late file
    std::int64_t late = 0;  ///< seconds
    double costs = 0;       ///< percent that wait for a confirmation
};
DYNLAB_DESCRIBE(OfficeTask, group, kind, stage, about, text, received, late, costs)

struct OfficeFile {
    std::string name, hash, received, reason;
};
DYNLAB_DESCRIBE(OfficeFile, name, hash, received, reason)

struct OfficeToday {
    std::string name, kind, next;
    std::vector<OfficeDeadline> deadlines;
    std::vector<OfficeTask> tasks;
    std::vector<OfficeFile> not_taken;
    int groups = 0, present = 0, late = 0, unreadable = 0, missing = 0;
};
DYNLAB_DESCRIBE(OfficeToday, name, kind, next, deadlines, tasks, not_taken, groups, present, late, unreadable, missing)

struct OfficeVersion {
    std::string group, stage, part, name, hash, received, trouble;
    std::int64_t number = 0, receipt = 0, late = 0;
    bool withdrawn = false;
};
DYNLAB_DESCRIBE(OfficeVersion, group, stage, part, name, hash, received, trouble, number, receipt, late, withdrawn)

struct OfficeExtension {
    std::string stage, due, reason;
};
DYNLAB_DESCRIBE(OfficeExtension, stage, due, reason)

struct OfficeOwnMark {
    std::string name;
    std::optional<double> percent;
    bool missing = false, open = false;
};
DYNLAB_DESCRIBE(OfficeOwnMark, name, percent, missing, open)

struct OfficeWork {
    std::string name, kind;
    std::vector<OfficeVersion> versions;
    std::vector<OfficeExtension> extensions;
    std::vector<OfficeOwnMark> marks;
};
DYNLAB_DESCRIBE(OfficeWork, name, kind, versions, extensions, marks)

struct OfficeMember {
    std::string name, until;
};
DYNLAB_DESCRIBE(OfficeMember, name, until)

struct OfficeGroup {
    std::string name;
    std::vector<OfficeMember> members;
};
DYNLAB_DESCRIBE(OfficeGroup, name, members)

struct OfficeLine {
    std::string at, what;
};
DYNLAB_DESCRIBE(OfficeLine, at, what)

/// One student with the groups that the student was in, or one group with its students.
struct OfficeFacts {
    std::vector<OfficePerson> people;
    std::vector<std::string> former;  ///< names and addresses of before
    std::vector<OfficeGroup> groups;
    std::vector<OfficeWork> work;
    std::vector<OfficeLine> history;
};
DYNLAB_DESCRIBE(OfficeFacts, people, former, groups, work, history)

void add_late_task(const Assignment& a, const GroupState& state, const SubmittedFile& file, const std::string& stage,
                   const std::string& received, std::vector<OfficeTask>& tasks) {
    if (!file.is_late()) return;
    const bool waits = stage == "first" && waits_for_confirmation(a.costs, file.late, file.confirmed);
    tasks.push_back({state.group.name, waits ? "late-waits" : "late", stage, "", duration_text(file.late), received,
                     file.late, waits ? late_percent(a.costs, file.late) : 0});
}

}  // namespace

OfficeViews::OfficeViews(const std::filesystem::path& folder, std::function<void()> more)
    : course_(folder), answers_(std::move(more)) {}

std::int64_t OfficeViews::revision() {
    const std::lock_guard lock(mutex_);
    Rows rows = course_.database().query("PRAGMA data_version");
    return rows.next() ? rows.integer(0) : 0;
}

std::string OfficeViews::shown(Instant instant) const {
    const std::string text = course_.clock().show(instant);
    return text.substr(text.find(' ') + 1);
}

std::string OfficeViews::course() {
    const std::lock_guard lock(mutex_);
    OfficeCourse all{course_.name(), course_.clock().zone(), course_.folder().string(), {}, {}};
    for (const Assignment& a : assignments_of(course_)) all.assignments.push_back({a.name, a.kind, a.lesson, a.weight});
    for (const Group& group : groups_of(course_)) all.people.push_back({group.name, "", "", group.name});
    for (const Student& student : students_of(course_))
        all.people.push_back({student.name, student.id, student.mail, student.group});
    return json_of(all);
}

std::string OfficeViews::today(const std::string& language) {
    const std::lock_guard lock(mutex_);
    const Instant now = CourseClock::now();
    const Reader reader{catalog_of(language)};
    std::vector<OfficeToday> all;
    for (const Assignment& a : assignments_of(course_)) {
        const AssignmentState state = assignment_state(course_, a, now);
        OfficeToday today{
            a.name,        a.kind,     state.next,       {},           {}, {}, static_cast<int>(state.groups.size()),
            state.present, state.late, state.unreadable, state.missing};
        const auto add_deadline = [&](const char* stage, std::optional<Instant> due) {
            if (due && *due != kNoDeadline) today.deadlines.push_back({stage, shown(*due), *due - now});
        };
        add_deadline("first", a.first_due), add_deadline("review", a.review_due), add_deadline("final", a.final_due);
        for (const GroupState& group : state.groups) {
            for (const ToDo& thing : group.to_do)
                today.tasks.push_back({group.group.name, thing.kind, thing.stage, thing.about, thing.text, "", 0, 0});
            for (const auto& [stage, parts] : {std::pair("first", &group.first), std::pair("final", &group.last)})
                if (const auto file = parts->find(a.document()); file != parts->end())
                    add_late_task(a, group, file->second, stage, shown(file->second.received_at), today.tasks);
        }
        for (const FileNotTaken& file : files_not_taken(course_, a))
            today.not_taken.push_back(
                {file.name, file.hash, shown(file.received_at), message_text(file.reason, reader)});
        all.push_back(std::move(today));
    }
    return json_of(all);
}

std::string OfficeViews::student(const std::string& name, const std::string& language) {
    const std::lock_guard lock(mutex_);
    const Reader reader{catalog_of(language)};
    const WhoFacts facts = who_is(course_, name, CourseClock::now());
    OfficeFacts all;
    for (const Student& person : facts.people) {
        all.people.push_back({person.name, person.id, person.mail, person.group});
        for (const FormerName& former : person.former)
            all.former.push_back(former.mail.empty() ? former.name : fmt::format("{} ({})", former.name, former.mail));
    }
    for (const WhoGroup& group : facts.groups) {
        OfficeGroup& read = all.groups.emplace_back();
        read.name = group.name;
        for (const WhoMember& member : group.members)
            read.members.push_back({member.name, member.until ? shown(*member.until) : ""});
    }
    for (const WhoWork& work : facts.work) {
        OfficeWork& read = all.work.emplace_back();
        read.name = work.assignment.name, read.kind = work.assignment.kind;
        for (const WhoVersion& one : work.versions)
            read.versions.push_back({one.group, one.stage, one.part, one.name, one.hash, shown(one.received),
                                     message_text(one.error_reason, reader), one.number, one.id, one.late,
                                     one.withdrawn});
        for (const WhoExtension& one : work.extensions)
            read.extensions.push_back({one.stage, one.due ? shown(*one.due) : "", one.reason});
        for (const auto& [whose, mark] : work.marks)
            read.marks.push_back({whose, mark.percent, mark.missing, mark.open});
    }
    for (const JournalLine& line : facts.history)
        all.history.push_back({course_.clock().show_exactly(line.at), line.what});
    return json_of(all);
}

}  // namespace dynlab::inline app
