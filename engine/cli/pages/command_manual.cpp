#include <fmt/format.h>

#include <iostream>

#include "base/reader.h"
#include "cli/commands.h"
#include "platform/terminal/activity_line.h"
#include "workflow/manual/make_manual.h"

namespace dynlab::inline cli {

void add_manual(CLI::App& app, Action& action) {
    auto request = std::make_shared<ManualRequest>();
    auto timings = std::make_shared<bool>(false);
    CLI::App* command =
        app.add_subcommand("manual", "Make a site of lessons, guides, functions and methods, for reading offline");
    command->add_option("DIR", request->folder, "New or empty folder, or folder of an older manual")->required();
    command->add_flag("--timings", *timings, "Print the time of each step");
    command->footer("Examples:  dynlab manual site     xdg-open site/index.html");
    command->callback([request, timings, &action] {
        action = [request, timings]() -> int {
            ActivityLine activity;
            request->step = [&activity](const Message& step) { activity.begin_step(message_text(step)); };
            const ManualResult made = make_manual(*request);
            for (const auto& [step, seconds] : made.timings)
                if (*timings) std::cout << fmt::format("{:6.2f} s  {}\n", seconds, message_text(step));
            const auto first = std::filesystem::absolute(request->folder / "index.html").lexically_normal();
            std::cout << fmt::format("{}\n{} pages, and manual.pdf\n", first.string(), made.pages);
            return kDone;
        };
    });
}

}  // namespace dynlab::inline cli
