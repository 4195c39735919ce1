#include "cli/commands.h"
#include "cli/document_command.h"
#include "cli/options/script_options.h"

namespace dynlab::inline cli {
namespace {

struct ReportArguments {
    std::string subject, output, record, language;
    bool timings = false, stay_in_folder = false;
    SeedOption seed;
    SliderOption sliders;
};

int report(const ReportArguments& words) {
    ReportRequest request = report_of(words.subject, words.output, words.language);
    request.seed = words.seed.value().value_or(request.seed);
    request.slider_values = words.sliders.values();
    request.record = words.record;
    request.stay_in_folder = words.stay_in_folder;
    return make_document(std::move(request), words.timings);
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
    auto words = std::make_shared<ReportArguments>();
    CLI::App* command = app.add_subcommand("report", "Make the PDF of a lesson, your folder or your script");
    command
        ->add_option("LESSON|FOLDER|FILE.lua", words->subject,
                     "Number or name of a lesson, folder made by dynlab new, or script")
        ->required();
    command
        ->add_option("-o,--output", words->output,
                     "Document to make (.pdf, .html or .md). Default: in the folder, in the script's folder, or for a "
                     "lesson in the current folder.")
        ->type_name("FILE");
    command->add_option("--record", words->record, "File for the run results (.json)")->type_name("FILE");
    add_language(*command, words->language, "Language of the report, if the lesson has several");
    command->add_flag("--timings", words->timings, "Print the time of each step");
    command->add_flag("--stay-in-folder", words->stay_in_folder, "")->group("");  // what check wants
    words->seed.add_to(*command);
    words->sliders.add_to(*command);
    command->footer("Examples:  dynlab report 02     dynlab report my-work -o my-work.html");
    command->callback([words, &action] {
        expect_script(words->subject, "report");
        action = [words] { return report(*words); };
    });
}

}  // namespace dynlab::inline cli
