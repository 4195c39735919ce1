#include "app/live/script_runner.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "app/live/folder_watch.h"
#include "app/live/runner_process.h"
#include "data_io/values/cbor_values.h"
#include "platform/error.h"
#include "platform/process_group.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

Message none_left() {
    return Message("the process that runs scripts has exited; restart dynlab");
}

/// What a change of which makes every part run again: the file's place, the seed, the header.
std::string settings_of(const PercentScript& script, std::uint32_t seed) {
    return fmt::format("{}\n{}\n{}", script.file.string(), seed, script.header.language);
}

/// The number of parts before the one with this cell; of all where there is none.
std::size_t parts_before(const std::vector<ScriptPart>& parts, const std::string& cell) {
    const auto has_cell = [&](const ScriptPart& part) {
        return std::ranges::find(part.cells, cell) != part.cells.end();
    };
    return static_cast<std::size_t>(std::ranges::find_if(parts, has_cell) - parts.begin());
}

bool is_same(const ScriptPart& a, const ScriptPart& b) {
    return a.code == b.code && a.cells == b.cells;
}

}  // namespace

ScriptRunner::ScriptRunner(RunnerEnvironment world) : keeps_end_(world.keeps_end) {
    auto [here, there] = Channel::pair();
    const pid_t first = fork_bound_copy();
    if (first < 0) throw EnvironmentError("cannot start a process for the script: {}", system_reason(errno));
    if (first == 0) {
        here.release();
        serve_runs(std::move(there), std::move(world));
    }
    kept_.push_back({0, std::move(here), first});
}

ScriptRunner::~ScriptRunner() {
    go_back_to(0);
    const pid_t first = kept_.front().process;
    ::kill(first, SIGKILL);
    retry_interrupted([&] { return ::waitpid(first, nullptr, 0); });
}

/// Each process is the child of the one before, and dies with it. The first stays, also where it has died.
void ScriptRunner::end_last() {
    if (kept_.size() == 1) return;
    ::kill(kept_.back().process, SIGKILL);
    kept_.pop_back();
}

void ScriptRunner::go_back_to(std::size_t parts) {
    while (running_ && !split_)
        next();  // the process with the order keeps its state; it is the one behind it that runs
    if (running_) end_last();
    running_ = false;
    while (kept_.back().parts > parts) end_last();
}

bool ScriptRunner::is_as_it_ran(std::size_t part, const std::vector<ScriptPart>& parts, const ReportRequest& request,
                                const std::set<fs::path>& changed) const {
    if (part >= parts_.size() || part >= parts.size() || !is_same(parts[part], parts_[part])) return false;
    if (part >= done_) return request.slider_values == slider_values_;
    const auto& [files, sliders] = used_[part];
    const auto was_moved = [&](const auto& slider) {
        const auto& [name, was] = slider;
        const auto chosen = request.slider_values.find(name);
        return was.value !=
               (chosen == request.slider_values.end() ? was.initial : std::clamp(chosen->second, was.from, was.to));
    };
    return std::none_of(files.begin(), files.end(), [&](const fs::path& file) { return changed.contains(file); }) &&
           std::none_of(sliders.begin(), sliders.end(), was_moved);
}

std::size_t ScriptRunner::run(const ReportRequest& request, const fs::path& figure_folder,
                              const std::set<fs::path>& changed, const RunExtent& extent) {
    const std::lock_guard lock(mutex_);
    const PercentScript& script = request.script;
    std::vector<ScriptPart> parts = script_parts(script);
    const std::string settings = settings_of(script, request.seed);
    std::size_t same = 0;
    while (settings == settings_ && is_as_it_ran(same, parts, request, changed)) ++same;
    const bool all_same = same == parts.size() && same == parts_.size();
    const std::size_t until =
        extent.until.empty() ? parts.size() : std::min(parts_before(parts, extent.until) + 1, parts.size());
    const bool reaches = running_ ? order_.until == until : done_ >= until;
    if (all_same && extent.again.empty() && reaches) return under_way_;
    if (!extent.again.empty()) same = std::min(same, parts_before(parts, extent.again));
    go_back_to(std::min(same, done_));
    settings_ = settings;
    slider_values_ = request.slider_values;
    parts_ = std::move(parts);
    used_.resize(parts_.size());
    order_ = {script.file.string(),   script.source,         0,    request.seed,
              figure_folder.string(), request.slider_values, until};
    if (!send_order()) throw EnvironmentError(none_left());
    return under_way_;
}

/// To the last process that is still there: others were killed. False when there is none.
bool ScriptRunner::send_order() {
    split_ = false;
    while (true) {
        order_.from = under_way_ = done_ = kept_.back().parts;
        running_ = kept_.back().line.send(cbor_of(order_));
        if (running_ || kept_.size() == 1) return running_;
        end_last();
    }
}

std::string ScriptRunner::ask(RunOrder question) {
    constexpr int kMaxDuration = 2000;  // ms
    const std::lock_guard lock(mutex_);
    const std::size_t runs = running_ ? 1 : 0;  // the last process has no time to answer
    if (kept_.size() <= runs) return {};
    Channel& line = kept_[kept_.size() - 1 - runs].line;
    question.number = ++questions_;
    if (!line.send(cbor_of(question))) return {};
    for (pollfd waiting{line.descriptor(), POLLIN, 0}; ::poll(&waiting, 1, kMaxDuration) > 0;) {
        const auto message = line.receive();
        if (!message) return {};
        RunnerNews news = from_cbor<RunnerNews>(message->bytes);
        if (news.kind == "answer" && news.part == questions_) return std::move(news.shown["answer"]);
    }
    return {};
}

void ScriptRunner::stop() {
    const std::lock_guard lock(mutex_);
    if (running_) go_back_to(done_);
    done_ = kept_.back().parts;
}

int ScriptRunner::descriptor() const {
    return running_ ? kept_.back().line.descriptor() : -1;
}

RunnerNews ScriptRunner::next() {
    const std::lock_guard lock(mutex_);
    std::optional<Channel::Message> message = kept_.back().line.receive();
    if (!message) {
        if (!split_) {  // it died before it had begun
            end_last();
            if (send_order()) return next();
        }
        RunnerNews died{.kind = "ended", .part = under_way_};
        died.record.error =
            RecordedError{split_ ? Message("the process that ran the script exited unexpectedly; run the script again")
                                 : none_left()};
        split_ = true;
        stop();
        return died;
    }
    RunnerNews news = from_cbor<RunnerNews>(message->bytes);
    if (news.kind == "split") {
        split_ = true;
        kept_.back().parts = done_;
        kept_.push_back({done_, Channel(std::move(message->file)), static_cast<pid_t>(news.process)});
    } else if (news.kind == "begun") {
        under_way_ = news.part;
    } else if (news.kind == "done" && !news.record.error) {
        done_ = news.part + 1;
        used_[news.part] = {{}, news.record.sliders};
        for (const fs::path& file : news.record.files_read) used_[news.part].files.insert(place_of(file));
    } else if (news.kind == "ended") {
        running_ = false;
        kept_.back().parts = done_;
        const std::size_t until = std::min(order_.until, parts_.size());
        if (done_ < until || !keeps_end_) end_last();  // a part failed: nothing goes on from there
    }
    return news;
}

}  // namespace dynlab::inline app
