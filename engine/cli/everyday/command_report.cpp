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

int report(const ReportArguments& args) {
    ReportRequest request = report_of(args.subject, args.output, args.language);
    request.seed = args.seed.value().value_or(request.seed);
    request.slider_values = args.sliders.values();
    request.record = args.record;
    request.stay_in_folder = args.stay_in_folder;
    return make_document(std::move(request), args.timings);
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
    auto args = std::make_shared<ReportArguments>();
    CLI::App* command = app.add_subcommand("report", "Create the PDF of a lesson, your folder or your script");
    command->add_option("LESSON|FOLDER|FILE.lua", args->subject,
                        "Number or name of a lesson, folder created by dynlab new, or script. Default: the current "
                        "folder if it contains analysis.lua.");
    command
        ->add_option("-o,--output", args->output,
                     "Document to create (.pdf, .html or .md). Default: in the folder, in the script's folder, or for "
                     "a lesson in the current folder.")
        ->type_name("FILE");
    command->add_option("--record", args->record, "File for the run results (.json)")->type_name("FILE");
    add_language(*command, args->language, "Language of the report, if the lesson has several");
    command->add_flag("--timings", args->timings, "Print the time of each step");
    command->add_flag("--stay-in-folder", args->stay_in_folder, "")->group("");  // what check wants
    args->seed.add_to(*command);
    args->sliders.add_to(*command);
    command->footer("Examples:  dynlab report 02     dynlab report my-work -o my-work.html");
    command->callback([args, &action] {
        use_current_folder_by_default(args->subject, "report");
        expect_script(args->subject, "report");
        action = [args] { return report(*args); };
    });
}

}  // namespace dynlab::inline cli
