#include "app/live/live_document.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/interrupt.h"
#include "workflow/run_script.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// A file is looked at when it has been left alone for so long: editors write in several steps.
constexpr auto kQuiet = 30ms;
/// Setting a page takes longer than most cells: those that are over by then are set with it.
constexpr auto kShortRun = 100ms;
/// A page from the cache runs after the reader has it: the run would otherwise take the processors from the browser.
constexpr auto kRunAfterCacheHit = 1500ms;
/// A page is kept for the next time when nothing has changed for so long: that takes disk and processor.
constexpr auto kKeepAfter = 3s;
/// How often Ctrl-C is looked for while nothing happens.
constexpr auto kLookForInterrupt = 1s;

/// Empty where it cannot be read.
std::string digest_of_picture(const fs::path& file) {
    std::error_code failure;
    if (!fs::is_regular_file(file, failure)) return "";
    try {
        return digest_of_file(file).hex();
    } catch (const EnvironmentError&) {
        return "";
    }
}

/// Also where a file appears that `load` prefers to the one that was read: NAME.mat to NAME.csv.
bool concerns_data(const fs::path& changed, const fs::path& data) {
    const bool is_data = changed.extension() == ".mat" || changed.extension() == ".csv";
    return concerns(changed, data) ||
           (is_data && changed.parent_path() == data.parent_path() && changed.stem() == data.stem());
}

/// Entries of the run before stay until this one gives its own.
template <class Map>
void add_older(Map& entries, const Map& older) {
    entries.insert(older.begin(), older.end());
}

}  // namespace

LiveDocument::LiveDocument(std::function<ReportRequest()> read, ScriptRunner& runner, LivePage& page)
    : read_(std::move(read)), runner_(runner), page_(page), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

void LiveDocument::wake() {
    const std::uint64_t one = 1;
    write_all(wake_.get(), reinterpret_cast<const char*>(&one), sizeof one);
}

void LiveDocument::allow_runs() {
    const std::lock_guard lock(orders_mutex_);
    may_run_ = true;
    wake();
}

void LiveDocument::stop_run() {
    const std::lock_guard lock(orders_mutex_);
    stop_ = true;
    wake();
}

void LiveDocument::run_at(const RunPlace& place) {
    const std::lock_guard lock(orders_mutex_);
    place_ = place;
    wake();
}

void LiveDocument::run_again_from_start() {
    const std::lock_guard lock(orders_mutex_);
    restart_ = true;
    wake();
}

void LiveDocument::set_sliders(const std::map<std::string, double>& values) {
    const std::lock_guard lock(orders_mutex_);
    for (const auto& [name, value] : values) sliders_[name] = value;
    wake();
}

void LiveDocument::end() {
    end_ = true;
    wake();
}

void LiveDocument::work() {
    try {
        follow();
    } catch (...) {
        save_page();
        throw;
    }
    save_page();
}

void LiveDocument::follow() {
    std::uint64_t earlier_orders = 0;  // the first reading sees to them
    while (::read(wake_.get(), &earlier_orders, sizeof earlier_orders) > 0) {
    }
    read_again({});
    while (!end_) {
        const bool may_end_soon = runner_.running() && Clock::now() < set_from_;
        if (page_is_old_ && !page_is_from_cache_ && !may_end_soon) set_page();
        wait_for_something();
        throw_if_interrupted();
        if (end_) break;
        take_orders();
        for (const fs::path& file : watch_.changes()) {
            if (!is_ours(file)) continue;
            changed_.insert(file);
            last_change_ = Clock::now();
            save_at_.reset();
        }
        if (!changed_.empty() && Clock::now() - last_change_ >= kQuiet) read_again(std::exchange(changed_, {}));
        if (first_run_ && Clock::now() >= *first_run_) or_complain([this] { run({}); });
        if (save_at_ && Clock::now() >= *save_at_) save_page();
        take_news();
    }
}

void LiveDocument::wait_for_something() {
    pollfd waiting[3] = {{watch_.descriptor(), POLLIN, 0}, {wake_.get(), POLLIN, 0}, {runner_.descriptor(), POLLIN, 0}};
    const Clock::time_point now = Clock::now();
    Clock::time_point until = now + kLookForInterrupt;
    if (!changed_.empty()) until = std::min(until, last_change_ + kQuiet);
    if (page_is_old_ && runner_.running() && now < set_from_) until = std::min(until, set_from_);
    for (const auto& instant : {first_run_, save_at_})
        if (instant) until = std::min(until, *instant);
    const auto max_wait = std::chrono::ceil<std::chrono::milliseconds>(until - now).count();
    ::poll(waiting, 3, std::max(0, static_cast<int>(max_wait)));
}

