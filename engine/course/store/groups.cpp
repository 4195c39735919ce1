#include "course/store/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "course/anonymity/name_patterns.h"
#include "course/intake/owners.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/spelling.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/small_letters.h"

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

/// The same words in any order: platforms write the family's name first, or last.
bool same_name(const std::string& a, const std::string& b) {
    std::vector<std::string> words = name_words(a), others = name_words(b);
    std::ranges::sort(words), std::ranges::sort(others);
    return words == others;
}

/// Names of Windows devices, and names of files next to the groups' folders in a delivery.
bool is_reserved(const std::string& name) {
    static const std::set<std::string> reserved = {"con", "prn", "aux", "nul", "mail.csv", "moodle.zip"};
    const std::string small = in_small_letters(name), stem = small.substr(0, small.find('.'));
    const bool port = stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) && stem[3] >= '1';
    return reserved.contains(small) || reserved.contains(stem) || (port && stem[3] <= '9');
}

/// Names of groups become names of folders and files: of receipts, and of what is delivered, also on Windows.
void refuse_odd_group(const std::string& name) {
    constexpr std::size_t kMaxNameBytes = 100;
    if (name.size() > kMaxNameBytes)
        throw EnvironmentError("the group's name \"{}...\" must have at most {} bytes, but it has {}",
                               terminal_text(name.substr(0, 40)), kMaxNameBytes, name.size());
    if (is_reserved(name))
        throw EnvironmentError(
            "a group cannot have the name \"{}\", because Windows or dynlab reserves this name. Correct the roster; "
            "nothing was changed",
            name);
    const bool plain = name.find_first_of("/\\\n\r\t") == name.npos && terminal_text(name) == name;
    if (plain && !name.starts_with('.') && !name.ends_with('.')) return;
    throw EnvironmentError(
        "the group's name \"{}\" cannot be the name of a folder: it must not start or end with a period, and must not "
        "contain /, \\ or invisible characters. Correct the roster, in which the id is the group name of a student "
        "without a group; nothing was changed",
        terminal_text(name));
}

class Import {
  public:
    Import(Course& course, const Roster& roster, Instant now)
        : course_(course), db_(course.database()), roster_(roster), now_(now) {}

    RosterChange run() {
        Transaction transaction(db_);
        // The group of a student alone is called by the id, which is no spelling of another name.
        for (Rows rows = db_.query("SELECT name FROM groups WHERE name NOT IN (SELECT id FROM students)"); rows.next();)
            groups_before_.push_back(rows.text(0));
        for (const Student& student : roster_.students())
            for (const std::string& name : names_in(student.group)) in_file_.insert(in_small_letters(name));
        std::set<std::string> present;
        for (const Student& student : roster_.students()) {
            present.insert(student.id);
            take(student);
            move(student);
        }
        for (const Student& known : students_of(course_))
            if (!present.contains(known.id)) change_.absent.push_back(known.id);
        change_.students = static_cast<int>(roster_.students().size());
        if (change_.new_students + change_.changed + std::ssize(change_.moved) > 0)
            course_.note(fmt::format("roster imported: {} students, {} new, {} changed, {} moved", change_.students,
                                     change_.new_students, change_.changed, change_.moved.size()),
                         now_);
        transaction.commit();
        return change_;
    }

