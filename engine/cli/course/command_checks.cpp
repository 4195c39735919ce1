#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/course/grading_options.h"
#include "course/grading/check_trial.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct ChecksArguments {
    std::string folder, lesson, secret;
    int timeout = 60;
};

int try_them(const ChecksArguments& args) {
    GradingSetup setup = trial_setup(find_lesson(args.lesson), args.secret, args.timeout);
    if (!args.folder.empty()) setup.more_checks = args.folder;
    const CheckTrial trial = try_checks_of(setup);
    std::cout << terminal_text(trial_in_words(trial));
    return trial.sound() ? kDone : kFailed;
}

}  // namespace

void add_checks(CLI::App& app, Action& action) {
    CLI::App* group = app.add_subcommand("checks", "Test checks before a class uses them");
    group->require_subcommand(1);
    auto args = std::make_shared<ChecksArguments>();
    CLI::App* command =
        group->add_subcommand("try", "Run the checks of a lesson, and your own, on correct and incorrect scripts");
    command
        ->add_option("FOLDER", args->folder, "Folder with your own checks (*.lua). Default: only the lesson's checks.")
        ->type_name("FOLDER");
    command->add_option("--lesson", args->lesson, "Lesson")->type_name("NN")->required();
    add_secret_option(*command, args->secret);
    add_timeout_option(*command, args->timeout);
    command->footer(
        "The checks run on the reference solution, the untouched starter, the lesson's wrong_*.lua and right_*.lua, "
        "and your\n"
        "own scripts FOLDER/try/*.lua. They also run on the reference solution with one answer 1.5 times as large, "
        "with the\n"
        "opposite sign, or missing. For each script, dynlab prints the points and the messages of missing points. At "
        "the end\n"
        "it lists the checks that the reference solution fails, and the checks that no script fails.\n"
        "Example:  dynlab checks try my-checks --lesson 04\n"
        "Exit codes: 0 the reference solution passes all checks, 1 it does not, 2 wrong usage.");
    command->callback([args, &action] { action = [args] { return try_them(*args); }; });
}

}  // namespace dynlab::inline cli
