#include "course/review/oral_marks.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/store/newest_versions.h"
#include "numerics/error.h"
#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

/// Whose a row of the sheet is: a group's, or a student's.
struct RowOwner {
    std::int64_t group = 0;
    std::string student;  ///< its id; else the row is of the whole group
    auto operator<=>(const RowOwner&) const = default;
};

std::map<std::string, CriterionPoints> student_points(Course& course, const Assignment& a) {
    std::map<std::string, CriterionPoints> points;
    for (Rows rows = course.database().query(
             "SELECT student, criterion, points FROM student_scores WHERE assignment = ? ORDER BY given_at", a.id);
         rows.next();) {
        CriterionPoints& own = points.try_emplace(rows.text(0), a.criteria.size()).first->second;
        const auto c = static_cast<std::size_t>(rows.integer(1));
        if (c < own.size()) own[c] = rows.isColumnNull(2) ? std::nullopt : std::optional(rows.number(2));
    }
    return points;
}

/// Finds whose rows are.
class RowOwners {
  public:
    explicit RowOwners(Course& course) : course_(course) {}

    /// Throws InvalidArgument.
    RowOwner find(const std::string& group, const std::string& student) const {
        if (student.empty()) return {group_named(course_, group).id, ""};
        const Student found = student_named(course_, student);
        if (found.group.empty()) throw InvalidArgument("{} is in no group", found.id);
        const Group own = group_named(course_, found.group);
        if (!group.empty() && group_named(course_, group).id != own.id)
            throw InvalidArgument("{} is in {}, not in {}", found.id, own.name, group);
        return {own.id, found.id};
    }

  private:
    Course& course_;
};

/// Reads a sheet into the store.
class OralReader {
  public:
    OralReader(Course& course, const Assignment& a, Instant now)
        : course_(course), a_(a), now_(now), groups_(groups_of(course)), said_(oral_comments(course, a)) {
        for (const auto& [group, points] : oral_points(course, a)) known_[{group, ""}] = points;
        for (const auto& [student, points] : student_points(course, a)) students_[student] = points;
    }

    int read(const ScoreSheet& sheet) {
        const RowOwners owners(course_);
        Transaction transaction(course_.database());
        for (std::size_t row = 0; row < sheet.rows(); ++row) {
            const RowOwner owner = sheet.at(row, [&] { return owner_of(owners, sheet, row); });
            for (std::size_t c = 0; c < a_.criteria.size(); ++c) read_points(sheet, row, c, owner);
            if (const std::string comment = sheet.cell(row, "comment"); !comment.empty()) comment_on(owner, comment);
        }
        if (fresh_ > 0) course_.note(fmt::format("{}: {} scores and comments of the oral read", a_.name, fresh_), now_);
        transaction.commit();
        return fresh_;
    }

  private:
    RowOwner owner_of(const RowOwners& owners, const ScoreSheet& sheet, std::size_t row) {
        const RowOwner owner = owners.find(sheet.cell(row, "group"), sheet.cell(row, "student"));
        if (sheet.has_points(row))
            for (const Group& group : groups_)
                if (group.id == owner.group) refuse_dropped_out(group);
        return owner;
    }

    CriterionPoints& points_of(const RowOwner& owner) {
        if (owner.student.empty()) return known_.try_emplace(owner, a_.criteria.size()).first->second;
        return students_.try_emplace(owner.student, a_.criteria.size()).first->second;
    }

    void read_points(const ScoreSheet& sheet, std::size_t row, std::size_t c, const RowOwner& owner) {
        const ScoreEntry entry = sheet.entry(row, c);
        std::optional<double>& known = points_of(owner)[c];
        if (!entry.given || known == entry.points) return;
        const auto criterion = static_cast<std::int64_t>(c);
        if (owner.student.empty())
            course_.database().run(
                "INSERT INTO oral_scores VALUES (?, ?, ?, ?, ?) ON CONFLICT DO UPDATE SET points = excluded.points",
                a_.id, owner.group, criterion, now_, entry.points);
        else
            course_.database().run(
                "INSERT INTO student_scores VALUES (?, ?, ?, ?, ?) ON CONFLICT DO UPDATE SET points = excluded.points",
                a_.id, owner.student, criterion, now_, entry.points);
        known = entry.points;
        ++fresh_;
    }

    void comment_on(const RowOwner& owner, const std::string& comment) {
        std::string& said = owner.student.empty() ? said_.groups[owner.group] : said_.students[owner.student];
        if (said == comment) return;
        std::optional<std::string> student;
        if (!owner.student.empty()) student = owner.student;
        course_.database().run(
            "INSERT INTO oral_comments (assignment, group_id, student, comment, made_at) VALUES (?, ?, ?, ?, ?)", a_.id,
            owner.group, student, comment, now_);
        said = comment;
        ++fresh_;
    }

    Course& course_;
    const Assignment& a_;
    Instant now_;
    std::vector<Group> groups_;
    OralComments said_;
    std::map<RowOwner, CriterionPoints> known_;
    std::map<std::string, CriterionPoints> students_;
    int fresh_ = 0;
};

void refuse_report(const Assignment& a) {
    if (a.is_report()) throw InvalidArgument("{} is a report: its marks come from reviews, not from an oral", a.name);
}

