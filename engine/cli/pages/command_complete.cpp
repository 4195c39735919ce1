#include <iostream>
#include <map>
#include <memory>

#include "cli/commands.h"
#include "cli/pages/next_words.h"
#include "data_io/dataset_index.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "workflow/demonstration.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline cli {
namespace {

std::vector<Suggestion> names_of(const std::string& place) {
    std::vector<Suggestion> names;
    if (place == "LESSON" || place == "NN") {
        for (const Lesson& lesson : lessons())
            names.push_back({lesson.slug, read_percent_script(lesson.script()).header.title});
    } else if (place == "DATA") {
        for (const std::string& name : dataset_names()) names.push_back({name, "data set"});
    } else if (place == "DEMO") {
        for (const Demonstration& one : demonstrations()) names.push_back({one.name, one.title});
    } else if (place == "PAGE") {
        std::map<std::string, std::string> pages;
        for (const HelpPage& page : help_pages()) pages[std::string(page.name)] = "guide";
        for (const FunctionEntry& entry : catalog_of_functions()) pages[entry.name] = entry.summary;
        for (const auto& [name, about] : pages) names.push_back({name, about});
    }
    return names;
}

/// A line a word, with a tab and what it is; a line ":files" where names of files are right, too.
int complete(const CLI::App& program, const std::vector<std::string>& words) {
    const NextWords next = next_words(program, words, names_of);
    for (const Suggestion& one : next.words) std::cout << one.word << '\t' << one.about << '\n';
    if (next.files) std::cout << ":files\n";
    return kDone;
}

}  // namespace

void add_complete(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("complete", "Internal: complete a command line for a shell")->group("");
    const auto words = std::make_shared<std::vector<std::string>>();
    command->add_option("words", *words, "Words of the command line after the program name");
    command->callback([&app, &action, words] { action = [&app, words] { return complete(app, *words); }; });
}

}  // namespace dynlab::inline cli
