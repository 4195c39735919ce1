#include <fmt/format.h>

#include <iostream>

#include "cli/commands.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::inline cli {
namespace {

int list_lessons() {
    for (const Lesson& lesson : lessons()) {
        const ScriptHeader header = read_percent_script(lesson.script()).header;
        std::string lines = fmt::format("{:<22} {}\n", lesson.slug, header.title);
        if (!header.subtitle.empty()) lines += fmt::format("{:<22} {}\n", "", header.subtitle);
        std::cout << terminal_text(lines);
    }
    std::cout << "\nRead one with its solution: dynlab report 02.  Work on one: dynlab new 02 my-work.\n";
    return kDone;
}

}  // namespace

void add_lessons(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("lessons", "List the lessons of the course");
    command->footer(
        "Lessons of your own: folders NN_name with lesson.lua (and checks.lua, data/NAME or NAME.csv) in a folder "
        "that\n"
        "DYNLAB_LESSONS lists, separated by colons; or name the lesson's folder wherever a lesson is wanted.");
    command->callback([&action] { action = list_lessons; });
}

}  // namespace dynlab::inline cli
