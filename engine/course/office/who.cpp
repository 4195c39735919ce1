#include "course/office/who.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "base/reader.h"
#include "course/store/groups.h"
#include "course/store/inspection.h"
#include "course/store/receipts.h"
#include "numerics/error.h"
#include "platform/terminal/aligned_table.h"

namespace dynlab::inline course {
namespace {

class WhoIs {
  public:
    WhoIs(Course& course, const std::string& name, Instant now) : course_(course), now_(now) {
        for (const Student& student : students_of(course)) students_[student.id] = student;
        try {
            facts_.people = {student_named(course, name)};
            for (Rows rows = course.database().query(
                     "SELECT group_id FROM memberships WHERE student = ? ORDER BY since", facts_.people.front().id);
                 rows.next();)
                groups_.push_back(rows.integer(0));
        } catch (const InvalidArgument&) {  // a group, then, or a name that several bear
            const Group group = group_named(course, name);
            groups_ = {group.id};
            for (const std::string& id : group.members) facts_.people.push_back(students_[id]);
        }
        for (const std::int64_t group : groups_) read_members(group);
        for (const Assignment& assignment : assignments_of(course)) read_work(assignment);
        read_history();
    }

    WhoFacts facts() { return std::move(facts_); }

  private:
    std::string name_of(std::int64_t group) const {
        Rows rows = course_.database().query("SELECT name FROM groups WHERE id = ?", group);
        return rows.next() ? rows.text(0) : "";
    }

    void read_members(std::int64_t group) {
        WhoGroup read{name_of(group), {}};
        for (Rows rows = course_.database().query(
                 "SELECT student, since, until FROM memberships WHERE group_id = ? ORDER BY since, student", group);
             rows.next();) {
            const auto known = students_.find(rows.text(0));
            read.members.push_back(
                {known == students_.end() || known->second.name.empty() ? rows.text(0) : known->second.name,
                 rows.optional_integer(2)});
        }
        facts_.groups.push_back(std::move(read));
    }

    void read_work(const Assignment& assignment) {
        WhoWork work{assignment, {}, {}, {}};
        for (const std::int64_t group : std::set<std::int64_t>(groups_.begin(), groups_.end())) {
            read_versions(assignment, group, work);
            for (Rows rows = course_.database().query(
                     "SELECT stage, due_at, reason FROM extensions WHERE assignment = ? AND group_id = ? ORDER BY id",
                     assignment.id, group);
                 rows.next();)
                work.extensions.push_back({rows.text(0), rows.optional_integer(1), rows.text(2)});
        }
        const auto marks = marks_of_students(course_, assignment, now_);
        for (const Student& person : facts_.people)
            if (const auto mark = marks.find(person.id); mark != marks.end())
                work.marks.push_back({person.name.empty() ? person.id : person.name, mark->second});
        facts_.work.push_back(std::move(work));
    }

    void read_versions(const Assignment& assignment, std::int64_t group, WhoWork& work) const {
        for (Rows rows = course_.database().query("SELECT w.id, w.stage, w.part, w.number, w.received_at, w.withdrawn, "
                                                  "w.findings, w.name, ifnull((SELECT s.late "
                                                  "FROM standing s WHERE s.id = w.id), 0), w.hash FROM arrived w WHERE "
                                                  "w.assignment = ? AND w.group_id = ? ORDER "
                                                  "BY w.received_at, w.id",
                                                  assignment.id, group);
             rows.next();) {
            const Inspection seen = inspection_from(rows.text(6));
            work.versions.push_back({name_of(group), rows.text(1), rows.text(2), rows.text(7), rows.text(9),
                                     rows.integer(0), rows.integer(3), rows.integer(8), rows.integer(4),
                                     rows.integer(5) != 0, seen.error_reason.empty() ? Message() : seen.reason});
        }
    }

