#include "course/office/course_grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "course/grading/deadlines.h"
#include "course/grading/feedback.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// The work of one lab as the course knows it.
class CourseWork {
  public:
    CourseWork(Course& course, const Assignment& assignment) : course_(course), assignment_(assignment) {
        work_.roster = true;
        work_.students = students_of(course);
        work_.deadlines = assignment.first_due != kNoDeadline;
        work_.newest_counts = assignment.keep == "newest";
        for (const Group& group : groups_of(course)) groups_.emplace(group.id, group);
        for (Rows rows = course.database().query(
                 "SELECT id, group_id, part, number, hash, name, received_at, first_at, due_at FROM standing WHERE "
                 "assignment = ? AND stage = 'first' AND part IN ('script', 'pack') ORDER BY group_id, number, part",
                 assignment.id);
             rows.next();)
            add(rows);
    }

    void choose(const std::vector<std::string>& only) {
        std::vector<std::int64_t> wanted;
        for (const std::string& name : only) {
            wanted.push_back(group_named(course_, name).id);
            if (std::ranges::find(groups_of_items_, wanted.back()) == groups_of_items_.end())
                throw InvalidArgument("{} has submitted nothing for {}", groups_.at(wanted.back()).name,
                                      assignment_.name);
        }
        for (std::size_t i = 0; i < work_.items.size(); ++i)
            if (only.empty() || std::ranges::find(wanted, groups_of_items_[i]) != wanted.end())
                work_.chosen.push_back(i);
    }

    const ClassWork& work() const { return work_; }
    std::int64_t version(std::size_t item) const { return versions_[item]; }
    const std::map<std::int64_t, Group>& groups() const { return groups_; }
    /// What a row of marks.csv is about: a version by its name, else all versions of a group. Nothing for a name that
    /// fits neither; the grading complains of the row.
    struct Marked {
        std::int64_t group = 0, version = 0;
        auto operator<=>(const Marked&) const = default;
    };
    std::optional<Marked> marked_by(const std::string& who) const {
        for (std::size_t i = 0; i < work_.items.size(); ++i)
            if (work_.items[i].submission.name == who) return Marked{groups_of_items_[i], versions_[i]};
        if (who.empty()) return {};
        try {
            return Marked{group_named(course_, who).id, 0};
        } catch (const InvalidArgument&) {
            return {};
        }
    }
    /// Names under which a mark stands in marks.csv: of its version, of each version of its group, or of the group
    /// where it submitted nothing.
    std::vector<std::string> names_of(const GivenMark& mark) const {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < work_.items.size(); ++i)
            if (groups_of_items_[i] == mark.group && (mark.version == 0 || mark.version == versions_[i]))
                names.push_back(work_.items[i].submission.name);
        if (names.empty() && mark.version == 0) names.push_back(groups_.at(mark.group).name);
        return names;
    }

  private:
    /// "group-07", "group-07 v2", "group-07 pack".
    static std::string name_of(const Group& group, const std::string& part, std::int64_t number) {
        return group.name + (part == "pack" ? " pack" : "") + (number > 1 ? fmt::format(" v{}", number) : "");
    }

    /// A file of the store under a name that tells what it is.
    fs::path named_copy(const std::string& hash, const std::string& name) const {
        const fs::path copy = files_.path() / std::to_string(work_.items.size()) / name;
        fs::create_directories(copy.parent_path());
        fs::copy_file(course_.file(hash), copy);
        return copy;
    }

    void add(const Rows& rows) {
        const Group& group = groups_.at(rows.integer(1));
        const bool pack = rows.text(2) == "pack";
        WorkItem item;
        item.submission.name = name_of(group, rows.text(2), rows.integer(3));
        item.submission.archive = pack;
        const std::string name = rows.text(5);
        const std::string ending = archive_stem(name) ? name.substr(archive_stem(name)->size()) : ".zip";
        item.submission.path = named_copy(rows.text(4), pack ? group.name + ending : "analysis.lua");
        if (!pack) item.submission.loose = {{item.submission.path, "analysis.lua"}};
        item.received = rows.integer(6);
        const Costs& costs = assignment_.costs;
        if (work_.deadlines)
            item.lateness =
                lateness_of({rows.integer(8), assignment_.grace, costs.late_day, costs.late_most}, rows.integer(7));
        address(item, group);
        work_.items.push_back(std::move(item));
        versions_.push_back(rows.integer(0));
        groups_of_items_.push_back(group.id);
    }

    void address(WorkItem& item, const Group& group) const {
        item.group = group.name;
        item.addressee = group.name;
        const std::vector<std::string> members = members_at(course_, group.id, item.received);
        for (std::size_t place = 0; place < work_.students.size(); ++place) {
            const Student& student = work_.students[place];
            if (std::ranges::find(members, student.id) == members.end()) continue;
            item.students.push_back(place);
            if (!student.language.empty()) item.language = student.language;
            if (student.seed) item.seed = student.seed;
            if (group.name == student.id && !student.name.empty()) item.addressee = student.name;
        }
        if (item.students.empty()) item.unmatched = Message("the group {} had no members then", group.name);
    }

    Course& course_;
    const Assignment& assignment_;
    TemporaryFolder files_;
    ClassWork work_;
    std::map<std::int64_t, Group> groups_;
    std::vector<std::int64_t> versions_, groups_of_items_;  ///< of the items
};

