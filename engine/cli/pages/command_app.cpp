#include <iostream>

#include "app/workbench/workbench_page.h"
#include "cli/commands.h"
#include "cli/pages/browser.h"
#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline cli {
namespace {

struct AppWords {
    WorkbenchOptions options;
    bool no_browser = false;
};

int show_workbench(AppWords words) {
    DesktopBrowser browser;
    words.options.opened = [&](const std::string& address, Visit visit, const std::filesystem::path& script) {
        std::cout << address << "\nThe session is " << script.string() << "\n(Ctrl-C ends it)" << std::endl;
        if (visit != Visit::kLate && !words.no_browser) browser.open(address);
    };
    try {
        const SlowEnding session_is_kept;
        serve_workbench(words.options);
    } catch (const Interrupted&) {
        std::cout << std::endl;
    }
    return kDone;
}

}  // namespace

void add_app(CLI::App& app, Action& action) {
    auto words = std::make_shared<AppWords>();
    CLI::App* command = app.add_subcommand(
        "app",
        "Look at a record, prepare it, find models and compare them in the browser; every click is a line of a script");
    command->add_option("DATA|LESSON|FILE.lua", words->options.subject,
                        "A data file, a data set, a lesson (its record), or a script; none: an empty session");
    command->add_option("--port", words->options.port, "The port of the page's address (default: any free one)")
        ->check(CLI::Range(1, 65535));
    command->add_flag("--run", words->options.run_at_once,
                      "Run the scripts of this folder without being asked on the page, now and later");
    command->add_flag("--no-browser", words->no_browser, "Only print the address");
    command->footer(
        "The session is a Lua script in the current folder, NAME_session.lua, written with every step: dynlab run, "
        "report,\n"
        "check and pack take it as it is, and dynlab app goes on with it.\n"
        "Examples:  dynlab app record.csv     dynlab app crane     dynlab app 03_crane     dynlab app "
        "record_session.lua");
    command->callback([words, &action] { action = [words] { return show_workbench(*words); }; });
}

}  // namespace dynlab::inline cli
