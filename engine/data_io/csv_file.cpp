#include "data_io/csv_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text_file.h"

namespace dynlab::inline data_io {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

enum class NumberStatus { kNumber, kEmpty, kNotANumber, kNotFinite, kOutOfRange };

/// Reads a whole cell as a number, whatever the locale; `decimal_comma` also accepts "1,5".
NumberStatus parse_number(std::string_view cell, bool decimal_comma, double& number) {
    cell = trimmed(cell);
    if (cell.empty()) return NumberStatus::kEmpty;
    char with_point[64];
    if (decimal_comma && cell.size() < sizeof with_point && cell.find('.') == std::string_view::npos) {
        std::replace_copy(cell.begin(), cell.end(), with_point, ',', '.');
        cell = {with_point, cell.size()};
    }
    if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error == std::errc::invalid_argument || end != cell.data() + cell.size()) return NumberStatus::kNotANumber;
    if (error == std::errc::result_out_of_range) return NumberStatus::kOutOfRange;
    return std::isfinite(number) ? NumberStatus::kNumber : NumberStatus::kNotFinite;
}

std::string shown(std::string_view given) {
    constexpr std::size_t kLongest = 40;
    given = trimmed(given);
    if (given.empty()) return "an empty cell";
    return given.size() <= kLongest ? fmt::format("\"{}\"", given)
                                    : fmt::format("\"{}...\"", given.substr(0, kLongest));
}

/// The separator that occurs most often outside quotes; a comma when there is only one column.
char separator_of(std::string_view header) {
    std::size_t commas = 0, semicolons = 0, tabs = 0;
    bool quoted = false;
    for (const char c : header) {
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        commas += c == ',', semicolons += c == ';', tabs += c == '\t';
    }
    // The rarer a character is in names, the sooner it is the separator.
    if (tabs > 0 && tabs >= std::max(commas, semicolons)) return '\t';
    return semicolons > 0 && semicolons >= commas ? ';' : ',';
}

