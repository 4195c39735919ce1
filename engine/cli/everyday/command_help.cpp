#include <fmt/ranges.h>

#include <iostream>

#include "cli/commands.h"
#include "platform/terminal/terminal_output.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "workflow/cheat_sheet.h"

namespace dynlab::inline cli {

namespace {

/// The help text of a command, as its option --help prints it; empty where these words are none.
std::string help_of_command(CLI::App& app, const std::vector<std::string>& args) {
    CLI::App* command = &app;
    std::string before;
    for (const std::string& word : args) {
        before += (before.empty() ? "" : " ") + command->get_name();
        const auto found = command->get_subcommands([&](const CLI::App* one) { return one->get_name() == word; });
        if (found.empty()) return "";
        command = found.front();
    }
    return args.empty() ? "" : command->help(before);
}

}  // namespace

void add_help(CLI::App& app, Action& action) {
    auto words_asked = std::make_shared<std::vector<std::string>>();
    auto word = std::make_shared<std::string>();
    auto sheet = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("help", "Show help for a function, with an example");
    CLI::Option* page =
        command->add_option("PAGE", *words_asked,
                            "Function (tf, lsim, ...), method (iddata.split), word of MATLAB or Lua, subject "
                            "(guide-first-hour, lua, matlab, "
                            "checks, names, review_marks) or command (course page). Default: the list of all.");
    CLI::Option* search =
        command->add_option("--search", *word, "List the pages that mention a term")->type_name("WORD")->excludes(page);
    command->add_option("--sheet", *sheet, "Write a two-page summary of all functions and MATLAB equivalents (.pdf)")
        ->type_name("FILE")
        ->excludes(page)
        ->excludes(search);
    command->footer(
        "Examples:  dynlab help     dynlab help procsrivc     dynlab help lua     dynlab help --search delay"
        "     dynlab help --sheet cheat.pdf");
    command->callback([words_asked, word, sheet, &app, &action] {
        action = [words_asked, word, sheet, &app]() -> int {
            const std::string name = fmt::format("{}", fmt::join(*words_asked, " "));
            if (!sheet->empty()) {
                make_cheat_sheet(*sheet);
                std::cout << std::filesystem::absolute(*sheet).lexically_normal().string() << "\n";
                return kDone;
            }
            std::vector<const FunctionEntry*> functions;
            for (const FunctionEntry& entry : catalog_of_functions()) functions.push_back(&entry);
            const std::size_t width = columns_of_text(kHelpWidth);
            if (!word->empty())
                std::cout << help_search(*word, functions, width);
            else if (const std::string text = help_of_command(app, *words_asked);
                     !find_help_page(name) && !text.empty())
                std::cout << text;
            else
                std::cout << (name.empty() ? help_overview(functions, width) : help_text(name, functions, width));
            return kDone;
        };
    });
}

}  // namespace dynlab::inline cli
