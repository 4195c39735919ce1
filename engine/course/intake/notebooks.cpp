#include "course/intake/notebooks.h"

#include "course/intake/folder_copy.h"
#include "documents/error.h"
#include "platform/atomic_file.h"
#include "platform/guarded_call.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kNotebookName[] = "analysis.ipynb", kScriptName[] = "analysis.lua";
constexpr auto kStepOfTimes = std::chrono::seconds(2);  // the step of times in a zip

std::vector<fs::path> notebooks_in(const fs::path& folder) {
    std::vector<fs::path> found = files_below(folder);
    std::erase_if(found, [](const fs::path& file) { return file.filename() != kNotebookName; });
    return found;
}

/// Whether the notebook holds where a script lies beside it.
bool notebook_holds(const fs::path& notebook, const fs::path& script, const std::string& source) {
    if (!fs::is_regular_file(fs::symlink_status(script)) || read_file(script) == source) return true;
    const auto of_notebook = fs::last_write_time(notebook), of_script = fs::last_write_time(script);
    if (of_notebook > of_script + kStepOfTimes) return true;
    if (of_script > of_notebook + kStepOfTimes) return false;
    throw SubmissionError(
        "analysis.lua and analysis.ipynb differ, and dynlab cannot determine which file is newer: submit only one of "
        "them.");
}

}  // namespace

std::string script_of_submitted_notebook(const fs::path& notebook) {
    const std::string name = notebook.filename().string();
    const GuardLimits limits;
    const ChildResult read = run_guarded(
        [&] {
            try {
                return "+" + read_notebook(notebook).source;
            } catch (const DocumentError& error) {
                return "-" + std::string(error.what());
            }
        },
        limits);
    if (read.time_limit() == TimeLimit::kProcessor)
        throw SubmissionError("The notebook {} cannot be read: reading used more than {} s of processor time.", name,
                              limits.time.seconds(TimeLimit::kProcessor));
    if (read.timed_out)
        throw SubmissionError("The notebook {} cannot be read: reading did not finish within {} s.", name,
                              limits.time.seconds(TimeLimit::kClock));
    if (read.exit_code != 0 || read.output.empty())
        throw SubmissionError("The notebook {} cannot be read: the reader crashed (code {}).", name, read.exit_code);
    if (read.output.front() == '+') return read.output.substr(1);
    std::string what = read.output.substr(1);
    if (const std::string path = notebook.string() + ": "; what.starts_with(path)) what = what.substr(path.size());
    throw SubmissionError("The notebook {} cannot be read: {}.", name, what);
}

std::vector<fs::path> take_notebooks(const fs::path& folder) {
    std::vector<fs::path> taken;
    for (const fs::path& notebook : notebooks_in(folder)) {
        const fs::path script = notebook.parent_path() / kScriptName;
        const std::string source = script_of_submitted_notebook(notebook);
        if (notebook_holds(notebook, script, source)) {
            const auto written = fs::last_write_time(notebook);
            write_file_atomically(script, source);
            fs::last_write_time(script, written);
            taken.push_back(notebook.parent_path());
        }
        fs::remove(notebook);
    }
    return taken;
}

}  // namespace dynlab::inline course
