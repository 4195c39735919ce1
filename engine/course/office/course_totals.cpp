#include "course/office/course_totals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "course/review/review_marks.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "course/store/newest_versions.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

/// Percent of a report or a talk. A report's has that of its reviews in it.
std::optional<double> percent_of(const Assignment& a, const Marks& marks, std::int64_t group,
                                 const std::string& student) {
    const auto mark = std::ranges::find(marks.groups, group, &GroupMark::group);
    GroupMark of_group;
    of_group.group = group;
    if (mark != marks.groups.end()) of_group = *mark;
    const std::optional<double> work = marks.work_of(of_group, student).percent,
                                reviews = marks.reviews_of(of_group, student).percent;
    if (!work || !reviews || !a.is_report()) return work;
    const double share = a.reviews_weight / 100;
    return (1 - share) * *work + share * *reviews;
}

/// Of students, for a lab: the mark of the group, or the student's own.
class LabMarks {
  public:
    LabMarks(Course& course, const Assignment& assignment, const std::set<std::int64_t>* versions)
        : course_(course),
          a_(assignment),
          versions_(versions),
          of_groups_(lab_marks(course, assignment, "", versions)) {
        for (const GivenMark& mark : marks_in_force(course, assignment))
            if (!mark.student.empty()) with_own_.insert(mark.student);
        for (const CheckPoints& check : newest_checks(course, assignment)) possible_ += check.points;
    }
    std::optional<LabMark> of(std::int64_t group, const std::string& student) const {
        const std::vector<LabMark> own =
            with_own_.contains(student) ? lab_marks(course_, a_, student, versions_) : std::vector<LabMark>();
        const std::vector<LabMark>& marks = with_own_.contains(student) ? own : of_groups_;
        const auto mark = std::ranges::find(marks, group, &LabMark::group);
        return mark == marks.end() ? std::nullopt : std::optional(*mark);
    }
    LabMark missing(std::int64_t group) const {
        LabMark mark;
        mark.group = group, mark.earned = 0, mark.possible = possible_;
        return mark;
    }

  private:
    Course& course_;
    const Assignment& a_;
    const std::set<std::int64_t>* versions_;
    std::set<std::string> with_own_;  ///< students with individual marks
    std::vector<LabMark> of_groups_;
    double possible_ = 0;
};

constexpr char kExported[] = "exported totals";

std::string mark_text(const std::optional<double>& percent) {
    return percent ? fmt::format("{:.4g}", *percent) : "";
}

}  // namespace

std::map<std::string, AssignmentMark> marks_of_students(Course& course, const Assignment& a, Instant now,
                                                        const std::set<std::int64_t>* versions) {
    std::optional<LabMarks> labs;
    Marks others;
    if (a.is_lab())
        labs.emplace(course, a, versions);
    else
        others = course_marks(course, a, now);
    auto submitted_by = newest_versions(course, a);
    std::map<std::string, AssignmentMark> marks;
    for (const auto& [student, group] : author_groups(course, a)) {
        AssignmentMark& mark = marks[student];
        if (labs) mark.lab = labs->of(group, student);
        if (!labs) mark.percent = percent_of(a, others, group, student);
        if (mark.lab) mark.percent = mark.lab->percent();
        const bool submitted = !submitted_by[group]["first"].empty();
        if (!submitted && now > due_for(course, a, group, "first") + a.grace && !mark.percent.has_value()) {
            mark.missing = true, mark.percent = 0;
            if (labs) mark.lab = labs->missing(group);
        }
        mark.open = submitted && !mark.percent;
    }
    return marks;
}

std::optional<double> weighted_total(const std::vector<Assignment>& assignments,
                                     const std::vector<AssignmentMark>& marks) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < assignments.size(); ++i)
        if (marks[i].percent) sum += assignments[i].weight * *marks[i].percent, weight += assignments[i].weight;
    if (weight <= 0) return {};
    return sum / weight;
}

void note_export(Course& course, const std::string& assignment, const std::string& file, const std::string& totals,
                 Instant now) {
    const std::string hash = totals.empty() ? "" : course.keep(totals);
    if (!hash.empty()) course.settle({hash});
    Transaction transaction(course.database());
    if (!hash.empty()) {
        course.register_file(hash, std::ssize(totals), now);
        course.save_entry(kExported, fmt::format("{} {}", hash, now));
    }
    course.note(assignment.empty() ? fmt::format("marks of the course written into {}", file)
                                   : fmt::format("{}: marks written into {}", assignment, file),
                now);
    transaction.commit();
}

ExportChanges changed_since_export(Course& course, const std::string& totals) {
    ExportChanges changes;
    const std::string saved_entry = course.saved_entry(kExported);
    const std::size_t blank = saved_entry.find(' ');
    if (blank == saved_entry.npos) return changes;
    changes.exported = read_number<Instant>(saved_entry.substr(blank + 1));
    const TextTable before = read_text_table(course.file(saved_entry.substr(0, blank)));
    const TemporaryFolder folder;
    write_file_atomically(folder.path() / "totals.csv", totals);
    const TextTable now = read_text_table(folder.path() / "totals.csv");
    const auto id = now.column("id"), name = now.column("name"), id_before = before.column("id");
    if (!id || !name || !id_before) return changes;
    std::map<std::string, const std::vector<std::string>*> rows;
    for (const auto& row : before.rows) rows[row[*id_before]] = &row;
    for (const auto& row : now.rows)
        for (std::size_t i = 0; i < now.names.size(); ++i) {
            const auto known = rows.find(row[*id]);
            const auto column = before.column(now.names[i]);
            const std::string old = known != rows.end() && column ? (*known->second)[*column] : "";
            if (old != row[i]) changes.cells.push_back({row[*id], row[*name], now.names[i], old, row[i]});
        }
    return changes;
}

CourseTotals course_totals(Course& course, Instant now) {
    CourseTotals totals{assignments_of(course), students_of(course), {}};
    totals.marks.resize(totals.students.size());
    for (const Assignment& a : totals.assignments) {
        auto marks = marks_of_students(course, a, now);
        for (std::size_t i = 0; i < totals.students.size(); ++i)
            totals.marks[i].push_back(marks[totals.students[i].id]);
    }
    return totals;
}

std::string totals_csv(const CourseTotals& totals) {
    TextTable table;
    table.names = {"id", "name", "mail", "moodle", "canvas", "group"};
    for (const Assignment& a : totals.assignments)
        table.names.push_back(fmt::format("{} percent (weight {:g})", a.name, a.weight));
    table.names.insert(table.names.end(), {"total percent", "missing", "not marked yet"});
    for (std::size_t k = 0; k < totals.students.size(); ++k) {
        const Student& student = totals.students[k];
        std::vector<std::string> row = {student.id,     student.name,   student.mail,
                                        student.moodle, student.canvas, student.group};
        std::vector<std::string> missing, open;
        for (std::size_t i = 0; i < totals.assignments.size(); ++i) {
            const AssignmentMark& own = totals.marks[k][i];
            row.push_back(mark_text(own.percent));
            if (own.missing) missing.push_back(totals.assignments[i].name);
            if (own.open) open.push_back(totals.assignments[i].name);
        }
        row.insert(row.end(), {mark_text(weighted_total(totals.assignments, totals.marks[k])),
                               fmt::format("{}", fmt::join(missing, ", ")), fmt::format("{}", fmt::join(open, ", "))});
        table.rows.push_back(std::move(row));
    }
    return csv_text(table);
}

}  // namespace dynlab::inline course
