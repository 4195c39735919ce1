#include <iostream>

#include "cli/commands.h"
#include "cli/terminal_width.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline cli {
void add_help(CLI::App& app, Action& action) {
    auto name = std::make_shared<std::string>();
    auto word = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("help", "What a function of the scripts does, with an example");
    CLI::Option* page = command->add_option(
        "NAME", *name,
        "A function (tf, lsim, ...), a method (iddata.split), a word of MATLAB or Lua, or a "
        "subject: lua, matlab, guide-report, checks, names, review_marks; without it the list of all");
    command->add_option("--search", *word, "List the pages that speak of it")->type_name("WORD")->excludes(page);
    command->footer(
        "Examples:  dynlab help     dynlab help procsrivc     dynlab help lua     dynlab help --search delay");
    command->callback([name, word, &action] {
        action = [name, word]() -> int {
            std::vector<const FunctionEntry*> functions;
            for (const FunctionEntry& entry : catalogue_of_functions()) functions.push_back(&entry);
            const std::size_t width = terminal_width();
            if (!word->empty())
                std::cout << help_search(*word, functions, width);
            else
                std::cout << (name->empty() ? help_overview(functions, width) : help_text(*name, functions, width));
            return kDone;
        };
    });
}

}  // namespace dynlab::inline cli
