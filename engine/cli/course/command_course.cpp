#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/course_commands.h"
#include "course/office/course_export.h"
#include "course/office/course_grading.h"
#include "course/office/course_status.h"
#include "course/office/deadline_import.h"
#include "course/office/who.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "numerics/error.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

void add_init(CLI::App& course, Action& action) {
    struct Arguments {
        std::string folder, name, zone = "UTC";
    };
    auto args = std::make_shared<Arguments>();
    CLI::App* command = course.add_subcommand("init", "Create a course: a folder with a store and a key");
    command->add_option("DIR", args->folder, "Folder of the course; it may exist")->required();
    command->add_option("--name", args->name, "Name of the course, for receipts. Default: the name of the folder.");
    command->add_option("--timezone", args->zone, "Time zone for all times of the course")
        ->type_name("ZONE")
        ->capture_default_str();
    command->footer("Example:  dynlab course init signals-2026 --name \"Signals 2026\" --timezone Europe/Paris");
    command->callback([args, &action] {
        action = [args] {
            const fs::path folder = fs::absolute(args->folder).lexically_normal();
            const std::string own = (folder.has_filename() ? folder : folder.parent_path()).filename();
            Course::create(folder, args->name.empty() ? own : args->name, args->zone);
            std::cout << fmt::format(
                "Course created in {}, times in {}.\ncourse.key signs the receipts: keep a copy of the whole folder, "
                "and keep the key secret.\ncourse.pub verifies them: give it to your students, who need only dynlab "
                "verify.\nNext: cd {} and dynlab course import roster.csv\n",
                folder.string(), args->zone, args->folder);
            return kDone;
        };
    });
}

int import_people(const CourseArguments& where, const std::string& file, bool no_groups, const std::string& at) {
    Course opened(where.folder);
    const RosterChange change = import_roster(opened, file, no_groups, time_of(opened, at));
    if (change.converted)
        std::cerr << terminal_text(
            fmt::format("dynlab: {} is not UTF-8; dynlab read it as Latin-1 (Windows-1252)\n", file));
    if (!change.unknown_columns.empty())
        std::cerr << terminal_text(fmt::format("dynlab: {}: unknown columns were ignored: {}\n", file,
                                               fmt::join(change.unknown_columns, ", ")));
    if (!change.short_ids.empty())
        std::cerr << terminal_text(fmt::format("dynlab: {}: {}\n", file, message_text(change.short_ids)));
    std::cout << message_text(Message("{}: {} new, {} changed, {} moved to another group; {}.",
                                      plural(change.students, "{} student", "{} students"), change.new_students,
                                      change.changed, std::ssize(change.moved),
                                      plural(change.new_groups, "{} new group", "{} new groups")))
              << '\n';
    for (const RosterChange::Move& move : change.moved)
        std::cout << terminal_text(message_text(Message("  {} moved from {} to {}", move.student, move.from, move.to)))
                  << '\n';
    if (!change.absent.empty())
        std::cout << terminal_text(
            fmt::format("In the course, but not in this file (not changed; drop GROUP removes a group): {}\n",
                        fmt::join(change.absent, ", ")));
    return kDone;
}

