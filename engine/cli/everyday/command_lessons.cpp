#include <fmt/format.h>

#include <iostream>

#include "cli/commands.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline cli {
namespace {

int list_lessons() {
    for (const Lesson& lesson : lessons()) {
        const ScriptHeader header = read_percent_script(lesson.script()).header;
        std::string lines = fmt::format("{:<22} {}\n", lesson.slug, header.title);
        if (!header.subtitle.empty()) lines += fmt::format("{:<22} {}\n", "", header.subtitle);
        std::cout << terminal_text(lines);
    }
    std::cout << "\nRead a lesson with its solution: dynlab report 02.  Work on it: dynlab new 02 my-work.\n";
    return kDone;
}

}  // namespace

void add_lessons(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("lessons", "List the lessons of the course");
    command->footer(
        "Your own lessons are folders NN_name with lesson.lua (and checks.lua, data/NAME or NAME.csv). Put them in a "
        "folder\nthat DYNLAB_LESSONS lists, separated by colons, or give the lesson's folder instead of its name.");
    command->callback([&action] { action = list_lessons; });
}

}  // namespace dynlab::inline cli