  private:
    void take(const Student& s) {
        Rows rows = db_.query("SELECT name, mail, moodle, canvas, language, own_data FROM students WHERE id = ?", s.id);
        std::optional<std::int64_t> seed;
        if (s.seed) seed = *s.seed;
        if (!rows.next()) {
            ++change_.new_students;
            db_.run(
                "INSERT INTO students (id, name, mail, moodle, canvas, language, own_data) VALUES (?, ?, ?, ?, ?, ?, "
                "?)",
                s.id, s.name, s.mail, s.moodle, s.canvas, s.language, seed);
            return;
        }
        const auto kept = [&](const char* column, const std::string& read, int index) {
            return roster_.has(column) ? read : rows.text(index);
        };
        const std::string name = kept("name", s.name, 0), mail = kept("mail", s.mail, 1),
                          moodle = kept("moodle", s.moodle, 2), canvas = kept("canvas", s.canvas, 3),
                          language = kept("language", s.language, 4);
        const std::string old_name = rows.text(0), old_mail = rows.text(1);
        if (!roster_.has("seed")) seed = rows.optional_integer(5);
        if (name == old_name && mail == old_mail && moodle == rows.text(2) && canvas == rows.text(3) &&
            language == rows.text(4) && seed == rows.optional_integer(5))
            return;
        ++change_.changed;
        if ((!same_name(name, old_name) && !old_name.empty()) || (mail != old_mail && !old_mail.empty()))
            db_.run("INSERT INTO former_names VALUES (?, ?, ?, ?) ON CONFLICT DO UPDATE SET until = excluded.until",
                    s.id, old_name, old_mail, now_);
        db_.run(
            "UPDATE students SET name = ?, mail = ?, moodle = ?, canvas = ?, language = ?, own_data = ? WHERE id = ?",
            name, mail, moodle, canvas, language, seed, s.id);
    }

    /// "Groupe 01" is the group-01 of an earlier roster, unless this one has both: then they are two groups.
    std::string known_spelling_of(const std::string& name) const {
        std::vector<std::string> others;
        for (const std::string& known : groups_before_)
            if (!in_file_.contains(in_small_letters(known))) others.push_back(known);
        return Owners({}, others).called(name).group;
    }

    std::int64_t group(const std::string& name) {
        for (const std::string& spelling : {name, known_spelling_of(name)}) {
            Rows rows = db_.query("SELECT id FROM groups WHERE name = ?", spelling);
            if (rows.next()) return rows.integer(0);
        }
        refuse_odd_group(name);
        ++change_.new_groups;
        db_.run("INSERT INTO groups (name, joined_at) VALUES (?, ?)", name, now_);
        return db_.getLastInsertRowid();
    }

    void move(const Student& student) {
        std::set<std::int64_t> requested, present;
        std::vector<std::string> from;
        for (Rows rows = db_.query("SELECT m.group_id, g.name FROM memberships m JOIN groups g ON g.id = m.group_id "
                                   "WHERE m.student = ? AND m.until IS NULL ORDER BY g.name",
                                   student.id);
             rows.next();)
            present.insert(rows.integer(0)), from.push_back(rows.text(1));
        if (!roster_.has("group") && !present.empty()) return;
        for (const std::string& name : names_in(student.group.empty() ? student.id : student.group))
            requested.insert(group(name));
        if (requested == present) return;
        if (!present.empty())
            change_.moved.push_back({student.id, fmt::format("{}", fmt::join(from, "|")),
                                     student.group.empty() ? student.id : student.group});
        for (const std::int64_t id : present)
            if (!requested.contains(id))
                // A first membership was there before the roster that says so: `since` may come after `now_`.
                db_.run(
                    "UPDATE memberships SET until = ?1, since = min(since, ?1 - 1) WHERE student = ?2 AND group_id "
                    "= ?3 AND until IS NULL",
                    now_, student.id, id);
        for (const std::int64_t id : requested)
            if (!present.contains(id))
                // Back within the second of having left: the same membership.
                db_.run("INSERT INTO memberships VALUES (?, ?, ?, NULL) ON CONFLICT DO UPDATE SET until = NULL",
                        student.id, id, now_);
    }

    Course& course_;
    Database& db_;
    const Roster& roster_;
    std::vector<std::string> groups_before_;
    std::set<std::string> in_file_;  ///< names of groups in lower-case letters
    const Instant now_;
    RosterChange change_;
};

}  // namespace