int import_table(const CourseArguments& where, const std::string& assignment, const std::string& file,
                 const std::string& at) {
    Course opened(where.folder);
    const Assignment a = assignment_named(opened, assignment);
    const DeadlineImport done = import_deadlines(opened, a, file, time_of(opened, at));
    for (const Message& complaint : done.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    std::cout << fmt::format("{}: {} extended, {} with another time of receipt.\n", a.name, done.extended,
                             done.corrected);
    return done.complaints.empty() ? kDone : kFailed;
}

void add_import(CLI::App& course, CourseArguments& where, Action& action) {
    struct Arguments {
        std::string file, folder, assignment, at, from = ".";
        bool no_groups = false;
    };
    auto args = std::make_shared<Arguments>();
    CLI::App* command = course.add_subcommand("import", "Read students and groups from a CSV file");
    command
        ->add_option("FILE", args->file,
                     "Roster or list of participants: columns id, group, name, email, ...; may be repeated")
        ->required();
    command->add_option("DIR", args->folder, "For a JSON export: folder of the new course");
    command->add_flag("--no-groups", args->no_groups, "The file has no column group: each new student works alone");
    command->add_option("--deadlines", args->assignment, "Read FILE as the deadlines of this assignment")
        ->type_name("ASSIGNMENT");
    add_time_option(*command, args->at);
    command->add_option("--from", args->from, "For a JSON export: folder of the old course, with its files and key")
        ->capture_default_str();
    command->footer(
        "Columns: id and group, and optionally name, email (or mail), moodle, canvas, language, seed. dynlab also "
        "reads the\n"
        "exports of Moodle and Canvas. A student without a group works alone; | joins several groups. Students and "
        "columns\n"
        "that are not in the file do not change. A student who moves keeps the marks of the group that the student "
        "submitted\n"
        "with; --at gives the time of an earlier move.\n"
        "Examples:\n"
        "  dynlab course import roster.csv\n"
        "  dynlab course import deadlines.csv --deadlines lab4    with the columns of dynlab grade\n"
        "  dynlab course import course.json copy --from signals-2026    from course export --json");
    command->callback([&where, args, &action] {
        action = [&where, args]() -> int {
            if (!args->assignment.empty()) return import_table(where, args->assignment, args->file, args->at);
            if (args->folder.empty()) return import_people(where, args->file, args->no_groups, args->at);
            import_course(args->file, args->from, args->folder);
            std::cout << fmt::format("Course created in {} from {}.\n", args->folder, args->file);
            return kDone;
        };
    });
}

void add_drop(CLI::App& course, CourseArguments& where, Action& action) {
    struct Arguments {
        std::string group, reason;
        bool end = false;
    };
    auto args = std::make_shared<Arguments>();
    CLI::App* command = course.add_subcommand("drop", "Mark a group as dropped out, or as returned");
    command->add_option("GROUP", args->group, "Group, or one of its students")->required();
    command->add_flag("--end", args->end, "Mark the group as returned");
    command->add_option("--reason", args->reason, "Reason; recorded in the history");
    command->footer("Example:  dynlab course drop group-07 --reason \"left the course\"");
    command->callback([&where, args, &action] {
        action = [&where, args] {
            Course opened(where.folder);
            const std::string group = group_named(opened, args->group).name;
            set_group_dropped_out(opened, group, !args->end, args->reason);
            std::cout << fmt::format(
                "{} {}; if reviews are already assigned, repeat dynlab course review assign.\n", group,
                args->end ? "has returned to the course" : "has dropped out; its work and its reviews are kept");
            return kDone;
        };
    });
}

struct AssignmentArguments {
    std::string name, kind, lesson, first, review, final, grace, criteria, costs, reason;
    std::optional<double> final_weight, weight, reviews_weight;
    std::string checks, secret, keep;
    std::optional<int> reviews;
    bool remove = false;
};

/// A path as it is found again from elsewhere: relative to the folder of the course if it is in it, so that the course
/// can be moved, otherwise absolute. "none" takes it back.
std::string lasting_path(const Course& course, const std::string& given) {
    if (given == "none") return "";
    const fs::path path = fs::absolute(given).lexically_normal(),
                   inside = path.lexically_relative(fs::absolute(course.folder()).lexically_normal());
    return inside.empty() || inside == "." || *inside.begin() == ".." ? path.string() : inside.string();
}

/// Sets what was given.
void apply(const AssignmentArguments& args, const Course& course, Assignment& a) {
    const CourseClock& clock = course.clock();
    if (!args.lesson.empty()) {
        a.lesson = lasting_name(find_lesson(args.lesson));
    }
    if (!args.first.empty()) a.first_due = clock.parse(args.first, "--first");
    if (!args.review.empty()) a.review_due = clock.parse(args.review, "--review");
    if (!args.final.empty()) a.final_due = clock.parse(args.final, "--final");
    if (!args.grace.empty()) {
        const auto grace = duration_of(args.grace);
        if (!grace)
            throw InvalidArgument("--grace must be a duration such as 15min, 2h or 1d, but \"{}\" was given",
                                  args.grace);
        a.grace = *grace;
    }
    if (!args.costs.empty()) a.costs = costs_of(args.costs == "none" ? "" : args.costs);
    if (args.final_weight) a.final_weight = *args.final_weight;
    if (args.weight) a.weight = *args.weight;
    if (args.reviews_weight) a.reviews_weight = *args.reviews_weight;
    if (!args.checks.empty()) a.checks = lasting_path(course, args.checks);
    if (!args.secret.empty()) a.secret = lasting_path(course, args.secret);
    if (!a.secret.empty() && !args.secret.empty()) secret_in(course.folder() / a.secret);
    if (!args.keep.empty()) a.keep = args.keep;
}

/// Adds it, or changes what was named of it: with a reason at any time, without one while that costs no student
/// anything.
int enter_assignment(const CourseArguments& where, const AssignmentArguments& args) {
    Course course(where.folder);
    if (args.remove) {
        remove_assignment(course, assignment_named(course, args.name), args.reason);
        std::cout << terminal_text(course_summary(course, CourseClock::now()));
        return kDone;
    }
    const std::vector<Assignment> all = assignments_of(course);
    const auto known = std::ranges::find_if(
        all, [&](const Assignment& a) { return ::strcasecmp(a.name.c_str(), args.name.c_str()) == 0; });
    Assignment a;
    if (known != all.end()) a = *known;
    const std::string kind = args.kind == "presentation" ? "talk" : args.kind;
    const bool other_kind = !kind.empty() && kind != a.kind;
    a.name = known != all.end() ? known->name : args.name;
    if (!kind.empty()) a.kind = kind;
    if (!a.is_report()) a.review_due.reset(), a.final_due.reset();
    if (args.reviews) a.reviews = *args.reviews;
    apply(args, course, a);
    if (!args.criteria.empty())
        a.criteria = criteria_of(args.criteria);
    else if (known == all.end() || other_kind)
        a.criteria = usual_criteria(a.kind);
    if (a.is_lab() && a.lesson.empty()) throw InvalidArgument("a lab needs the checks of a lesson: give --lesson NN");
    if (known == all.end() && !args.reason.empty() && !all.empty()) assignment_named(course, args.name);  // throws
    const bool changed = set_assignment(course, a, args.reason);
    std::cout << (changed ? "" : "No changes. ") << terminal_text(course_summary(course, CourseClock::now()));
    return kDone;
}

/// Those that may be changed later.
void add_settings(CLI::App& command, AssignmentArguments& args) {
    command.add_option("--lesson", args.lesson, "Lesson of the assignment")->type_name("NN");
    command.add_option("--first", args.first, "Deadline of the first version (or the slides): \"2026-03-01 18:00\"")
        ->type_name("TIME");
    command.add_option("--review", args.review, "Deadline of the reviews")->type_name("TIME");
    command.add_option("--final", args.final, "Deadline of the final version")->type_name("TIME");
    command.add_option("--grace", args.grace, "Grace period after a deadline: 15min, 2h, 1d. Default: 0.")
        ->type_name("DURATION");
    command
        .add_option(
            "--costs", args.costs,
            "Penalties in percentage points: of the work late-day:10 for each day or part of a day, late-most:50 as "
            "their maximum, missing-final:30; of the reviews late-review:5,missing-review:25. Default: none.")
        ->type_name("NAME:POINTS,...");
    command
        .add_option("--final-weight", args.final_weight,
                    "Weight of the final version in the work's mark, in percent, once it is scored. Default: 50.")
        ->check(CLI::Range(0, 100));
    command.add_option("--weight", args.weight, "Weight in the total of the course. Default: 1.")
        ->check(CLI::Range(0, 1000));
    command
        .add_option("--reviews-weight", args.reviews_weight,
                    "Weight of the reviews in the total mark of a report, in percent. Default: 20.")
        ->check(CLI::Range(0, 100));
    command.add_option("--checks", args.checks, "For a lab: folder with your own checks (*.lua)")->type_name("FOLDER");
    command.add_option("--secret", args.secret, "For a lab: file that determines the hidden data")->type_name("FILE");
    command.add_option("--keep", args.keep, "For a lab: which of several versions counts. Default: best.")
        ->type_name("best|newest")
        ->check(CLI::IsMember({"best", "newest"}));
}

void add_assignment_command(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<AssignmentArguments>();
    CLI::App* command = course.add_subcommand("assignment", "Add, change or remove an assignment");
    command->add_option("NAME", args->name, "Short name, such as crane")->required();
    command
        ->add_option("--kind", args->kind,
                     "lab: graded by checks; report: reviewed, then improved; talk: slides. Default: report.")
        ->type_name("lab|report|talk")
        ->check(CLI::IsMember({"lab", "report", "talk", "presentation"}));
    add_settings(*command, *args);
    command
        ->add_option("--reviews", args->reviews, "Number of reviews that each group writes and receives. Default: 2.")
        ->check(CLI::Range(1, 20));
    command->add_option(
        "--criteria", args->criteria,
        "Criteria that reviewers score (for a talk, that you score): name:points,... Default: data, steps, "
        "conclusions, strength, suggestions; for a talk content, slides, delivery, answers; 5 points each.");
    command->add_option(
        "--reason", args->reason,
        "Reason; recorded in the history. Required to change an assignment with submissions, and to remove one.");
    command->add_flag("--remove", args->remove, "Remove the assignment if nothing depends on it");
    command->footer(
        "Times are in the course's time zone. Options that you omit keep their values. Once files were submitted, "
        "--reason is\nrequired to move a deadline to an earlier time. dynlab updates lateness and marks "
        "immediately.\nExamples:\n  dynlab course assignment lab4 --kind lab --lesson 04 --first \"2026-03-09 18:00\" "
        "--secret secret.txt --weight 10\n  dynlab course assignment crane --lesson 03_crane --first \"2026-02-28 "
        "13:00\" \\\n            --review \"2026-03-04 13:00\" --final \"2026-03-07 14:00\" --grace 15min --reviews "
        "2\n  dynlab course assignment crane --final \"2026-03-08 14:00\" --reason \"strike on Friday\"");
    command->callback([&where, args, &action] { action = [&where, args] { return enter_assignment(where, *args); }; });
}

void add_who(CLI::App& course, CourseArguments& where, Action& action) {
    struct Arguments {
        std::string name, at;
    };
    auto args = std::make_shared<Arguments>();
    CLI::App* command =
        course.add_subcommand("who", "Show all data of a student or a group: work, receipts, marks, history");
    command->add_option("NAME", args->name, "Group in any spelling, or a student's name, id or address")->required();
    add_time_option(*command, args->at);
    command->footer("Example:  dynlab course who \"Kim Min-jun\"");
    command->callback([&where, args, &action] {
        action = [&where, args] {
            Course opened(where.folder);
            std::cout << terminal_text(who_text(opened, args->name, time_of(opened, args->at)));
            return kDone;
        };
    });
}

void add_status(CLI::App& course, CourseArguments& where, Action& action) {
    struct Arguments {
        std::string assignment, at;
    };
    auto args = std::make_shared<Arguments>();
    CLI::App* command = course.add_subcommand("status", "Show submissions, late and missing work, and what to do next");
    command->add_option("ASSIGNMENT", args->assignment, "Assignment. Default: all.");
    command->footer(
        "Examples:\n"
        "  dynlab course status\n"
        "  dynlab course status crane");
    add_time_option(*command, args->at);
    command->callback([&where, args, &action] {
        action = [&where, args] {
            Course opened(where.folder);
            const Instant now = time_of(opened, args->at);
            std::vector<Assignment> shown;
            if (args->assignment.empty()) {
                std::cout << terminal_text(course_summary(opened, now));
                shown = assignments_of(opened);
            } else {
                shown = {assignment_named(opened, args->assignment)};
            }
            for (const Assignment& a : shown)
                std::cout << (args->assignment.empty() ? "\n" : "") << terminal_text(assignment_status(opened, a, now));
            return kDone;
        };
    });
}

}  // namespace

