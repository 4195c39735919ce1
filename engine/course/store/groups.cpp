#include "course/store/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "course/anonymity/name_patterns.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/spelling.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {
namespace {

std::set<std::string> names_in(const std::string& cell) {
    std::set<std::string> names;
    for (std::size_t at = 0; at <= cell.size();) {
        const std::size_t end = std::min(cell.find('|', at), cell.size());
        std::string name = cell.substr(at, end - at);
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        if (!name.empty()) names.insert(name);
        at = end + 1;
    }
    return names;
}

/// Names of groups become names of folders and files: of receipts, and of what is returned.
void refuse_odd_group(const std::string& name) {
    constexpr std::size_t kMostBytes = 100;
    if (name.size() > kMostBytes)
        throw EnvironmentError("the group's name \"{}...\" is too long: at most {} bytes, but it has {}",
                               terminal_text(name.substr(0, 40)), kMostBytes, name.size());
    if (!name.starts_with('.') && name.find_first_of("/\\\n\r\t") == name.npos && terminal_text(name) == name) return;
    throw EnvironmentError(
        "the group's name \"{}\" cannot name a folder: it must not begin with a full stop, nor hold /, \\ or "
        "characters that cannot be seen. Correct the roster, where the id names the group of who has none; nothing was "
        "changed",
        terminal_text(name));
}

class Import {
  public:
    Import(Course& course, const Roster& roster) : course_(course), db_(course.database()), roster_(roster) {}

    RosterChange run() {
        Transaction transaction(db_);
        std::set<std::string> present;
        for (const Student& student : roster_.students()) {
            present.insert(student.id);
            take(student);
            move(student);
        }
        for (const Student& known : students_of(course_))
            if (!present.contains(known.id)) change_.absent.push_back(known.id);
        change_.students = static_cast<int>(roster_.students().size());
        if (change_.new_students + change_.changed + change_.moved > 0)
            course_.note(fmt::format("roster imported: {} students, {} new, {} changed, {} moved", change_.students,
                                     change_.new_students, change_.changed, change_.moved),
                         now_);
        transaction.commit();
        return change_;
    }

  private:
    void take(const Student& s) {
        Rows rows = db_.query("SELECT name, mail, moodle, canvas FROM students WHERE id = ?", s.id);
        if (!rows.next()) {
            ++change_.new_students;
            db_.run("INSERT INTO students VALUES (?, ?, ?, ?, ?)", s.id, s.name, s.mail, s.moodle, s.canvas);
            return;
        }
        const std::vector<std::string> before = {rows.text(0), rows.text(1), rows.text(2), rows.text(3)};
        const auto kept = [&](const char* column, const std::string& read, std::size_t index) {
            return roster_.has(column) ? read : before[index];
        };
        const std::vector<std::string> after = {kept("name", s.name, 0), kept("mail", s.mail, 1),
                                                kept("moodle", s.moodle, 2), kept("canvas", s.canvas, 3)};
        if (after == before) return;
        ++change_.changed;
        if ((after[0] != before[0] && !before[0].empty()) || (after[1] != before[1] && !before[1].empty()))
            db_.run("INSERT INTO former_names VALUES (?, ?, ?, ?) ON CONFLICT DO UPDATE SET until = excluded.until",
                    s.id, before[0], before[1], now_);
        db_.run("UPDATE students SET name = ?, mail = ?, moodle = ?, canvas = ? WHERE id = ?", after[0], after[1],
                after[2], after[3], s.id);
    }

    std::int64_t group(const std::string& name) {
        Rows rows = db_.query("SELECT id FROM groups WHERE name = ?", name);
        if (rows.next()) return rows.integer(0);
        refuse_odd_group(name);
        ++change_.new_groups;
        db_.run("INSERT INTO groups (name, joined_at) VALUES (?, ?)", name, now_);
        return db_.getLastInsertRowid();
    }

    void move(const Student& student) {
        std::set<std::int64_t> wanted, present;
        for (Rows rows = db_.query("SELECT group_id FROM memberships WHERE student = ? AND until IS NULL", student.id);
             rows.next();)
            present.insert(rows.integer(0));
        if (!roster_.has("group") && !present.empty()) return;
        for (const std::string& name : names_in(student.group.empty() ? student.id : student.group))
            wanted.insert(group(name));
        if (wanted == present) return;
        if (!present.empty()) ++change_.moved;
        for (const std::int64_t id : present)
            if (!wanted.contains(id))
                db_.run("UPDATE memberships SET until = ? WHERE student = ? AND group_id = ? AND until IS NULL", now_,
                        student.id, id);
        for (const std::int64_t id : wanted)
            if (!present.contains(id))
                // Back within the second of having left: the same membership.
                db_.run("INSERT INTO memberships VALUES (?, ?, ?, NULL) ON CONFLICT DO UPDATE SET until = NULL",
                        student.id, id, now_);
    }

