#include "cli/commands.h"
#include "cli/document_command.h"

namespace dynlab::inline cli {

void add_sheet(CLI::App& app, Action& action) {
    auto lesson = std::make_shared<std::string>();
    auto output = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("sheet", "Make the task sheet of a lesson, without its solutions");
    command->add_option("LESSON", *lesson, "The lesson's number or name, or its folder")->required();
    command
        ->add_option("-o,--output", *output, "Where to write it (.pdf, .html or .md); NN_name_sheet.pdf unless given")
        ->type_name("FILE");
    command->footer("Example:  dynlab sheet 02");
    command->callback([lesson, output, &action] {
        action = [lesson, output] { return make_document(sheet_of(*lesson, *output), false); };
    });
}

}  // namespace dynlab::inline cli
