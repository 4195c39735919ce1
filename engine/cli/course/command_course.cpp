#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/course_commands.h"
#include "course/office/course_status.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "numerics/error.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

void add_init(CLI::App& course, Action& action) {
    struct Arguments {
        std::string folder, name, zone = "UTC";
    };
    auto words = std::make_shared<Arguments>();
    CLI::App* command = course.add_subcommand("init", "Make a course: a folder with its store and its key");
    command->add_option("DIR", words->folder, "The course's folder; it may exist")->required();
    command->add_option("--name", words->name, "The course's name, for receipts; the folder's unless given");
    command->add_option("--timezone", words->zone, "Times are read and shown in it")
        ->type_name("ZONE")
        ->capture_default_str();
    command->footer("Example:  dynlab course init signals-2026 --name \"Signals 2026\" --timezone Europe/Paris");
    command->callback([words, &action] {
        action = [words] {
            const fs::path folder = fs::absolute(words->folder).lexically_normal();
            const std::string own = (folder.has_filename() ? folder : folder.parent_path()).filename();
            Course::create(folder, words->name.empty() ? own : words->name, words->zone);
            std::cout << fmt::format(
                "Course made in {}, times in {}.\n"
                "course.key signs the receipts: keep a copy of the whole folder, and give the key to nobody.\n"
                "course.pub verifies them: give it to your students, who need dynlab verify and no course.\n"
                "Next: cd {} and dynlab course roster import roster.csv\n",
                folder.string(), words->zone, words->folder);
            return kDone;
        };
    });
}

void add_roster(CLI::App& course, CourseArguments& where, Action& action) {
    CLI::App* roster = course.add_subcommand("roster", "Students and groups: import, drop, return");
    roster->require_subcommand(1);
    auto file = std::make_shared<std::string>();
    auto no_groups = std::make_shared<bool>(false);
    CLI::App* import = roster->add_subcommand("import", "Read students and groups from a CSV; may be repeated");
    import->add_option("CSV", *file, "Columns id and group, and optionally name, email (or mail), moodle, canvas")
        ->required();
    import->add_flag("--no-groups", *no_groups, "The file has no column group: new students work alone");
    import->footer(
        "A student without a group is one alone; in several, they are joined by |. Who is not in the file stays, and\n"
        "so does what has no column in it. Names and addresses that change are still looked for in anonymous copies.\n"
        "Example:  dynlab course roster import roster.csv");
    import->callback([&where, file, no_groups, &action] {
        action = [&where, file, no_groups] {
            Course opened(where.folder);
    const RosterChange change = import_roster(opened, *file, *no_groups);
    if (change.converted)
        std::cerr << terminal_text(
            fmt::format("dynlab: {} is not UTF-8; it was read as Latin-1 (Windows-1252)\n", *file));
    if (!change.unknown_columns.empty())
        std::cerr << terminal_text(fmt::format("dynlab: {}: not read: the unknown columns {}\n", *file,
                                               fmt::join(change.unknown_columns, ", ")));
    if (!change.short_ids.empty())
        std::cerr << terminal_text(fmt::format("dynlab: {}: {}\n", *file, message_text(change.short_ids)));
    std::cout << fmt::format("{} students: {} new, {} changed, {} moved to another group; {} new groups.\n",
                             change.students, change.new_students, change.changed, change.moved, change.new_groups);
    if (!change.absent.empty())
        std::cout << terminal_text(
            fmt::format("Not in this file, but in the course (they stay; roster drop GROUP takes a group out): {}\n",
                        fmt::join(change.absent, ", ")));
    return kDone;
};
}  // namespace
);
const auto add_move = [&](const char* name, const char* about, bool dropped_out) {
    auto group = std::make_shared<std::string>(), reason = std::make_shared<std::string>();
    CLI::App* command = roster->add_subcommand(name, about);
    command->add_option("GROUP", *group)->required();
    command->add_option("--reason", *reason, "For the journal");
    command->callback([&where, group, reason, dropped_out, &action] {
        action = [&where, group, reason, dropped_out] {
            Course opened(where.folder);
            set_group_dropped_out(opened, *group, dropped_out, *reason);
            std::cout << fmt::format(
                "{} {}; repeat dynlab course peer assign where reviews are under way.\n", *group,
                dropped_out ? "has dropped out: its work and the reviews it wrote stay" : "is in the course again");
            return kDone;
        };
    });
};
add_move("drop", "A group has dropped out", true);
add_move("return", "A group that had dropped out is back", false);
}  // namespace dynlab::inline cli