void add_time_option(CLI::App& command, std::string& text) {
    command.add_option("--at", text, "Time to use instead of now, in the course's time zone")
        ->type_name("TIME")
        ->group("");  // the help of all commands says it once
}

void add_after_option(CLI::App& command, std::optional<std::int64_t>& entry) {
    command
        .add_option(
            "--after", entry,
            "Set the mark only if its newest entry still has this number, which dynlab course page shows. 0: if "
            "it has no entry.")
        ->type_name("N");
}

Instant time_of(const Course& course, const std::string& text) {
    return text.empty() ? CourseClock::now() : course.clock().parse(text, "--at");
}

void add_course(CLI::App& app, Action& action) {
    static CourseArguments where;
    CLI::App* course = app.add_subcommand("course", "Run a course from roster to marks: labs, reports, talks");
    course->require_subcommand(1);
    course
        ->add_option("--course", where.folder, "Folder of the course. Default: this folder, or the nearest one above.")
        ->type_name("DIR");
    add_init(*course, action);
    add_import(*course, where, action);
    add_drop(*course, where, action);
    add_assignment_command(*course, where, action);
    add_receive_commands(*course, where, action);
    add_issues_command(*course, where, action);
    add_peer_commands(*course, where, action);
    add_changes(*course, where, action);
    add_remind_command(*course, where, action);
    add_grade_commands(*course, where, action);
    add_mark_commands(*course, where, action);
    add_course_answers(*course, where, action);
    add_correction_commands(*course, where, action);
    add_status(*course, where, action);
    add_who(*course, where, action);
    add_course_page(*course, where, action);
    course->footer(
        "Each command changes either everything or nothing, and can be repeated. dynlab deletes nothing.\n"
        "  dynlab course init signals-2026 --timezone Europe/Paris    then, in that folder:\n"
        "  dynlab course import roster.csv\n"
        "  dynlab course assignment lab4 --kind lab --lesson 04 --first ...\n"
        "  dynlab course submit lab4.zip --assignment lab4            an export of Moodle or Canvas, or files\n"
        "  dynlab course status lab4                                  late submissions, and what to do next\n"
        "  dynlab course grade lab4                                   marks and feedback\n"
        "  dynlab course export -o term.csv                           all marks, and the total\n"
        "  dynlab course page                                         the course in the browser\n"
        "A term in 20 commands: dynlab help guide-instructor\n"
        "Commands that depend on the date have the option --at TIME, which replaces the current time.\n"
        "More: dynlab help review_marks (how marks follow from scores), dynlab help names (which names are searched "
        "for)\n"
        "Exit codes: 0 done, 1 something failed or was not accepted, 2 wrong usage.");
}

}  // namespace dynlab::inline cli
