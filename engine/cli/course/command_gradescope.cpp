#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/course/grading_options.h"
#include "course/export/gradescope.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"

namespace dynlab::inline cli {
namespace {

struct GradescopeArguments {
    std::string lesson, output, checks, secret;
    int timeout = 60;
};

int make_autograder(const GradescopeArguments& args) {
    AutograderRequest request;
    request.lesson = find_lesson(args.lesson);
    if (!args.checks.empty()) request.more_checks = args.checks;
    request.secret = read_file(args.secret);
    request.timeout_seconds = args.timeout;
    request.program = running_program();
    const std::filesystem::path zip = args.output.empty() ? request.lesson.slug + "-autograder.zip" : args.output;
    const std::uintmax_t bytes = write_autograder(request, zip);
    std::cout << fmt::format("{}: {:.1f} MB\n", zip.string(), static_cast<double>(bytes) / 1e6);
    return kDone;
}

}  // namespace

void add_gradescope(CLI::App& app, Action& action) {
    auto args = std::make_shared<GradescopeArguments>();
    CLI::App* command =
        app.add_subcommand("gradescope", "Create the Gradescope autograder of a lesson as one zip file");
    command->add_option("LESSON", args->lesson, "Number, name or folder of the lesson")->required();
    add_secret_option(*command, args->secret)->required();
    command
        ->add_option("-o,--output", args->output,
                     "Zip file to create. Default: NN_name-autograder.zip in the current folder.")
        ->type_name("FILE.zip");
    command->add_option("--checks", args->checks, "Folder with your own checks (*.lua), which students never see")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory);
    add_timeout_option(*command, args->timeout);
    command->footer(
        "The zip file contains setup.sh, run_autograder and all files that they need. Upload it, and choose a base "
        "image that is\nat least as new as this machine (x86-64). Students submit analysis.lua, or the zip file from "
        "dynlab pack, and see the\nsame points, messages and hints as from dynlab grade; for your own checks, they see "
        "only points and hints.\nExample:  dynlab gradescope 04 --secret secret.txt --checks my-checks");
    command->callback([args, &action] { action = [args] { return make_autograder(*args); }; });
}

}  // namespace dynlab::inline cli
