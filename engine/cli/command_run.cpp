#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "cli/commands.h"
#include "cli/seed_option.h"
#include "platform/atomic_file.h"
#include "platform/terminal/activity_line.h"
#include "platform/terminal/terminal_text.h"
#include "scripting/memoized_calls/call_cache.h"
#include "workflow/run_script.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
    std::string file, code, out;
    bool interactive = false;
    SeedOption seed;
};

/// A terminal would obey what a script prints; a file gets it as it is.
void print_now(const std::string& text) {
    static const bool terminal = ::isatty(STDOUT_FILENO) == 1;
    const std::string shown = terminal ? terminal_text(text) : text;
    std::fwrite(shown.data(), 1, shown.size(), stdout);
    std::fflush(stdout);
}

/// Draws what the script made: a figure without a file of its own goes to `folder`, which is made for it. Waits for the
/// files that the script saved by itself, too.
void save_figures(RunRecord& record, GnuplotRenderer& renderer, const fs::path& folder, const std::string& language) {
    if (!record.figures.empty()) fs::create_directories(folder);
    draw_figures(record, renderer, folder, FigureFormat::kPdf, language);
    renderer.finish();
    for (const std::string& name : figures_in_order(record))
        std::cout << "figure " << terminal_text(name) << ": " << record.figures.at(name).file.string() << '\n';
}

RunRecord run_showing_activity(RunRequest& request, GnuplotRenderer& renderer) {
    ActivityLine activity;
    request.print = [&activity](const std::string& text) { activity.print(text, print_now); };
    request.enter_cell = [&activity](const std::string& cell) { activity.begin_part(cell); };
    return run_script(request, renderer);
}

int run(const RunArguments& words) {
    const bool from_file = !words.file.empty();
    RunRequest request;
    const fs::path file = fs::is_directory(words.file) ? fs::path(words.file) / "analysis.lua" : fs::path(words.file);
    request.script = from_file ? read_percent_script(file) : parse_percent_script(words.code, "command line");
    request.seed = words.seed.value();
    const std::string stem = from_file ? file.stem().string() : "dynlab";
    const fs::path out = words.out.empty() ? fs::path(stem + "_out") : fs::path(words.out);
    request.out_folder = words.out.empty() ? fs::path(".") : out;
    if (!words.out.empty()) fs::create_directories(out);

    const Cache cache;
    CallCache calls(cache);
    GnuplotRenderer renderer(&cache);
    request.call_cache = &calls;
    RunRecord record = run_showing_activity(request, renderer);
    save_figures(record, renderer, out, request.script.header.language);
    if (!words.out.empty()) write_file_atomically(out / "record.json", to_json(record));
    std::cout.flush();
    if (const std::string missing = missing_answers(request.script, record); !missing.empty())
        std::cerr << "dynlab: answers that are not given yet: " << terminal_text(missing) << '\n';
    if (!record.error) return kDone;
    std::cerr << "dynlab: " << terminal_text(record.error->message) << '\n';
    return kFailed;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
    auto words = std::make_shared<RunArguments>();
    CLI::App* command = app.add_subcommand("run", "Run a Lua script, or code given on the command line");
    auto* file = command->add_option("FILE", words->file, "The script, or a folder with an analysis.lua");
    auto* code = command->add_option("-e", words->code, "Code to run instead of a file")->type_name("CODE");
    file->excludes(code);
    command->add_flag("-i,--interactive", words->interactive, "Open the prompt afterwards, with the script's variables")
        ->needs(file);
    command->add_option("--out", words->out, "Folder for figures, saved files and the run's record (record.json)")
        ->type_name("DIR");
    words->seed.add_to(*command);
    command->footer(
        "Figures that the script makes are saved as PDF and their paths printed.\n"
        "Example:  dynlab run -e 's = tf(\"s\") step(2/(s^2 + s + 1))'");
    command->callback([words, command, &action] {
        if (words->file.empty() && words->code.empty()) {
            throw CLI::RequiredError("a script FILE or -e CODE");
        }
        action = [words] { return words->interactive ? open_prompt(words->file) : run(*words); };
    });
}

}  // namespace dynlab::inline cli
