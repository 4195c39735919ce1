#include "app/workbench/workbench_session.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/workbench/estimator_forms.h"
#include "base/error.h"
#include "base/languages.h"
#include "base/reader.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "data_io/values/json_values.h"
#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/prompt_statement.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kViewsOfData[] = {"record", "spectrum", "advice"};
constexpr std::size_t kMaxPrinted = 4000;  // bytes of a cell that are shown
constexpr int kLookForInterrupt = 1000;    // ms

std::string printed_by(const RunRecord& record, const std::string& cell) {
    const auto outputs = record.outputs.find(cell);
    std::string text;
    if (outputs == record.outputs.end()) return text;
    for (const CellOutput& output : outputs->second) text += output.printed;
    if (text.size() > kMaxPrinted) text.resize(kMaxPrinted);
    return text;
}

Reader reader_of_session(const std::string& language) {
    return {catalog_of(language), &option_name};
}

}  // namespace

WorkbenchSession::WorkbenchSession(fs::path file, ScriptRunner& runner)
    : runner_(runner), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), text_(std::move(file)) {
    looked_at_.settings = "{}";
    const fs::path folder = text_.file().parent_path();
    watch_.add(folder.empty() ? "." : folder);
}

void WorkbenchSession::wake() {
    const std::uint64_t one = 1;
    write_all(wake_.get(), reinterpret_cast<const char*>(&one), sizeof one);
}

std::optional<std::size_t> WorkbenchSession::change(const ScriptOrder& order) {
    const std::lock_guard lock(mutex_);
    if (!text_.obey(order)) {
        wake();  // the page hears of another program's text
        return {};
    }
    order.unsaved ? wake() : text_is_ours();
    return text_.revision();
}

void WorkbenchSession::put(const std::function<std::string(const std::string&)>& make) {
    const std::lock_guard lock(mutex_);
    text_.take_from_file();
    text_.put(make(text_.text()));
    text_is_ours();
}

void WorkbenchSession::undo() {
    const std::lock_guard lock(mutex_);
    text_.undo();
    text_is_ours();
}

void WorkbenchSession::redo() {
    const std::lock_guard lock(mutex_);
    text_.redo();
    text_is_ours();
}

/// Notes that the text comes from the user of the page, or that the reason why it is not on disk has changed.
void WorkbenchSession::text_is_ours() {
    changed_ = true;
    if (may_run_) notify_saving_(text_.text());
    wake();
}

std::size_t WorkbenchSession::look(const ViewOrder& order) {
    view_cells(order);  // refuses what it cannot write
    const std::lock_guard lock(mutex_);
    looked_at_ = order;
    old_ = true;
    wake();
    return ++looks_;
}

void WorkbenchSession::stop() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    wake();
}

void WorkbenchSession::again() {
    const std::lock_guard lock(mutex_);
    lines_to_run_.reset();
    stopped_ = false;
    old_ = true;
    seen_.clear();
    wake();
}

void WorkbenchSession::allow_runs() {
    const std::lock_guard lock(mutex_);
    may_run_ = old_ = true;
    wake();
}

std::string WorkbenchSession::saved(const std::string& name) const {
    return read_file(figures_.path() / fs::path(name).filename());
}

void WorkbenchSession::end() {
    end_ = true;
    wake();
}

std::string WorkbenchSession::script() const {
    const std::lock_guard lock(mutex_);
    return text_.text();
}

fs::path WorkbenchSession::file() const {
    const std::lock_guard lock(mutex_);
    return text_.file();
}

void WorkbenchSession::work() {
    try {
        follow();
    } catch (...) {
        save_rest();
        throw;
    }
    save_rest();
}

/// The file of a slider that was held to the last.
void WorkbenchSession::save_rest() {
    const std::lock_guard lock(mutex_);
    if (text_.save() && may_run_) notify_saving_(text_.text());
    if (!text_.unsaved().empty()) throw EnvironmentError("the last changes are lost: {}", text_.unsaved());
}

