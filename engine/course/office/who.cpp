#include "course/office/who.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "base/reader.h"
#include "course/office/course_totals.h"
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
            people_ = {student_named(course, name)};
            for (Rows rows = course.database().query(
                     "SELECT group_id FROM memberships WHERE student = ? ORDER BY since", people_.front().id);
                 rows.next();)
                groups_.push_back(rows.integer(0));
        } catch (const InvalidArgument&) {  // a group, then, or a name that several bear
            const Group group = group_named(course, name);
            groups_ = {group.id};
            for (const std::string& id : group.members) people_.push_back(students_[id]);
        }
    }

    std::string text() const {
        std::string text;
        for (const Student& person : people_) text += person_text(person);
        for (const std::int64_t group : groups_) text += membership_text(group);
        for (const Assignment& assignment : assignments_of(course_)) text += work_text(assignment);
        return text + history_text();
    }

  private:
    std::string name_of(std::int64_t group) const {
        Rows rows = course_.database().query("SELECT name FROM groups WHERE id = ?", group);
        return rows.next() ? rows.text(0) : "";
    }

    static std::string person_text(const Student& person) {
        std::vector<std::string> facts = {person.id};
        for (const std::string& fact : {person.mail, person.language}) facts.push_back(fact);
        if (!person.moodle.empty()) facts.push_back("Moodle " + person.moodle);
        if (!person.canvas.empty()) facts.push_back("Canvas " + person.canvas);
        std::erase(facts, "");
        std::string text = fmt::format("{} ({})\n", person.name, fmt::join(facts, ", "));
        for (const FormerName& former : person.former)
            text += fmt::format("  before: {} {}\n", former.name, former.mail);
        return text;
    }

    std::string membership_text(std::int64_t group) const {
        std::string text = name_of(group) + ":";
        for (Rows rows = course_.database().query(
                 "SELECT student, since, until FROM memberships WHERE group_id = ? ORDER BY since, student", group);
             rows.next();) {
            const auto known = students_.find(rows.text(0));
            text += fmt::format(
                " {}", known == students_.end() || known->second.name.empty() ? rows.text(0) : known->second.name);
            if (const auto until = rows.optional_integer(2))
                text += fmt::format(" (until {})", course_.clock().show(*until));
            text += ";";
        }
        text.back() = '\n';
        return text;
    }

    std::string work_text(const Assignment& assignment) const {
        std::vector<std::vector<std::string>> rows;
        std::set<std::int64_t> shown(groups_.begin(), groups_.end());
        for (const std::int64_t group : shown) add_versions(assignment, group, rows);
        std::string text = fmt::format("\n{} ({})\n", assignment.name, assignment.kind);
        if (!rows.empty()) text += aligned_table({"group", "what", "received", "state", "receipt"}, rows);
        for (const std::int64_t group : shown) text += extensions_text(assignment, group);
        const auto marks = marks_of_students(course_, assignment, now_);
        for (const Student& person : people_) {
            const auto mark = marks.find(person.id);
            if (mark == marks.end()) continue;
            const AssignmentMark& own = mark->second;
            text += fmt::format("  mark of {}: {}\n", person.name.empty() ? person.id : person.name,
                                own.missing   ? std::string("0 percent, nothing was submitted")
                                : own.percent ? fmt::format("{:.4g} percent", *own.percent)
                                : own.open    ? std::string("not marked yet")
                                              : std::string("-"));
        }
        return text;
    }

    void add_versions(const Assignment& assignment, std::int64_t group,
                      std::vector<std::vector<std::string>>& table) const {
        for (Rows rows = course_.database().query("SELECT w.id, w.stage, w.part, w.number, w.received_at, w.withdrawn, "
                                                  "w.findings, w.name, ifnull((SELECT s.late "
                                                  "FROM standing s WHERE s.id = w.id), 0) FROM arrived w WHERE "
                                                  "w.assignment = ? AND w.group_id = ? ORDER "
                                                  "BY w.received_at, w.id",
                                                  assignment.id, group);
             rows.next();) {
            const Inspection seen = inspection_from(rows.text(6));
            const std::int64_t late = rows.integer(8);
            table.push_back({name_of(group), fmt::format("{} {} v{}", rows.text(1), rows.text(2), rows.integer(3)),
                             course_.clock().show(rows.integer(4)),
                             rows.integer(5) != 0    ? "withdrawn"
                             : !seen.trouble.empty() ? fmt::format("{}: {}", rows.text(7), message_text(seen.reason))
                             : late > 0              ? "late by " + duration_text(late)
                                                     : "in time",
                             fmt::format("{:05}", rows.integer(0))});
        }
    }

    std::string extensions_text(const Assignment& assignment, std::int64_t group) const {
        std::string text;
        for (Rows rows = course_.database().query(
                 "SELECT stage, due_at, reason FROM extensions WHERE assignment = ? AND group_id = ? ORDER BY id",
                 assignment.id, group);
             rows.next();) {
            const auto due = rows.optional_integer(1);
            text += fmt::format("  {} is due {} ({})\n", rows.text(0),
                                due ? course_.clock().show(*due) : std::string("as for all"), rows.text(2));
        }
        return text;
    }

    /// Lines that name one of the groups or people as a whole word.
    std::string history_text() const {
        std::vector<std::string> names;
        for (const std::int64_t group : groups_) names.push_back(name_of(group));
        for (const Student& person : people_) names.push_back(person.id);
        const auto names_one = [&](const std::string& line) {
            return std::ranges::any_of(names, [&](const std::string& name) {
                if (name.empty()) return false;
                const std::string words = " " + line + " ";
                for (std::size_t at = words.find(" " + name); at != words.npos; at = words.find(" " + name, at + 1)) {
                    const char after = words[at + name.size() + 1];
                    if (!std::isalnum(static_cast<unsigned char>(after)) && after != '-') return true;
                }
                return false;
            });
        };
        std::string text;
        for (Rows rows = course_.database().query("SELECT at, what FROM journal ORDER BY id"); rows.next();)
            if (names_one(rows.text(1)))
                text += fmt::format("  {}  {}\n", course_.clock().show_exactly(rows.integer(0)), rows.text(1));
        return text.empty() ? "" : "\nHistory\n" + text;
    }

    Course& course_;
    Instant now_;
    std::map<std::string, Student> students_;
    std::vector<Student> people_;
    std::vector<std::int64_t> groups_;
};

}  // namespace

std::string who_text(Course& course, const std::string& name, Instant now) {
    return WhoIs(course, name, now).text();
}

}  // namespace dynlab::inline course
