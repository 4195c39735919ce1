#include "scripting/runtime/recorder.h"

#include <algorithm>

namespace dynlab::inline scripting {

void Recorder::start(const PercentScript& script, std::uint32_t seed, LineSource current_line,
                     CellListener enter_cell) {
    *this = Recorder();
    record_.script = script.file.filename().string();
    record_.seed = seed;
    current_line_ = std::move(current_line);
    enter_cell_ = std::move(enter_cell);
    follow(script);
    timed_cell_ = cells_.front().second;
    timed_since_ = std::chrono::steady_clock::now();
    report_cell();
}

void Recorder::follow(const PercentScript& script) {
    expected_ = script.header.answers;
    cells_.clear();
    for (const Cell& cell : script.cells)
        if (cell.kind == Cell::Kind::kCode) cells_.emplace_back(cell.first_line, cell.id);
    if (cells_.empty()) cells_.emplace_back(1, "cell-1");
    timed_since_ = std::chrono::steady_clock::now();
}

RunRecord Recorder::so_far(const Reader& reader) const {
    return Recorder(*this).finish(reader);
}

void Recorder::report_cell() const {
    if (enter_cell_) enter_cell_(timed_cell_);
}

std::string Recorder::current_cell() {
    const int line = current_line_ ? current_line_() : 0;
    if (line <= 0) return timed_cell_;
    auto after = std::ranges::upper_bound(cells_, line, {}, &std::pair<int, std::string>::first);
    return after == cells_.begin() ? cells_.front().second : std::prev(after)->second;
}

void Recorder::note_time() {
    const auto now = std::chrono::steady_clock::now();
    std::string cell = current_cell();
    if (cell == timed_cell_) return;
    record_.timings[timed_cell_] += std::chrono::duration<double>(now - timed_since_).count();
    timed_cell_ = std::move(cell);
    timed_since_ = now;
    report_cell();
}

void Recorder::print(const std::string& text) {
    note_time();
    printed_bytes_ += text.size();
    auto& pieces = pieces_[timed_cell_];
    if (pieces.empty() || pieces.back().figure) pieces.emplace_back();
    pieces.back().printed += text;
}

bool Recorder::ends_in_block() {
    note_time();
    const auto& pieces = pieces_[timed_cell_];
    return !pieces.empty() && !pieces.back().figure && block_end_ == std::pair(timed_cell_, printed_bytes_);
}

void Recorder::add_figure(const FigurePointer& figure) {
    note_time();
    figure->order = ++figures_made_;
    if (next_number_) {
        figure->number = next_number_;
        next_number_.reset();
        for (auto& earlier : numbered_)
            if (auto shown = earlier.lock(); shown && shown->number == figure->number) shown->used = true;
        numbered_.push_back(figure);
    }
    pieces_[timed_cell_].push_back({"", figure});
}

void Recorder::show_figure(const FigurePointer& figure) {
    note_time();
    auto& pieces = pieces_[timed_cell_];
    const bool made_here = std::ranges::any_of(pieces, [&](const Piece& piece) { return piece.figure == figure; });
    figure->used = false;
    if (!made_here) pieces.push_back({"", figure});
}

void Recorder::report_figure(const std::string& name, const FigurePointer& figure, const std::string& caption) {
    figure->used = true;
    reported_[name] = {figure, caption};
}

void Recorder::add_slider(const std::string& name, RecordedSlider slider) {
    note_time();
    slider.cell = timed_cell_;
    slider.order = record_.sliders.size() + 1;
    record_.sliders.emplace(name, std::move(slider));
}

void Recorder::note_file_read(const std::filesystem::path& file) {
    auto& files = record_.files_read;
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
}

void Recorder::capture_figures(const std::string& cell, const std::vector<Piece>& pieces, const Reader& reader) {
    std::vector<CellOutput> outputs;
    int count = 0;
    std::string printed;
    for (const Piece& piece : pieces) {
        printed += piece.printed;
        if (!piece.figure || piece.figure->used) continue;
        const std::string name = cell + "-figure-" + std::to_string(++count);
        const Figure& figure = piece.figure->figure;
        const Message& title =
            !figure.title.empty() || figure.panels.empty() ? figure.title : figure.panels.front().title;
        record_.figures[name] = {
            std::make_shared<const Figure>(figure), message_text(title, reader), {}, piece.figure->order};
        outputs.push_back({std::move(printed), name});
        printed.clear();
    }
    if (!printed.empty()) outputs.push_back({std::move(printed), std::nullopt});
    if (!outputs.empty()) record_.outputs[cell] = std::move(outputs);
}

RunRecord Recorder::finish(const Reader& reader) {
    record_.timings[timed_cell_] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - timed_since_).count();
    for (const auto& [cell, pieces] : pieces_) capture_figures(cell, pieces, reader);
    for (const auto& [name, reported] : reported_)
        record_.figures[name] = {
            std::make_shared<const Figure>(reported.figure->figure), reported.caption, {}, reported.figure->order};
    pieces_.clear();
    reported_.clear();
    numbered_.clear();
    current_line_ = nullptr;
    enter_cell_ = nullptr;
    return std::move(record_);
}

}  // namespace dynlab::inline scripting
