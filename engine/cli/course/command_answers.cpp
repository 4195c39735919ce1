#include <algorithm>
#include <iostream>
#include <memory>

#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/course_commands.h"
#include "course/answers/answers_page.h"
#include "course/intake/submission.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/newest_versions.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct AnswersArguments {
    std::string submissions, assignment, stage = "first", lesson, question, check, roster, out;
};

void add_answers_options(CLI::App& command, AnswersArguments& args) {
    command.add_option("--question", args.question, "Number of a question, or title of a section of the report")
        ->type_name("N")
        ->required();
    command.add_option("-o,--out", args.out, "Folder for answers-qN.html, .md and .csv")->type_name("OUT")->required();
    command.add_option("--check", args.check, "Check to which the marks belong. Default: q and the question's number.")
        ->type_name("ID");
}

constexpr char kFiles[] =
    "Numbers replace the names of submissions, and [name] replaces names and ids of the roster. Equal and nearly "
    "equal\n"
    "answers are shown once. Enter points and reason in answers-qN.csv. Then copy submission (as who), check, points\n"
    "and reason into marks.csv of the results. A further call keeps the numbers and all entries.\n";

int print_answers(AnswersRequest request) {
    request.isolation = strongest_isolation();
    request.program = running_program();
    const AnswersOutcome outcome = collect_answers(request);
    for (const Message& complaint : outcome.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    if (request.roster.empty()) std::cerr << "dynlab: no --roster FILE: names in the answers are not replaced\n";
    const auto count = [](std::size_t number) { return static_cast<std::int64_t>(number); };
    std::cout << message_text(plural(count(outcome.submissions), "{} submission: {}, {}", "{} submissions: {}, {}",
                                     plural(count(outcome.answers), "{} answer", "{} answers"),
                                     plural(count(outcome.groups), "{} of them different", "{} of them different")))
              << '\n'
              << outcome.page.string() << '\n'
              << outcome.marks.string() << '\n';
    return outcome.complaints.empty() ? kDone : kFailed;
}

int answers_of_folder(const AnswersArguments& args) {
    AnswersRequest request;
    request.lesson = find_lesson(args.lesson);
    request.submissions = args.submissions;
    request.out = args.out;
    request.question = args.question;
    request.check = args.check;
    if (!args.roster.empty()) request.roster = Roster(args.roster).students();
    return print_answers(std::move(request));
}

/// Puts what each group submitted last, script or pack, into a folder, as collect_answers reads it.
bool lay_out_work(Course& course, const Assignment& assignment, const std::string& stage, const fs::path& folder) {
    for (const Group& group : groups_of(course)) {
        auto newest = newest_file(course, assignment, group.id, stage, "script");
        const auto pack = newest_file(course, assignment, group.id, stage, "pack");
        if (pack && (!newest || pack->received_at > newest->received_at)) newest = pack;
        if (!newest) continue;
        const auto stem = archive_stem(newest->name);
        const fs::path file = newest->part == "script"
                                  ? folder / group.name / "analysis.lua"
                                  : folder / (group.name + (stem ? newest->name.substr(stem->size()) : ".zip"));
        fs::create_directories(file.parent_path());
        fs::copy_file(course.file(newest->hash), file);
    }
    return fs::exists(folder);
}

int answers_of_course(const CourseArguments& where, const AnswersArguments& args) {
    const TemporaryFolder work;
    AnswersRequest request;
    {
        Course course(where.folder);
        const Assignment assignment = assignment_named(course, args.assignment);
        const std::string lesson = args.lesson.empty() ? assignment.lesson : args.lesson;
        if (lesson.empty())
            throw EnvironmentError("the assignment {} does not specify a lesson; give --lesson NN", assignment.name);
        request.lesson = find_lesson(lesson);
        request.submissions = work.path() / "submissions";
        request.roster = students_of(course);
        if (!lay_out_work(course, assignment, args.stage, request.submissions))
            throw EnvironmentError("{}: no group has submitted a script or a pack", assignment.name);
    }
    request.out = args.out;
    request.question = args.question;
    request.check = args.check;
    return print_answers(std::move(request));
}

}  // namespace

void add_answers(CLI::App& app, Action& action) {
    auto args = std::make_shared<AnswersArguments>();
    CLI::App* command =
        app.add_subcommand("answers", "Collect all written answers to a question on one anonymous page");
    command
        ->add_option("FOLDER", args->submissions,
                     "Submissions: folders, packs, zip files, or an export of Moodle or Canvas")
        ->required()
        ->check(CLI::ExistingPath);
    command->add_option("--lesson", args->lesson, "Lesson of the question")->type_name("NN")->required();
    add_answers_options(*command, *args);
    command->add_option("--roster", args->roster, "CSV with the columns id, name, group: names to replace")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command->footer(std::string(kFiles) +
                    "Example:  dynlab answers Lab4.zip --lesson 04 --question 3 --roster roster.csv --out "
                    "answers\nExit codes: 0 all submissions were read, 1 some could not be read, 2 wrong usage.");
    command->callback([args, &action] { action = [args] { return answers_of_folder(*args); }; });
}

void add_course_answers(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<AnswersArguments>();
    CLI::App* command =
        course.add_subcommand("answers", "Collect all written answers to a question on one anonymous page");
    command->add_option("ASSIGNMENT", args->assignment, "Assignment. Required if there are several.");
    add_answers_options(*command, *args);
    command->add_option("--lesson", args->lesson, "Lesson of the question. Default: the assignment's.")
        ->type_name("NN");
    command->add_option("--stage", args->stage, "Version of the submissions")
        ->check(CLI::IsMember({"first", "final"}))
        ->capture_default_str();
    command->footer(std::string(kFiles) +
                    "Example:  dynlab course answers crane --question 3 --out answers\nExit codes: 0 all submissions "
                    "were read, 1 some could not be read, 2 wrong usage.");
    command->callback([&where, args, &action] { action = [&where, args] { return answers_of_course(where, *args); }; });
}

}  // namespace dynlab::inline cli
