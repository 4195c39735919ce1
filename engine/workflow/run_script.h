#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "documents/percent_script.h"
#include "documents/run_record.h"
#include "figures/gnuplot_renderer.h"

namespace dynlab::inline platform {
class WrittenFiles;
}

namespace dynlab::inline scripting {
class CallCache;
class CallsInParts;
}

namespace dynlab::inline workflow {

struct RunRequest {
    PercentScript script;
    std::optional<std::uint32_t> seed;               ///< instead of the script header's
    std::map<std::string, double> slider_values;     ///< instead of what the script gives its sliders
    std::filesystem::path out_folder;                ///< where `save` and `save_csv` may write
    std::function<void(const std::string&)> print;   ///< live output; none when empty
    std::function<void(const Message&)> enter_cell;  ///< called with each cell that begins: "cell 4 of 12, validation"
    bool stay_in_folder = false;      ///< files are read from the script's folder and the installed data only
    WrittenFiles* written = nullptr;  ///< says which files the script may replace; all without
    CallCache* call_cache = nullptr;  ///< where results of long calls are kept
    CallsInParts* parts = nullptr;    ///< makes calls of montecarlo in parts
};

/// Runs a script from top to bottom. The run results contain an error of the script; Ctrl-C throws Interrupted. Throws
/// DocumentError for a value of a slider that the script does not have.
RunRecord run_script(const RunRequest& request, GnuplotRenderer& renderer);

/// The answers that the script's header declares and the run did not give, "G1 (model), gain (number)"; empty where
/// there are none.
std::string missing_answers(const PercentScript& script, const RunRecord& record);

/// Names of the figures of the run results, in the order in which the script made them.
std::vector<std::string> figures_in_order(const RunRecord& record);

/// Queues every figure of the run results for a file of `folder` with its name and its number in that order, and notes
/// the file in the run results; renderer.finish() completes the files. Texts and numbers are those of the language.
void draw_figures(RunRecord& record, GnuplotRenderer& renderer, const std::filesystem::path& folder,
                  FigureFormat format, const std::string& language);

}  // namespace dynlab::inline workflow
