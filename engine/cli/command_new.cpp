#include <iostream>
#include <optional>

#include "cli/commands.h"
#include "workflow/student_copy.h"

namespace dynlab {
namespace {

struct NewWords {
    std::string lesson, folder;
    std::optional<std::uint32_t> group_seed;
};

int make_new(const NewWords& words) {
    make_student_copy(find_lesson(words.lesson), words.folder, words.group_seed);
    std::cout << words.folder << ": analysis.lua is yours to edit, report.md is your report's text.\n"
              << "Try:  dynlab run " << words.folder << "/analysis.lua    then    dynlab report " << words.folder
              << '\n';
    return kDone;
}

}  // namespace

void add_new(CLI::App& app, Action& action) {
    auto words = std::make_shared<NewWords>();
    CLI::App* command = app.add_subcommand("new", "Make your own copy of a lesson, without its solutions");
    command->add_option("LESSON", words->lesson, "The lesson's number or name")->required();
    command->add_option("DIR", words->folder, "The folder to make")->required();
    command
        ->add_option("--group-seed", words->group_seed,
                     "Records of the group's own: another specimen of each simulated apparatus, other noise")
        ->type_name("N")
        ->check(CLI::Range(1u, 4294967295u));
    command->footer("Example:  dynlab new 02 my-work");
    command->callback([words, &action] { action = [words] { return make_new(*words); }; });
}

}  // namespace dynlab