    /// Lines that name one of the groups or people as a whole word.
    void read_history() {
        std::vector<std::string> names;
        for (const std::int64_t group : groups_) names.push_back(name_of(group));
        for (const Student& person : facts_.people) names.push_back(person.id);
        const auto names_one = [&](const std::string& line) {
            return std::ranges::any_of(names, [&](const std::string& name) {
                if (name.empty()) return false;
                const std::string words = " " + line + " ";
                for (std::size_t at = words.find(" " + name); at != words.npos; at = words.find(" " + name, at + 1)) {
                    // A text that the instructor wrote, as the course's name, may contain an id such as 2026.
                    if (std::count(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(at), '"') % 2 != 0)
                        continue;
                    const char after = words[at + name.size() + 1];
                    if (!std::isalnum(static_cast<unsigned char>(after)) && after != '-') return true;
                }
                return false;
            });
        };
        for (JournalLine& line : journal_of(course_))
            if (names_one(line.what)) facts_.history.push_back(std::move(line));
    }

    Course& course_;
    Instant now_;
    std::map<std::string, Student> students_;
    std::vector<std::int64_t> groups_;
    WhoFacts facts_;
};

std::string person_text(const Student& person) {
    std::vector<std::string> facts = {person.id};
    for (const std::string& fact : {person.mail, person.language}) facts.push_back(fact);
    if (!person.moodle.empty()) facts.push_back("Moodle " + person.moodle);
    if (!person.canvas.empty()) facts.push_back("Canvas " + person.canvas);
    std::erase(facts, "");
    std::string text = fmt::format("{} ({})\n", person.name, fmt::join(facts, ", "));
    for (const FormerName& former : person.former) text += fmt::format("  before: {} {}\n", former.name, former.mail);
    return text;
}

std::string membership_text(const WhoGroup& group, const CourseClock& clock) {
    std::string text = group.name + ":";
    for (const WhoMember& member : group.members) {
        text += " " + member.name;
        if (member.until) text += fmt::format(" (until {})", clock.show(*member.until));
        text += ";";
    }
    text.back() = '\n';
    return text;
}

std::string work_text(const WhoWork& work, const CourseClock& clock) {
    std::vector<std::vector<std::string>> rows;
    for (const WhoVersion& version : work.versions)
        rows.push_back({version.group, fmt::format("{} {} v{}", version.stage, version.part, version.number),
                        clock.show(version.received),
                        version.withdrawn ? "withdrawn"
                        : !version.error_reason.empty()
                            ? fmt::format("{}: {}", version.name, message_text(version.error_reason))
                        : version.late > 0 ? "late by " + duration_text(version.late)
                                           : "on time",
                        fmt::format("{:05}", version.id)});
    std::string text = fmt::format("\n{} ({})\n", work.assignment.name, work.assignment.kind);
    if (!rows.empty()) text += aligned_table({"group", "what", "received", "state", "receipt"}, rows);
    for (const WhoExtension& extension : work.extensions)
        text += fmt::format("  {} is due {} ({})\n", extension.stage,
                            extension.due ? clock.show(*extension.due) : std::string("as for all"), extension.reason);
    for (const auto& [name, mark] : work.marks)
        text += fmt::format("  mark of {}: {}\n", name,
                            mark.missing   ? std::string("0 percent, nothing was submitted")
                            : mark.percent ? fmt::format("{:.4g} percent", *mark.percent)
                            : mark.open    ? std::string("not marked yet")
                                           : std::string("-"));
    return text;
}

}  // namespace

WhoFacts who_is(Course& course, const std::string& name, Instant now) {
    return WhoIs(course, name, now).facts();
}

std::string who_text(Course& course, const std::string& name, Instant now) {
    const WhoFacts facts = who_is(course, name, now);
    std::string text;
    for (const Student& person : facts.people) text += person_text(person);
    for (const WhoGroup& group : facts.groups) text += membership_text(group, course.clock());
    for (const WhoWork& work : facts.work) text += work_text(work, course.clock());
    if (!facts.history.empty()) text += "\nHistory\n";
    for (const JournalLine& line : facts.history)
        text += fmt::format("  {}  {}\n", course.clock().show_exactly(line.at), line.what);
    return text;
}

}  // namespace dynlab::inline course
