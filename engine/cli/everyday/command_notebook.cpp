#include "base/languages.h"
#include "cli/commands.h"
#include "cli/say.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/written_files.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/error_text.h"
#include "workflow/given_script.h"
#include "workflow/notebooks/figure_bundle.h"
#include "workflow/notebooks/notebook.h"
#include "workflow/run_script.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct NotebookArguments {
    std::string file, output;
    bool run = false, force = false;
};

void write(const NotebookArguments& args, const char* ending, const std::string& content) {
    const fs::path file = args.output.empty() ? fs::path(args.file).replace_extension(ending) : fs::path(args.output);
    WrittenFiles written(state_file("written"),
                         args.force ? WrittenFiles::Others::kReplaced : WrittenFiles::Others::kKept);
    const fs::path folder = fs::absolute(file).parent_path();
    if (fs::exists(file) && read_file(file) == content) {
        say(Message("{} is up to date", file.string()));
        return;
    }
    written.take(fs::weakly_canonical(folder / file.filename()));
    write_file_atomically(file, content);
    say(Message("{}", file.string()));
}

/// The notebook with what a run of the script prints and draws. Returns the exit code.
int write_with_outputs(const NotebookArguments& args, const PercentScript& script) {
    const Cache cache;
    CallCache calls(cache);
    WrittenFiles written(state_file("written"));
    GnuplotRenderer renderer(&cache);
    const fs::path folder = script.file.parent_path();
    RunRequest request;
    request.script = script;
    request.out_folder = folder.empty() ? fs::path(".") : folder;
    request.call_cache = &calls, request.written = &written;
    const RunRecord record = run_script(request, renderer);
    std::map<std::string, std::string> figures;
    for (const auto& [name, figure] : record.figures)
        figures[name] = figure_bundle(*figure.figure, renderer, Reader{catalog_of(script.header.language)});
    write(args, ".ipynb", notebook_of(script, &record, figures));
    if (!record.error) return kDone;
    complain(error_message(*record.error, script));
    return kFailed;
}

int convert(const NotebookArguments& args) {
    speak(language_of_work(args.file));
    if (is_notebook(args.file)) {
        const NotebookScript script = read_notebook(args.file);
        parse_percent_script(script.source, args.file);  // throws where the cells do not make a script
        for (const Message& loss : script.losses) note(loss);
        write(args, ".lua", script.source);
        return kDone;
    }
    const PercentScript script = read_percent_script(args.file);
    if (args.run) return write_with_outputs(args, script);
    write(args, ".ipynb", notebook_of(script));
    return kDone;
}

}  // namespace

void add_notebook(CLI::App& app, Action& action) {
    auto args = std::make_shared<NotebookArguments>();
    CLI::App* command =
        app.add_subcommand("notebook", "Convert a script to a Jupyter notebook, or a notebook to a script");
    command->add_option("FILE.lua|FILE.ipynb", args->file, "Script, or notebook in Lua")->required();
    command->add_option("-o", args->output, "File to create. Default: in the same folder, with the other extension.")
        ->type_name("FILE");
    command->add_flag("--run", args->run, "Run the script, and add its output and figures to the notebook");
    command->add_flag("--force", args->force, "Replace a file that dynlab did not write, or that was changed");
    command->footer(
        "An unchanged notebook is converted back to the same script, byte for byte. Jupyter runs the notebook with the "
        "kernel that\ndynlab kernel install registers; see dynlab help guide-notebook.\nExamples:  dynlab notebook "
        "my-crane/analysis.lua     dynlab notebook analysis.ipynb");
    command->callback([args, &action] { action = [args] { return convert(*args); }; });
}

}  // namespace dynlab::inline cli