    Course& course_;
    Database& db_;
    const Roster& roster_;
    const Instant now_ = CourseClock::now();
    RosterChange change_;
};

}  // namespace

std::vector<Group> groups_of(Course& course) {
    std::vector<Group> groups;
    std::map<std::int64_t, std::size_t> index;
    for (Rows rows = course.database().query(
             "SELECT id, name, left_at FROM groups WHERE id IN (SELECT group_id FROM memberships WHERE until IS NULL "
             "UNION SELECT group_id FROM versions UNION SELECT group_id FROM oral_scores UNION SELECT group_id FROM "
             "overrides) ORDER BY name");
         rows.next();) {
        index[rows.integer(0)] = groups.size();
        groups.push_back({rows.integer(0), rows.text(1), !rows.isColumnNull(2), {}});
    }
    for (Rows rows =
             course.database().query("SELECT group_id, student FROM memberships WHERE until IS NULL ORDER BY student");
         rows.next();)
        groups[index.at(rows.integer(0))].members.push_back(rows.text(1));
    return groups;
}

Group group_named(Course& course, const std::string& name) {
    std::vector<std::string> names;
    for (const Group& group : groups_of(course)) {
        if (::strcasecmp(group.name.c_str(), name.c_str()) == 0) return group;
        names.push_back(group.name);
    }
    const auto near = nearest_word(name, names);
    throw near ? InvalidArgument("there is no group \"{}\" in this course; did you mean {}?", name, *near)
               : InvalidArgument(
                     "there is no group \"{}\" in this course; see dynlab course status for those there are", name);
}

std::vector<Student> students_of(Course& course) {
    std::vector<Student> students;
    for (Rows rows = course.database().query(
             "SELECT s.id, s.name, coalesce(min(g.name), ''), s.mail, s.moodle, s.canvas FROM students s "
             "LEFT JOIN memberships m ON m.student = s.id AND m.until IS NULL LEFT JOIN groups g ON g.id = m.group_id "
             "GROUP BY s.id ORDER BY s.id");
         rows.next();)
        students.push_back({rows.text(0), rows.text(1), rows.text(2), {}, rows.text(3), rows.text(4), rows.text(5)});
    std::map<std::string, std::size_t> index;
    for (std::size_t i = 0; i < students.size(); ++i) index[students[i].id] = i;
    for (Rows rows = course.database().query("SELECT student, name, mail FROM former_names ORDER BY student, until");
         rows.next();)
        students[index.at(rows.text(0))].former.push_back({rows.text(1), rows.text(2)});
    for (Rows rows = course.database().query(
             "SELECT DISTINCT m.student, g.name FROM memberships m JOIN groups g ON g.id = m.group_id ORDER BY 1, 2");
         rows.next();) {
        Student& student = students[index.at(rows.text(0))];
        if (rows.text(1) != student.group) student.other_groups.push_back(rows.text(1));
    }
    return students;
}

RosterChange import_roster(Course& course, const std::filesystem::path& file, bool no_groups) {
    const Roster roster(file);
    if (roster.students().empty()) throw EnvironmentError("{}: there are no students below the header", file.string());
    if (!roster.has("group") && !no_groups)
        throw EnvironmentError(
            "{}: the column group is missing; there are {}, and known are id, name, group, email (or mail), moodle, "
            "canvas. Say --no-groups where each student works alone",
            file.string(), listed(roster.columns()));
    RosterChange change = Import(course, roster).run();
    change.unknown_columns = roster.unknown_columns();
    change.unsought_ids = numbers_too_short(roster.students());
    change.converted = roster.converted();
    return change;
}

void set_group_dropped_out(Course& course, const std::string& name, bool dropped_out, const std::string& reason) {
    Transaction transaction(course.database());
    const Group group = group_named(course, name);
    if (group.dropped_out == dropped_out)
        throw dropped_out ? InvalidArgument("{} has dropped out already", group.name)
                          : InvalidArgument("{} is in the course already", group.name);
    const Instant now = CourseClock::now();
    course.database().run("UPDATE groups SET left_at = ?, left_reason = ? WHERE id = ?",
                          dropped_out ? std::optional(now) : std::nullopt,
                          dropped_out ? std::optional(reason) : std::nullopt, group.id);
    course.note(fmt::format("{} {}{}", group.name, dropped_out ? "dropped out" : "came back",
                            reason.empty() ? "" : ": " + reason),
                now);
    transaction.commit();
}

std::vector<std::pair<std::int64_t, std::int64_t>> kindred_groups(Course& course) {
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    for (Rows rows = course.database().query(
             "SELECT DISTINCT a.group_id, b.group_id FROM memberships a JOIN memberships b ON a.student = b.student "
             "AND a.group_id < b.group_id ORDER BY 1, 2");
         rows.next();)
        pairs.emplace_back(rows.integer(0), rows.integer(1));
    return pairs;
}

}  // namespace dynlab::inline course
