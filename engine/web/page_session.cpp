#include <emscripten.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>

#include "base/languages.h"
#include "data_io/values/json_values.h"
#include "data_io/values/message_values.h"
#include "documents/html/plot_data.h"
#include "documents/record_description.h"
#include "figures/gnuplot_renderer.h"
#include "platform/cache.h"
#include "platform/stopwatch.h"
#include "platform/terminal/progress.h"
#include "scripting/interpreter/catalogue.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/lint/lint.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/prompt/completion.h"
#include "scripting/prompt/inspection.h"
#include "scripting/runtime/services.h"

// The engine of a page: a worker calls the functions at the end of this file
// with JSON and passes on the JSON that send_news() gives it.

EM_JS(void, dynlab_send_news, (const char* json), { Module.news(UTF8ToString(json)); });

namespace dynlab::inline web {

namespace {

/// A call of a page: run a script.
struct RunOrder {
    std::string source, file;                     ///< the script, and its name in messages
    std::optional<std::uint32_t> seed;            ///< instead of the script header's
    std::map<std::string, double> slider_values;  ///< instead of the script's own
    std::size_t from = 0;                         ///< the first part whose results are sent
};
DYNLAB_DESCRIBE(RunOrder, source, file, seed, slider_values, from)

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

/// What a page hears of a run: "begun" and "done" for each part, "progress" within one, "ended".
struct News {
    std::string kind;
    std::size_t part = 0;
    std::vector<std::string> cells;  ///< of the part
    double progress = 0, seconds = 0;
    std::optional<RunRecord> results = {};  ///< of the run so far
    std::map<std::string, PageFigure> figures = {};
    std::optional<PageError> error = {};
};
template <Is<News> T, class V>
void describe(T& object, V& member) {
    auto& [kind, part, cells, progress, seconds, results, figures, error] = object;
    member("kind", kind), member("part", part), member("cells", cells), member("progress", progress);
    member("seconds", seconds), member("results", results), member("figures", figures), member("error", error);
}

void send(const News& news) {
    dynlab_send_news(json_of(news).c_str());
}

/// A script's world. A page has one at a time; results of long calls stay from one to the next.
class World {
  public:
    World(const CallCache& calls, const PercentScript& script, const RunOrder& order)
        : language_{script.header.language},
          reader_{catalog_of(script.header.language), &option_name},
          sliders_{order.slider_values, true},
          runtime_(options(calls, script, order), renderer_) {
        runtime_.services() = {.language = &language_, .sliders = &sliders_};
        runtime_.begin_parts(script);
    }

    Runtime& runtime() { return runtime_; }

    void run(const PercentScript& script, const RunOrder& order) {
        const std::vector<ScriptPart> parts = script_parts(script);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const bool wanted = i >= order.from;
            if (wanted) send({.kind = "begun", .part = i, .cells = parts[i].cells});
            ProgressBar::tell_instead([&](std::size_t done, std::size_t total) {
                const double share = total == 0 ? 0 : double(std::min(done, total)) / double(total);
                send({.kind = "progress", .part = i, .cells = parts[i].cells, .progress = share});
            });
            const auto start = std::chrono::steady_clock::now();
            RunRecord results = runtime_.run_part(script, parts[i]);
            News news{.kind = "done", .part = i, .cells = parts[i].cells, .seconds = seconds_since(start)};
            if (results.error)
                news.error = {results.error->text(reader_), results.error->line_in(script.file.filename().string())};
            if (wanted || news.error) {
                for (auto& [name, figure] : results.figures) news.figures[name] = page_figure(name, figure);
                news.results = std::move(results);
                send(news);
            }
            if (news.error) break;
        }
        send({.kind = "ended", .part = parts.size()});
    }

  private:
    RunOptions options(const CallCache& calls, const PercentScript& script, const RunOrder& order) {
        RunOptions options;
        options.seed = order.seed.value_or(script.header.seed);
        options.script_folder = script.file.parent_path();
        options.out_folder = options.script_folder / "out";
        options.call_cache = const_cast<CallCache*>(&calls);
        options.stay_in_folder = true;
        options.memory_limit_bytes = std::size_t{512} << 20;
        return options;
    }

    /// A figure is described once: a script that changes one that it reported before makes it new.
    PageFigure page_figure(const std::string& name, const RecordedFigure& figure) {
        auto& [drawn, plot] = drawn_[name];
        if (drawn != figure.figure) drawn = figure.figure, plot = plot_data(*figure.figure, reader_);
        return {figure.caption, plot, figure.order};
    }

    ReportLanguage language_;
    Reader reader_;
    SliderValues sliders_;
    GnuplotRenderer renderer_;
    Runtime runtime_;
    std::map<std::string, std::pair<std::shared_ptr<const Figure>, std::string>> drawn_;
};

struct PageSession {
    Cache cache;
    CallCache calls{cache};
    std::unique_ptr<World> world;
};

PageSession& session() {
    static PageSession the_one;
    return the_one;
}

/// What the caller gets; it stays until the next call.
const char* answer(std::string text) {
    static std::string kept;
    kept = std::move(text);
    return kept.c_str();
}

struct Completed {
    std::size_t typed = 0;
    std::vector<std::string> candidates;
    std::string note;
};
DYNLAB_DESCRIBE(Completed, typed, candidates, note)

struct Linted {
    int line = 1, column = 1;
    std::string kind, message;
};
DYNLAB_DESCRIBE(Linted, line, column, kind, message)

}  // namespace
}  // namespace dynlab::inline web

using namespace dynlab;

extern "C" {

/// RunOrder. Everything else is news.
void dynlab_run(const char* order_json) {
    try {
        const auto order = from_json<web::RunOrder>(order_json);
        const PercentScript script = parse_percent_script(order.source, order.file);
        PageSession& page = session();
        page.world.reset();  // before the next: memory for one
        page.world = std::make_unique<World>(page.calls, script, order);
        page.world->run(script, order);
    } catch (const std::exception& error) {
        send({.kind = "failed", .error = PageError{error.what()}});
    }
}

/// What could stand behind this text, in the world of the last run.
const char* dynlab_complete(const char* text) {
    if (!session().world) return answer("null");
    const Completion found = complete(session().world->runtime().state(), text);
    return answer(json_of(Completed{found.typed, found.candidates, found.note}));
}

/// What there is to say of the name at this byte of the text; "" for nothing.
const char* dynlab_inspect(const char* text, int cursor) {
    if (!session().world) return answer("");
    return answer(inspect(session().world->runtime().state(), text, static_cast<std::size_t>(cursor)).value_or(""));
}

/// What will not work in a script, in the words of this language.
const char* dynlab_lint(const char* source, const char* file, const char* language) {
    const Reader reader{catalog_of(language), &option_name};
    std::vector<Linted> found;
    for (const LintFinding& finding : lint_script(source, file))
        found.push_back({finding.line, finding.column, finding.kind, message_text(finding.message, reader)});
    return answer(json_of(found));
}
}
