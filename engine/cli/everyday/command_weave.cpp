#include "cli/commands.h"
#include "cli/document_command.h"
#include "cli/options/script_options.h"
#include "workflow/given_script.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline cli {
namespace {

struct WeaveArguments {
    std::string script, output;
    bool timings = false;
    SeedOption seed;
    SliderOption sliders;
};

int weave(const WeaveArguments& args) {
    ReportRequest request = report_of_script(read_script_or_notebook(meant_script(args.script)), args.output);
    request.seed = args.seed.value().value_or(request.seed);
    request.slider_values = args.sliders.values();
    return make_document(std::move(request), args.timings);
}

}  // namespace

void add_weave(CLI::App& app, Action& action) {
    auto args = std::make_shared<WeaveArguments>();
    CLI::App* command =
        app.add_subcommand("weave", "Run a script and create a document from its text, code and results");
    command->add_option("FILE", args->script, "Script (percent format: -- %% starts a cell)")->required();
    command->add_option("-o,--output", args->output, "Document: .pdf, .html or .md")->type_name("FILE")->required();
    command->add_flag("--timings", args->timings, "Print the time of each step");
    args->seed.add_to(*command);
    args->sliders.add_to(*command);
    command->footer("Example:  dynlab weave analysis.lua -o analysis.html");
    command->callback([args, &action] {
        expect_script(args->script, "weave");
        action = [args] { return weave(*args); };
    });
}

}  // namespace dynlab::inline cli
