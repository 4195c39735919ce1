#include <iostream>

#include "app/live/preview.h"
#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/pages/browser.h"
#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline cli {
namespace {

struct PreviewArgs {
    PreviewOptions options;
    bool no_browser = false;
};

int show_preview(PreviewArgs args) {
    DesktopBrowser browser;
    args.options.opened = [&](const std::string& address, Visit visit) {
        std::cout << address << (visit == Visit::kElsewhere ? "\n(the document is already open)" : "\n(Ctrl-C to stop)")
                  << std::endl;
        if (visit != Visit::kLate && !args.no_browser) browser.open(address);
    };
    try {
        const SlowEnding session_is_kept;
        preview(args.options);
    } catch (const Interrupted&) {
        std::cout << std::endl;
    }
    return kDone;
}

}  // namespace

void add_preview(CLI::App& app, Action& action) {
    auto args = std::make_shared<PreviewArgs>();
    CLI::App* command =
        app.add_subcommand("preview", "Show a document in the browser; the page follows every change of its files");
    command->add_option("LESSON|FOLDER|FILE.lua", args->options.document,
                        "Script, folder with analysis.lua and report.md, or lesson. Default: the current folder if it "
                        "contains analysis.lua.");
    command->add_option("--port", args->options.port, "Port of the page. Default: a free port.")
        ->check(CLI::Range(1, 65535));
    command->add_flag("--edit", args->options.edit, "Show an editor for the script and the text next to the page");
    command->add_flag("--no-browser", args->no_browser, "Print the address without opening the browser");
    command->add_flag("--run", args->options.run_at_once,
                      "Allow the scripts of this folder to run without asking, now and later");
    command->footer("Examples:  dynlab preview my-work     dynlab preview my-work --edit     dynlab preview 02");
    command->callback([args, &action] {
        use_current_folder_by_default(args->options.document, "preview");
        expect_script(args->options.document, "preview");
        action = [args] { return show_preview(*args); };
    });
}

}  // namespace dynlab::inline cli
