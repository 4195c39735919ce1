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

int weave(const WeaveArguments& words) {
    ReportRequest request = report_of_script(read_script_or_notebook(meant_script(words.script)), words.output);
    request.seed = words.seed.value().value_or(request.seed);
    request.slider_values = words.sliders.values();
    return make_document(std::move(request), words.timings);
}

}  // namespace

void add_weave(CLI::App& app, Action& action) {
    auto words = std::make_shared<WeaveArguments>();
    CLI::App* command = app.add_subcommand("weave", "Run a script and make a document of its text, code and results");
    command->add_option("FILE", words->script, "Script (percent format: -- %% starts a cell)")->required();
    command->add_option("-o,--output", words->output, "Document: .pdf, .html or .md")->type_name("FILE")->required();
    command->add_flag("--timings", words->timings, "Print the time of each step");
    words->seed.add_to(*command);
    words->sliders.add_to(*command);
    command->footer("Example:  dynlab weave analysis.lua -o analysis.html");
    command->callback([words, &action] {
        expect_script(words->script, "weave");
        action = [words] { return weave(*words); };
    });
}

}  // namespace dynlab::inline cli
