#include "app/live/live_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "data_io/values/json_values.h"
#include "data_io/values/message_values.h"
#include "documents/html/web_page.h"
#include "documents/record_description.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/hash.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Pictures that no version since so many has shown are forgotten: tabs may still ask for those of the one before.
constexpr std::uint64_t kVersionsKept = 3;

/// In the order in which the script asks for them.
json sliders_json(const std::map<std::string, RecordedSlider>& sliders) {
    json list = json::array();
    for (const auto& [name, slider] : sliders) {
        list.push_back(json::parse(json_of(slider)));
        list.back()["name"] = name;
    }
    std::sort(list.begin(), list.end(), [](const json& a, const json& b) { return a["order"] < b["order"]; });
    return list;
}

/// Findings of `dynlab check --json` for a reader. What was looked at stays as it is: the page reads points in it.
void put_into_language(json& checked, const LessonReader& reader) {
    if (!checked.is_object() || !checked.contains("findings")) return;
    for (json& issue : checked["findings"])
        for (const std::string part : {"what", "remedy"})
            if (const std::string message = part + "_message"; issue.is_object() && issue.contains(message))
                issue[part] = reader.text(value_of_json<Message>(issue[message]));
}

}  // namespace

std::string LivePage::keep_picture(const fs::path& file) {
    std::string bytes;
    try {
        bytes = read_text(file);
    } catch (const std::exception&) {
        return "missing";  // it is being written again; the version after this has it
    }
    const std::string name = digest_of(bytes).hex() + file.extension().string();
    content_.pictures[name] = {media_type(ending_of(file)), std::move(bytes), version_};
    return name;
}

std::string LivePage::with_pictures(const SetChunk& chunk, const RunRecord& record) {
    std::string html = chunk.html;
    for (const SetPicture& picture : chunk.pictures) {
        fs::path file = picture.file;
        std::string plot;
        if (picture.is_figure) {
            const auto figure = record.figures.find(picture.name);
            file = figure == record.figures.end() ? fs::path() : figure->second.file;
            if (figure != record.figures.end()) plot = plot_element(figure->second.plot);
        }
        const std::string sign = "\"" + picture.written_name + "\"", address = "\"picture/" + keep_picture(file) + "\"";
        for (std::size_t at = html.find(sign); at != std::string::npos; at = html.find(sign, at + address.size())) {
            html.insert(html.find('>', at) + 1, plot);
            html.replace(at, sign.size(), address);
        }
    }
    return html;
}

void LivePage::show(const SetDocument& document, const PercentScript& script, const RunRecord& record) {
    const std::lock_guard lock(mutex_);
    ++version_;
    changed_ = text_changed_ = true;
    from_cache_ = false;
    content_.name = script.file.filename().string();
    content_.head = document.head;
    content_.notes = document.notes;
    content_.complaints = document.complaints;
    content_.sliders = record.sliders;
    error_ = record.error;
    content_.pieces.clear();
    fresh_.clear();
    std::map<std::string, std::string> html;
    std::map<std::string, int> copies;
    for (const SetChunk& chunk : document.chunks) {
        std::string content = with_pictures(chunk, record);
        if (content.empty()) continue;
        const std::string digest = digest_of(content).hex();
        const std::string id = fmt::format("p{}-{}", digest.substr(0, 16), copies[digest]++);
        const bool in_script = chunk.chunk.origin.file == script.file;
        const Cell* const cell = in_script ? script.cell_at_line(chunk.chunk.origin.line) : nullptr;
        const bool is_code = cell && cell->kind == Cell::Kind::kCode;
        content_.pieces.push_back(
            {id, is_code ? cell->id : "", chunk.chunk.origin.file.filename().string(), chunk.chunk.origin.line});
        if (!content_.html.contains(id)) fresh_.push_back(id);
        html[id] = std::move(content);
    }
    add_unseen_cells(script, html);
    content_.html = std::move(html);
    std::erase_if(content_.pictures,
                  [&](const auto& entry) { return entry.second.version + kVersionsKept < version_; });
}

/// Gives code that is not shown and printed nothing an empty piece, so that a reader can go to it. Applies to documents
/// that show their script.
void LivePage::add_unseen_cells(const PercentScript& script, std::map<std::string, std::string>& html) {
    std::vector<PagePiece>& pieces = content_.pieces;
    const std::string name = script.file.filename().string();
    const auto in_script = [&](const PagePiece& piece) { return piece.file == name; };
    if (std::none_of(pieces.begin(), pieces.end(), in_script)) return;
    for (const Cell& cell : script.cells) {
        if (cell.kind != Cell::Kind::kCode) continue;
        if (std::any_of(pieces.begin(), pieces.end(), [&](const PagePiece& piece) { return piece.cell == cell.id; }))
            continue;
        const auto before = [&](const PagePiece& piece) { return in_script(piece) && piece.line <= cell.first_line; };
        const auto last = std::find_if(pieces.rbegin(), pieces.rend(), before);
        const auto place = last != pieces.rend() ? last.base() : std::find_if(pieces.begin(), pieces.end(), in_script);
        const std::string id = fmt::format("unseen-{}", cell.id);
        if (!content_.html.contains(id)) fresh_.push_back(id);
        html[id] = "";
        pieces.insert(place, {id, cell.id, name, cell.first_line});
    }
}

void LivePage::show(PageContent saved_entry) {
    const std::lock_guard lock(mutex_);
    ++version_;
    changed_ = text_changed_ = from_cache_ = true;
    error_.reset();
    fresh_.clear();
    for (const auto& [id, html] : saved_entry.html) fresh_.push_back(id);
    for (auto& [name, picture] : saved_entry.pictures) picture.version = version_;
    content_ = std::move(saved_entry);
}

