#include "web/page_bench.h"

#include <algorithm>
#include <memory>

#include "app/live/page_values.h"
#include "app/workbench/bench_state.h"
#include "app/workbench/data_choice.h"
#include "base/error.h"
#include "data_io/data_file.h"
#include "data_io/dataset_index.h"
#include "data_io/values/json_values.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/stopwatch.h"
#include "platform/terminal/progress.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/runtime/help.h"
#include "web/page_world.h"

namespace dynlab::inline web {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBenchMemory = std::size_t{512} << 20;
constexpr int kNothing = 204, kMissing = 404, kConflict = 409, kWrong = 422;

/// The state behind the parts of a script that have run, with what the workbench's views need.
struct BenchWorld {
    ReportLanguage language;
    SliderValues sliders;
    GnuplotRenderer renderer;
    app::PageValues page;
    Runtime runtime;

    BenchWorld(RunOptions options, const PercentScript& script, const std::string& prelude)
        : language{script.header.language}, runtime(std::move(options), renderer) {
        runtime.services() = {.language = &language, .sliders = &sliders};
        page.reader = {catalog_of(script.header.language), &option_name};
        runtime.add_functions(app::page_functions(), page);
        const RunRecord made = runtime.run_library(prelude, "workbench");
        if (made.error) throw EnvironmentError(made.error->text());
        runtime.begin_parts(script);
    }
};

/// Runs the parts in the page's engine, one with each call of next(). Views only look at variables, so the state behind
/// them is the state before them.
class PagePartRunner : public app::PartRunner {
  public:
    PagePartRunner(const CallCache& calls, std::string prelude) : calls_(calls), prelude_(std::move(prelude)) {}

    std::size_t run(const PercentScript& script, const std::set<fs::path>& changed) override {
        const std::vector<ScriptPart> parts = script_parts(script);
        const auto has_run = [&](std::size_t i) {
            return i < parts.size() && parts_[i].code == parts[i].code && parts_[i].cells == parts[i].cells;
        };
        bool goes_on = world_ && changed.empty() && world_->language.code == script.header.language &&
                       script_.header.seed == script.header.seed;
        for (std::size_t i = 0; i < done_; ++i) goes_on = goes_on && has_run(i);
        script_ = script;
        parts_ = parts;
        if (!goes_on) begin_again();
        at_ = done_;
        begun_ = false;
        return at_;
    }
    const std::vector<ScriptPart>& parts() const override { return parts_; }
    bool running() const override { return at_ < parts_.size(); }
    std::size_t at() const { return at_; }  ///< the part that runs

    app::RunnerNews next() {
        app::RunnerNews news{.kind = "begun", .part = at_};
        if (!std::exchange(begun_, true)) return news;
        const auto start = std::chrono::steady_clock::now();
        news.kind = "done";
        news.record = world_->runtime.run_part(script_, parts_[at_]);
        news.record.figures.clear();
        news.seconds = seconds_since(start);
        news.shown = world_->page.take();
        begun_ = false;
        ++at_;
        if (news.record.error)
            give_up();
        else if (!is_view(parts_[news.part]))
            done_ = at_;
        return news;
    }
    /// The part that ran has left its work half done: the next run begins with the first part.
    void give_up() {
        at_ = parts_.size();
        world_.reset();
        done_ = 0;
    }

  private:
    static bool is_view(const ScriptPart& part) {
        return std::ranges::all_of(
            part.cells, [](const std::string& cell) { return cell == app::kViewCell || cell == app::kSlowViewCell; });
    }

    void begin_again() {
        done_ = 0;
        world_.reset();  // before the next: memory for one
        RunOptions options;
        options.seed = script_.header.seed;
        options.script_folder = script_.file.parent_path();
        options.out_folder = options.script_folder / "out";
        options.call_cache = const_cast<CallCache*>(&calls_);
        options.stay_in_folder = true;
        options.memory_limit_bytes = kMaxBenchMemory;
        world_ = std::make_unique<BenchWorld>(std::move(options), script_, prelude_);
    }

    const CallCache& calls_;
    std::string prelude_;
    PercentScript script_;
    std::vector<ScriptPart> parts_;
    std::unique_ptr<BenchWorld> world_;
    std::size_t done_ = 0;  ///< parts behind which the world is
    std::size_t at_ = 0;    ///< the part that runs
    bool begun_ = false;
};

struct PageBench {
    PagePartRunner runner;
    app::BenchState state;
    std::vector<std::string> told_past;

