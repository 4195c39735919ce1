#include "course/office/course_grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "course/grading/feedback.h"
#include "course/office/course_totals.h"
#include "course/office/marks_join.h"
#include "course/store/marks.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {

namespace fs = std::filesystem;

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

void join_marks(Course& course, const Assignment& assignment, CourseWork& work, const EvaluatedRules& evaluated,
                const GradingOptions& options, bool file_alone) {
    std::map<std::string, double> max_points;  // points by check; with --force any
    for (const CheckDescription& check : evaluated.rules.checks())
        max_points[check.id] = check.points, max_points[kWholeItem] += check.points;
    if (options.above_maximum)
        for (auto& [check, points] : max_points) points = std::numeric_limits<double>::infinity();
    work.take_marks(course, assignment, join_marks_file(course, assignment, work, max_points, options.out, file_alone));
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
