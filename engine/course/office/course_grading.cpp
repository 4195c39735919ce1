#include "course/office/course_grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "course/grading/feedback.h"
#include "course/office/course_totals.h"
#include "course/store/marks.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// The marks in force, by what they are about and the check.
class MarksInForce {
  public:
    explicit MarksInForce(const std::vector<GivenMark>& marks) {
        for (const GivenMark& mark : marks)
            if (mark.student.empty()) marks_[{{mark.group, mark.version}, mark.item}] = mark;
    }
    /// That of a version, or else of all versions of its group; null where there is none.
    const GivenMark* of(const CourseWork::Marked& marked, const std::string& check) const {
        const GivenMark* const own = exactly(marked, check);
        return own != nullptr ? own : exactly({marked.group, 0}, check);
    }
    const GivenMark* exactly(const CourseWork::Marked& marked, const std::string& check) const {
        const auto found = marks_.find({marked, check});
        return found == marks_.end() ? nullptr : &found->second;
    }

  private:
    std::map<std::pair<CourseWork::Marked, std::string>, GivenMark> marks_;
};

/// Whether a row of the file says what a mark says; points are compared as they are printed.
bool says(const MarksFile::Row& row, const GivenMark* mark) {
    if (mark == nullptr || !row.points) return mark == nullptr && !row.points;
    return points_text(*row.points) == points_text(*mark->points) && row.reason == mark->reason;
}

std::string joined_setting(const Assignment& assignment) {
    return fmt::format("marks joined {}", assignment.id);
}

/// A mark whose row the instructor took out of the file, or emptied, is in force no more.
void take_back_lost_rows(Course& course, const Assignment& assignment, const CourseWork& work, const MarksFile& file,
                         const MarksInForce& before) {
    std::set<std::pair<CourseWork::Marked, std::string>> written;
    const MarkedItems items(work.work());
    for (const MarksFile::Row& row : file.rows())
        if (const auto marked = CourseWork::marked_by(course, items, row.who); marked && row.points)
            written.insert({*marked, row.check});
    for (const GivenMark& mark : marks_in_force(course, assignment)) {
        const CourseWork::Marked marked{mark.group, mark.version};
        if (!mark.student.empty() || written.contains({marked, mark.item}) ||
            before.exactly(marked, mark.item) == nullptr || work.names_of(mark.group, mark.version).empty())
            continue;
        give_mark(course, assignment, {mark.group, "", mark.item, {}, "its row was removed", mark.version},
                  CourseClock::now());
    }
}

/// The rows that the instructor changed. Refuses a row that contradicts an earlier one about the same work, or a
/// command since the last grading: only the instructor knows which mark is right.
class ChangedRows {
  public:
    explicit ChangedRows(const fs::path& results) : file_((results / kMarksFile).string()) {}
    void refuse_contradiction(const CourseWork::Marked& marked, const MarksFile::Row& row) {
        const auto [other, fresh] = rows_.try_emplace({marked, row.check}, row);
        if (fresh || points_text(*other->second.points) == points_text(*row.points)) return;
        throw EnvironmentError(
            "{}, lines {} and {}: both are about the same work and the check \"{}\", but give {} and {} points. Delete "
            "one of the two rows",
            file_, other->second.line, row.line, row.check, points_text(*other->second.points),
            points_text(*row.points));
    }
    void refuse_other_than(const GivenMark& given, const MarksFile::Row& row) const {
        if (points_text(*given.points) == points_text(*row.points)) return;
        throw EnvironmentError(
            "{}, line {}: \"{}\" has the mark {} for the check \"{}\", but dynlab course mark gave {} since the last "
            "grading. Write the correct mark into this row",
            file_, row.line, row.who, points_text(*row.points), row.check, points_text(*given.points));
    }

  private:
    std::string file_;
    std::map<std::pair<CourseWork::Marked, std::string>, MarksFile::Row> rows_;
};

