#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <thread>

#include "cli/course/course_commands.h"
#include "cli/course/grading_options.h"
#include "cli/course/grading_report.h"
#include "course/office/course_grading.h"
#include "course/review/review_marks.h"
#include "course/store/answer_names.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "course/store/newest_versions.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct GradeWords {
    std::string assignment, isolation = "full";
    std::vector<std::string> only;
    int jobs = 0, timeout = 60;
    bool regrade = false, no_pdf = false, force = false;
};

int grade(const CourseArguments& where, const GradeWords& words) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, words.assignment);
    CourseGradingRequest request;
    request.setup.isolation = words.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    request.setup.time.processor = std::chrono::seconds(words.timeout);
    request.setup.program = running_program();
    request.setup.jobs =
        words.jobs > 0 ? words.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    request.only = words.only;
    request.regrade = words.regrade, request.pdf = !words.no_pdf, request.above_maximum = words.force;
    const GradingOutcome outcome = grade_assignment(course, assignment, request);
    return show_grading(outcome, request.setup.isolation, results_folder(course, assignment), request.pdf);
}

struct MarkWords {
    std::string assignment, who, reason, at;
    std::vector<std::string> mark;  ///< the item, which may miss, and the points
    std::optional<std::int64_t> seen;
    bool alone = false, force = false;
};

/// The id of the student who is called so; empty for a group's name.
std::string student_called(Course& course, const std::string& who) {
    try {
        return student_named(course, who).id;
    } catch (const InvalidArgument&) {
        return "";
    }
}

/// Of a student the group that they submitted with, which may not be the one that they are in now.
std::int64_t group_of_work(Course& course, const Assignment& a, const std::string& student, const std::string& who) {
    const auto authors = author_groups(course, a);
    const auto author = authors.find(student);
    return author != authors.end() ? author->second : group_named(course, who).id;
}

constexpr double kMaxPercent = 200;  ///< for work that deserves more than all

int set_mark(const CourseArguments& where, const MarkWords& words) {
    Course course(where.folder);
    const Assignment a = assignment_named(course, words.assignment);
    GivenMark mark;
    if (const auto answers = group_of_answers(course, a, words.who); answers && !words.alone) {
        mark.group = answers->id;
    } else {
        const std::string student =
            words.alone ? student_named(course, words.who).id : student_called(course, words.who);
        mark.group = group_of_work(course, a, student, words.who);
        if (words.alone) mark.student = student;
    }
    mark.item = words.mark.size() > 1 ? item_called(a, words.mark.front()) : kWholeItem;
    mark.points = number_in_cell(words.mark.back());
    mark.reason = words.reason;
    if (!mark.points || *mark.points < 0)
        throw InvalidArgument("a mark must be a number from 0, but \"{}\" was given", words.mark.back());
    const double most = most_points(course, a, mark.item).value_or(*mark.points);
    if (*mark.points > most && !words.force)
        throw InvalidArgument("{} exceeds the {} points of \"{}\"; correct the mark, or give --force", *mark.points,
                              most, mark.item);
    if (!a.is_lab() && *mark.points > kMaxPercent)
        throw InvalidArgument("a mark must be a number from 0 to {} percent, but {} was given", kMaxPercent,
                              *mark.points);
    if (!a.is_lab() || mark.item == kWholeItem) refuse_without_reason(words.reason);
    Transaction transaction(course.database());
    if (words.seen) refuse_unseen_entry(course, a, mark.group, words.who, mark.item, *words.seen);
    give_mark(course, a, mark, time_of(course, words.at));
    transaction.commit();
    std::cout << terminal_text(
        a.is_lab() ? fmt::format("{}: {} has {} points for {}; dynlab course grade {} writes the feedback.\n", a.name,
                                 words.who, *mark.points, mark.item, a.name)
                   : fmt::format("{}: {} has {} percent for its {}.\n", a.name, words.who, *mark.points,
                                 mark.item == kWholeItem ? "work" : mark.item));
    return kDone;
}

void add_mark(CLI::App& course, CourseArguments& where, Action& action) {
    auto words = std::make_shared<MarkWords>();
    CLI::App* command = course.add_subcommand("mark", "Set a manual mark, which takes precedence");
    command->add_option("ASSIGNMENT", words->assignment)->required();
    command->add_option("WHO", words->who, "Group, a student by name or id, or answer-NAME of course page")->required();
    command
        ->add_option("MARK", words->mark,
                     "For a lab [CHECK] POINTS, without CHECK for the complete lab; otherwise [work|reviews] PERCENT")
        ->required()
        ->expected(1, 2);
    command->add_option("--reason", words->reason,
                        "Reason; recorded in the history and shown to the student. Optional for one check of a lab.");
    command->add_flag("--alone", words->alone, "Set the mark of this student only, not of the group");
    command->add_flag("--force", words->force, "Accept a mark above the maximum");
    add_after_option(*command, words->seen);
    add_time_option(*command, words->at);
    command->footer(
        "dynlab course withdraw withdraws a mark. For a lab, you can also enter marks in marks.csv in the folder of "
        "its results.\n"
        "Examples:\n"
        "  dynlab course mark lab4 \"Wei Li\" q3 2 --reason \"right idea\"\n"
        "  dynlab course mark lab4 group-08 14 --reason \"shown at the desk\"\n"
        "  dynlab course mark crane group-09 work 60 --reason \"submitted on paper\"");
    command->callback([&where, words, &action] { action = [&where, words] { return set_mark(where, *words); }; });
}

}  // namespace

void add_grade_commands(CLI::App& course, CourseArguments& where, Action& action) {
    auto words = std::make_shared<GradeWords>();
    CLI::App* command = course.add_subcommand("grade", "Grade the submissions of a lab: marks, feedback, summary");
    command->add_option("ASSIGNMENT", words->assignment, "Assignment. Required if there are several.");
    command->add_option("--only", words->only, "Group or student; may be repeated")->type_name("NAME");
    command->add_flag("--regrade", words->regrade, "Grade submissions again that have a result; manual marks are kept");
    command->add_option("--jobs", words->jobs, "Number of parallel jobs. Default: number of cores.")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    add_timeout_option(*command, words->timeout);
    command
        ->add_option("--isolation", words->isolation,
                     "full: separate file system, network and processes. Default: full.")
        ->type_name("full|process")
        ->capture_default_str()
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag("--force", words->force, "Accept marks above the points of their check");
    command->add_flag("--no-pdf", words->no_pdf, "Write feedback and summary as Markdown only");
    command->footer(
        "The assignment determines lesson, checks and secret (dynlab course assignment). The results are in "
        "marks/ASSIGNMENT\n"
        "of the course's folder: gradebook.csv, summary.pdf, feedback, and marks.csv for manual marks.\n"
        "Example:  dynlab course grade lab4");
    command->callback([&where, words, &action] { action = [&where, words] { return grade(where, *words); }; });
    add_mark(course, where, action);
}

}  // namespace dynlab::inline cli