PageContent LivePage::content() const {
    const std::lock_guard lock(mutex_);
    PageContent content = content_;
    std::erase_if(content.pictures, [&](const auto& entry) { return entry.second.version != version_; });
    return content;
}

void LivePage::complain(const std::vector<Message>& sentences) {
    const std::lock_guard lock(mutex_);
    if (content_.complaints == sentences) return;
    content_.complaints = sentences;
    changed_ = true;
}

void LivePage::speak(const std::string& language, const std::string& lesson) {
    const std::lock_guard lock(mutex_);
    if (language_ == language && lesson_ == lesson) return;
    changed_ = issues_changed_ = true;
    language_ = language;
    lesson_ = lesson;
    reader_.reset();
}

const LessonReader& LivePage::reader() const {
    if (!reader_) reader_.emplace(language_, lesson_);
    return *reader_;
}

std::string LivePage::translated(const Message& message) const {
    const std::lock_guard lock(mutex_);
    return reader().text(message);
}

void LivePage::set_states(std::map<std::string, CellState> states, bool running) {
    const std::lock_guard lock(mutex_);
    content_.states = std::move(states);
    running_ = running;
    changed_ = true;
}

void LivePage::set_running(bool running) {
    const std::lock_guard lock(mutex_);
    changed_ = changed_ || running_ != running;
    running_ = running;
}

void LivePage::ask_whether_to_run(bool asking) {
    const std::lock_guard lock(mutex_);
    asking_ = asking;
    changed_ = true;
}

void LivePage::set_made_here(bool made_here) {
    const std::lock_guard lock(mutex_);
    made_here_ = made_here;
}

void LivePage::set_open_answers(std::string answers) {
    const std::lock_guard lock(mutex_);
    changed_ = changed_ || content_.open_answers != answers;
    content_.open_answers = std::move(answers);
}

void LivePage::set_sources(std::map<std::string, std::string> digests) {
    const std::lock_guard lock(mutex_);
    changed_ = changed_ || sources_ != digests;
    sources_ = std::move(digests);
}

void LivePage::set_can_submit(bool can_submit) {
    const std::lock_guard lock(mutex_);
    changed_ = changed_ || can_submit_ != can_submit;
    can_submit_ = can_submit;
}

void LivePage::set_work(std::string findings, bool pdf_is_ready, std::optional<double> checking) {
    const std::lock_guard lock(mutex_);
    changed_ = changed_ || issues_ != findings || pdf_is_ready_ != pdf_is_ready || checking_ != checking;
    checking_ = checking;
    issues_changed_ = issues_changed_ || issues_ != findings;
    issues_ = std::move(findings);
    pdf_is_ready_ = pdf_is_ready;
}

std::string LivePage::json(bool all) const {
    ::nlohmann::json page = {{"version", version_},
                             {"all", all},
                             {"running", running_},
                             {"recalled", from_cache_},
                             {"asking", asking_},
                             {"language", language_},
                             {"name", content_.name},
                             {"complaints", ::nlohmann::json::array()},
                             {"open_answers", content_.open_answers},
                             {"sources", sources_},
                             {"pdf_is_ready", pdf_is_ready_},
                             {"hands_in", can_submit_},
                             {"made_here", made_here_},
                             {"states", ::nlohmann::json::object()}};
    if (checking_) page["checking"] = *checking_;
    for (const Message& complaint : content_.complaints)
        for (const std::string& line : lines_of(reader().text(complaint))) page["complaints"].push_back(line);
    if (error_)
        page["error"] = {{"file", error_->file}, {"line", error_->line}, {"text", reader().text(error_->message)}};
    for (const auto& [cell, state] : content_.states)
        page["states"][cell] = {{"state", state.state}, {"seconds", state.seconds}, {"progress", state.progress}};
    if (all || issues_changed_) {
        ::nlohmann::json& findings = page["findings"];
        if (::nlohmann::json::accept(issues_)) findings = ::nlohmann::json::parse(issues_);
        put_into_language(findings, reader());
    }
    if (all || text_changed_) {
        ::nlohmann::json& pieces = page["pieces"] = ::nlohmann::json::array();
        for (const PagePiece& piece : content_.pieces) pieces.push_back({piece.id, piece.cell, piece.file, piece.line});
        page["sliders"] = sliders_json(content_.sliders);
        page["head"] = content_.head;
        page["notes"] = content_.notes;
        ::nlohmann::json& html = page["html"] = ::nlohmann::json::object();
        for (const auto& [id, content] : content_.html)
            if (all || std::find(fresh_.begin(), fresh_.end(), id) != fresh_.end()) html[id] = content;
    }
    return page.dump(-1, ' ', false, ::nlohmann::json::error_handler_t::replace);
}

bool LivePage::settled() const {
    const std::lock_guard lock(mutex_);
    const auto any = [this](const char* state) {
        return std::any_of(content_.states.begin(), content_.states.end(),
                           [&](const auto& cell) { return cell.second.state == state; });
    };
    return !running_ && !from_cache_ && (any("failed") || !any("waiting"));
}

std::string LivePage::whole() const {
    const std::lock_guard lock(mutex_);
    return json(true);
}

std::optional<std::string> LivePage::changes() {
    const std::lock_guard lock(mutex_);
    if (!changed_) return {};
    std::string text = json(false);
    changed_ = text_changed_ = issues_changed_ = false;
    fresh_.clear();
    return text;
}

std::optional<std::pair<std::string, std::string>> LivePage::picture(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto found = content_.pictures.find(name);
    if (found == content_.pictures.end()) return {};
    return std::pair{found->second.type, found->second.bytes};
}

}  // namespace dynlab::inline app