/// Brings marks.csv and the marks of the store together. A row that differs from what the two had in common last time
/// was changed by the instructor and goes into the store; at the end all rows say what the store says. An emptied row
/// takes nothing back: it is filled again. Only where marks are given in the file alone, `file_alone`, a mark whose row
/// is not there any more, or is empty, is taken back. Throws EnvironmentError for points that contradict others.
void join_rows(Course& course, const Assignment& assignment, const CourseWork& work,
               const std::map<std::string, double>& max_points, const fs::path& results, bool file_alone) {
    MarksFile file(results);
    const MarkedItems items(work.work());
    Transaction transaction(course.database());  // a mark that a command gives meanwhile comes with the next join
    const std::optional<std::int64_t> last = newest_joined_mark(course, assignment);
    const MarksInForce before(last ? marks_in_force(course, assignment, last) : std::vector<GivenMark>());
    if (file_alone) take_back_lost_rows(course, assignment, work, file, before);
    const MarksInForce now(marks_in_force(course, assignment));
    std::vector<std::pair<MarksFile::Row, CourseWork::Marked>> known;
    ChangedRows changed(results);
    for (const MarksFile::Row& row : file.rows()) {
        const auto marked = CourseWork::marked_by(course, items, row.who);
        const auto points = max_points.find(row.check);
        if (!marked || points == max_points.end() || row.points > points->second)
            continue;  // complained of by the grading
        if (file_alone && !row.points) continue;
        known.emplace_back(row, *marked);
        // In a file alone, each row is a mark. A row of a group that was taken out also takes back what rows of its
        // versions say; they give it again.
        const auto of = file_alone ? &MarksInForce::exactly : &MarksInForce::of;
        const GivenMark *const given = (now.*of)(*marked, row.check), *const common = (before.*of)(*marked, row.check);
        if (!row.points || says(row, given)) continue;
        if (says(row, common) && (given != nullptr || !file_alone)) continue;
        changed.refuse_contradiction(*marked, row);
        const bool given_since = given != nullptr && (common == nullptr || given->id != common->id);
        if (given_since && !file_alone) changed.refuse_other_than(*given, row);
        give_mark(course, assignment, {marked->group, "", row.check, row.points, row.reason, marked->version},
                  CourseClock::now());
    }
    const std::vector<GivenMark> in_force = marks_in_force(course, assignment);
    Rows newest = course.database().query("SELECT max(id) FROM marks WHERE assignment = ?", assignment.id);
    const std::int64_t last_now = newest.next() ? newest.optional_integer(0).value_or(0) : 0;
    transaction.commit();
    const MarksInForce valid(in_force);
    for (const auto& [row, marked] : known) {
        const GivenMark* const mark = valid.of(marked, row.check);
        if (!says(row, mark))
            file.fill(row.who, row.check, mark ? mark->points : std::nullopt, mark ? mark->reason : "");
    }
    std::vector<MarksFile::Row> missing;
    for (const GivenMark& mark : in_force)
        if (mark.student.empty())
            for (const std::string& name : work.names_of(mark.group, mark.version))
                missing.push_back({0, name, mark.item, mark.points, mark.reason});
    file.add(missing);
    Transaction joined(course.database());
    course.save_entry(joined_setting(assignment), std::to_string(last_now));
    joined.commit();
}

}  // namespace

std::vector<CountedMark> counted_marks(Course& course, const Assignment& assignment, const ClassWork& work) {
    std::set<std::int64_t> versions;
    for (const WorkItem& item : work.items) versions.insert(item.version);
    auto marks = marks_of_students(course, assignment, CourseClock::now(), &versions);
    std::vector<CountedMark> all(work.students.size());
    const auto& items = work.items;
    for (std::size_t place = 0; place < items.size(); ++place)  // of work without marks the newest
        for (const std::size_t student : items[place].students)
            if (auto& item = all[student].item; !item || items[place].received >= items[*item].received) item = place;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::optional<LabMark>& lab = marks[work.students[i].id].lab;
        if (!lab) continue;
        if (lab->version != 0)
            all[i].item =
                static_cast<std::size_t>(std::ranges::find(items, lab->version, &WorkItem::version) - items.begin());
        all[i].points = lab->earned, all[i].penalty = lab->penalty, all[i].own_reason = lab->own_reasons;
        if (lab->version == 0 && lab->own_reasons.empty()) all[i].own_reason = lab->reason;
        if (lab->possible > 0) all[i].possible = lab->possible;
        for (const CheckPoints& check : lab->checks)
            all[i].checks.emplace_back(check.id, check.graded ? std::optional(check.earned) : std::nullopt);
    }
    return all;
}

