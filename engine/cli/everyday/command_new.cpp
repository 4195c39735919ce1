#include <optional>

#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/say.h"
#include "platform/error.h"
#include "platform/terminal/activity_line.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/authoring/editor_files.h"
#include "workflow/authoring/lesson_skeleton.h"
#include "workflow/authoring/made_folders.h"
#include "workflow/student_copy.h"

namespace dynlab::inline cli {
namespace {

struct NewArguments {
    std::string lesson, folder, language;
    std::optional<std::uint32_t> group_seed;
};

int make_editor_files(const std::string& folder) {
    if (!std::filesystem::is_directory(folder)) throw EnvironmentError("folder not found: {}", folder);
    for (const std::string& kept : write_editor_files(folder))
        say(Message("{} already exists and was not changed", kept));
    say(Message("{}: editors can now complete and check dynlab functions", folder));
    return kDone;
}

int make_lesson(const std::string& folder) {
    for (const std::string& name : make_lesson_skeleton(folder)) std::cout << name << '\n';
    say(
        Message("{}: this small lesson is ready to run; lesson.lua contains its text, code and reference "
                "solution.\nTry:  dynlab test-lesson {}    then    dynlab report {}",
                folder, shell_word(folder), shell_word(folder)));
    return kDone;
}

int make_new(const NewArguments& args) {
    const std::string folder = shell_word(args.folder);
    if (args.lesson == "lesson") return make_lesson(args.folder);
    if (args.lesson == "editor") return make_editor_files(args.folder);
    if (args.lesson == "review") {
        make_review_folder(args.folder, args.language);
        say(
            Message("{}: report.md contains the five questions, and analysis.lua contains the scores.\nNext "
                    "steps:\n  dynlab report {}    create the PDF of the review\n  dynlab check {}     list what is "
                    "missing and what is wrong\n  dynlab pack {}      pack the folder into one file for submission",
                    args.folder, folder, folder, folder));
        return kDone;
    }
    const Lesson lesson = find_lesson(args.lesson);
    {
        ActivityLine activity;
        if (args.group_seed)
            activity.begin_step(message_text(Message("finding the data that the lesson loads"), user()));
        make_student_copy(lesson, args.folder, args.group_seed, args.language, write_editor_files);
        note_made_folder(args.folder);
    }
    say(Message(
        "{}: edit analysis.lua for your analysis and report.md for your text.\nNext steps:\n  dynlab preview "
        "{}    show the report in the browser while you work\n  dynlab report {}     create the PDF of the "
        "report\n  dynlab check {}      list what is missing and what is wrong\n  dynlab pack {}       pack the "
        "folder into one file for submission",
        args.folder, folder, folder, folder, folder));
    return kDone;
}

}  // namespace

void add_new(CLI::App& app, Action& action) {
    auto args = std::make_shared<NewArguments>();
    CLI::App* command =
        app.add_subcommand("new", "Create your own copy of a lesson, without its solutions, or a folder for a review");
    command->add_option("LESSON", args->lesson, "Number, name or folder of the lesson; or review, lesson, or editor")
        ->required();
    command->add_option("DIR", args->folder, "Folder to create")->required();
    command
        ->add_option("--group-seed", args->group_seed,
                     "Seed of the group's own data: another unit of each simulated plant, and other noise")
        ->type_name("N")
        ->check(CLI::Range(1u, 4294967295u));
    add_language(*command, args->language, "Language of the report. Default: the lesson's language.");
    command->footer(
        "Examples:  dynlab new 02 my-work     dynlab new review my-review --lang fr\ndynlab new lesson DIR creates a "
        "small lesson with checks, which you can change: see dynlab help guide-own-course.\ndynlab new editor DIR adds "
        "files for editors to an existing folder: .luarc.json with all functions (completion,\nsignatures), tasks for "
        "VS Code, .editorconfig. A student's copy contains them.");
    command->callback([args, &action] { action = [args] { return make_new(*args); }; });
}

}  // namespace dynlab::inline cli
