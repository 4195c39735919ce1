#include <iostream>

#include "app/live/preview.h"
#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/pages/browser.h"
#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline cli {
namespace {

struct PreviewWords {
    PreviewOptions options;
    bool no_browser = false;
};

int show_preview(PreviewWords words) {
    DesktopBrowser browser;
    words.options.opened = [&](const std::string& address, Visit visit) {
        std::cout << address << (visit == Visit::kElsewhere ? "\n(it is shown there already)" : "\n(Ctrl-C ends it)")
                  << std::endl;
        if (visit != Visit::kLate && !words.no_browser) browser.open(address);
    };
    try {
        const SlowEnding session_is_kept;
        preview(words.options);
    } catch (const Interrupted&) {
        std::cout << std::endl;
    }
    return kDone;
}

}  // namespace

void add_preview(CLI::App& app, Action& action) {
    auto words = std::make_shared<PreviewWords>();
    CLI::App* command =
        app.add_subcommand("preview", "Show a document in the browser; the page follows every change of its files");
    command
        ->add_option("LESSON|FOLDER|FILE.lua", words->options.document,
                     "A script, a folder with analysis.lua and report.md, or a lesson")
        ->required();
    command->add_option("--port", words->options.port, "The port of the page's address (default: any free one)")
        ->check(CLI::Range(1, 65535));
    command->add_flag("--edit", words->options.edit,
                      "Show the script and the text beside the page, to be changed there");
    command->add_flag("--no-browser", words->no_browser, "Only print the address");
    command->add_flag("--run", words->options.run_at_once,
                      "Run the scripts of this folder without being asked on the page, now and later");
    command->footer("Examples:  dynlab preview my-work     dynlab preview my-work --edit     dynlab preview 02");
    command->callback([words, &action] {
        expect_script(words->options.document, "preview");
        action = [words] { return show_preview(*words); };
    });
}

}  // namespace dynlab::inline cli
