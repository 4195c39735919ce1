#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/say.h"
#include "platform/interrupt.h"
#include "platform/text/read_number.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/demonstration.h"
#include "workflow/error_text.h"
#include "workflow/run_script.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct DemoArguments {
    std::string name;
    bool list = false;
};

bool on_terminal() {
    return ::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0;
}

constexpr int kMillisecondsBetweenLooks = 100;

/// A line from the terminal; nothing after Ctrl-D. Ctrl-C throws Interrupted: it would not end getline, and one that
/// comes just before poll does not end that either, so poll looks up now and then.
std::optional<std::string> ask(const std::string& question) {
    std::cout << question << std::flush;
    pollfd keyboard{STDIN_FILENO, POLLIN, 0};
    while (::poll(&keyboard, 1, kMillisecondsBetweenLooks) <= 0) throw_if_interrupted();
    std::string answer;
    const bool given = static_cast<bool>(std::getline(std::cin, answer));
    if (!given) std::cout << '\n';
    throw_if_interrupted();
    return given ? std::optional(answer) : std::nullopt;
}

/// Runs a complete demonstration, then shows it: page by page on a terminal, in one go elsewhere.
int show(const Demonstration& demonstration) {
    RunRequest request;
    request.script = read_percent_script(demonstration.script);
    const fs::path folder = demonstration.name + "_out";
    request.out_folder = folder;
    std::cout << '\n' << demonstration.title << "\n\n" << std::flush;

    const Cache cache;
    CallCache calls(cache);
    GnuplotRenderer renderer(&cache);
    request.call_cache = &calls;
    RunRecord record = run_script(request, renderer);
    if (!record.figures.empty()) fs::create_directories(folder);
    draw_figures(record, renderer, folder, FigureFormat::kPdf, request.script.header.language);
    renderer.finish();

    const std::vector<std::string> pages = pages_of(request.script, record);
    for (std::size_t i = 0; i < pages.size(); ++i) {
        std::cout << pages[i] << '\n' << std::flush;
        if (!on_terminal() || i + 1 == pages.size()) continue;
        const auto answer =
            ask(fmt::format("-- {} of {}: Enter for the next page, q to quit -- ", i + 1, pages.size()));
        if (!answer || *answer == "q") return kDone;
        std::cout << '\n';
    }
    if (!record.error) return kDone;
    complain(error_message(*record.error, request.script));
    return kFailed;
}

int list(const std::vector<Demonstration>& all) {
    for (const Demonstration& one : all) std::cout << fmt::format("{:<20} {}\n", one.name, one.title);
    return kDone;
}

/// The demonstration a menu's answer means: its number or its name.
const Demonstration* chosen(const std::vector<Demonstration>& all, const std::string& answer) {
    const std::size_t number = read_number<std::size_t>(answer).value_or(0);
    if (number >= 1 && number <= all.size()) return &all[number - 1];
    for (const Demonstration& one : all)
        if (one.name == answer) return &one;
    return nullptr;
}

int menu() {
    const std::vector<Demonstration> all = demonstrations();
    if (!on_terminal()) return list(all);
    for (;;) {
        std::cout << "\nDemonstrations\n\n";
        for (std::size_t i = 0; i < all.size(); ++i)
            std::cout << fmt::format("  {}  {:<20} {}\n", i + 1, all[i].name, all[i].title);
        const auto answer = ask(fmt::format("\nNumber (1 to {}), or q to quit: ", all.size()));
        if (!answer || *answer == "q") return kDone;
        if (answer->empty()) continue;
        if (const Demonstration* one = chosen(all, *answer)) {
            show(*one);
        } else {
            std::cout << fmt::format("Unknown demonstration '{}'; type a number from 1 to {}, or q.\n", *answer,
                                     all.size());
        }
    }
}

}  // namespace

void add_demo(CLI::App& app, Action& action) {
    auto args = std::make_shared<DemoArguments>();
    CLI::App* command = app.add_subcommand("demo", "Show short guided demonstrations");
    auto* name = command->add_option("DEMO", args->name, "Name of the demonstration. Default: a menu in the terminal.");
    command->add_flag("--list", args->list, "List the demonstrations, each with one line")->excludes(name);
    command->footer(
        "In a terminal, press Enter for the next page and q to go back. Figures are saved in NAME_out; dynlab prints "
        "their paths.\nExamples:  dynlab demo     dynlab demo getting_started     dynlab demo --list");
    command->callback([args, &action] {
        action = [args] {
            if (args->list) return list(demonstrations());
            return args->name.empty() ? menu() : show(find_demonstration(args->name));
        };
    });
}

}  // namespace dynlab::inline cli
