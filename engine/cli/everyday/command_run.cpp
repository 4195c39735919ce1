#include <re2/re2.h>
#include <unistd.h>

#include <iostream>

#include "base/languages.h"
#include "cli/commands.h"
#include "cli/options/run_command.h"
#include "cli/say.h"
#include "figures/gnuplot_script.h"
#include "platform/atomic_file.h"
#include "platform/terminal/activity_line.h"
#include "platform/terminal/aligned_table.h"
#include "platform/terminal/terminal_output.h"
#include "platform/written_files.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/error_text.h"
#include "workflow/given_script.h"
#include "workflow/make_report.h"
#include "workflow/notebooks/notebook.h"
#include "workflow/run_script.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

/// Where a script's files go: beside it, or where nothing may be written there (an installed lesson), here.
fs::path folder_of(const fs::path& script) {
    const fs::path folder = script.parent_path();
    return folder.empty() || ::access(folder.c_str(), W_OK) != 0 ? fs::path(".") : folder;
}

/// Figures of an earlier run, by the names that draw_figures gives: "03-step-figure-1.pdf".
void remove_old_figures(const fs::path& folder) {
    static const RE2 kDrawn(R"(\d\d+-.+\.(pdf|gp))", RE2::Latin1);
    std::error_code none;
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.is_regular_file() && RE2::FullMatch(entry.path().filename().string(), kDrawn))
            old.push_back(entry.path());
    for (const fs::path& file : old) fs::remove(file, none);
}

/// Draws the figures of the script: a figure without a file name goes to `folder`, which is created for it. Also waits
/// for the files that the script itself saved.
void save_figures(RunRecord& record, GnuplotRenderer& renderer, const fs::path& folder, const std::string& language) {
    if (!record.figures.empty()) fs::create_directories(folder);
    draw_figures(record, renderer, folder, FigureFormat::kPdf, language);
    renderer.finish();
    for (const std::string& name : figures_in_order(record))
        say(Message("figure {}: {}", name, record.figures.at(name).file.string()));
}

/// Beside each figure what gnuplot draws it from.
void save_gnuplot_files(const RunRecord& record, const std::string& language) {
    const Reader reader{catalog_of(language)};
    for (const auto& [name, figure] : record.figures) {
        fs::path file = figure.file;
        const std::string drawn = file.filename().string();
        write_file_atomically(file.replace_extension(".gp"),
                              gnuplot_file(*figure.figure, FigureFormat::kPdf, drawn, reader));
    }
}

/// What the script gave to the report, and what of it the report would not show.
void show_reported(const PercentScript& script, const RunRecord& record) {
    for (const auto& [name, value] : record.values) say(Message("value {}: {}", name, value.text));
    for (const auto& [name, table] : record.tables) {
        std::string lines = aligned_table(table.header, table.rows);
        lines.pop_back();
        say(Message("table {}:\n{}", name, lines));
    }
    for (const auto& [name, text] : record.texts) say(Message("text {}: {}", name, text.markdown));
    std::cout.flush();
    for (const UnplacedEntries& entries : entries_without_place(script, record)) note(entries.message());
}

RunRecord run_showing_activity(RunRequest& request, GnuplotRenderer& renderer) {
    ActivityLine activity;
    request.print = [&activity](const std::string& text) { activity.print(text, print_shown); };
    request.enter_cell = [&activity](const Message& cell) { activity.begin_part(message_text(cell, user())); };
    return run_script(request, renderer);
}

}  // namespace

fs::path figures_folder(const fs::path& script) {
    if (script.empty()) return "dynlab_out";
    return (folder_of(script) / (script.stem().string() + "_out")).lexically_normal();
}

int run_and_show(const RunArguments& args, CallsInParts* parts) {
    const bool from_file = !args.file.empty();
    RunRequest request;
    const fs::path file = from_file ? meant_script(args.file) : fs::path();
    request.script = from_file ? read_script_or_notebook(file) : parse_percent_script(args.code, "command line");
    request.seed = args.seed.value();
    request.slider_values = args.sliders.values();
    const fs::path beside = from_file ? folder_of(file) : fs::path(".");
    const fs::path out = args.out.empty() ? figures_folder(file) : fs::path(args.out);
    request.out_folder = args.out.empty() ? beside : out;
    if (!args.out.empty()) fs::create_directories(out);

    const Cache cache;
    CallCache calls(cache);
    WrittenFiles written(state_file("written"),
                         args.force ? WrittenFiles::Others::kReplaced : WrittenFiles::Others::kKept);
    GnuplotRenderer renderer(&cache);
    if (parts == nullptr) request.call_cache = &calls;
    request.parts = parts;
    request.written = &written;
    RunRecord record = run_showing_activity(request, renderer);
    if (args.out.empty()) remove_old_figures(out);  // a named folder may contain the user's files
    save_figures(record, renderer, out, request.script.header.language);
    if (args.gnuplot) save_gnuplot_files(record, request.script.header.language);
    if (!args.out.empty()) write_file_atomically(out / "record.json", to_json(record));
    show_reported(request.script, record);
    if (!record.error) {
        if (const std::string missing = missing_answers(request.script, record); !missing.empty())
            complain(Message("answers not given yet: {}", missing));
        return kDone;
    }
    complain(error_message(*record.error, request.script));
    return kFailed;
}

void add_run(CLI::App& app, Action& action, const FigureView& view) {
    auto args = std::make_shared<RunArguments>();
    CLI::App* command = app.add_subcommand("run", "Run a Lua script, or code from the command line");
    auto* file = command->add_option("FILE", args->file, "Script or notebook, or folder with an analysis.lua");
    auto* code = command->add_option("-e", args->code, "Code to run instead of a file")->type_name("CODE");
    file->excludes(code);
    command->add_flag("-i,--interactive", args->interactive, "Open the prompt afterwards, with the script's variables")
        ->needs(file);
    command->add_flag("--view", args->view, "Open the prompt afterwards, and show the figures in the browser")
        ->needs(file);
    command->add_option("--out", args->out, "Folder for figures, saved files and the run results (record.json)")
        ->type_name("DIR");
    command->add_flag("--gnuplot", args->gnuplot, "Write NAME.gp next to each figure, for `gnuplot NAME.gp`");
    CLI::Option* force =
        command->add_flag("--force", args->force, "Let the script replace files that dynlab did not write");
    args->seed.add_to(*command);
    args->sliders.add_to(*command);
    for (CLI::Option* option : {force, command->get_option("--set")})
        option->excludes(command->get_option("--interactive"))->excludes(command->get_option("--view"));
    command->footer(
        "dynlab saves the script's figures as PDF in NAME_out, in the folder of the script, and prints their paths. It "
        "removes\n"
        "the figures of an earlier run. Other files that the script saves go into the folder of the script. An "
        "existing file\n"
        "is replaced only if dynlab wrote it and it was not changed since (see --force). dynlab prints reported values "
        "and\n"
        "tables, and lists the entries that the text of the report does not show.\n"
        "Example:  dynlab run -e 's = tf(\"s\") step(2/(s^2 + s + 1))'");
    command->callback([args, view, &action] {
        if (args->file.empty() && args->code.empty()) {
            throw CLI::RequiredError("a script FILE or -e CODE");
        }
        expect_script(args->file, "run");
        action = [args, view] {
            if (args->view) return open_prompt(args->file, view());
            return args->interactive ? open_prompt(args->file, nullptr) : run_and_show(*args);
        };
    });
}

}  // namespace dynlab::inline cli
