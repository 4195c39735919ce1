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

int test_lesson(const TestLessonArguments& words) {
    const Lesson lesson = find_lesson(words.lesson);
    if (!words.skeleton.empty()) {
        for (const auto& file : write_translation_skeleton(lesson, words.skeleton))
            std::cout << terminal_text(file.string()) << '\n';
        return kDone;
    }
    std::size_t faults = 0;
    const auto tell = [&](const LessonFaults& found, const std::string& what) {
        for (const LessonFault& fault : found) {
            const std::string line = fault.line > 0 ? fmt::format(":{}", fault.line) : "";
            std::cout << terminal_text(
                fmt::format("{}{}: {}\n", (lesson.folder / fault.file).string(), line, message_text(fault.what)));
        }
        if (found.empty()) std::cout << what << ": in order\n";
        faults += found.size();
        return found.empty();
    };
    const auto wanted = [&](const char* part) { return words.part.empty() || words.part == part; };
    bool readable = true;  // what cannot be read is not run
    if (wanted("texts")) readable = tell(faults_of_texts(lesson), "texts");
    if (readable && wanted("checks")) {
        LessonFaults warnings;
        tell(faults_of_checks(trial_setup(lesson, words.secret, words.timeout), &warnings), "checks");
        for (const LessonFault& warning : warnings)
            std::cout << terminal_text(
                fmt::format("{}: warning: {}\n", (lesson.folder / warning.file).string(), message_text(warning.what)));
    }
    if (readable && wanted("documents")) {
        LessonFaults found;
        {
            ActivityLine activity;
            activity.begin_step("making reports and students' copies");
            found = faults_of_documents(lesson);
        }
        tell(found, "documents");
    }
    if (faults > 0)
        std::cerr << "dynlab: "
                  << message_text(readable ? plural(faults, "{} fault in {}", "{} faults in {}", lesson.slug)
                                           : plural(faults, "{} fault in {}; nothing was run",
                                                    "{} faults in {}; nothing was run", lesson.slug))
                  << '\n';
    return faults == 0 ? kDone : kFailed;
}

}  // namespace

void add_test_lesson(CLI::App& app, Action& action) {
    auto words = std::make_shared<TestLessonArguments>();
    CLI::App* command = app.add_subcommand("test-lesson", "Test a lesson before a class meets it");
    command->add_option("LESSON", words->lesson, "The lesson's folder, number or name")->required();
    command->add_option("--part", words->part, "Only a part of it")
        ->type_name("PART")
        ->check(CLI::IsMember({"texts", "checks", "documents"}));
    command
        ->add_option("--skeleton", words->skeleton,
                     "Test nothing; write tasks.LANG.lua and checks.LANG.po with the texts to translate")
        ->type_name("LANG")
        ->check(CLI::IsMember(languages()));
    add_secret_option(*command, words->secret);
    add_timeout_option(*command, words->timeout);
    command->footer(
        "texts: headers, cells, Lua, names and options, hints, tasks in other languages; nothing is run.\n"
        "checks: the worked solution gets full marks, the untouched starter none, right_*.lua all; each wrong_*.lua\n"
        "fails what its lines \"-- expects: CHECK: words\" name, with these words, and nothing else.\n"
        "Warned of, as students read checks.lua: a number in it that passes a check when it is typed in as the "
        "answer.\n"
        "documents: in each language the report is whole and fits its pages, and the student's copy runs and has one.\n"
        "Example:  dynlab new lesson lessons/08_springs && dynlab test-lesson lessons/08_springs\n"
        "Exit codes: 0 all is in order, 1 something is not, 2 wrong usage.");
    command->callback([words, &action] { action = [words] { return test_lesson(*words); }; });
}

}  // namespace dynlab::inline cli
