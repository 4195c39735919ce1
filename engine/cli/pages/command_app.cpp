#include <iostream>

#include "app/workbench/workbench_page.h"
#include "cli/commands.h"
#include "cli/pages/browser.h"
#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline cli {
namespace {

struct AppArgs {
    WorkbenchOptions options;
    bool no_browser = false;
};

int show_workbench(AppArgs args) {
    DesktopBrowser browser;
    args.options.opened = [&](const std::string& address, Visit visit, const std::filesystem::path& script) {
        std::cout << address << "\nThe session is " << script.string() << "\n(Ctrl-C to stop)" << std::endl;
        if (visit != Visit::kLate && !args.no_browser) browser.open(address);
    };
    try {
        const SlowEnding session_is_kept;
        serve_workbench(args.options);
    } catch (const Interrupted&) {
        std::cout << std::endl;
    }
    return kDone;
}

}  // namespace

void add_app(CLI::App& app, Action& action) {
    auto args = std::make_shared<AppArgs>();
    CLI::App* command = app.add_subcommand(
        "app",
        "Inspect and preprocess data, estimate and compare models in the browser; every action is a line of a script");
    command->add_option("DATA|LESSON|FILE.lua", args->options.subject,
                        "Data file, data set, lesson (for its data), or script. Default: an empty session.");
    command->add_option("--port", args->options.port, "Port of the page. Default: a free port.")
        ->check(CLI::Range(1, 65535));
    command->add_flag("--run", args->options.run_at_once,
                      "Allow the scripts of this folder to run without asking, now and later");
    command->add_flag("--no-browser", args->no_browser, "Print the address without opening the browser");
    command->footer(
        "The session is a Lua script in the current folder, NAME_session.lua, updated with every step. dynlab run, "
        "report,\n"
        "check and pack accept the script, and dynlab app resumes it.\n"
        "Examples:  dynlab app record.csv     dynlab app crane     dynlab app 03_crane     dynlab app "
        "record_session.lua");
    command->callback([args, &action] { action = [args] { return show_workbench(*args); }; });
}

}  // namespace dynlab::inline cli
