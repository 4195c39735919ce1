#include "data_io/tables/instrument_text.h"

#include <algorithm>
#include <string_view>

#include "data_io/tables/clock_cell.h"
#include "data_io/tables/number_cell.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::string_view kEndOfHeader = "***End_of_Header***";

/// A text line by line, and cell by cell.
class Lines {
  public:
    explicit Lines(std::string& text) : text_(text) {}

    bool at_end() const { return at_ >= text_.size(); }
    std::size_t number() const { return number_; }
    std::string_view line() const { return std::string_view(text_).substr(at_, end() - at_); }
    void skip() { at_ = std::min(end() + 1, text_.size()), ++number_; }
    void blank() { blank(0, end() - at_); }
    void blank(std::size_t from, std::size_t count) {
        for (std::size_t i = at_ + from; i < at_ + from + count; ++i)
            if (text_[i] != '\r') text_[i] = ' ';
    }
    /// Overwrites as many characters.
    void write(std::size_t from, std::string_view words) { text_.replace(at_ + from, words.size(), words); }

    std::vector<std::string_view> cells(char separator) const {
        std::vector<std::string_view> cells;
        for (std::string_view rest = line();;) {
            const std::size_t end = rest.find(separator);
            cells.push_back(trimmed_cell(rest.substr(0, end)));
            if (end == std::string_view::npos) return cells;
            rest.remove_prefix(end + 1);
        }
    }
    /// Where a cell of cells() begins in the line.
    std::size_t place(std::string_view cell) const { return static_cast<std::size_t>(cell.data() - line().data()); }

  private:
    std::size_t end() const { return std::min(text_.find('\n', at_), text_.size()); }

    std::string& text_;
    std::size_t at_ = 0, number_ = 1;
};

std::optional<double> number_of(std::string_view cell) {
    double number = 0;
    return parse_number(cell, number) == NumberStatus::kNumber ? std::optional(number) : std::nullopt;
}

/// LabVIEW: two headers, the names with a Comment that no row has, then the rows; more headers begin more data sets.
void take_labview(const std::filesystem::path& file, std::string& text, InstrumentFacts& facts) {
    Lines lines(text);
    const bool commas = text.substr(0, text.find(kEndOfHeader)).find("Separator\tComma") != std::string::npos ||
                        text.find("Separator,Comma") < text.find(kEndOfHeader);
    const char separator = commas ? ',' : '\t';
    bool has_time = false;
    std::vector<std::string> units;
    for (int headers = 0; headers < 2 && !lines.at_end(); lines.skip()) {
        const auto cells = lines.cells(separator);
        if (cells.front() == kEndOfHeader) ++headers;
        if (cells.size() > 1 && cells[0] == "X_Dimension") has_time = cells[1] == "Time";
        if (cells.size() > 1 && cells[0] == "X0") facts.start = number_of(cells[1]).value_or(0);
        if (cells.size() > 1 && cells[0] == "Delta_X") facts.Ts = number_of(cells[1]);
        if (cells[0] == "Y_Unit_Label") units.assign(cells.begin() + 1, cells.end());
        lines.blank();
    }
    const auto names = lines.cells(separator);
    std::size_t signal = 0;
    for (const std::string_view name : names) {
        if (name == "Comment") lines.blank(lines.place(name), name.size());
        if (name == "X_Value") {
            if (has_time) facts.units[std::string(name)] = "s";
        } else if (signal < units.size() && !name.empty()) {
            if (!units[signal].empty()) facts.units[std::string(name)] = units[signal];
            ++signal;
        }
    }
    lines.skip();
    if (!has_time || std::ranges::count(names, "X_Value") > 0) facts.Ts.reset();
    const std::size_t again = text.find(kEndOfHeader);
    if (again == std::string::npos) return;
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(again), '\n') + 1;
    throw EnvironmentError(
        "{}, line {}: another recording starts here, with its own header; save each recording in a separate file",
        file.string(), line);
}