class CsvReader {
  public:
    CsvReader(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

    CsvTable read() {
        if (text_.substr(0, 2) == "\xFF\xFE" || text_.substr(0, 2) == "\xFE\xFF") {
            fail("the text is in UTF-16; save it as UTF-8");
        }
        read_comments();
        read_header();
        read_rows();
        check_units();
        return std::move(table_);
    }

  private:
    struct Column {
        bool is_text = false;
        std::vector<double> numbers;
        std::vector<std::string> texts;
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw EnvironmentError(fmt::format("{}: {}", file_.string(), what));
    }
    [[noreturn]] void fail_in_line(const std::string& what) const {
        throw EnvironmentError(fmt::format("{}, line {}: {}", file_.string(), record_line_, what));
    }
    [[noreturn]] void fail_in_column(std::size_t column, const std::string& what) const {
        throw EnvironmentError(
            fmt::format("{}, line {}, column {}: {}", file_.string(), record_line_, table_.names[column], what));
    }

    bool at_end() const { return at_ >= text_.size(); }
    std::string_view rest_of_line() const { return text_.substr(at_, text_.find('\n', at_) - at_); }
    void skip_line() {
        at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
        ++line_;
    }
    void skip_blank_lines() {
        while (!at_end() && trimmed(rest_of_line()).empty()) skip_line();
    }

    void read_comments() {
        for (skip_blank_lines(); !at_end() && text_[at_] == '#'; skip_blank_lines()) {
            record_line_ = line_;
            const std::string_view comment = rest_of_line().substr(1);
            const auto colon = comment.find(':');
            if (colon != std::string_view::npos) {
                take_remark(trimmed(comment.substr(0, colon)), trimmed(comment.substr(colon + 1)));
            }
            skip_line();
        }
    }

    void take_remark(std::string_view key, std::string_view value) {
        if (key.substr(0, 5) == "unit ") {
            table_.units[std::string(trimmed(key.substr(5)))] = value;
        } else if (key == "Ts") {
            double Ts = 0;
            if (value.size() > 2 && value.substr(value.size() - 2) == " s") value.remove_suffix(2);
            if (parse_number(value, true, Ts) != NumberStatus::kNumber || Ts <= 0) {
                fail_in_line("the sampling time Ts must be a positive number of seconds, given " + shown(value));
            }
            table_.Ts = Ts;
        } else {
            table_.remarks[std::string(key)] = value;
        }
    }

    /// One cell of the record at hand; afterwards either past its separator or, with `record_ended_`, in the next
    /// line. Cells in quotes may hold separators, line ends and doubled quotes (RFC 4180).
    std::string_view next_cell() {
        std::size_t blanks = at_;
        while (blanks < text_.size() && text_[blanks] == ' ') ++blanks;
        if (blanks < text_.size() && text_[blanks] == '"') return next_quoted_cell(blanks + 1);
        const std::size_t begin = at_;
        while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n') ++at_;
        std::string_view cell = text_.substr(begin, at_ - begin);
        if (!cell.empty() && cell.back() == '\r') cell.remove_suffix(1);
        pass_cell_end();
        return cell;
    }

    std::string_view next_quoted_cell(std::size_t begin) {
        unquoted_.clear();
        for (at_ = begin;; ++at_) {
            if (at_end()) fail_in_line("a quotation mark is opened and never closed");
            if (text_[at_] == '"') {
                if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
                ++at_;
            }
            line_ += text_[at_] == '\n';
            unquoted_ += text_[at_];
        }
        ++at_;
        while (!at_end() && (text_[at_] == ' ' || text_[at_] == '\r')) ++at_;
        if (!at_end() && text_[at_] != separator_ && text_[at_] != '\n') {
            fail_in_line("there is text after a closing quotation mark");
        }
        pass_cell_end();
        return unquoted_;
    }

    void pass_cell_end() {
        record_ended_ = at_end() || text_[at_] == '\n';
        line_ += !at_end() && text_[at_] == '\n';
        if (!at_end()) ++at_;
    }

    void read_header() {
        if (at_end()) fail("there is no header line with the names of the columns");
        separator_ = separator_of(rest_of_line());
        record_line_ = line_;
        bool only_numbers = true;
        do {
            table_.names.emplace_back(trimmed(next_cell()));
            double number = 0;
            only_numbers = only_numbers && parse_number(table_.names.back(), true, number) != NumberStatus::kNotANumber;
        } while (!record_ended_);
        if (only_numbers) fail_in_line("wanted a header line with the names of the columns, given numbers");
        check_names();
    }

    void check_names() const {
        for (auto name = table_.names.begin(); name != table_.names.end(); ++name) {
            if (name->empty()) {
                fail_in_line(fmt::format("column {} has no name", name - table_.names.begin() + 1));
            }
            if (std::find(table_.names.begin(), name, *name) != name) {
                fail_in_line(fmt::format("two columns have the name {}", *name));
            }
        }
    }

    void read_rows() {
        std::vector<Column> columns(table_.names.size());
        const auto lines_left = std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(), '\n') + 1;
        bool first = true;
        for (skip_blank_lines(); !at_end(); skip_blank_lines()) {
            read_row(columns, first, static_cast<std::size_t>(lines_left));
            first = false;
        }
        if (first) fail("there are no rows below the header line");
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const std::vector<double>& numbers = columns[i].numbers;
            table_.columns.push_back(Eigen::Map<const Vector>(numbers.data(), static_cast<Index>(numbers.size())));
            if (columns[i].is_text) table_.texts[table_.names[i]] = std::move(columns[i].texts);
        }
    }

    void read_row(std::vector<Column>& columns, bool first, std::size_t rows_at_most) {
        record_line_ = line_;
        std::size_t cells = 0;
        do {
            const std::string_view cell = next_cell();
            if (cells < columns.size()) take_cell(columns[cells], cells, cell, first, rows_at_most);
            ++cells;
        } while (!record_ended_);
        if (cells == columns.size()) return;
        fail_in_line(fmt::format("wanted {} cells as in the header line, given {}", columns.size(), cells));
    }

    void take_cell(Column& column, std::size_t index, std::string_view cell, bool first, std::size_t rows_at_most) {
        if (column.is_text) {
            column.texts.emplace_back(trimmed(cell));
            return;
        }
        double number = 0;
        switch (parse_number(cell, separator_ != ',', number)) {
            case NumberStatus::kNumber:
                if (first) column.numbers.reserve(rows_at_most);
                column.numbers.push_back(number);
                return;
            case NumberStatus::kNotANumber:
                if (!first) fail_in_column(index, "wanted a number, given " + shown(cell));
                column.is_text = true;
                column.texts.emplace_back(trimmed(cell));
                return;
            case NumberStatus::kEmpty:
                fail_in_column(index, "wanted a number, given an empty cell");
            case NumberStatus::kNotFinite:
                fail_in_column(index, "wanted a finite number, given " + shown(cell));
            case NumberStatus::kOutOfRange:
                fail_in_column(index, "wanted a number that fits double precision, given " + shown(cell));
        }
    }

    void check_units() const {
        for (const auto& [name, unit] : table_.units) {
            if (std::find(table_.names.begin(), table_.names.end(), name) == table_.names.end()) {
                fail(fmt::format("a unit is given for {}, but there is no such column; the columns are {}", name,
                                 fmt::join(table_.names, ", ")));
            }
        }
    }

    const std::filesystem::path& file_;
    std::string_view text_;
    std::size_t at_ = 0, line_ = 1;
    std::size_t record_line_ = 1;  // where the record at hand begins: errors point there
    char separator_ = ',';
    bool record_ended_ = false;
    std::string unquoted_;
    CsvTable table_;
};

