#include "documents/percent_script.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "documents/error.h"
#include "documents/script_header.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "platform/spelling.h"

namespace dynlab::inline documents {
namespace {

const std::vector<std::string> kCellOptions = {"id", "echo", "output"};

class CellReader {
  public:
    CellReader(const std::vector<std::string>& lines, const std::filesystem::path& file) : lines_(lines), file_(file) {}

    std::vector<Cell> read(std::size_t first) {
        Cell cell;
        std::size_t start = first;
        bool marked = false;
        for (std::size_t i = first; i <= lines_.size(); ++i) {
            if (i < lines_.size() && !is_cell_marker(lines_[i])) continue;
            finish(cell, start, i, marked);
            if (i == lines_.size()) break;
            cell = Cell{};
            read_marker(cell, i);
            start = i + 1;
            marked = true;
        }
        return std::move(cells_);
    }

  private:
    [[noreturn]] void fail(std::size_t index, const Message& what) const {
        throw DocumentError(Place{file_, static_cast<int>(index) + 1}, what);
    }

    void read_marker(Cell& cell, std::size_t index) const {
        std::istringstream words{std::string(cell_marker_options(lines_[index]))};
        std::string word;
        for (bool first = true; words >> word; first = false) {
            if (first && word == "[markdown]") {
                cell.kind = Cell::Kind::kText;
                continue;
            }
            const std::size_t equals = word.find('=');
            if (equals == std::string::npos || equals + 1 == word.size())
                fail(index,
                     Message("cell option \"{}\" does not have the form key=value (or [markdown] as the first option)",
                             word));
            read_option(cell, index, word.substr(0, equals), word.substr(equals + 1));
        }
    }

    void read_option(Cell& cell, std::size_t index, const std::string& key, const std::string& value) const {
        if (std::find(kCellOptions.begin(), kCellOptions.end(), key) == kCellOptions.end()) {
            const auto near = nearest_word(key, kCellOptions);
            fail(index, near ? Message("unknown cell option \"{}\"; did you mean \"{}\"?", key, *near)
                             : Message("unknown cell option \"{}\"; the options are {}", key, listed(kCellOptions)));
        }
        if (key == "id") {
            if (!is_name(value))
                fail(index, Message("cell id \"{}\" may contain only letters, digits, _ and -", value));
            cell.id = value;
            return;
        }
        if (value != "true" && value != "false")
            fail(index, Message("cell option {} must be true or false, not \"{}\"", key, value));
        if (!cell.options.emplace(key, value).second) fail(index, Message("cell option {} occurs twice", key));
    }

    /// Takes lines [start, end) as the content of `cell`, blank lines at both ends left out.
    void finish(Cell& cell, std::size_t start, std::size_t end, bool marked) {
        const std::size_t after_marker = start;
        while (start < end && is_blank(lines_[start])) ++start;
        while (end > start && is_blank(lines_[end - 1])) --end;
        if (!marked && start == end) return;
        cell.first_line = static_cast<int>(start < end ? start : after_marker) + 1;
        for (std::size_t i = start; i < end; ++i) cell.content += content_line(cell, i) + "\n";
        if (ids_.contains(cell.id)) cell.repeats = std::exchange(cell.id, {});  // copied, marker and all
        for (std::size_t number = cells_.size() + 1; cell.id.empty() || ids_.contains(cell.id); ++number)
            cell.id = "cell-" + std::to_string(number);
        ids_.insert(cell.id);
        cells_.push_back(std::move(cell));
    }

    std::string content_line(const Cell& cell, std::size_t index) const {
        const std::string& line = lines_[index];
        if (cell.kind == Cell::Kind::kCode || is_blank(line)) return line;
        if (!line.starts_with("--"))
            fail(index, Message("\"{}\" is in a text cell, in which lines start with \"-- \"; start a code cell with a "
                                "line \"-- %%\"",
                                trimmed(line)));
        return line.substr(line.starts_with("-- ") ? 3 : 2);
    }

    const std::vector<std::string>& lines_;
    const std::filesystem::path& file_;
    std::vector<Cell> cells_;
    std::set<std::string> ids_;
};

std::string_view without_leading_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

}  // namespace

int Cell::last_line() const {
    const auto lines = static_cast<int>(std::count(content.begin(), content.end(), '\n'));
    return first_line + std::max(lines - 1, 0);
}

const Cell* PercentScript::cell_at_line(int line) const {
    const Cell* found = nullptr;
    for (const Cell& cell : cells)
        if (cell.first_line <= line) found = &cell;
    return found;
}

PercentScript parse_percent_script(const std::string& source, const std::filesystem::path& name) {
    PercentScript script;
    script.file = name;
    script.source = source;
    without_solutions(source, name);  // throws for markers that do not pair up
    const std::vector<std::string> lines = lines_of(source);
    const std::size_t used = read_script_header(lines, name, script.header);
    script.cells = CellReader(lines, name).read(used);
    return script;
}

std::filesystem::path bibliography_of(const PercentScript& script) {
    const std::string& name = script.header.bibliography;
    return name.empty() ? std::filesystem::path() : script.file.parent_path() / name;
}

PercentScript read_percent_script(const std::filesystem::path& file) {
    return parse_percent_script(text_of_source(file), file);
}

bool is_cell_marker(std::string_view line) {
    return line.starts_with("--") && without_leading_blanks(line.substr(2)).starts_with("%%");
}

std::string_view cell_marker_options(std::string_view line) {
    return without_leading_blanks(without_leading_blanks(line.substr(2)).substr(2));
}

bool is_text_cell_marker(std::string_view line) {
    return is_cell_marker(line) && cell_marker_options(line).starts_with("[markdown]");
}

}  // namespace dynlab::inline documents