void WorkbenchSession::take_file_changes() {
    const std::lock_guard lock(mutex_);
    for (const fs::path& file : watch_.changes()) {
        if (file.filename() == text_.file().filename()) {
            changed_ = true;
            unread_ = Message();
            try {
                text_.read_changed_file();
            } catch (const std::exception& error) {
                unread_ = message_of(error);
            }
            continue;
        }
        for (const fs::path& data : data_) {
            if (!concerns(place_of(file), data)) continue;
            changed_data_.insert(data);
            watch_.add_around(data);
            old_ = true;
        }
    }
}

void WorkbenchSession::follow() {
    while (!end_) {
        take_orders();
        pollfd waiting[3] = {
            {watch_.descriptor(), POLLIN, 0}, {wake_.get(), POLLIN, 0}, {runner_.descriptor(), POLLIN, 0}};
        ::poll(waiting, 3, kLookForInterrupt);
        throw_if_interrupted();
        if (waiting[0].revents != 0) take_file_changes();
        while (runner_.running()) {
            pollfd news{runner_.descriptor(), POLLIN, 0};
            if (::poll(&news, 1, 0) <= 0) break;
            take(runner_.next());
        }
    }
}

void WorkbenchSession::take_orders() {
    std::uint64_t count = 0;
    while (::read(wake_.get(), &count, sizeof count) > 0) {
    }
    bool must_run = false;
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(stop_, false) && runner_.running()) {
            runner_.stop();
            stopped_ = changed_ = true;
            for (std::size_t i = 0; i < runner_.parts().size(); ++i)
                if (states_[runner_.parts()[i].cells.front()].state != "done") {
                    leave_out(i);
                    break;
                }
            for (auto& [cell, state] : states_)
                if (state.state != "done") state = {"waiting", 0, 0};
        }
        must_run = may_run_ && (old_ || run_revision_ != text_.revision());
    }
    if (must_run) run();
    notify_();
}

/// Returns only the views whose text or settings differ from those when they were made; nothing if all are current.
/// Advice takes longer than all other views, and panning a data set needs only its plot.
std::optional<ViewOrder> WorkbenchSession::stale_views() {
    ViewOrder order = looked_at_;
    ::nlohmann::json settings = ::nlohmann::json::parse(order.settings), common = settings;
    for (const char* name : {"views", "sizes", "range", "save", "first"}) common.erase(name);
    const std::vector<std::string> lines = lines_of(text_.text());
    const std::size_t until = std::min(lines.size(), static_cast<std::size_t>(std::max(0, order.data_until)));
    const std::string of_data =
        fmt::format("{}", fmt::join(lines.begin(), lines.begin() + static_cast<long>(until), "\n"));
    under_way_.clear();
    const auto part = [](const ::nlohmann::json& from, const std::string& name) {
        return from.is_object() && from.contains(name) ? from[name].dump() : "";
    };
    const auto is_stale = [&](const std::string& view) {
        std::string& key = under_way_[view];
        key = is_one_of(view, kViewsOfData) ? of_data + part(settings, "raw") + part(settings, "prepared")
                                            : text_.text() + common.dump();
        if (settings.contains("sizes")) key += part(settings["sizes"], view);
        if (view == "record") key += part(settings, "range");
        const auto seen = seen_.find(view);
        return !changed_data_.empty() || seen == seen_.end() || seen->second != key;
    };
    ::nlohmann::json views = ::nlohmann::json::array();
    for (const auto& view : settings.value("views", ::nlohmann::json::array()))
        if (view.is_string() && is_stale(view)) views.push_back(view);
    settings["views"] = views;
    order.settings = settings.dump();
    return views.empty() && !settings.contains("save") ? std::nullopt : std::optional(order);
}