void put_points(std::vector<std::string>& row, const CriterionPoints* points, std::size_t criteria) {
    for (std::size_t c = 0; c < criteria; ++c)
        row.push_back(points && (*points)[c] ? fmt::format("{}", *(*points)[c]) : "");
}

template <class Map, class Key>
const typename Map::mapped_type* given_for(const Map& map, const Key& key) {
    const auto found = map.find(key);
    return found == map.end() ? nullptr : &found->second;
}

}  // namespace

std::map<std::int64_t, CriterionPoints> oral_points(Course& course, const Assignment& a) {
    std::map<std::int64_t, CriterionPoints> points;
    for (Rows rows = course.database().query(
             "SELECT group_id, criterion, points FROM oral_scores WHERE assignment = ? ORDER BY given_at", a.id);
         rows.next();) {
        CriterionPoints& own = points.try_emplace(rows.integer(0), a.criteria.size()).first->second;
        const auto c = static_cast<std::size_t>(rows.integer(1));
        if (c < own.size()) own[c] = rows.isColumnNull(2) ? std::nullopt : std::optional(rows.number(2));
    }
    return points;
}

OralComments oral_comments(Course& course, const Assignment& a) {
    OralComments said;
    for (Rows rows = course.database().query(
             "SELECT group_id, student, comment FROM oral_comments WHERE assignment = ? ORDER BY id", a.id);
         rows.next();)
        (rows.isColumnNull(1) ? said.groups[rows.integer(0)] : said.students[rows.text(1)]) = rows.text(2);
    return said;
}

int import_oral_scores(Course& course, const Assignment& a, const std::filesystem::path& file, Instant now) {
    refuse_report(a);
    return OralReader(course, a, now).read(ScoreSheet(a, file, {"group", "student"}, {"name", "comment"}));
}

std::string oral_sheet(Course& course, const Assignment& a, const OralSheetWishes& wishes) {
    refuse_report(a);
    TextTable table;
    table.names = {"group"};
    if (wishes.students) table.names.insert(table.names.end(), {"student", "name"});
    for (const Criterion& c : a.criteria) table.names.push_back(c.name);
    table.names.emplace_back("comment");
    std::vector<Group> groups = groups_of(course);
    const auto lot = [&](const Group& group) {
        return hmac_sha256(course.key(), {"dynlab oral order\n", a.name, "\n", group.name});
    };
    if (wishes.drawn) std::ranges::sort(groups, [&](const Group& x, const Group& y) { return lot(x) < lot(y); });
    std::map<std::string, std::string> names;
    for (const Student& student : students_of(course)) names[student.id] = student.name;
    const auto points = oral_points(course, a);
    const auto own_points = student_points(course, a);
    const OralComments said = oral_comments(course, a);
    const auto finish = [&](std::vector<std::string> row, const CriterionPoints* given, const std::string* comment) {
        put_points(row, given, a.criteria.size());
        row.push_back(comment ? *comment : "");
        table.rows.push_back(std::move(row));
    };
    for (const Group& group : groups) {
        if (group.dropped_out) continue;
        std::vector<std::string> row = {group.name};
        if (wishes.students) row.resize(3);
        finish(row, given_for(points, group.id), given_for(said.groups, group.id));
        if (!wishes.students) continue;
        for (const std::string& id : group.members)
            finish({group.name, id, names[id]}, given_for(own_points, id), given_for(said.students, id));
    }
    return csv_text(table);
}

void count_missing_points(const Assignment& a, const std::vector<bool>& graded, CriterionPoints& points,
                          std::vector<std::string>& zeros) {
    for (std::size_t c = 0; c < points.size(); ++c) {
        if (points[c] || !graded[c]) continue;
        points[c] = 0;
        zeros.push_back(a.criteria[c].name);
    }
}

bool has_points(const CriterionPoints& points) {
    return std::ranges::any_of(points, [](const auto& p) { return p.has_value(); });
}

std::vector<bool> graded_criteria(Course& course, const Assignment& a) {
    std::vector<bool> graded(a.criteria.size());
    const auto see = [&](const auto& all) {
        for (const auto& [owner, points] : all)
            for (std::size_t c = 0; c < graded.size(); ++c) graded[c] = graded[c] || points[c];
    };
    see(oral_points(course, a)), see(student_points(course, a));
    return graded;
}

void add_student_marks(Course& course, const Assignment& a, std::vector<GroupMark>& marks) {
    const std::vector<bool> graded = graded_criteria(course, a);
    const auto own_points = student_points(course, a);
    for (const auto& [id, group] : author_groups(course, a)) {
        const CriterionPoints* const own = given_for(own_points, id);
        if (!own || !has_points(*own)) continue;
        for (GroupMark& mark : marks) {
            if (mark.group != group) continue;
            StudentMark student{id, mark.medians, {}, {}};
            for (std::size_t c = 0; c < own->size(); ++c)
                if ((*own)[c]) student.points[c] = (*own)[c];
            count_missing_points(a, graded, student.points, student.zeros);
            student.work = percent_of(a.criteria, student.points);
            if (student.work) student.work = std::max(0.0, *student.work - mark.work_costs);
            mark.students.push_back(std::move(student));
        }
    }
}

}  // namespace dynlab::inline course