void LiveDocument::take_orders() {
    std::uint64_t count = 0;
    if (::read(wake_.get(), &count, sizeof count) <= 0) return;
    bool stop = false, restart = false;
    RunPlace place;
    {
        const std::lock_guard lock(orders_mutex_);
        stop = std::exchange(stop_, false);
        restart = std::exchange(restart_, false);
        place = std::exchange(place_, {});
    }
    if (stop && runner_.running()) {
        runner_.stop();
        for (auto& [cell, state] : states_)
            if (state.state != "done") state = {"waiting", 0, 0};
        show_states();
    }
    if (restart) {
        runner_.forget();
        page_is_from_cache_ = false;
        until_.clear();
    }
    if (!stop) read_again({}, place);
}

bool LiveDocument::is_ours(const fs::path& changed) const {
    // A script may draw the picture that its document shows: the same picture again is no change.
    if (const auto picture = pictures_.find(changed); picture != pictures_.end())
        return digest_of_picture(changed) != picture->second;
    const fs::path folder = changed.parent_path();
    const bool literature = changed.extension() == ".bib" && request_ &&
                            (folder == place_of(request_->template_file).parent_path() ||
                             folder == place_of(request_->script.file).parent_path());
    return literature || std::ranges::any_of(inputs_, [&](const fs::path& file) { return concerns(changed, file); }) ||
           std::ranges::any_of(data_, [&](const fs::path& file) { return concerns_data(changed, file); });
}

/// What is wrong is said on the page.
void LiveDocument::or_complain(const std::function<void()>& act) {
    try {
        act();
    } catch (const DocumentError& error) {
        page_.complain({error.message()});
        notify_();
    } catch (const EnvironmentError& error) {
        page_.complain({error.message()});
        notify_();
    }
}

/// Reads script and template again and runs what has changed.
void LiveDocument::read_again(const std::set<fs::path>& changed, const RunPlace& place) {
    save_at_.reset();
    or_complain([&] {
        const std::string before = request_ ? request_->script.source : "";
        request_ = read_();
        if (request_->script.source != before) until_.clear();
        page_.speak(request_->script.header.language, request_->script.header.lesson);
        std::set<fs::path> data;
        for (const fs::path& file : data_)
            if (std::ranges::any_of(changed, [&file](const fs::path& one) { return concerns_data(one, file); }))
                data.insert(file);
        watch_inputs();
        page_is_old_ = true;
        bool may_run = false;
        {
            const std::lock_guard lock(orders_mutex_);
            may_run = may_run_;
            request_->slider_values = sliders_;
        }
        notify_reading_(request_->slider_values);
        page_.ask_whether_to_run(!may_run);
        if (!may_run) return;
        if (!changed.empty() || !request_->slider_values.empty()) page_is_from_cache_ = false;
        first_run_.reset();
        if (!std::exchange(opened_, true) && load_saved_page()) {
            first_run_ = Clock::now() + kRunAfterCacheHit;
            return;
        }
        run(data, place);
    });
}

void LiveDocument::run(const std::set<fs::path>& changed_data, const RunPlace& place) {
    first_run_.reset();
    const bool in_script = place.file == request_->script.file.filename();
    const Cell* const chosen = in_script ? request_->script.cell_at_line(place.line) : nullptr;
    const std::string id = chosen && chosen->kind == Cell::Kind::kCode ? chosen->id : "";
    if (!id.empty()) until_ = place.again ? "" : id;
    set_from_ = Clock::now() + kShortRun;
    const std::size_t first = runner_.run(*request_, figures_.path(), changed_data, {place.again ? id : "", until_});
    for (std::size_t i = first; runner_.running() && i < runner_.parts().size(); ++i)
        for (const std::string& cell : runner_.parts()[i].cells) states_[cell] = {"waiting", 0, 0};
    show_states();
}

void LiveDocument::take_news() {
    while (runner_.running()) {
        pollfd waiting{runner_.descriptor(), POLLIN, 0};
        if (::poll(&waiting, 1, 0) <= 0) return;
        take(runner_.next());
    }
}