struct AssignmentArguments {
    std::string name, kind = "report", lesson, first, review, final, grace, criteria, costs, reason;
    std::optional<double> final_weight, weight, reviews_weight;
    std::string checks, secret, keep;
    int reviews = 2;
};

/// A path as it is found again from elsewhere; "none" takes it back.
std::string lasting_path(const std::string& given) {
    return given == "none" ? "" : fs::absolute(given).lexically_normal().string();
}

/// Sets what was given.
void apply(const AssignmentArguments& words, const CourseClock& clock, Assignment& a) {
    if (!words.lesson.empty()) {
        find_lesson(words.lesson);  // there is one, and one only
        a.lesson = words.lesson;
    }
    if (!words.first.empty()) a.first_due = clock.parse(words.first, "--first");
    if (!words.review.empty()) a.review_due = clock.parse(words.review, "--review");
    if (!words.final.empty()) a.final_due = clock.parse(words.final, "--final");
    if (!words.grace.empty()) {
        const auto grace = duration_of(words.grace);
        if (!grace)
            throw InvalidArgument("--grace must be a duration such as 15min, 2h or 1d, but \"{}\" was given",
                                  words.grace);
        a.grace = *grace;
    }
    if (!words.costs.empty()) a.costs = costs_of(words.costs == "none" ? "" : words.costs);
    if (words.final_weight) a.final_weight = *words.final_weight;
    if (words.weight) a.weight = *words.weight;
    if (words.reviews_weight) a.reviews_weight = *words.reviews_weight;
    if (!words.checks.empty()) a.checks = lasting_path(words.checks);
    if (!words.secret.empty()) a.secret = lasting_path(words.secret);
    if (!words.keep.empty()) a.keep = words.keep;
}

int change_one(const CourseArguments& where, const AssignmentArguments& words) {
    Course course(where.folder);
    Assignment a = assignment_named(course, words.name);
    apply(words, course.clock(), a);
    std::cout << (change_assignment(course, a, words.reason) ? "" : "Nothing new. ")
              << terminal_text(course_summary(course, CourseClock::now()));
    return kDone;
}

int remove_one(const CourseArguments& where, const AssignmentArguments& words) {
    Course course(where.folder);
    remove_assignment(course, assignment_named(course, words.name), words.reason);
    std::cout << terminal_text(course_summary(course, CourseClock::now()));
    return kDone;
}

int add_one(const CourseArguments& where, const AssignmentArguments& words) {
    Course course(where.folder);
    Assignment a;
    a.name = words.name, a.kind = words.kind, a.reviews = words.reviews;
    apply(words, course.clock(), a);
    if (a.is_lab() && a.lesson.empty()) throw InvalidArgument("a lab is graded by the checks of a lesson: --lesson NN");
    a.criteria = words.criteria.empty() ? usual_criteria(a.kind) : criteria_of(words.criteria);
    std::cout << (add_assignment(course, a) ? "" : "Nothing new. ")
              << terminal_text(course_summary(course, CourseClock::now()));
    return kDone;
}

