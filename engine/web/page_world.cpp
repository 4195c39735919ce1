#include "web/page_world.h"

#include <emscripten.h>

#include <algorithm>

#include "data_io/values/json_values.h"
#include "documents/html/plot_data.h"
#include "platform/stopwatch.h"
#include "platform/terminal/progress.h"
#include "scripting/interpreter/catalog.h"

EM_JS(void, dynlab_send_news, (const char* json), { Module.news(UTF8ToString(json)); });

namespace dynlab::inline web {
namespace {

constexpr std::size_t kMaxPageMemory = std::size_t{512} << 20;

/// What a change of which makes every part run again.
std::string settings_of(const PercentScript& script, const PageRunOrder& order) {
    return script.file.string() + "\n" + std::to_string(order.seed.value_or(script.header.seed)) + "\n" +
           script.header.language + "\n" + json_of(order.slider_values);
}

RunOptions options_of(const CallCache& calls, const PercentScript& script, const PageRunOrder& order) {
    RunOptions options;
    options.seed = order.seed.value_or(script.header.seed);
    options.script_folder = script.file.parent_path();
    options.out_folder = options.script_folder / "out";
    options.call_cache = const_cast<CallCache*>(&calls);
    options.stay_in_folder = true;
    options.memory_limit_bytes = kMaxPageMemory;
    return options;
}

/// The number of the part that has this cell; of all where there is none.
std::size_t part_with(const std::vector<ScriptPart>& parts, const std::string& cell) {
    const auto has_cell = [&](const ScriptPart& part) {
        return std::find(part.cells.begin(), part.cells.end(), cell) != part.cells.end();
    };
    return static_cast<std::size_t>(std::find_if(parts.begin(), parts.end(), has_cell) - parts.begin());
}

}  // namespace

void send(const News& news) {
    send_json(json_of(news));
}

void send_json(const std::string& news) {
    dynlab_send_news(news.c_str());
}

void report_progress(std::size_t part, const std::vector<std::string>& cells) {
    ProgressBar::set_listener([part, cells](std::size_t done, std::size_t total) {
        const double share = total == 0 ? 0 : double(std::min(done, total)) / double(total);
        send({.kind = "progress", .part = part, .cells = cells, .progress = share});
    });
}

RunEnvironment::RunEnvironment(const CallCache& calls, const PercentScript& script, const PageRunOrder& order)
    : language_{script.header.language},
      reader_{catalog_of(script.header.language), &option_name},
      sliders_{order.slider_values, true},
      runtime_(options_of(calls, script, order), renderer_),
      settings_(settings_of(script, order)) {
    runtime_.services() = {.language = &language_, .sliders = &sliders_};
    runtime_.begin_parts(script);
}

std::size_t RunEnvironment::lasting_parts(const PercentScript& script, const PageRunOrder& order) const {
    if (order.fresh || settings_ != settings_of(script, order)) return 0;
    const std::vector<ScriptPart> parts = script_parts(script);
    const std::size_t first = order.again.empty() ? parts.size() : part_with(parts, order.again);
    std::size_t same = 0;
    while (same < std::min(done_.size(), first) && done_[same].code == parts[same].code &&
           done_[same].cells == parts[same].cells)
        ++same;
    return same;
}

bool RunEnvironment::goes_on(const PercentScript& script, const PageRunOrder& order) const {
    return !failed_ && !order.fresh && settings_ == settings_of(script, order) &&
           lasting_parts(script, order) == done_.size();
}

void RunEnvironment::begin(PercentScript script, const PageRunOrder& order) {
    script_ = std::move(script);
    parts_ = script_parts(script_);
    until_ = order.until.empty() ? parts_.size() : std::min(part_with(parts_, order.until) + 1, parts_.size());
}

std::size_t RunEnvironment::run_part() {
    const std::size_t i = done_.size();
    const auto end = [&] {
        send({.kind = "ended", .part = i});
        return std::size_t{0};
    };
    if (i >= until_) return end();
    const ScriptPart& part = parts_[i];
    send({.kind = "begun", .part = i, .cells = part.cells});
    report_progress(i, part.cells);
    failed_ = true;  // until it has ended
    const auto start = std::chrono::steady_clock::now();
    RunRecord results = runtime_.run_part(script_, part);
    News news{.kind = "done", .part = i, .cells = part.cells, .seconds = seconds_since(start)};
    if (results.error)
        news.error = {results.error->text(reader_), results.error->line_in(script_.file.filename().string())};
    news.figures = new_figures(results);
    news.results = std::move(results);
    send(news);
    if (news.error) return end();
    failed_ = false;
    done_.push_back(part);
    return done_.size();
}

std::map<std::string, PageFigure> RunEnvironment::new_figures(const RunRecord& results) {
    std::map<std::string, PageFigure> figures;
    for (const auto& [name, recorded] : results.figures) {
        auto& [drawn, caption] = drawn_[name];
        if (drawn == recorded.figure && caption == recorded.caption) continue;
        drawn = recorded.figure, caption = recorded.caption;
        figures[name] = {recorded.caption, plot_data(*recorded.figure, reader_), recorded.order};
    }
    return figures;
}

}  // namespace dynlab::inline web
