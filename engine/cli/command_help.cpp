#include <iostream>

#include "cli/commands.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline cli {

void add_help(CLI::App& app, Action& action) {
    auto name = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("help", "What a function of the scripts does, with an example");
    command->add_option(
        "NAME", *name,
        "A function (tf, lsim, ...) or a subject: matlab, checks, names, review_marks; without it the list of all");
    command->footer("Examples:  dynlab help     dynlab help procsrivc     dynlab help matlab");
    command->callback([name, &action] {
        action = [name]() -> int {
            std::vector<const FunctionEntry*> functions;
            for (const FunctionEntry& entry : catalogue_of_functions()) functions.push_back(&entry);
            std::cout << (name->empty() ? help_overview(functions) : help_text(*name, functions));
            return kDone;
        };
    });
}

}  // namespace dynlab::inline cli