void LiveDocument::take(RunnerNews news) {
    const std::vector<ScriptPart>& parts = runner_.parts();
    const auto set_state = [&](std::size_t part, const CellState& state) {
        if (part >= parts.size()) return;
        for (const std::string& cell : parts[part].cells) states_[cell] = state;
    };
    if (news.kind == "begun" || news.kind == "progress") {
        set_state(news.part, {"running", 0, news.progress});
    } else if (news.kind == "done" || (news.kind == "ended" && news.record.error)) {
        const bool failed = news.record.error.has_value();
        set_state(news.part, {failed ? "failed" : "done", news.seconds, 0});
        if (news.kind == "ended") {  // the process died: nothing but that is known
            shown_.error = news.record.error;
        } else {
            RunRecord before = std::exchange(shown_, std::move(news.record));
            for (std::size_t i = 0; i <= news.part && i < parts.size(); ++i)
                for (const std::string& cell : parts[i].cells) before.outputs.erase(cell);
            if (failed || news.part + 1 < parts.size()) {
                add_older(shown_.values, before.values);
                add_older(shown_.tables, before.tables);
                add_older(shown_.texts, before.texts);
                add_older(shown_.figures, before.figures);
                add_older(shown_.outputs, before.outputs);
                add_older(shown_.sliders, before.sliders);
            }
        }
        page_is_old_ = true;
        if (page_is_from_cache_) watch_inputs();  // else set_page does
    }
    if (news.kind == "ended") {
        page_is_from_cache_ = false;
        page_is_old_ = page_is_old_ || page_is_unfinished_;
        if (!shown_.error) settle_sliders();
    }
    show_states();
}

/// Choices are those of the script as it is now: for sliders that it has, within their ranges.
void LiveDocument::settle_sliders() {
    std::map<std::string, double> settled;
    {
        const std::lock_guard lock(orders_mutex_);
        for (const auto& [name, value] : sliders_)
            if (const auto slider = shown_.sliders.find(name); slider != shown_.sliders.end())
                settled[name] = std::clamp(value, slider->second.from, slider->second.to);
        if (settled == sliders_) return;
        sliders_ = settled;
    }
    request_->slider_values = settled;
    notify_reading_(settled);
}

void LiveDocument::show_states() {
    std::map<std::string, CellState> known;
    for (const ScriptPart& part : runner_.parts())
        for (const std::string& cell : part.cells)
            if (const auto state = states_.find(cell); state != states_.end()) known.insert(*state);
    states_ = known;
    if (page_is_from_cache_)
        page_.set_running(runner_.running());
    else
        page_.set_states(std::move(known), runner_.running());
    notify_();
}

/// What the document is made of is watched; what is not there yet may come.
void LiveDocument::watch_inputs() {
    std::set<fs::path> inputs = {place_of(request_->script.file), place_of(request_->template_file)};
    data_.clear();
    for (const fs::path& file : shown_.files_read) data_.insert(place_of(file));
    inputs.insert(data_.begin(), data_.end());
    const fs::path folder = request_->script.file.parent_path();
    for (const char* name : {"group.toml", "checks.lua"}) inputs.insert(place_of(folder / name));  // `check` reads them
    if (const fs::path literature = bibliography_of(request_->script); !literature.empty())
        inputs.insert(place_of(literature));
    for (const auto& [file, digest] : pictures_) inputs.insert(file);
    for (const fs::path& file : inputs) watch_.add_around(file);
    inputs_ = std::move(inputs);
}

void LiveDocument::set_page() {
    page_is_old_ = false;
    save_at_.reset();
    if (!request_) return;
    try {
        page_is_unfinished_ =
            runner_.running() || shown_.error.has_value() || runner_.parts().empty() || !runner_.finished();
        const SetDocument document = setter_.set(document_source(*request_, shown_), page_is_unfinished_);
        page_.show(document, request_->script, shown_);
        pictures_.clear();
        for (const SetChunk& chunk : document.chunks)
            for (const SetPicture& picture : chunk.pictures)
                if (!picture.is_figure && !picture.file.empty())
                    pictures_[place_of(picture.file)] = digest_of_picture(picture.file);
        watch_inputs();
        if (!page_is_unfinished_) {
            page_.set_open_answers(missing_answers(request_->script, shown_));
            if (request_->slider_values.empty()) save_at_ = Clock::now() + kKeepAfter;
        }
    } catch (const DocumentError& error) {
        page_.complain({error.message()});
    }
    notify_();
}

/// Shows the whole page at once, where it was whole before.
bool LiveDocument::load_saved_page() {
    std::optional<PageContent> known = memory_.load_entry(*request_);
    if (!known) return false;
    for (auto& [cell, state] : known->states) state.state = "recalled";
    page_.show(*std::move(known));
    page_is_from_cache_ = true;
    notify_();
    return true;
}

/// Keeps the page for the next time, unless something has changed since it was set.
void LiveDocument::save_page() {
    if (!std::exchange(save_at_, std::nullopt)) return;
    for (const fs::path& file : watch_.changes()) {
        if (!is_ours(file)) continue;
        changed_.insert(file);
        last_change_ = Clock::now();
    }
    if (!changed_.empty()) return;
    std::vector<fs::path> files = shown_.files_read;
    for (const auto& [picture, digest] : pictures_) files.push_back(picture);
    memory_.save_entry(*request_, files, page_.content());
}

}  // namespace dynlab::inline app