void WorkbenchSession::run() {
    const std::lock_guard lock(mutex_);
    old_ = false;
    changed_ = changed_ || run_looks_ != looks_;
    run_looks_ = looks_;
    const bool other = run_revision_ != text_.revision() || !changed_data_.empty();
    if (other) {
        lines_to_run_.reset();
        error_.reset();
        stopped_ = false;
    }
    const std::optional<ViewOrder> views = stale_views();
    if (!views && !other) return;
    run_revision_ = text_.revision();
    changed_ = true;
    try {
        const std::string text = text_to_run(), cells = views && !ends_early(text) ? view_cells(*views) : "";
        const PercentScript script = parse_percent_script(text + cells, text_.file());
        const std::size_t first = runner_.run(report_of_script(script, "session.html"), figures_.path(), changed_data_);
        changed_data_.clear();
        clear_other_cells();
        for (std::size_t i = first; i < runner_.parts().size(); ++i)
            for (const std::string& cell : runner_.parts()[i].cells) states_[cell] = {"waiting", 0, 0};
    } catch (const DocumentError& error) {
        if (!lines_to_run_) error_ = RecordedError{message_of(error)};  // else its beginning alone is no script
    } catch (const EnvironmentError& error) {
        error_ = RecordedError{message_of(error)};
    }
}

/// Removes messages about cells that the script no longer has.
void WorkbenchSession::clear_other_cells() {
    std::set<std::string> there = {kViewCell, kSlowViewCell};
    for (const Cell& cell : parse_percent_script(text_.text(), text_.file()).cells) there.insert(cell.id);
    const auto is_gone = [&](const auto& entry) { return !there.contains(entry.first); };
    std::erase_if(states_, is_gone);
    std::erase_if(printed_, is_gone);
}

/// Whether the script ends in the middle of a statement, which whatever is appended would be taken to end.
bool WorkbenchSession::ends_early(const std::string& text) const {
    const std::vector<ScriptPart> parts = script_parts(parse_percent_script(text, text_.file()));
    return !parts.empty() && read_script_part(parts.back().code, {}).kind == PromptStatement::Kind::kIncomplete;
}

std::optional<Message> WorkbenchSession::mistake() const {
    const std::lock_guard lock(mutex_);
    return error_ ? std::optional(with_place(*error_)) : std::nullopt;
}

std::string WorkbenchSession::translated(const Message& message) const {
    const std::lock_guard lock(mutex_);
    return message_text(message, reader_of_session(language()));
}

/// From now on only the lines before this part are run and shown, until the script changes.
void WorkbenchSession::leave_out(std::size_t part) {
    const auto before = static_cast<std::size_t>(runner_.parts()[part].first_line - 1);
    if (before > lines_of(text_.text()).size()) return;  // a view
    lines_to_run_ = before;
    old_ = true;
}

std::string WorkbenchSession::text_to_run() const {
    if (!lines_to_run_) return text_.text();
    const std::vector<std::string> lines = lines_of(text_.text());
    std::string text;
    for (std::size_t i = 0; i < *lines_to_run_ && i < lines.size(); ++i) text += lines[i] + "\n";
    return text;
}

void WorkbenchSession::take(RunnerNews news) {
    const std::lock_guard lock(mutex_);
    const std::vector<ScriptPart>& parts = runner_.parts();
    changed_ = true;
    const auto set_state = [&](const CellState& state) {
        if (news.part >= parts.size()) return;
        for (const std::string& cell : parts[news.part].cells) states_[cell] = state;
    };
    for (auto& [name, value] : news.shown)
        if (View& view = views_[name]; view.json != value) view = {std::move(value), true};
    if (news.kind == "begun" || news.kind == "progress") {
        set_state({"running", 0, news.progress});
    } else if (news.kind == "done" || (news.kind == "ended" && news.record.error)) {
        set_state({news.record.error ? "failed" : "done", news.seconds, 0});
        take_record(news);
        const bool whole = news.part + 1 == parts.size() && !news.record.error && !lines_to_run_;
        if (whole)
            for (const auto& [view, made_from] : under_way_) seen_[view] = made_from;
        if (!news.record.error || lines_to_run_) return;
        error_ = news.record.error;
        if (run_revision_ == text_.revision()) leave_out(news.part);
    }
}

