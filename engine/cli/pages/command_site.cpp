#include <fmt/format.h>

#include <iostream>

#include "app/page/page_routes.h"
#include "base/reader.h"
#include "cli/commands.h"
#include "cli/say.h"
#include "platform/terminal/activity_line.h"
#include "workflow/site/make_site.h"

namespace dynlab::inline cli {

void add_site(CLI::App& app, Action& action) {
    struct SiteArguments {
        SiteRequest request;
        std::string engine;
        bool timings = false;
    };
    auto args = std::make_shared<SiteArguments>();
    CLI::App* command = app.add_subcommand(
        "site", "Create a static site of the course: lessons with cells that run in the browser, data and help");
    command->add_option("FOLDER", args->request.folder, "New or empty folder, or an older site, which is replaced")
        ->required();
    command->add_option("--engine", args->engine,
                        "Folder with dynlab.js and dynlab.wasm. Default: the installed engine, or the engine that "
                        "scripts/build web built");
    command->add_flag("--timings", args->timings, "Print the time of each step");
    command->footer(
        "Copy FOLDER to any web server (dynlab help guide-site). Without an engine, the pages show results, but "
        "cells\ndo not run.\n\nExamples:  dynlab site site     python3 -m http.server --directory site");
    command->callback([args, &action] {
        action = [args]() -> int {
            SiteRequest& request = args->request;
            request.engine = args->engine.empty() ? web_engine() : args->engine;
            request.page_files = page_files_of_site();
            SiteResult made;
            {
                ActivityLine activity;
                request.step = [&activity](const Message& step) { activity.begin_step(message_text(step, user())); };
                made = make_site(request);
            }
            for (const auto& [step, seconds] : made.timings)
                if (args->timings) std::cout << fmt::format("{:6.2f} s  {}\n", seconds, message_text(step, user()));
            const auto first = std::filesystem::absolute(request.folder / "index.html").lexically_normal();
            std::cout << first.string() << '\n';
            say(plural(made.pages, "{} page", "{} pages"));
            if (!request.engine)
                say(
                    Message("The cells of the lessons do not run, because the engine for browsers is missing. To "
                            "build it, run scripts/build web in the source tree."));
            return kDone;
        };
    });
}

}  // namespace dynlab::inline cli
