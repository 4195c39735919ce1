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

struct GradeArgs {
    std::string assignment, isolation = "full";
    std::vector<std::string> only;
    int jobs = 0, timeout = 60;
    bool regrade = false, no_pdf = false, force = false;
};

int grade(const CourseArguments& where, const GradeArgs& args) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    CourseGradingRequest request;
    request.setup.isolation = args.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    request.setup.time.processor = std::chrono::seconds(args.timeout);
    request.setup.program = running_program();
    request.setup.jobs =
        args.jobs > 0 ? args.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    request.only = args.only;
    request.regrade = args.regrade, request.pdf = !args.no_pdf, request.above_maximum = args.force;
    const GradingOutcome outcome = grade_assignment(course, assignment, request);
    return show_grading(outcome, request.setup.isolation, results_folder(course, assignment), request.pdf);
}

struct MarkArgs {
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

/// "group-01 (Kim Min-jun, Élise Petit)": all who get the mark. A number of written answers stays anonymous.
std::string marked_people(Course& course, const Assignment& a, const GivenMark& mark, const std::string& who) {
    if (group_of_answers(course, a, who) && mark.student.empty()) return who;
    std::map<std::string, std::string> names;
    for (const Student& student : students_of(course))
        names[student.id] = student.name.empty() ? student.id : student.name;
    if (!mark.student.empty()) return names[mark.student];
    for (const Group& group : groups_of_authors(course, a)) {
        if (group.id != mark.group) continue;
        std::vector<std::string> members;
        for (const std::string& id : group.members) members.push_back(names[id]);
        return members.empty() ? group.name : fmt::format("{} ({})", group.name, fmt::join(members, ", "));
    }
    return who;
}

constexpr double kMaxPercent = 200;  ///< for work that deserves more than all

int set_mark(const CourseArguments& where, const MarkArgs& args) {
    Course course(where.folder);
    const Assignment a = assignment_named(course, args.assignment);
    GivenMark mark;
    if (const auto answers = group_of_answers(course, a, args.who); answers && !args.alone) {
        mark.group = answers->id;
    } else {
        const std::string student = args.alone ? student_named(course, args.who).id : student_called(course, args.who);
        mark.group = group_of_work(course, a, student, args.who);
        if (args.alone) mark.student = student;
    }
    mark.item = args.mark.size() > 1 ? item_called(a, args.mark.front()) : kWholeItem;
    mark.points = number_in_cell(args.mark.back());
    mark.reason = args.reason;
    if (!mark.points || *mark.points < 0)
        throw InvalidArgument("a mark must be a nonnegative number, but \"{}\" was given", args.mark.back());
    const double max_points = max_points_of(course, a, mark.item).value_or(*mark.points);
    if (*mark.points > max_points && !args.force)
        throw InvalidArgument(
            "{} exceeds {}, the maximum number of points for \"{}\"; correct the mark, or give --force", *mark.points,
            max_points, !a.is_lab() && mark.item == kWholeItem ? "work" : mark.item);
    if (!a.is_lab() && *mark.points > kMaxPercent)
        throw InvalidArgument("a mark must be a number from 0 to {} percent, but {} was given", kMaxPercent,
                              *mark.points);
    if (!a.is_lab() || mark.item == kWholeItem) refuse_without_reason(args.reason);
    Transaction transaction(course.database());
    if (args.seen) refuse_unseen_entry(course, a, mark.group, args.who, mark.item, *args.seen);
    give_mark(course, a, mark, time_of(course, args.at));
    transaction.commit();
    const std::string who = marked_people(course, a, mark, args.who);
    std::cout << terminal_text(
        a.is_lab() ? fmt::format("{}: {} has {} {} for {}; dynlab course grade {} writes the feedback.\n", a.name, who,
                                 *mark.points, *mark.points == 1 ? "point" : "points", mark.item, a.name)
                   : fmt::format("{}: {} has {} percent for its {}.\n", a.name, who, *mark.points,
                                 mark.item == kWholeItem ? "work" : mark.item));
    return kDone;
}

void add_mark(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<MarkArgs>();
    CLI::App* command = course.add_subcommand("mark", "Set a manual mark, which overrides the computed mark");
    command->add_option("ASSIGNMENT", args->assignment)->required();
    command->add_option("WHO", args->who, "Group, a student by name or id, or answer-NAME of course page")->required();
    command
        ->add_option(
            "MARK", args->mark,
            "For a lab, [CHECK] POINTS (without CHECK for the complete lab); otherwise, [work|reviews] PERCENT")
        ->required()
        ->expected(1, 2);
    command->add_option("--reason", args->reason,
                        "Reason; recorded in the history and shown to the student. Optional for one check of a lab.");
    command->add_flag("--alone", args->alone, "Set the mark of this student only, not of the group");
    command->add_flag("--force", args->force, "Accept a mark above the maximum");
    add_after_option(*command, args->seen);
    add_time_option(*command, args->at);
    command->footer(
        "dynlab course withdraw withdraws a mark. For a lab, you can also enter marks in marks.csv in the folder of "
        "its results.\n"
        "Examples:\n"
        "  dynlab course mark lab4 \"Wei Li\" q3 2 --reason \"right idea\"\n"
        "  dynlab course mark lab4 group-08 14 --reason \"shown at the desk\"\n"
        "  dynlab course mark crane group-09 work 60 --reason \"submitted on paper\"");
    command->callback([&where, args, &action] { action = [&where, args] { return set_mark(where, *args); }; });
}

}  // namespace

void add_grade_commands(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<GradeArgs>();
    CLI::App* command = course.add_subcommand("grade", "Grade the submissions of a lab: marks, feedback, summary");
    command->add_option("ASSIGNMENT", args->assignment, "Assignment. Required if there are several.");
    command->add_option("--only", args->only, "Group or student; may be repeated")->type_name("NAME");
    command->add_flag("--regrade", args->regrade, "Grade submissions again that have a result; manual marks are kept");
    command->add_option("--jobs", args->jobs, "Number of parallel jobs. Default: number of cores.")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    add_timeout_option(*command, args->timeout);
    command
        ->add_option("--isolation", args->isolation,
                     "full: separate file system, network and processes. Default: full.")
        ->type_name("full|process")
        ->capture_default_str()
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag("--force", args->force, "Accept marks above the maximum points of their check");
    command->add_flag("--no-pdf", args->no_pdf, "Write feedback and summary as Markdown only");
    command->footer(
        "The assignment determines lesson, checks and secret (dynlab course assignment). The results are in "
        "marks/ASSIGNMENT\nof the course's folder: gradebook.csv, summary.pdf, feedback, and marks.csv for manual "
        "marks.\nExample:  dynlab course grade lab4");
    command->callback([&where, args, &action] { action = [&where, args] { return grade(where, *args); }; });
    add_mark(course, where, action);
}

}  // namespace dynlab::inline cli
