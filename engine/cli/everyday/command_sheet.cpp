#include "cli/commands.h"
#include "cli/document_command.h"
#include "cli/options/script_options.h"

namespace dynlab::inline cli {

void add_sheet(CLI::App& app, Action& action) {
    auto lesson = std::make_shared<std::string>();
    auto output = std::make_shared<std::string>(), language = std::make_shared<std::string>();
    auto talk = std::make_shared<bool>(false), answers = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("sheet", "Make the task sheet of a lesson, without its solutions");
    command->add_option("LESSON", *lesson, "The lesson's number or name, or its folder")->required();
    command
        ->add_option("-o,--output", *output, "Where to write it (.pdf, .html or .md); NN_name_sheet.pdf unless given")
        ->type_name("FILE");
    CLI::Option* questions =
        command->add_flag("--talk", *talk, "Instead: questions that a talk on the lesson may meet (NN_name_talk.pdf)");
    command->add_flag("--answers", *answers, "With the model answers, for whoever asks")->needs(questions);
    add_language(*command, *language, "Language of the tasks, where the lesson has several")->excludes(questions);
    command->footer(
        "Examples:  dynlab sheet 02     dynlab sheet 03_crane --lang fr     dynlab sheet 05 --talk --answers");
    command->callback([lesson, output, language, talk, answers, &action] {
        action = [lesson, output, language, talk, answers] {
            return make_document(
                *talk ? talk_sheet_of(*lesson, *answers, *output) : sheet_of(*lesson, *output, *language), false);
        };
    });
}

}  // namespace dynlab::inline cli
