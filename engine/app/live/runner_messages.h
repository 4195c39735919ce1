#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "documents/record_description.h"

namespace dynlab::inline app {

/// What a page's runner is asked to do: the parts of a script from one on; what came before has run in the process that
/// gets the order.
struct RunOrder {
    std::string file;      ///< of the script
    std::string source;    ///< its text
    std::size_t from = 0;  ///< the first part to run
    std::uint32_t seed = 1;
    std::string figure_folder;
    std::map<std::string, double> slider_values;  ///< instead of what the script gives its sliders
    std::size_t until = 0;                        ///< the part before which the run ends
    /// "complete", "help" or "variables": a question about the state, answered without a run. `text` is the code up to
    /// the cursor ("complete") or the line with the cursor ("help"), `number` returns as the part of the answer.
    std::string question = {}, text = {};
    std::size_t cursor = 0, number = 0;
};

/// What scripts find in the process in addition to dynlab's own functions, and the treatment of their figures.
struct RunnerEnvironment {
    std::string prelude;        ///< Lua that runs before every script, with workbench.show (page_values.h); none: empty
    bool draws_figures = true;  ///< draws the figures of the run results, for documents; else the results have none
    bool keeps_end = true;      ///< the state behind the last part, for what may be written there
};

/// A message of the runner.
struct RunnerNews {
    /// "split": another process continues, and its line comes with the message; "begun": a part starts; "progress": the
    /// progress of a long calculation; "done": the part is finished, and the message contains all run results up to
    /// here; "ended": all parts are finished, or one failed; "answer": to a question, shown["answer"] is JSON.
    std::string kind;
    std::size_t part = 0;
    std::int64_t process = 0;  ///< number of the process that goes on
    double seconds = 0;        ///< the part took
    double progress = 0;       ///< from 0 to 1
    RunRecord record = {};
    std::map<std::string, std::string> shown = {};  ///< what the part gave the page (page_values.h)
};

DYNLAB_DESCRIBE(RunOrder, file, source, from, seed, figure_folder, slider_values, until, question, text, cursor, number)
DYNLAB_DESCRIBE(RunnerNews, kind, part, process, seconds, progress, record, shown)

}  // namespace dynlab::inline app
