#include "cli/commands.h"
#include "cli/document_command.h"
#include "cli/options/script_options.h"

namespace dynlab::inline cli {

void add_sheet(CLI::App& app, Action& action) {
    auto lesson = std::make_shared<std::string>();
    auto output = std::make_shared<std::string>(), language = std::make_shared<std::string>();
    auto talk = std::make_shared<bool>(false), answers = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("sheet", "Create the task sheet of a lesson, without its solutions");
    command->add_option("LESSON", *lesson, "Number, name or folder of the lesson")->required();
    command->add_option("-o,--output", *output, "Document to create (.pdf, .html or .md). Default: NN_name_sheet.pdf.")
        ->type_name("FILE");
    CLI::Option* questions = command->add_flag(
        "--talk", *talk, "Create a list of questions for a talk on the lesson instead (NN_name_talk.pdf)");
    command->add_flag("--answers", *answers, "Include the model answers")->needs(questions);
    add_language(*command, *language, "Language of the tasks, if the lesson has several")->excludes(questions);
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