std::vector<Group> groups_of(Course& course) {
    std::vector<Group> groups;
    std::map<std::int64_t, std::size_t> index;
    for (Rows rows = course.database().query(
             "SELECT id, name, left_at FROM groups WHERE id IN (SELECT group_id FROM memberships WHERE until IS NULL "
             "UNION SELECT group_id FROM versions UNION SELECT group_id FROM marks) ORDER BY name");
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
    const std::vector<Group> groups = groups_of(course);
    std::vector<std::string> names;
    for (const Group& group : groups) {
        if (::strcasecmp(group.name.c_str(), name.c_str()) == 0) return group;
        names.push_back(group.name);
    }
    const std::vector<Student> students = students_of(course);
    const Owners owners(students, names);
    const Owners::Found found = owners.called(name);
    if (const auto group = std::ranges::find(groups, found.group, &Group::name); group != groups.end()) return *group;
    if (found.doubtful) throw InvalidArgument("\"{}\" is ambiguous: {}", name, found.error_reason);
    const auto near = nearest_word(name, owners.names());
    if (near) throw InvalidArgument("the group \"{}\" does not exist; did you mean {}?", name, *near);
    throw names.empty() ? InvalidArgument(
                              "the group \"{}\" does not exist, because the course has no groups yet; import the "
                              "roster with dynlab course import",
                              name)
                        : InvalidArgument("the group \"{}\" does not exist; an example of an existing group is \"{}\"",
                                          name, names.front());
}

Student student_named(Course& course, const std::string& name) {
    const std::vector<Student> students = students_of(course);
    const auto by_id = std::ranges::find(students, name, &Student::id);
    if (by_id != students.end()) return *by_id;
    std::vector<Student> alone = students;  // each is an owner, also of those who share a group
    for (Student& student : alone) student.group.clear();
    const Owners owners(alone);
    const Owners::Found found = owners.called(name);
    if (found.anybody()) return students[found.students.front()];
    if (found.doubtful) throw InvalidArgument("several students are named \"{}\": give the id", name);
    const auto near = nearest_word(name, owners.names());
    throw near ? InvalidArgument("unknown student \"{}\"; did you mean {}?", name, *near)
               : InvalidArgument("unknown student \"{}\"", name);
}

std::vector<std::string> members_at(Course& course, std::int64_t group, Instant at) {
    std::vector<std::string> members;
    for (Rows rows = course.database().query(
             "SELECT DISTINCT student FROM memberships m WHERE group_id = ?1 AND ifnull(until, ?2 + 1) > ?2 AND "
             "(since <= ?2 OR since = (SELECT min(since) FROM memberships f WHERE f.student = m.student)) "
             "ORDER BY student",
             group, at);
         rows.next();)
        members.push_back(rows.text(0));
    return members;
}

std::vector<Student> students_of(Course& course) {
    std::vector<Student> students;
    for (Rows rows = course.database().query(
             "SELECT s.id, s.name, coalesce(min(g.name), ''), s.mail, s.moodle, s.canvas, s.language, s.own_data FROM "
             "students s "
             "LEFT JOIN memberships m ON m.student = s.id AND m.until IS NULL LEFT JOIN groups g ON g.id = m.group_id "
             "GROUP BY s.id ORDER BY s.id");
         rows.next();) {
        Student student{rows.text(0), rows.text(1), rows.text(2), {}, rows.text(3), rows.text(4), rows.text(5)};
        student.language = rows.text(6);
        if (const auto seed = rows.optional_integer(7)) student.seed = static_cast<std::uint32_t>(*seed);
        students.push_back(std::move(student));
    }
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

RosterChange import_roster(Course& course, const std::filesystem::path& file, bool no_groups, Instant now) {
    const Roster roster(file);
    if (roster.students().empty())
        throw EnvironmentError("{}: the file has no students below the header", file.string());
    if (!roster.has("group") && !no_groups)
        throw EnvironmentError(
            "{}: the column \"group\" is missing; the file has the columns {}. dynlab recognizes \"id\", \"name\", "
            "\"group\", \"email\" (or \"mail\"), \"moodle\" and \"canvas\". Add the column, or specify --no-groups if "
            "each student works alone",
            file.string(), listed(roster.columns()));
    RosterChange change = Import(course, roster, now).run();
    change.unknown_columns = roster.unknown_columns();
    change.short_ids = numbers_too_short(roster.students());
    change.converted = roster.converted();
    return change;
}

void set_group_dropped_out(Course& course, const std::string& name, bool dropped_out, const std::string& reason) {
    Transaction transaction(course.database());
    const Group group = group_named(course, name);
    if (group.dropped_out == dropped_out)
        throw dropped_out ? InvalidArgument("{} has already dropped out", group.name)
                          : InvalidArgument("{} is already in the course", group.name);
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
