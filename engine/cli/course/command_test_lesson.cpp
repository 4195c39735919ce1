#include <fmt/format.h>

#include <iostream>

#include "base/languages.h"
#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/grading_options.h"
#include "course/grading/lesson_translation.h"
#include "course/grading/lesson_trial.h"
#include "platform/terminal/activity_line.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct TestLessonArguments {
    std::string lesson, part, secret, skeleton;
    int timeout = 60;
};

int test_lesson(const TestLessonArguments& args) {
    const Lesson lesson = find_lesson(args.lesson);
    if (!args.skeleton.empty()) {
        for (const auto& file : write_translation_skeleton(lesson, args.skeleton))
            std::cout << terminal_text(file.string()) << '\n';
        return kDone;
    }
    std::size_t faults = 0;
    const auto print_faults = [&](const LessonFaults& found, const std::string& what) {
        for (const LessonFault& fault : found) {
            const std::string line = fault.line > 0 ? fmt::format(":{}", fault.line) : "";
            std::cout << terminal_text(
                fmt::format("{}{}: {}\n", (lesson.folder / fault.file).string(), line, message_text(fault.what)));
        }
        if (found.empty()) std::cout << what << ": no errors\n";
        faults += found.size();
        return found.empty();
    };
    const auto requested = [&](const char* part) { return args.part.empty() || args.part == part; };
    bool readable = true;  // what cannot be read is not run
    if (requested("texts")) readable = print_faults(faults_of_texts(lesson), "texts");
    if (readable && requested("checks")) {
        LessonFaults warnings;
        print_faults(faults_of_checks(trial_setup(lesson, args.secret, args.timeout), &warnings), "checks");
        for (const LessonFault& warning : warnings)
            std::cout << terminal_text(
                fmt::format("{}: warning: {}\n", (lesson.folder / warning.file).string(), message_text(warning.what)));
    }
    if (readable && requested("documents")) {
        LessonFaults found;
        {
            ActivityLine activity;
            activity.begin_step("creating reports and students' copies");
            found = faults_of_documents(lesson);
        }
        print_faults(found, "documents");
    }
    if (faults > 0)
        std::cerr << "dynlab: "
                  << message_text(readable ? plural(faults, "{} error in {}", "{} errors in {}", lesson.slug)
                                           : plural(faults, "{} error in {}; nothing was run",
                                                    "{} errors in {}; nothing was run", lesson.slug))
                  << '\n';
    return faults == 0 ? kDone : kFailed;
}

}  // namespace

void add_test_lesson(CLI::App& app, Action& action) {
    auto args = std::make_shared<TestLessonArguments>();
    CLI::App* command = app.add_subcommand("test-lesson", "Test a lesson before a class uses it");
    command->add_option("LESSON", args->lesson, "Folder, number or name of the lesson")->required();
    command->add_option("--part", args->part, "Part of the test to run")
        ->type_name("PART")
        ->check(CLI::IsMember({"texts", "checks", "documents"}));
    command
        ->add_option("--skeleton", args->skeleton,
                     "Run no test; write tasks.LANG.lua and checks.LANG.po with the texts to translate")
        ->type_name("LANG")
        ->check(CLI::IsMember(languages()));
    add_secret_option(*command, args->secret);
    add_timeout_option(*command, args->timeout);
    command->footer(
        "texts: headers, cells, Lua, names and options, hints, tasks in other languages; no script runs.\nchecks: the "
        "reference solution and right_*.lua get full marks, and the untouched starter gets none; each\nwrong_*.lua "
        "fails exactly the checks that its lines \"-- expects: CHECK: words\" name, with these words.\nStudents read "
        "checks.lua: dynlab warns if it contains a number that passes a check when entered as the answer.\ndocuments: "
        "in each language the report is complete and fits its pages, and the student's copy runs and gives a "
        "report.\nExample:  dynlab new lesson lessons/08_springs && dynlab test-lesson lessons/08_springs\nExit codes: "
        "0 no errors, 1 errors were found, 2 wrong usage.");
    command->callback([args, &action] { action = [args] { return test_lesson(*args); }; });
}

}  // namespace dynlab::inline cli