/// The marks in force, by what they are about and the check.
class MarksInForce {
  public:
    explicit MarksInForce(const std::vector<GivenMark>& marks) {
        for (const GivenMark& mark : marks)
            if (mark.student.empty()) marks_[{{mark.group, mark.version}, mark.item}] = mark;
    }
    /// That of a version, or else of all versions of its group; null where there is none.
    const GivenMark* of(const CourseWork::Marked& marked, const std::string& check) const {
        for (const std::int64_t version : {marked.version, std::int64_t{0}})
            if (const auto found = marks_.find({{marked.group, version}, check}); found != marks_.end())
                return &found->second;
        return nullptr;
    }

  private:
    std::map<std::pair<CourseWork::Marked, std::string>, GivenMark> marks_;
};

/// Whether a row of the file says what a mark says; points are compared as they are printed.
bool says(const MarksFile::Row& row, const GivenMark* mark) {
    if (mark == nullptr || !row.points) return mark == nullptr && !row.points;
    return points_text(*row.points) == points_text(*mark->points) && row.reason == mark->reason;
}

/// Up to which mark file and store were brought together.
class JoinedMarks {
  public:
    JoinedMarks(Course& course, const Assignment& assignment)
        : course_(course), setting_(fmt::format("marks joined {}", assignment.id)) {}
    std::optional<std::int64_t> last() const {
        Rows rows = course_.database().query("SELECT CAST(value AS INTEGER) FROM course WHERE key = ?", setting_);
        return rows.next() ? std::optional(rows.integer(0)) : std::nullopt;
    }
    void note(std::int64_t mark) const {
        Transaction transaction(course_.database());
        course_.database().run(
            "INSERT INTO course VALUES (?, ?) ON CONFLICT DO UPDATE SET value = excluded.value WHERE value <> "
            "excluded.value",
            setting_, std::to_string(mark));
        transaction.commit();
    }

  private:
    Course& course_;
    std::string setting_;
};

