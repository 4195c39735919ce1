#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/languages.h"
#include "data_io/values/described.h"
#include "data_io/values/message_values.h"
#include "documents/record_description.h"
#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"

namespace dynlab::inline web {

/// A call of a page: run a script.
struct PageRunOrder {
    std::string source, file;                     ///< the script, and its name in messages
    std::optional<std::uint32_t> seed;            ///< instead of the script header's
    std::map<std::string, double> slider_values;  ///< instead of the script's own
    std::string again, until;  ///< ids of cells: the first that runs, changed or not, and the last; empty: none, all
    bool fresh = false;        ///< every cell runs
};
DYNLAB_DESCRIBE(PageRunOrder, source, file, seed, slider_values, again, until, fresh)

struct PageFigure {
    std::string caption, plot;  ///< plot: documents/html/plot_data.h
    std::size_t order = 0;
};
DYNLAB_DESCRIBE(PageFigure, caption, plot, order)

struct PageError {
    std::string text;  ///< with its place
    int line = 0;      ///< of the script; 0 elsewhere
};
DYNLAB_DESCRIBE(PageError, text, line)

/// What a page hears of a run: "begun" and "done" for each part, "progress" within one, "ended"; "failed" of an order
/// that cannot be carried out.
struct News {
    std::string kind;
    std::size_t part = 0;
    std::vector<std::string> cells;  ///< of the part
    double progress = 0, seconds = 0;
    std::optional<RunRecord> results = {};           ///< of the run so far
    std::map<std::string, PageFigure> figures = {};  ///< those that are new or others than before
    std::optional<PageError> error = {};
};
template <Is<News> T, class V>
void describe(T& object, V& member) {
    auto& [kind, part, cells, progress, seconds, results, figures, error] = object;
    member("kind", kind), member("part", part), member("cells", cells), member("progress", progress);
    member("seconds", seconds), member("results", results), member("figures", figures), member("error", error);
}

/// Of a slow call of the work that runs meanwhile.
void report_progress(std::size_t part, const std::vector<std::string>& cells);
void send(const News& news);
void send_json(const std::string& news);

/// A script's world. A page has one at a time; results of long calls stay from one to the next.
class RunEnvironment {
  public:
    RunEnvironment(const CallCache& calls, const PercentScript& script, const PageRunOrder& order);

    Runtime& runtime() { return runtime_; }
    /// So many parts at the beginning of the script need not run again where they have run in a world like this one.
    std::size_t lasting_parts(const PercentScript& script, const PageRunOrder& order) const;
    /// Whether the script can go on in this world: nothing that it needs to run again has run.
    bool goes_on(const PercentScript& script, const PageRunOrder& order) const;
    /// What run_part() runs from now on.
    void begin(PercentScript script, const PageRunOrder& order);
    /// Runs the next part of the script: the number of parts that have run; 0 when the run has ended, behind the last
    /// or one that failed. The page is told of both.
    std::size_t run_part();
    /// The page may show other figures than this world has drawn: the next part sends all.
    void forget_drawn() { drawn_.clear(); }

  private:
    std::map<std::string, PageFigure> new_figures(const RunRecord& results);

    ReportLanguage language_;
    Reader reader_;
    SliderValues sliders_;
    GnuplotRenderer renderer_;
    Runtime runtime_;
    std::string settings_;
    PercentScript script_;
    std::vector<ScriptPart> parts_, done_;
    std::size_t until_ = 0;  ///< the part behind the last that is to run
    bool failed_ = false;    ///< a part has left its work half done
    std::map<std::string, std::pair<std::shared_ptr<const Figure>, std::string>> drawn_;  ///< with its caption
};

}  // namespace dynlab::inline web