/// Those that may be changed later; returns the option of the first deadline.
CLI::Option* add_settings(CLI::App& command, AssignmentArguments& words) {
    command.add_option("--lesson", words.lesson, "The lesson it belongs to")->type_name("NN");
    CLI::Option* const first =
        command
            .add_option("--first", words.first, "Deadline of the first version (or the slides): \"2026-03-01 18:00\"")
            ->type_name("TIME");
    command.add_option("--review", words.review, "Deadline of the reviews")->type_name("TIME");
    command.add_option("--final", words.final, "Deadline of the final version")->type_name("TIME");
    command.add_option("--grace", words.grace, "So much later counts as in time: 15min, 2h, 1d; 0 at first")
        ->type_name("DURATION");
    command
        .add_option("--costs", words.costs,
                    "Percent points off marks: late-day:10 off the work for each day or part of a day, late-most:50 in "
                    "all, missing-final:30; late-review:5,missing-review:25 off the reviews. Default: none.")
        ->type_name("NAME:POINTS,...");
    command
        .add_option("--final-weight", words.final_weight,
                    "Percent of the work's mark that the final version has once it is scored; 50 at first")
        ->check(CLI::Range(0, 100));
    command.add_option("--weight", words.weight, "Weight in the course's total. Default: 1.")
        ->check(CLI::Range(0, 1000));
    command
        .add_option("--reviews-weight", words.reviews_weight,
                    "Percent of a report's mark in the total that the mark of its reviews makes. Default: 20.")
        ->check(CLI::Range(0, 100));
    command.add_option("--checks", words.checks, "Of a lab: folder with your own checks (*.lua)")->type_name("FOLDER");
    command.add_option("--secret", words.secret, "Of a lab: file from which the hidden data are drawn")
        ->type_name("FILE");
    command.add_option("--keep", words.keep, "Of a lab: which of several versions counts. Default: best.")
        ->type_name("best|newest")
        ->check(CLI::IsMember({"best", "newest"}));
    return first;
}

void add_assignment_commands(CLI::App& course, CourseArguments& where, Action& action) {
    CLI::App* assignment = course.add_subcommand("assignment", "What is to be handed in, and when");
    assignment->require_subcommand(1);
    auto words = std::make_shared<AssignmentArguments>();
    CLI::App* add = assignment->add_subcommand("add", "Add an assignment, or give more time for one");
    add->add_option("NAME", words->name, "A short word, such as crane")->required();
    add->add_option("--kind", words->kind, "lab: script, graded by checks; report: reviewed, improved; talk: slides")
        ->check(CLI::IsMember({"lab", "report", "talk"}))
        ->capture_default_str();
    add_settings(*add, *words);
    add->add_option("--reviews", words->reviews, "Reviews that each group writes and gets")
        ->check(CLI::Range(1, 20))
        ->capture_default_str();
    add->add_option("--criteria", words->criteria,
                    "What reviewers (or you, at the oral) score: name:points,...; unless given data, steps, "
                    "conclusions, strength, suggestions, at the oral content, slides, delivery, answers, of 5 each");
    add->footer(
        "Times are in the course's time zone. The same command again changes nothing; once work was handed in, "
        "deadlines can\n"
        "only move to later here; assignment change moves them both ways.\n"
        "Example:  dynlab course assignment add crane --lesson 03_crane --first \"2026-02-28 13:00\" \\\n"
        "            --review \"2026-03-04 13:00\" --final \"2026-03-07 14:00\" --grace 15min --reviews 2");
    add->callback([&where, words, &action] { action = [&where, words] { return add_one(where, *words); }; });

    auto changes = std::make_shared<AssignmentArguments>();
    CLI::App* change = assignment->add_subcommand("change", "Move deadlines, set costs and weights, at any time");
    change->add_option("NAME", changes->name, "The assignment")->required();
    add_settings(*change, *changes);
    change->add_option("--reason", changes->reason, "Stands in the history")->required();
    change->footer(
        "What is not named stays. Lateness and marks follow at once, also of what came before.\n"
        "Example:  dynlab course assignment change crane --final \"2026-03-08 14:00\" --reason \"strike on Friday\"");
    change->callback(
        [&where, changes, &action] { action = [&where, changes] { return change_one(where, *changes); }; });

    auto gone = std::make_shared<AssignmentArguments>();
    CLI::App* remove = assignment->add_subcommand("remove", "Take an assignment out, while nothing hangs on it");
    remove->add_option("NAME", gone->name, "The assignment")->required();
    remove->add_option("--reason", gone->reason, "Stands in the history")->required();
    remove->footer("Example:  dynlab course assignment remove carne --reason \"mistyped\"");
    remove->callback([&where, gone, &action] { action = [&where, gone] { return remove_one(where, *gone); }; });
}