/// Brings marks.csv and the marks of the store together. A row that differs from what the two had in common last time
/// was changed by the instructor and goes into the store; one that does not follows the store. An emptied row takes
/// nothing back: it is filled again.
void join_marks(Course& course, const Assignment& assignment, const CourseWork& work,
                const std::map<std::string, double>& most, const fs::path& results) {
    MarksFile file(results);
    const JoinedMarks joined(course, assignment);
    Transaction transaction(course.database());  // a mark that a command gives meanwhile comes with the next join
    const std::optional<std::int64_t> last = joined.last();
    const MarksInForce before(last ? marks_in_force(course, assignment, last) : std::vector<GivenMark>());
    const MarksInForce now(marks_in_force(course, assignment));
    std::vector<MarksFile::Row> filled;
    for (const MarksFile::Row& row : file.rows()) {
        const auto marked = work.marked_by(row.who);
        const auto points = most.find(row.check);
        if (!marked || points == most.end() || row.points > points->second) continue;  // complained of by the grading
        const GivenMark* const mark = now.of(*marked, row.check);
        if (says(row, mark)) continue;
        if (row.points && !says(row, before.of(*marked, row.check)))
            give_mark(course, assignment, {marked->group, "", row.check, row.points, row.reason, marked->version},
                      CourseClock::now());
        else
            filled.push_back(
                {row.line, row.who, row.check, mark ? mark->points : std::nullopt, mark ? mark->reason : ""});
    }
    const std::vector<GivenMark> in_force = marks_in_force(course, assignment);
    Rows newest = course.database().query("SELECT max(id) FROM marks WHERE assignment = ?", assignment.id);
    const std::int64_t last_now = newest.next() ? newest.optional_integer(0).value_or(0) : 0;
    transaction.commit();
    for (const MarksFile::Row& row : filled) file.fill(row.who, row.check, row.points, row.reason);
    std::vector<MarksFile::Row> missing;
    for (const GivenMark& mark : in_force)
        if (mark.student.empty())
            for (const std::string& name : work.names_of(mark))
                missing.push_back({0, name, mark.item, mark.points, mark.reason});
    file.add(missing);
    joined.note(last_now);
}

void record_results(Course& course, const Assignment& assignment, const CourseWork& work, const fs::path& results) {
    Transaction transaction(course.database());
    for (std::size_t i = 0; i < work.work().items.size(); ++i) {
        const std::optional<Grade> grade = earlier_grade(results / "results" / work.work().items[i].submission.name);
        if (!grade) continue;
        VersionResult result{work.version(i), {}, grade->fingerprint};
        for (const CheckGrade& check : grade->checks)
            result.checks.push_back({check.id, check.points, check.earned, check.graded});
        record_result(course, result, CourseClock::now());
    }
    course.note(fmt::format("{}: graded", assignment.name));
    transaction.commit();
}

}  // namespace

fs::path results_folder(const Course& course, const Assignment& assignment) {
    return course.folder() / "marks" / assignment.name;
}

GradingOutcome grade_assignment(Course& course, const Assignment& assignment, const CourseGradingRequest& request) {
    if (!assignment.is_lab())
        throw InvalidArgument("{} is not a lab: only labs are graded by checks; see dynlab course scores",
                              assignment.name);
    GradingOptions options;
    options.setup = request.setup;
    options.setup.lesson = find_lesson(assignment.lesson);
    if (!assignment.checks.empty()) options.setup.more_checks = assignment.checks;
    if (!assignment.secret.empty()) {
        options.setup.secret = read_file(assignment.secret);
        if (options.setup.secret.empty())
            throw EnvironmentError("{} is empty: hidden records drawn from it would be no secret", assignment.secret);
    }
    options.out = results_folder(course, assignment);
    options.regrade = request.regrade, options.pdf = request.pdf, options.above_maximum = request.above_maximum;
    const FileLock lock = lock_results(options.out);
    CourseWork work(course, assignment);
    if (work.work().items.empty())
        throw InvalidArgument("nothing was submitted for {} yet: dynlab course submit FILE... --assignment {}",
                              assignment.name, assignment.name);
    work.choose(request.only);
    const TriedRules tried(options);
    std::map<std::string, double> most;  // points by check; with --force any
    for (const CheckDescription& check : tried.rules.checks())
        most[check.id] = check.points, most[kWholeItem] += check.points;
    if (options.above_maximum)
        for (auto& [check, points] : most) points = std::numeric_limits<double>::infinity();
    join_marks(course, assignment, work, most, options.out);
    GradingOutcome outcome = grade_class(work.work(), tried, options);
    record_results(course, assignment, work, options.out);
    return outcome;
}

}  // namespace dynlab::inline course
