#include "data_io/tables/table_rows.h"

#include <algorithm>

#include "data_io/reading_memory.h"
#include "data_io/tables/cell_scanner.h"
#include "data_io/variable.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

/// Numbers are read into the vector that is given back; a text is moved into its variable, one beside the other.
constexpr std::size_t kBytesOfNumber = sizeof(double), kBytesOfText = sizeof(std::string) + sizeof(Variable);

/// The memory of a string outside the object itself.
std::size_t bytes_besides(std::string_view text) {
    constexpr std::size_t kShort = 15, kBlock = 16;
    return text.size() > kShort ? text.size() + kBlock : 0;
}

class RowReader {
  public:
    RowReader(const std::filesystem::path& file, std::string_view text, const TableLayout& layout,
              const std::vector<std::string>& names)
        : file_(file), text_(text), layout_(layout), names_(names), columns_(layout.formats.size()) {}

    TableRows read() {
        const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(layout_.rows_at);
        const auto lines_left = static_cast<std::size_t>(std::count(begin, text_.end(), '\n') + 1);
        const std::size_t rows = std::min(lines_left, (text_.size() - layout_.rows_at) / columns_.size() + 1);
        for (std::size_t j = 0; j < columns_.size(); ++j)
            is_text(j) ? columns_[j].texts.reserve(rows) : columns_[j].numbers.resize(static_cast<Index>(rows));
        CellScanner scanner(file_, text_, layout_.separator, layout_.rows_at, layout_.rows_line);
        while (scanner.next_row() && read_row(scanner)) ++rows_.count;
        rows_.count -= empty_rows_;  // spreadsheets write rows of nothing but separators below a table
        for (std::size_t j = 0; j < columns_.size(); ++j) {
            TableColumn& column = columns_[j];
            column.texts.resize(is_text(j) ? rows_.count : 0);
            column.numbers.conservativeResize(is_text(j) ? 0 : static_cast<Index>(rows_.count));  // without a copy
            column.missing = static_cast<std::size_t>(column.numbers.array().isNaN().count());
        }
        report_formats();
        rows_.columns = std::move(columns_);
        return std::move(rows_);
    }

  private:
    bool is_text(std::size_t j) const { return layout_.formats[j].kind == ColumnFormat::Kind::kText; }

    /// False where the table ends.
    bool read_row(CellScanner& scanner) {
        std::size_t cells = 0;
        bool rest_is_empty = true, empty = true;  // empty: so far
        do {
            const std::string_view cell = scanner.next_cell();
            if (cells < columns_.size()) {
                if (!take_cell(cells, cell, empty, scanner)) return false;
            } else {
                rest_is_empty = rest_is_empty && cell.empty();
            }
            empty = empty && cell.empty();
            ++cells;
        } while (!scanner.row_ended());
        if (cells == columns_.size() || (cells > columns_.size() && rest_is_empty)) {
            empty_rows_ = empty ? empty_rows_ + 1 : 0;
            return true;
        }
        if (cells == 1 && ends_before(scanner)) return false;
        throw EnvironmentError("{}, line {}: expected {} as in the lines above, got {}", file_.string(), scanner.line(),
                               plural(std::ssize(columns_), "{} cell", "{} cells"), cells);
    }

    /// Refuses a table before it takes more memory than a file of that size may.
    void take_memory(std::size_t bytes, const CellScanner& scanner) {
        if ((memory_ += bytes) <= memory_for_reading(text_.size())) return;
        const ReadingMegabytes megabytes = megabytes_for_reading(text_.size());
        throw EnvironmentError(
            "{}, line {}: the table has too many cells: reading it requires more than {} MB of memory, the limit for a "
            "file of {} MB",
            file_.string(), scanner.line(), megabytes.limit, megabytes.of_file);
    }

