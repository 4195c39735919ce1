#include "data_io/text_table.h"

#include <algorithm>
#include <array>
#include <set>

#include "data_io/tables/number_cell.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/foreign_text.h"
#include "platform/text/read_number.h"
#include "platform/text/small_letters.h"
#include "platform/utf8.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::size_t kMaxTableCells = 4'000'000;  // the empty ones at the ends of short rows count, too

/// The separator that the first line has most of.
char table_separator_of(std::string_view text) {
    const std::string_view header = text.substr(0, text.find('\n'));
    char best = ',';
    for (const char c : {';', '\t'})
        if (std::count(header.begin(), header.end(), c) > std::count(header.begin(), header.end(), best)) best = c;
    return best;
}

class Reader {
  public:
    Reader(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {
        separator_ = table_separator_of(text_);
    }

    TextTable read() {
        TextTable table;
        std::vector<std::string> row;
        for (int line = line_; read_row(row); line = line_) {
            if (row.size() == 1 && row.front().empty()) continue;
            if (table.names.empty()) {
                take_header(table, row, line);
                continue;
            }
            if (row.size() > table.names.size())
                throw EnvironmentError("{}, line {}: the row has {}, but the header has {}", file_.string(), line,
                                       plural(std::ssize(row), "{} cell", "{} cells"),
                                       plural(std::ssize(table.names), "{} column", "{} columns"));
            row.resize(table.names.size());
            if (table.rows.size() >= kMaxTableCells / row.size())
                throw EnvironmentError("{}, line {}: the table has more than {} cells", file_.string(), line,
                                       kMaxTableCells);
            table.rows.push_back(row);
            table.lines.push_back(line);
        }
        if (table.names.empty())
            throw EnvironmentError("{}, line 1: the file is empty; its first line must contain the column names",
                                   file_.string());
        return table;
    }

  private:
    void take_header(TextTable& table, const std::vector<std::string>& row, int line) const {
        std::set<std::string> known;
        for (const std::string& cell : row) {
            std::string name = in_small_letters(cell);
            if (!known.insert(name).second)
                throw EnvironmentError("{}, line {}: two columns are named \"{}\"; give each column a different name",
                                       file_.string(), line, name);
            table.names.push_back(std::move(name));
        }
    }

    bool read_row(std::vector<std::string>& row) {
        row.clear();
        if (at_ >= text_.size()) return false;
        for (bool more = true; more;) row.push_back(read_cell(more));
        return true;
    }

    /// One cell with its terminator; `more` is set if another cell follows on the line.
    std::string read_cell(bool& more) {
        std::string cell;
        const int line = line_;
        const std::size_t begin = text_.find_first_not_of(" ", at_);
        const bool quoted = begin != std::string_view::npos && text_[begin] == '"';
        if (quoted) {
            at_ = begin + 1;
            while (true) {
                if (at_ >= text_.size())
                    throw EnvironmentError("{}, line {}: a quotation mark is not closed", file_.string(), line);
                const char c = text_[at_++];
                if (c == '\n') ++line_;
                if (c != '"') {
                    cell += c;
                } else if (at_ < text_.size() && text_[at_] == '"') {
                    cell += text_[at_++];
                } else {
                    break;
                }
            }
        }
        const std::size_t end = std::min(text_.find_first_of(std::string{separator_, '\n'}, at_), text_.size());
        cell += text_.substr(at_, end - at_);
        more = end < text_.size() && text_[end] == separator_;
        if (end < text_.size() && text_[end] == '\n') ++line_;
        at_ = end + 1;
        return std::string(trimmed_cell(cell));
    }

    const std::filesystem::path& file_;
    std::string_view text_;
    char separator_;
    std::size_t at_ = 0;
    int line_ = 1;
};

/// After blanks, a sign that makes spreadsheets compute; some take the full-width ones for the same.
bool begins_like_a_formula(std::string_view cell) {
    constexpr std::array<std::string_view, 10> kSpaces = {" ",      "\t",     "\r",     "\n",     "\u00A0",
                                                          "\u2007", "\u202F", "\u3000", "\uFEFF", "\u200B"};
    constexpr std::array<std::string_view, 8> kSigns = {"=", "+", "-", "@", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"};
    const auto begins = [&cell](std::string_view text) { return cell.starts_with(text); };
    if (begins("\t") || begins("\r")) return true;
    for (auto blank = kSpaces.begin(); blank != kSpaces.end();) {
        blank = std::find_if(kSpaces.begin(), kSpaces.end(), begins);
        if (blank != kSpaces.end()) cell.remove_prefix(blank->size());
    }
    return std::any_of(kSigns.begin(), kSigns.end(), begins);
}

constexpr std::string_view kCellEnds = ";\t\r\n";

/// Where a spreadsheet may begin a cell: what separates cells in another country ends them even between quotation
/// marks, as these hold only where they begin a cell.
std::string without_formulas(const std::string& cell) {
    std::string text;
    for (std::size_t from = 0; from <= cell.size();) {
        const std::size_t end = std::min(cell.find_first_of(kCellEnds, from), cell.size());
        const std::string part = cell.substr(from, end - from), rest = from == 0 ? cell : part;
        if (begins_like_a_formula(rest) && !read_number<double>(trimmed_cell(rest))) text += "'";
        text += cell.substr(from, end + 1 - from);
        from = end + 1;
    }
    return text;
}

void append_row(std::string& text, const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (i > 0) text += ',';
        text += csv_cell(row[i]);
    }
    text += "\r\n";
}

}  // namespace

std::string csv_cell(const std::string& given) {
    const std::string cell = without_formulas(given);
    if (cell.find_first_of(",;\"\r\n\t") == std::string::npos) return cell;
    std::string quoted = "\"";
    for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string as_written(const std::string& cell) {
    std::string text;
    for (std::size_t from = 0; from <= cell.size();) {
        const std::size_t end = std::min(cell.find_first_of(kCellEnds, from), cell.size());
        const bool guarded = cell[from] == '\'' && begins_like_a_formula(std::string_view(cell).substr(from + 1));
        text += cell.substr(from + (guarded ? 1 : 0), end + 1 - from - (guarded ? 1 : 0));
        from = end + 1;
    }
    return text;
}

std::optional<std::size_t> TextTable::column(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    return static_cast<std::size_t>(found - names.begin());
}

TextTable read_text_table(const std::filesystem::path& file) {
    std::string text = read_text(file);
    if (text.find('\0') != std::string::npos)
        throw EnvironmentError("{}: the file is not UTF-8 text; save it as CSV in UTF-8", file.string());
    const bool converted = !is_utf8(text);
    if (converted) text = utf8_of_windows_1252(text);
    TextTable table = Reader(file, text).read();
    table.converted = converted;
    return table;
}

std::optional<double> number_in_cell(const std::string& cell) {
    double number = 0;
    if (parse_number(cell, number) != NumberStatus::kNumber) return {};
    return number;
}

std::string csv_text(const TextTable& table) {
    std::string text;
    append_row(text, table.names);
    for (const auto& row : table.rows) append_row(text, row);
    return text;
}

}  // namespace dynlab::inline data_io