    PageBench(const BenchOpening& opening, const CallCache& calls)
        : runner(calls, opening.prelude), state(opening.file, runner, opening.past), told_past(opening.past) {}
};

std::unique_ptr<PageBench>& bench() {
    static std::unique_ptr<PageBench> the_one;
    return the_one;
}

/// The last steps, which a page stores.
std::vector<std::string> last_steps(const std::vector<std::string>& past) {
    constexpr std::size_t kMaxSteps = 50;
    return {past.end() - std::ptrdiff_t(std::min(past.size(), kMaxSteps)), past.end()};
}

void tell() {
    const auto changes = bench()->state.changes();
    if (!changes) return;
    std::string news = "{\"kind\":\"page\",\"page\":" + *changes;
    const std::vector<std::string> past = last_steps(bench()->state.text().past());
    if (past != bench()->told_past) {
        news += ",\"past\":" + nlohmann::json(past).dump();
        bench()->told_past = past;
    }
    send_json(news + "}");
}

void run_next_part(PageBench& page) {
    ProgressBar::set_listener([&page](std::size_t done, std::size_t total) {
        const double share = total == 0 ? 0 : double(std::min(done, total)) / double(total);
        page.state.take({.kind = "progress", .part = page.runner.at(), .progress = share});
        tell();
    });
    for (const bool begins : {true, false}) {
        page.state.take(page.runner.next());
        if (begins) tell();
    }
}

/// Data files that lie beside the script, and the course's.
std::string data_names(const fs::path& folder) {
    nlohmann::json list = dataset_names();
    for (const auto& entry : fs::directory_iterator(folder))
        if (is_data_file(entry.path())) list.push_back(entry.path().filename().string());
    return list.dump();
}

/// Keeps the file that the page has put at `body` under its name, or one like it that is free, beside the script.
std::string taken_file(const fs::path& folder, const BenchOrder& order) {
    const fs::path name = app::name_of_data_file(order.name);
    fs::path file = folder / name;
    for (int k = 2; fs::exists(file); ++k)
        file = folder / (name.stem().string() + "-" + std::to_string(k) + name.extension().string());
    fs::rename(order.body, file);
    return json_of(app::describe_data(file.filename().string()));
}

BenchReply help_reply(const std::string& name) {
    const auto page = find_help_page(name);
    if (!page) return {kMissing, message_text(Message("No help page has this name."), bench()->state.reader())};
    return {.text = page_text(*page, find_function(std::string(page->name)))};
}

BenchReply reply_to(const BenchOrder& order) {
    app::BenchState& state = bench()->state;
    const fs::path folder = state.text().file().parent_path();
    if (order.path == "whole") return {.text = state.json(true)};
    if (order.path == "script") {
        const auto revision = state.change(from_json<app::ScriptOrder>(order.body));
        if (revision) return {.text = std::to_string(*revision)};
        return {kConflict,
                message_text(Message("The script has changed in the meantime. Reload the page."), state.reader())};
    }
    if (order.path == "look") return {.text = std::to_string(state.look(from_json<app::ViewOrder>(order.body)))};
    if (order.path == "datasets") return {.text = data_names(folder)};
    if (order.path == "columns") return {.text = json_of(app::describe_data(order.name))};
    if (order.path == "upload") return {.text = taken_file(folder, order)};
    if (order.path == "help") return help_reply(order.name);
    if (order.path == "record") {
        const auto selection = from_json<app::DataSelection>(order.body);
        const std::string lines = app::loading_lines_for_page(selection);
        state.put([&](const std::string& script) { return app::with_data(script, selection, lines); });
    } else if (order.path == "undo") {
        state.undo();
    } else if (order.path == "redo") {
        state.redo();
    } else if (order.path == "again") {
        state.again();
    } else {
        return {kMissing, order.path};
    }
    return {kNothing, ""};
}

}  // namespace

void open_bench(const BenchOpening& opening, const CallCache& calls) {
    const fs::path file = opening.file;
    fs::create_directories(file.parent_path());
    fs::current_path(file.parent_path());  // of data that are named without a folder
    write_file_atomically(file, opening.source.empty() ? app::new_session("Session", "", "en") : opening.source);
    bench().reset();
    bench() = std::make_unique<PageBench>(opening, calls);
    bench()->state.allow_runs();
    if (opening.stopped.empty()) return;
    bench()->state.run();
    bench()->state.run_was_stopped(opening.stopped);
}

BenchReply answer_bench(const BenchOrder& order) {
    try {
        return reply_to(order);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return {kWrong, message_text(message_of(error), bench()->state.reader())};
    }
}

bool work_for_bench() {
    PageBench& page = *bench();
    if (page.state.must_run()) page.state.run();
    try {
        if (page.runner.running()) run_next_part(page);
    } catch (...) {
        page.runner.give_up();
        page.state.run_was_stopped();
        tell();
        throw;
    }
    tell();
    return page.runner.running() || page.state.must_run();
}

}  // namespace dynlab::inline web
