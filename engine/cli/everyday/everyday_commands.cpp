#include "cli/commands.h"

namespace dynlab::inline cli {

Commands everyday_commands(const FigureView& view) {
    Commands commands = {[view](CLI::App& app, Action& action) { add_run(app, action, view); }};
    for (const auto add : {add_look, add_identify, add_study, add_report, add_sheet, add_hint, add_weave, add_new,
                           add_lessons, add_demo, add_help, add_manual, add_notebook, add_lint, add_lsp, add_boxed})
        commands.emplace_back(add);
    return commands;
}

}  // namespace dynlab::inline cli
