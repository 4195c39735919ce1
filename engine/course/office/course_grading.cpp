#include "course/office/course_grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "course/grading/deadlines.h"
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
    /// Whose a row of marks.csv is: a group's, or of one of its versions.
    std::optional<std::int64_t> group_of(const std::string& who) const {
        for (std::size_t i = 0; i < work_.items.size(); ++i)
            if (work_.items[i].submission.name == who) return groups_of_items_[i];
        try {
            return group_named(course_, who).id;
        } catch (const InvalidArgument&) {
            return {};  // the grading complains of the row
        }
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

/// Brings marks.csv and the marks of the store together: the newer of the two is in force. A row that says what the
/// store once had is the older one.
void join_marks(Course& course, const Assignment& assignment, const CourseWork& work, const fs::path& results) {
    MarksFile file(results);
    std::map<std::pair<std::int64_t, std::string>, std::vector<GivenMark>> history;
    for (const GivenMark& mark : marks_ever_given(course, assignment))
        if (mark.student.empty()) history[{mark.group, mark.item}].push_back(mark);
    Transaction transaction(course.database());
    for (const MarksFile::Row& row : std::vector(file.rows())) {
        const auto group = work.group_of(row.who);
        if (!group) continue;
        const auto& known = history[{*group, row.check}];
        const auto same = [&row](const GivenMark& mark) {
            return mark.points == row.points && mark.reason == row.reason;
        };
        if (!known.empty() && (std::ranges::any_of(known, same) || !row.points)) {
            if (!same(known.back())) file.fill(row.who, row.check, known.back().points, known.back().reason);
        } else if (row.points) {
            give_mark(course, assignment, {*group, "", row.check, row.points, row.reason}, CourseClock::now());
        }
    }
    transaction.commit();
    std::vector<MarksFile::Row> missing;
    for (const GivenMark& mark : marks_in_force(course, assignment)) {
        const auto there = [&](const MarksFile::Row& row) {
            return row.check == mark.item && work.group_of(row.who) == mark.group;
        };
        if (mark.student.empty() && std::ranges::none_of(file.rows(), there))
            missing.push_back({0, work.groups().at(mark.group).name, mark.item, mark.points, mark.reason});
    }
    file.add(missing);
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
    join_marks(course, assignment, work, options.out);
    const TriedRules tried(options);
    GradingOutcome outcome = grade_class(work.work(), tried, options);
    record_results(course, assignment, work, options.out);
    return outcome;
}

}  // namespace dynlab::inline course