    /// False at the end of the table, which the `first` cell that is not empty may show.
    bool take_cell(std::size_t j, std::string_view cell, bool first, const CellScanner& scanner) {
        TableColumn& column = columns_[j];
        const ColumnFormat& format = layout_.formats[j];
        if (is_text(j)) {
            take_memory(kBytesOfText + bytes_besides(cell), scanner);
            column.texts.resize(rows_.count);
            column.texts.emplace_back(cell);
            return true;
        }
        take_memory(kBytesOfNumber, scanner);
        double number = 0;
        const bool plain = format.kind == ColumnFormat::Kind::kNumber && format.thousands == 0;
        NumberStatus status = plain ? parse_number(cell, number) : NumberStatus::kNotANumber;
        if (status == NumberStatus::kNotANumber) status = read_cell(format, cell, number, column.clocks);
        if (status == NumberStatus::kMissing) {
            if (column.first_missing_line == 0) column.first_missing_line = scanner.line();
        } else if (status != NumberStatus::kNumber) {
            if (first && status == NumberStatus::kNotANumber && ends_before(scanner)) return false;
            refuse_cell({file_, scanner.line(), names_[j]}, cell, format);
        } else if (first_comma_.empty() && format.thousands != ',' && cell.find(',') != std::string_view::npos) {
            if (format.kind == ColumnFormat::Kind::kNumber) first_comma_ = cell;
        }
        const auto place = static_cast<Index>(rows_.count);
        if (place == column.numbers.size()) column.numbers.conservativeResize(2 * place + 1);
        column.numbers[place] = number;
        return true;
    }

    /// Whether no row follows the current line, which is not a row: then this line and the following ones are text
    /// below the table.
    bool ends_before(const CellScanner& at) {
        constexpr std::size_t kMaxLineCount = 200;
        CellScanner scanner(file_, text_, layout_.separator, at.place(), at.line());
        std::string first;
        for (std::size_t lines = 0; scanner.next_row(); ++lines) {
            std::size_t cells = 0, numbers = 0, others = 0;
            do {
                const std::string_view cell = scanner.next_cell();
                if (first.empty()) first = cell;
                double number = 0;
                ClockForms clocks;
                if (cells < columns_.size() && !is_text(cells)) {
                    const NumberStatus status = read_cell(layout_.formats[cells], cell, number, clocks);
                    numbers += status == NumberStatus::kNumber;
                    others += status == NumberStatus::kNotANumber;
                }
                ++cells;
            } while (!scanner.row_ended());
            double number = 0;
            if (lines == 0 && parse_number(first, number) != NumberStatus::kNotANumber) return false;
            const bool is_row = cells >= columns_.size() && numbers > 0 && others == 0;
            if (is_row || lines == kMaxLineCount) return false;
        }
        constexpr std::size_t kShown = 30;
        if (first.size() > kShown) first = first.substr(0, kShown) + "...";
        if (rows_.count == 0) return false;
        rows_.notes.push_back(Message(
            "dynlab ignores line {} and the lines after it, which are below the table: \"{}\"", at.line(), first));
        return true;
    }

    void report_formats() {
        for (std::size_t j = 0; j < columns_.size(); ++j) {
            const ColumnFormat& format = layout_.formats[j];
            if (format.kind == ColumnFormat::Kind::kSwitch)
                rows_.notes.push_back(Message("column {} contains the words {} and {}, which are read as 1 and 0",
                                              names_[j], format.on, format.off));
            else if (format.kind == ColumnFormat::Kind::kMeasure)
                rows_.notes.push_back(
                    Message("column {} contains numbers with a unit, such as {}; the unit of the column is {}",
                            names_[j], format.example, format.unit));
            else if (format.kind == ColumnFormat::Kind::kNumber && !format.example.empty())
                rows_.notes.push_back(
                    Message("column {} contains thousands separators, as in {}", names_[j], format.example));
            else if (is_text(j) && !columns_[j].texts.empty() && begins_with_digit(columns_[j].texts.front()))
                rows_.notes.push_back(
                    Message("column {} contains text, not numbers, such as \"{}\"; to use the column as a signal, "
                            "write only numbers with a decimal point",
                            names_[j], columns_[j].texts.front()));
        }
        if (!first_comma_.empty())
            rows_.notes.push_back(Message("the numbers have a decimal comma, as in {}", first_comma_));
    }
    static bool begins_with_digit(const std::string& text) { return text.find_first_of("0123456789") == 0; }

    const std::filesystem::path& file_;
    std::string_view text_;
    const TableLayout& layout_;
    const std::vector<std::string>& names_;
    std::vector<TableColumn> columns_;
    TableRows rows_ = {};
    std::size_t empty_rows_ = 0;         ///< the last ones
    std::string first_comma_;            ///< first number with a decimal comma
    std::size_t memory_ = text_.size();  ///< of the text, and of what its rows have become so far
};

}  // namespace

TableRows read_table_rows(const std::filesystem::path& file, std::string_view text, const TableLayout& layout,
                          const std::vector<std::string>& names) {
    return RowReader(file, text, layout, names).read();
}

}  // namespace dynlab::inline data_io