void WorkbenchSession::take_record(const RunnerNews& news) {
    for (std::size_t i = 0; i <= news.part && i < runner_.parts().size(); ++i)
        for (const std::string& cell : runner_.parts()[i].cells)
            if (cell != kViewCell && cell != kSlowViewCell) printed_[cell] = printed_by(news.record, cell);
    for (const fs::path& file : news.record.files_read) {
        const fs::path place = place_of(file);
        data_.insert(place);
        watch_.add_around(place);
    }
}

std::string WorkbenchSession::language() const {
    try {
        return parse_percent_script(text_.text(), text_.file()).header.language;
    } catch (const DocumentError&) {
        return "en";  // no script yet
    }
}

std::string WorkbenchSession::json(bool all) const {
    const std::string page_language = language();
    const Reader reader = reader_of_session(page_language);
    ::nlohmann::json page = {{"all", all},
                             {"revision", text_.revision()},
                             {"shown", run_revision_},
                             {"looked", run_looks_},
                             {"running", runner_.running()},
                             {"asking", !may_run_},
                             {"stopped", stopped_},
                             {"undo", text_.can_undo()},
                             {"redo", text_.can_redo()},
                             {"unsaved", message_text(text_.unsaved(), reader)},
                             {"states", ::nlohmann::json::object()}};
    for (const auto& [cell, state] : states_)
        page["states"][cell] = {{"state", state.state}, {"seconds", state.seconds}, {"progress", state.progress}};
    if (!unread_.empty())
        page["error"] = {{"message", message_text(unread_, reader)}, {"line", 0}};
    else if (error_)
        page["error"] = {{"message", message_text(with_place(*error_), reader)},
                         {"text", message_text(error_->message, reader)},
                         {"place", fmt::format("{}:{}", error_->file, error_->line)},
                         {"line", error_->line_in(text_.file().filename().string())}};
    if (all) page["file"] = fs::absolute(text_.file()).string();
    if (all || sent_language_ != page_language)
        page["forms"] = ::nlohmann::json::parse(json_of(estimator_forms(reader)));
    if (all || sent_revision_ != text_.revision()) {
        page["source"] = text_.text();
        page["steps"] = ::nlohmann::json::parse(json_of(session_steps(text_.text())));
        ::nlohmann::json& cells = page["cells"] = ::nlohmann::json::array();
        try {
            const PercentScript script = parse_percent_script(text_.text(), text_.file());
            for (const Cell& cell : script.cells)
                cells.push_back({{"id", cell.id}, {"line", cell.first_line}, {"code", cell.kind == Cell::Kind::kCode}});
        } catch (const DocumentError&) {  // reported as the run's mistake
        }
    }
    page["printed"] = printed_;
    ::nlohmann::json& views = page["views"] = ::nlohmann::json::object();
    for (const auto& [name, view] : views_)
        if (all || view.fresh) views[name] = ::nlohmann::json::parse(view.json);
    return page.dump(-1, ' ', false, ::nlohmann::json::error_handler_t::replace);
}

std::string WorkbenchSession::whole() const {
    const std::lock_guard lock(mutex_);
    return json(true);
}

std::optional<std::string> WorkbenchSession::changes() {
    const std::lock_guard lock(mutex_);
    if (!changed_ && sent_revision_ == text_.revision()) return {};
    std::string text = json(false);
    changed_ = false;
    sent_revision_ = text_.revision();
    sent_language_ = language();
    for (auto& [name, view] : views_) view.fresh = false;
    return text;
}

}  // namespace dynlab::inline app