/// Tektronix: settings in the first three columns of the first rows, time and voltage behind them.
bool take_tektronix(std::string& text, InstrumentFacts& facts) {
    Lines lines(text);
    const auto first = lines.cells(',');
    constexpr std::size_t kTime = 3;
    if (first.size() < kTime + 2 || first[0] != "Record Length" || !number_of(first[kTime]) ||
        !number_of(first[kTime + 1]))
        return false;
    facts.names = {"time", "CH1"};
    facts.units = {{"time", "s"}};
    for (; !lines.at_end(); lines.skip()) {
        const auto cells = lines.cells(',');
        if (cells.size() <= kTime) continue;
        if (cells[0] == "Source") facts.names[1] = cells[1];
        if (cells[0] == "Horizontal Units") facts.units["time"] = cells[1];
        if (cells[0] == "Vertical Units" && !cells[1].empty()) facts.units["CH1"] = cells[1];
        lines.blank(0, lines.place(cells[kTime]));
    }
    if (const auto unit = facts.units.find("CH1"); unit != facts.units.end() && facts.names[1] != "CH1")
        facts.units[facts.names[1]] = unit->second, facts.units.erase("CH1");
    return true;
}

/// Rigol: the names, followed by Start and Increment, whose numbers are in the line of units; or "t0 = -0.005, tInc =
/// 4e-06" after the names.
void take_rigol(std::string& text, InstrumentFacts& facts) {
    Lines lines(text);
    const auto names = lines.cells(',');
    const auto start = std::ranges::find(names, "Start"), increment = std::ranges::find(names, "Increment");
    const auto value_behind = [&](std::string_view key) -> std::optional<double> {
        for (const std::string_view cell : names)
            if (const std::size_t equals = cell.find('=');
                equals != std::string_view::npos && trimmed_cell(cell.substr(0, equals)) == key)
                return number_of(cell.substr(equals + 1));
        return std::nullopt;
    };
    if (start != names.end() && increment != names.end()) {
        const auto place = [&](const auto& name) { return static_cast<std::size_t>(name - names.begin()); };
        const std::size_t from = place(start), to = place(increment);
        Lines units = lines;
        units.skip();
        const auto cells = units.cells(',');
        if (cells.size() <= std::max(from, to) || !number_of(cells[from]) || !number_of(cells[to])) return;
        facts.counter = names.front();
        units.blank(units.place(cells.front()), cells.front().size());
        facts.start = *number_of(cells[from]), facts.Ts = number_of(cells[to]);
        for (const std::size_t j : {from, to}) {
            units.blank(units.place(cells[j]), cells[j].size());
            lines.blank(lines.place(names[j]), names[j].size());
        }
    } else if (const auto step = value_behind("tInc")) {
        facts.start = value_behind("t0").value_or(0);
        for (const std::string_view cell : names)
            if (cell.find('=') != std::string_view::npos) lines.blank(lines.place(cell), cell.size());
        facts.Ts = step;
    }
}

/// Arduino's serial monitor: "10:12:05.500 -> " before each line, which becomes a separate cell.
void take_serial_monitor(std::string& text) {
    constexpr std::string_view kArrow = " -> ";
    Lines lines(text);
    const std::size_t arrow = lines.line().find(kArrow);
    if (arrow == std::string_view::npos || !clock_cell(lines.line().substr(0, arrow))) return;
    char separator = ',';
    for (Lines look = lines; !look.at_end(); look.skip()) {
        const std::string_view line = look.line();
        if (line.size() <= arrow + kArrow.size()) continue;
        const std::string_view payload = line.substr(arrow + kArrow.size());
        for (const char sign : {'\t', ';', ','})
            if (payload.find(sign) != std::string_view::npos) separator = sign;
        if (payload.find_first_of("\t;,") != std::string_view::npos) break;
    }
    for (; !lines.at_end(); lines.skip()) {
        const std::size_t at = lines.line().find(kArrow);
        if (at == std::string_view::npos) continue;
        const std::string_view payload = trimmed_cell(lines.line().substr(at + kArrow.size()));
        const bool names =
            !payload.empty() && std::string_view("+-.0123456789").find(payload.front()) == std::string_view::npos;
        if (names && at >= 4) lines.blank(0, at), lines.write(0, "time");
        lines.write(at, std::string{' ', separator, ' ', ' '});
    }
}

}  // namespace

InstrumentFacts take_instrument_text(const std::filesystem::path& file, std::string& text) {
    InstrumentFacts facts;
    if (text.starts_with("LabVIEW Measurement") && text.find(kEndOfHeader) != std::string::npos)
        take_labview(file, text, facts);
    else if (!take_tektronix(text, facts))
        take_rigol(text, facts), take_serial_monitor(text);
    return facts;
}

}  // namespace dynlab::inline data_io