void add_status(CLI::App& course, CourseArguments& where, Action& action) {
    struct Arguments {
        std::string assignment, at;
    };
    auto words = std::make_shared<Arguments>();
    CLI::App* command = course.add_subcommand("status", "What was handed in, what is late, and what to do about it");
    command->add_option("ASSIGNMENT", words->assignment, "All unless given");
    command->footer(
        "Examples:\n"
        "  dynlab course status\n"
        "  dynlab course status crane");
    add_time_option(*command, words->at);
    command->callback([&where, words, &action] {
        action = [&where, words] {
            Course opened(where.folder);
            const Instant now = time_of(opened, words->at);
            std::vector<Assignment> shown;
            if (words->assignment.empty()) {
                std::cout << terminal_text(course_summary(opened, now));
                shown = assignments_of(opened);
            } else {
                shown = {assignment_named(opened, words->assignment)};
            }
            for (const Assignment& a : shown)
                std::cout << (words->assignment.empty() ? "\n" : "")
                          << terminal_text(assignment_status(opened, a, now));
            return kDone;
        };
    });
}

}  // namespace

void add_time_option(CLI::App& command, std::string& text) {
    command.add_option("--at", text, "As if it were this time, in the course's zone; now unless given")
        ->type_name("TIME");
}

Instant time_of(const Course& course, const std::string& text) {
    return text.empty() ? CourseClock::now() : course.clock().parse(text, "--at");
}

void add_course(CLI::App& app, Action& action) {
    static CourseArguments where;
    CLI::App* course = app.add_subcommand("course", "A course from roster to marks: hand-ins, peer review, export");
    course->require_subcommand(1);
    course->add_option("--course", where.folder, "The course's folder; this one, or one above it, unless given")
        ->type_name("DIR");
    add_init(*course, action);
    add_roster(*course, where, action);
    add_assignment_commands(*course, where, action);
    add_receive_commands(*course, where, action);
    add_findings_command(*course, where, action);
    add_peer_commands(*course, where, action);
    add_changes(*course, where, action);
    add_remind_command(*course, where, action);
    add_mark_commands(*course, where, action);
    add_course_answers(*course, where, action);
    add_correction_commands(*course, where, action);
    add_status(*course, where, action);
    course->footer(
        "Every command is all or nothing and may be repeated; nothing is ever deleted.\n"
        "  dynlab course init signals-2026 --timezone Europe/Paris    then, in that folder:\n"
        "  dynlab course roster import roster.csv\n"
        "  dynlab course assignment add crane --first \"2026-02-28 13:00\" --review ... --final ...\n"
        "  dynlab course receive crane.zip --assignment crane         what Moodle or Canvas exports, or files\n"
        "  dynlab course status crane                                 who is late, and what to do\n"
        "  dynlab course findings group-07                            what was found in a group's report\n"
        "  dynlab course peer assign crane                            who reviews whom\n"
        "  dynlab course changes --assignment crane                   first and final versions, word by word\n"
        "  dynlab course marks crane                                  from the reviewers' scores and your own word\n"
        "  dynlab course export crane --out marks.csv                 for Moodle and Canvas\n"
        "More: dynlab help review_marks (how marks come out of scores), dynlab help names (what is searched for)\n"
        "Exit codes: 0 done, 1 something failed or was not taken, 2 wrong usage.");
}

}  // namespace dynlab::inline cli
