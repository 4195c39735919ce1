#include "app/live/runner_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "app/live/page_values.h"
#include "app/live/runner_messages.h"
#include "app/live/state_questions.h"
#include "base/languages.h"
#include "data_io/values/cbor_values.h"
#include "documents/html/plot_data.h"
#include "documents/weave.h"
#include "figures/figure.h"
#include "figures/gnuplot_renderer.h"
#include "platform/cache.h"
#include "platform/error.h"
#include "platform/memory.h"
#include "platform/process_group.h"
#include "platform/stopwatch.h"
#include "platform/terminal/progress.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/runtime/services.h"
#include "workflow/process_copy.h"
#include "workflow/run_script.h"

namespace dynlab::inline app {
namespace {

using Clock = std::chrono::steady_clock;

/// A state is kept where it took at least this long to come there from the one before.
constexpr double kWorthKeeping = 0.003;

/// The environment of the executed part of the script.
struct RunEnvironment {
    Cache cache;
    CallCache calls{cache};
    GnuplotRenderer renderer{&cache};
    ReportLanguage language;
    SliderValues sliders;
    PageValues page;
    Runtime runtime;
    std::map<std::string, std::string> drawn;  ///< names of figures, and what a page draws them from

    RunEnvironment(RunOptions options, const std::string& report_language, const std::string& prelude)
        : language{report_language}, runtime(with_memory(std::move(options), &calls), renderer) {
        runtime.services().language = &language;
        page.reader = {catalog_of(report_language), &option_name};
        if (!prelude.empty()) {
            runtime.add_functions(page_functions(), page);
            const RunRecord made = runtime.run_library(prelude, "workbench");
            if (made.error) throw EnvironmentError(made.error->text());
        }
        sliders.clamped = true;  // it was chosen before the script had this range
        runtime.services().sliders = &sliders;
    }

  private:
    static RunOptions with_memory(RunOptions options, CallCache* calls) {
        options.call_cache = calls;
        return options;
    }
};

class RunnerProcess {
  public:
    RunnerProcess(Channel orders, RunnerEnvironment requested)
        : line_(std::move(orders)), requested_(std::move(requested)) {}

    [[noreturn]] void serve() {
        while (const auto message = line_.receive()) {
            const RunOrder order = from_cbor<RunOrder>(message->bytes);
            if (!order.question.empty())
                answer(order);
            else if (split() == Side::kGoesOn)
                run(order);
        }
        ::_exit(0);
    }

  private:
    enum class Side { kStays, kGoesOn };

    Side split() {
        end_worker_threads();
        while (::waitpid(-1, nullptr, WNOHANG) > 0) {
        }
        auto [here, there] = Channel::pair();
        const pid_t next = fork_bound_copy();
        if (next < 0) ::_exit(1);
        if (next == 0) {
            line_ = std::move(there);
            kept_at_ = Clock::now();
            return Side::kGoesOn;
        }
        RunnerNews news{.kind = "split", .process = next};
        if (!line_.send(cbor_of(news), here.descriptor())) ::_exit(0);
        return Side::kStays;
    }

    void send_news(const RunnerNews& news) {
        if (!line_.send(cbor_of(news))) ::_exit(0);
    }

    /// Answers from the current state: that of the executed part of the script, or an empty script if nothing has run.
    void answer(const RunOrder& question) {
        if (!run_environment_ && !empty_environment_) {
            empty_environment_ = std::make_unique<RunEnvironment>(RunOptions(), "en", requested_.prelude);
            empty_environment_->runtime.run_statement(read_script_part("", {}), "start");  // names can be completed
        }
        lua_State* const L = (run_environment_ ? run_environment_ : empty_environment_)->runtime.state();
        send_news({.kind = "answer", .part = question.number, .shown = {{"answer", answer_about_state(L, question)}}});
    }

    void run(const RunOrder& order) {
        const PercentScript script = parse_percent_script(order.source, order.file);
        const std::vector<ScriptPart> parts = script_parts(script);
        if (!run_environment_) begin(order, script);
        run_environment_->sliders.chosen = order.slider_values;
        const std::size_t end = std::min(parts.size(), order.until);
        std::size_t last = order.from;
        for (std::size_t i = order.from; i < end; ++i) {
            last = i;
            send_news({.kind = "begun", .part = i});
            ProgressBar::set_listener([this, i](std::size_t done, std::size_t total) {
                const double part = total == 0 ? 0 : static_cast<double>(std::min(done, total)) / double(total);
                send_news({.kind = "progress", .part = i, .progress = part});
            });
            const Clock::time_point start = Clock::now();
            RunRecord record = run_environment_->runtime.run_part(script, parts[i]);
            const double seconds = seconds_since(start);
            if (requested_.draws_figures) {
                draw(record, order.figure_folder, i + 1 == parts.size());
            } else {
                run_environment_->renderer.finish();  // what the script saved itself
                record.figures.clear();
            }
            const bool failed = record.error.has_value();
            send_news({.kind = "done",
                       .part = i,
                       .seconds = seconds,
                       .record = std::move(record),
                       .shown = run_environment_->page.take()});
            if (failed) {
                send_news({.kind = "ended", .part = i});
                ::_exit(0);
            }
            const bool keep = i + 1 < end && seconds_since(kept_at_) >= kWorthKeeping;
            if (keep) return_freed_memory();
            if (keep && split() == Side::kStays) return;
        }
        send_news({.kind = "ended", .part = last});
        return_freed_memory();
    }

    void begin(const RunOrder& order, const PercentScript& script) {
        RunOptions options;
        options.seed = order.seed;
        const std::filesystem::path folder = script.file.parent_path();
        options.script_folder = folder.empty() ? "." : folder;
        options.out_folder = order.figure_folder;
        run_environment_ = std::make_unique<RunEnvironment>(options, script.header.language, requested_.prelude);
        run_environment_->runtime.begin_parts(script);
    }

    /// Figures that are new; at the end all, since a script may have changed one that it reported before.
    void draw(RunRecord& record, const std::filesystem::path& folder, bool all) {
        run_environment_->renderer.finish();
        GnuplotRenderer renderer(&run_environment_->cache);
        const Reader& reader = run_environment_->page.reader;
        for (auto& [name, figure] : record.figures) {
            figure.file = folder / (digest_of(name).hex() + ".svg");
            if (all || !run_environment_->drawn.contains(name)) {
                renderer.draw(*figure.figure, figure.file, FigureFormat::kSvg, reader);
                run_environment_->drawn[name] = plot_data(*figure.figure, reader);
            }
            figure.plot = run_environment_->drawn.at(name);
            figure.axes = words_of_axes(*figure.figure, reader);
        }
        renderer.finish();
    }

    Channel line_;
    RunnerEnvironment requested_;
    std::unique_ptr<RunEnvironment> run_environment_, empty_environment_;
    Clock::time_point kept_at_ = Clock::now();
};

/// What the terminal sends to the program ends the program, and with it this; nothing is written there from here.
void leave_terminal() {
    ::signal(SIGINT, SIG_IGN);
    const FileDescriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
    ::dup2(nowhere.get(), STDIN_FILENO);
    ::dup2(nowhere.get(), STDOUT_FILENO);
}

}  // namespace

void serve_runs(Channel orders, RunnerEnvironment world) {
    leave_terminal();
    try {
        RunnerProcess(std::move(orders), std::move(world)).serve();
    } catch (const std::exception& error) {
        fmt::print(stderr, "dynlab: {}\n", error.what());
        ::_exit(1);
    } catch (...) {
        ::_exit(1);
    }
}

}  // namespace dynlab::inline app
