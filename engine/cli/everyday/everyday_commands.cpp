#include "cli/commands.h"

namespace dynlab::inline cli {

Commands everyday_commands(const FigureView& view, const CheckNames& check_names) {
    Commands commands = {[view](CLI::App& app, Action& action) { add_run(app, action, view); }};
    for (const auto add : {add_inspect, add_identify, add_report, add_sheet, add_hint, add_weave, add_new, add_lessons,
                           add_demo, add_help, add_notebook, add_lsp})
        commands.emplace_back(add);
    commands.emplace_back([check_names](CLI::App& app, Action& action) { add_lint(app, action, check_names); });
    return commands;
}

}  // namespace dynlab::inline cli