std::string quoted_where_needed(const std::string& text) {
    if (text.find_first_of(",;\t\"\r\n#") == std::string::npos && trimmed(text) == text) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

/// Number of rows; throws unless every column has it.
std::size_t checked_rows(const CsvTable& table) {
    std::size_t rows = 0;
    for (std::size_t i = 0; i < table.names.size(); ++i) {
        if (std::find(table.names.begin(), table.names.begin() + static_cast<std::ptrdiff_t>(i), table.names[i]) !=
            table.names.begin() + static_cast<std::ptrdiff_t>(i)) {
            throw InvalidArgument(
                fmt::format("two columns are named {}; every column needs a name of its own", table.names[i]));
        }
        const auto text = table.texts.find(table.names[i]);
        if (text == table.texts.end() && i >= table.columns.size()) {
            throw InvalidArgument(fmt::format("column {} has a name but no data", table.names[i]));
        }
        const std::size_t here =
            text != table.texts.end() ? text->second.size() : static_cast<std::size_t>(table.columns[i].size());
        if (i > 0 && here != rows) {
            throw InvalidArgument(fmt::format("columns of a table must have equal lengths: {} has {} rows, {} has {}",
                                              table.names[0], rows, table.names[i], here));
        }
        rows = here;
    }
    if (rows == 0) throw InvalidArgument("a table needs at least one column and one row");
    return rows;
}

void append_number(std::string& out, double number, int digits, const std::string& column, std::size_t row) {
    if (!std::isfinite(number)) {
        throw InvalidArgument(fmt::format("column {} holds a value that is not finite in row {}", column, row + 1));
    }
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::general, digits).ptr;
    out.append(text, end);
}

void append_comments(std::string& out, const CsvTable& table) {
    for (const auto& [key, value] : table.remarks) out += fmt::format("# {}: {}\n", key, value);
    if (table.Ts) out += fmt::format("# Ts: {}\n", *table.Ts);
    for (const auto& [column, unit] : table.units) out += fmt::format("# unit {}: {}\n", column, unit);
}

}  // namespace

CsvTable read_csv_file(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    return CsvReader(file, text).read();
}

void write_csv_file(const std::filesystem::path& file, const CsvTable& table, int digits) {
    if (digits < 1 || digits > 17) {
        throw InvalidArgument(fmt::format("a table is written with 1 to 17 significant digits, not {}", digits));
    }
    const std::size_t rows = checked_rows(table);
    std::string out;
    append_comments(out, table);
    for (std::size_t i = 0; i < table.names.size(); ++i) {
        if (i) out += ',';
        out += quoted_where_needed(table.names[i]);
    }
    out += '\n';
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < table.names.size(); ++i) {
            if (i) out += ',';
            const auto text = table.texts.find(table.names[i]);
            if (text != table.texts.end()) {
                out += quoted_where_needed(text->second[row]);
            } else {
                append_number(out, table.columns[i][static_cast<Index>(row)], digits, table.names[i], row);
            }
        }
        out += '\n';
    }
    write_file_atomically(file, out);
}

}  // namespace dynlab::inline data_io