fs::path results_folder(const Course& course, const Assignment& assignment) {
    return course.folder() / "marks" / assignment.name;
}

std::optional<std::int64_t> newest_joined_mark(Course& course, const Assignment& assignment) {
    return read_number<std::int64_t>(course.saved_entry(joined_setting(assignment)));
}

std::optional<ResultsCourse> course_of_results(const fs::path& results) {
    if (fs::exists(results / "course" / "course.db")) {
        Course course(results / "course");
        const std::vector<Assignment> all = assignments_of(course);
        return ResultsCourse{results / "course", all.empty() ? "" : all.front().name, true};
    }
    const fs::path folder = fs::weakly_canonical(results), course = folder.parent_path().parent_path();
    if (folder.parent_path().filename() != "marks" || !fs::exists(course / "course.db")) return {};
    return ResultsCourse{course, folder.filename(), false};
}

std::string secret_in(const fs::path& file) {
    std::string secret = read_file(file);
    if (secret.empty())
        throw EnvironmentError(
            "{} is empty, so the hidden data sets would not be secret. Write a secret text to this file",
            file.string());
    return secret;
}

GradingOptions grading_options(const Course& course, const Assignment& assignment, const CourseGradingRequest& request,
                               const fs::path& out) {
    if (!assignment.is_lab())
        throw InvalidArgument(
            "{} is not a lab, and checks grade only labs. For the scores of reviews and talks, use dynlab course "
            "scores",
            assignment.name);
    GradingOptions options;
    options.setup = request.setup;
    options.setup.lesson = find_lesson(assignment.lesson);
    if (!assignment.checks.empty()) options.setup.more_checks = course.folder() / assignment.checks;
    if (!assignment.secret.empty()) options.setup.secret = secret_in(course.folder() / assignment.secret);
    options.out = out;
    options.regrade = request.regrade, options.pdf = request.pdf, options.above_maximum = request.above_maximum;
    return options;
}

void join_marks(Course& course, const Assignment& assignment, const CourseWork& work, const EvaluatedRules& evaluated,
                const GradingOptions& options, bool file_alone) {
    std::map<std::string, double> max_points;  // points by check; with --force any
    for (const CheckDescription& check : evaluated.rules.checks())
        max_points[check.id] = check.points, max_points[kWholeItem] += check.points;
    if (options.above_maximum)
        for (auto& [check, points] : max_points) points = std::numeric_limits<double>::infinity();
    join_rows(course, assignment, work, max_points, options.out, file_alone);
}

void save_results(Course& course, const Assignment& assignment, const CourseWork& work, const fs::path& out) {
    Transaction transaction(course.database());
    int fresh = 0;
    for (const WorkItem& item : work.work().items) {
        const std::optional<Grade> grade = earlier_grade(out / "results" / item.submission.name);
        if (!grade || item.version == 0) continue;
        VersionResult result{item.version, {}, grade->fingerprint};
        for (const CheckGrade& check : grade->checks)
            result.checks.push_back({check.id, check.points, check.earned, check.graded});
        if (save_result(course, result, CourseClock::now())) ++fresh;
    }
    if (fresh > 0) course.note(fmt::format("{}: {} graded", assignment.name, fresh));
    transaction.commit();
}

GradingOutcome grade_assignment(Course& course, const Assignment& assignment, const CourseGradingRequest& request) {
    const GradingOptions options = grading_options(course, assignment, request, results_folder(course, assignment));
    const FileLock lock = lock_results(options.out);
    CourseWork work(course, assignment);
    if (work.work().items.empty())
        throw InvalidArgument("nothing was submitted for {} yet; run dynlab course submit FILE... --assignment {}",
                              assignment.name, assignment.name);
    work.choose(course, request.only);
    const EvaluatedRules evaluated(options);
    join_marks(course, assignment, work, evaluated, options, false);
    return grade_class(work.work(), evaluated, options, [&] {
        save_results(course, assignment, work, options.out);
        return counted_marks(course, assignment, work.work());
    });
}

}  // namespace dynlab::inline course
