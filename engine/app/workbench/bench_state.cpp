#include "app/workbench/bench_state.h"

#include <fmt/format.h>

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
#include "platform/error.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/prompt_statement.h"

namespace dynlab::inline app {
namespace {

constexpr const char* kViewsOfData[] = {"record", "spectrum", "advice"};
constexpr std::size_t kMaxPrinted = 4000;  // bytes of a cell that are shown

std::string printed_by(const RunRecord& record, const std::string& cell) {
    const auto outputs = record.outputs.find(cell);
    std::string text;
    if (outputs == record.outputs.end()) return text;
    for (const CellOutput& output : outputs->second) text += output.printed;
    if (text.size() > kMaxPrinted) text.resize(kMaxPrinted);
    return text;
}

/// Adds a member to the JSON of an object, without reading that of its value, which may be long.
void add_member(std::string& object, const std::string& name, const std::string& value) {
    object.pop_back();
    if (object != "{") object += ',';
    object += ::nlohmann::json(name).dump() + ':' + value + '}';
}

}  // namespace

BenchState::BenchState(std::filesystem::path file, PartRunner& runner, std::vector<std::string> past)
    : runner_(runner), text_(std::move(file), std::move(past)) {
    looked_at_.settings = "{}";
}

std::optional<std::size_t> BenchState::change(const ScriptOrder& order) {
    if (!text_.obey(order)) return {};
    changed_ = true;
    return text_.revision();
}

void BenchState::put(const std::function<std::string(const std::string&)>& make) {
    text_.take_from_file();
    text_.put(make(text_.text()));
    changed_ = true;
}

void BenchState::undo() {
    text_.undo();
    changed_ = true;
}

void BenchState::redo() {
    text_.redo();
    changed_ = true;
}

std::size_t BenchState::look(const ViewOrder& order) {
    view_cells(order);  // refuses what it cannot write
    looked_at_ = order;
    old_ = true;
    return ++looks_;
}

void BenchState::again() {
    lines_to_run_.reset();
    stopped_ = false;
    old_ = true;
    seen_.clear();
}

void BenchState::allow_runs() {
    may_run_ = old_ = true;
}

void BenchState::run_was_stopped(const std::string& cell) {
    stopped_ = changed_ = true;
    const std::vector<ScriptPart>& parts = runner_.parts();
    const auto stopped = std::ranges::find_if(parts, [&](const ScriptPart& part) {
        return cell.empty() ? states_[part.cells.front()].state != "done"
                            : std::ranges::find(part.cells, cell) != part.cells.end();
    });
    if (stopped != parts.end()) leave_out(static_cast<std::size_t>(stopped - parts.begin()));
    for (auto& [id, state] : states_)
        if (state.state != "done") state = {"waiting", 0, 0};
}

void BenchState::read_changed_file() {
    changed_ = true;
    unread_ = Message();
    try {
        text_.read_changed_file();
    } catch (const std::exception& error) {
        unread_ = message_of(error);
    }
}

void BenchState::data_changed(const std::filesystem::path& file) {
    changed_data_.insert(file);
    old_ = true;
}

/// Returns only the views whose text or settings differ from those when they were made; nothing if all are current.
/// Advice takes longer than all other views, and panning a data set needs only its plot.
std::optional<ViewOrder> BenchState::stale_views() {
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

void BenchState::run() {
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
        const std::size_t first = runner_.run(script, changed_data_);
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
void BenchState::clear_other_cells() {
    std::set<std::string> there = {kViewCell, kSlowViewCell};
    for (const Cell& cell : parse_percent_script(text_.text(), text_.file()).cells) there.insert(cell.id);
    const auto is_gone = [&](const auto& entry) { return !there.contains(entry.first); };
    std::erase_if(states_, is_gone);
    std::erase_if(printed_, is_gone);
}

/// Whether the script ends in the middle of a statement, which whatever is appended would be taken to end.
bool BenchState::ends_early(const std::string& text) const {
    const std::vector<ScriptPart> parts = script_parts(parse_percent_script(text, text_.file()));
    return !parts.empty() && read_script_part(parts.back().code, {}).kind == PromptStatement::Kind::kIncomplete;
}

std::optional<Message> BenchState::mistake() const {
    return error_ ? std::optional(with_place(*error_)) : std::nullopt;
}

Reader BenchState::reader() const {
    return {catalog_of(language()), &option_name};
}

/// From now on only the lines before this part are run and shown, until the script changes.
void BenchState::leave_out(std::size_t part) {
    const auto before = static_cast<std::size_t>(runner_.parts()[part].first_line - 1);
    if (before > lines_of(text_.text()).size()) return;  // a view
    lines_to_run_ = before;
    old_ = true;
}

std::string BenchState::text_to_run() const {
    if (!lines_to_run_) return text_.text();
    const std::vector<std::string> lines = lines_of(text_.text());
    std::string text;
    for (std::size_t i = 0; i < *lines_to_run_ && i < lines.size(); ++i) text += lines[i] + "\n";
    return text;
}

void BenchState::take(RunnerNews news) {
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

void BenchState::take_record(const RunnerNews& news) {
    for (std::size_t i = 0; i <= news.part && i < runner_.parts().size(); ++i)
        for (const std::string& cell : runner_.parts()[i].cells)
            if (cell != kViewCell && cell != kSlowViewCell) printed_[cell] = printed_by(news.record, cell);
}

std::string BenchState::language() const {
    try {
        return parse_percent_script(text_.text(), text_.file()).header.language;
    } catch (const DocumentError&) {
        return "en";  // no script yet
    }
}

std::string BenchState::json(bool all) const {
    const std::string page_language = language();
    const Reader reader = this->reader();
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
    if (all) page["file"] = std::filesystem::absolute(text_.file()).string();
    if (all || sent_revision_ != text_.revision()) {
        page["source"] = text_.text();
        ::nlohmann::json& cells = page["cells"] = ::nlohmann::json::array();
        try {
            const PercentScript script = parse_percent_script(text_.text(), text_.file());
            for (const Cell& cell : script.cells)
                cells.push_back({{"id", cell.id}, {"line", cell.first_line}, {"code", cell.kind == Cell::Kind::kCode}});
        } catch (const DocumentError&) {  // reported as the run's mistake
        }
    }
    page["printed"] = printed_;
    std::string text = page.dump(-1, ' ', false, ::nlohmann::json::error_handler_t::replace);
    std::string views = "{}";
    for (const auto& [name, view] : views_)
        if (all || view.fresh) add_member(views, name, view.json);
    add_member(text, "views", views);
    if (all || sent_language_ != page_language) add_member(text, "forms", json_of(estimator_forms(reader)));
    if (all || sent_revision_ != text_.revision()) add_member(text, "steps", json_of(session_steps(text_.text())));
    return text;
}

std::optional<std::string> BenchState::changes() {
    if (!changed_ && sent_revision_ == text_.revision()) return {};
    std::string text = json(false);
    changed_ = false;
    sent_revision_ = text_.revision();
    sent_language_ = language();
    for (auto& [name, view] : views_) view.fresh = false;
    return text;
}

}  // namespace dynlab::inline app
