#include "data_io/tables/table_layout.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "data_io/tables/cell_scanner.h"
#include "data_io/tables/number_cell.h"
#include "data_io/tables/unit_text.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::size_t kMaxTableRows = 300, kMaxCells = 200000;  // of the sample
constexpr std::size_t kMaxColumns = 100000;

enum class CellKind { kNumber, kDisguised, kMissing, kText };

struct TableRow {
    std::size_t at = 0, line = 1;
    std::vector<std::string> cells;
    std::vector<CellKind> kinds;

    /// Without the empty cells at its end.
    std::size_t filled() const {
        std::size_t count = cells.size();
        while (count > 0 && cells[count - 1].empty()) --count;
        return count;
    }
};

/// The beginning of a text, cut into cells by one separator.
struct TableSample {
    char separator;
    std::vector<TableRow> table_rows;
    std::string last_comment;  ///< before the first row
    std::size_t cells = 0;     ///< of most rows in the last half

    /// What speaks for this separator, 1 at most.
    double score = 0;
};

CellKind kind_of(std::string_view cell) {
    double number = 0;
    const NumberStatus status = parse_number(cell, number);
    if (status == NumberStatus::kMissing) return CellKind::kMissing;
    if (status != NumberStatus::kNotANumber) return CellKind::kNumber;
    return is_number_in_disguise(cell) ? CellKind::kDisguised : CellKind::kText;
}

[[noreturn]] void fail_wide(const std::filesystem::path& file, const CellScanner& scanner) {
    throw EnvironmentError("{}, line {}: the row has more than {} cells", file.string(), scanner.line(), kMaxColumns);
}

/// Nothing when quotation marks, or rows of no sensible length, show that the separator is another.
std::optional<TableSample> sample_of(const std::filesystem::path& file, std::string_view text, std::size_t at,
                                     std::size_t line, char separator) try {
    TableSample sample{separator, {}, {}, 0, 0};
    CellScanner scanner(file, text, separator, at, line);
    std::size_t cells = 0;
    while (sample.table_rows.size() < kMaxTableRows && cells < kMaxCells && scanner.next_row()) {
        if (sample.table_rows.empty()) sample.last_comment = scanner.last_comment();
        TableRow table_row{scanner.place(), scanner.line(), {}, {}};
        do {
            if (table_row.cells.size() == kMaxColumns) fail_wide(file, scanner);
            const std::string_view cell = scanner.next_cell();
            table_row.kinds.push_back(kind_of(cell));
            table_row.cells.emplace_back(cell);
        } while (!scanner.row_ended());
        cells += table_row.cells.size();
        sample.table_rows.push_back(std::move(table_row));
    }
    return sample;
} catch (const EnvironmentError&) {
    return std::nullopt;
}

/// The part of the text that is assumed to contain the table's rows.
std::span<const TableRow> last_half(const TableSample& sample) {
    return std::span(sample.table_rows).subspan(sample.table_rows.size() / 2);
}

/// The size of most rows; those of the last half count twice.
std::size_t most_frequent_size(const TableSample& sample) {
    std::map<std::size_t, int> times;
    for (const TableRow& table_row : sample.table_rows) ++times[table_row.cells.size()];
    for (const TableRow& table_row : last_half(sample)) ++times[table_row.cells.size()];
    std::size_t best = 0;
    for (const auto& [size, count] : times)
        if (best == 0 || count >= times[best]) best = size;
    return best;
}

class LayoutFinder {
  public:
    LayoutFinder(const std::filesystem::path& file, const TableSample& sample, bool named)
        : file_(file), sample_(sample), table_rows_(sample.table_rows), named_(named) {
        layout_.separator = sample.separator;
        look_at_columns();
        find_names();
    }

    /// Whether the lines above the rows name the columns, or there are none.
    bool is_complete() const { return header_ || first_row_ == 0 || named_; }

    TableLayout layout() {
        if (mismatch_) fail_mismatch();
        TableLayout& layout = layout_;
        const std::size_t first = header_ ? *header_ : first_row_;
        if (header_) layout.names = table_rows_[*header_].cells;
        if (units_) {
            layout.units = table_rows_[*units_].cells;
            layout.units_line = table_rows_[*units_].line;
        }
        const std::size_t rows = header_ ? (units_ ? *units_ : *header_) + 1 : first_row_;
        if (rows >= table_rows_.size())
            throw EnvironmentError("{}: the table has no rows below the header line", file_.string());
        layout.rows_at = table_rows_[rows].at, layout.rows_line = table_rows_[rows].line;
        layout.table_line = table_rows_[first].line, layout.passed_over = first;
        if (!header_ && first_row_ == 0) take_names_of_comment();
        find_formats();
        return std::move(layout);
    }

  private:
    void look_at_columns() {
        std::vector<std::size_t> numbers(sample_.cells), texts(sample_.cells);
        for (const TableRow& table_row : last_half(sample_)) {
            if (table_row.cells.size() != sample_.cells) continue;
            for (std::size_t j = 0; j < sample_.cells; ++j) {
                numbers[j] += table_row.kinds[j] == CellKind::kNumber || table_row.kinds[j] == CellKind::kDisguised;
                texts[j] += table_row.kinds[j] == CellKind::kText;
            }
        }
        for (std::size_t j = 0; j < sample_.cells; ++j) is_text_.push_back(numbers[j] < texts[j]);
        for (const TableRow& table_row : table_rows_)
            if (is_row(table_row)) columns_ = std::max(columns_, table_row.filled());
        if (columns_ == 0) columns_ = sample_.cells;
    }

    bool is_row(const TableRow& table_row) const {
        return table_row.cells.size() == sample_.cells &&
               (holds(table_row, CellKind::kNumber) || holds(table_row, CellKind::kDisguised)) &&
               !holds(table_row, CellKind::kText);
    }
    /// In a column that is not one of texts.
    bool holds(const TableRow& table_row, CellKind kind) const {
        for (std::size_t j = 0; j < std::min(sample_.cells, table_row.cells.size()); ++j)
            if (!is_text_[j] && table_row.kinds[j] == kind) return true;
        return false;
    }
    bool holds_number(const TableRow& table_row) const { return holds(table_row, CellKind::kNumber); }
    bool holds_text(const TableRow& table_row) const { return holds(table_row, CellKind::kText); }

    /// Row numbers count on from row to row, so that their column needs no name.
    bool first_column_counts() const {
        const std::span<const TableRow> rows = last_half(sample_);
        double before = 0, number = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (parse_number(rows[i].cells.front(), number) != NumberStatus::kNumber) return false;
            if (i > 0 && number != before + 1) return false;
            before = number;
        }
        return rows.size() > 1;
    }

    /// Whether a line has a name for each column, and perhaps for empty columns after them.
    bool names_columns(const TableRow& table_row) {
        const std::size_t size = table_row.cells.size(), filled = table_row.filled();
        if (size == sample_.cells || (filled >= columns_ && filled <= sample_.cells)) return true;
        const bool one_decimal = size == 1 && sample_.separator == ',';  // 1,5 below a single name
        return size + 1 == columns_ && !one_decimal && first_column_counts();
    }

    void find_names() {
        const bool has_numbers = std::ranges::find(is_text_, false) != is_text_.end();
        first_row_ = 0;
        if (!has_numbers) {  // a table of texts: the first line of that length names them
            while (first_row_ < table_rows_.size() && !names_columns(table_rows_[first_row_])) ++first_row_;
            if (first_row_ < table_rows_.size()) header_ = first_row_++;
            return;
        }
        first_row_ = static_cast<std::size_t>(
            std::ranges::find_if(table_rows_, [this](const TableRow& table_row) { return is_row(table_row); }) -
            table_rows_.begin());
        std::vector<std::size_t> wordy;  // lines above that may contain names or units
        for (std::size_t i = 0; i < first_row_; ++i)
            if (!holds_number(table_rows_[i]) && holds_text(table_rows_[i]) && names_columns(table_rows_[i]))
                wordy.push_back(i);
        if (wordy.empty()) {
            const TableRow* above =
                first_row_ > 0 && first_row_ < table_rows_.size() ? &table_rows_[first_row_ - 1] : nullptr;
            mismatch_ = above != nullptr && above->cells.size() > 1 && !holds_number(*above) && !named_;
            return;
        }
        header_ = wordy.back();
        const bool two = wordy.size() > 1 && wordy[wordy.size() - 2] + 1 == *header_;
        if ((two && holds_units(table_rows_[*header_])) || is_below_numbered_channels(*header_))
            units_ = *header_, header_ = *header_ - 1;
        columns_ = std::max(columns_, std::min(sample_.cells, table_rows_[*header_].filled()));
        layout_.numbered_rows = table_rows_[*header_].cells.size() < columns_;
    }

    static bool holds_units(const TableRow& table_row) {
        const auto [units, others] = units_and_others(table_row);
        return units > 0 && units >= others;
    }
    static std::pair<std::size_t, std::size_t> units_and_others(const TableRow& table_row) {
        std::size_t units = 0, others = 0;
        for (const std::string& cell : table_row.cells)
            if (!cell.empty()) ++(is_unit(without_brackets(cell)) ? units : others);
        return {units, others};
    }
    /// Oscilloscopes write: x-axis,1,2 and below it second,Volt,Volt.
    bool is_below_numbered_channels(std::size_t row) const {
        const auto [units, others] = units_and_others(table_rows_[row]);
        if (row == 0 || units < 2 || others > 0) return false;
        const TableRow& above = table_rows_[row - 1];
        return above.cells.size() == table_rows_[row].cells.size() && above.kinds.front() == CellKind::kText;
    }

    void find_formats() {
        std::vector<const std::vector<std::string>*> rows;
        for (const TableRow& table_row : table_rows_)
            if (table_row.at >= layout_.rows_at && table_row.cells.size() == sample_.cells)
                rows.push_back(&table_row.cells);
        layout_.formats = formats_of(rows, columns_, sample_.separator);
    }

    /// A comment right above the rows may hold the names.
    void take_names_of_comment() {
        const auto sample = sample_of(file_, sample_.last_comment, 0, layout_.rows_line - 1, sample_.separator);
        if (!sample || sample->table_rows.size() != 1 || sample_.last_comment.find(':') != std::string::npos) return;
        const TableRow& table_row = sample->table_rows.front();
        if (!holds_number(table_row) && holds_text(table_row) && table_row.cells.size() == columns_) {
            layout_.names = table_row.cells;
            layout_.named_by_comment = true;
        }
    }

    [[noreturn]] void fail_mismatch() const {
        const TableRow& above = table_rows_[first_row_ - 1];
        throw EnvironmentError(
            "{}, line {}: the line has {}, but the rows below it have {}; if the line is not part of the table, use "
            "load(file, {skip = {}})",
            file_.string(), above.line, plural(std::ssize(above.cells), "{} name", "{} names"),
            plural(static_cast<std::int64_t>(columns_), "{} cell", "{} cells"), above.line);
    }

    const std::filesystem::path& file_;
    const TableSample& sample_;
    const std::vector<TableRow>& table_rows_;
    const bool named_;
    TableLayout layout_;
    std::vector<bool> is_text_;  ///< by cell of a row
    std::size_t columns_ = 0;    ///< without those at the end that have neither name nor cells
    std::size_t first_row_ = 0;
    std::optional<std::size_t> header_, units_;
    bool mismatch_ = false;
};

/// How much of the last half is numbers, in rows of equal length; less for one column and where names are missing.
double score_of(const std::filesystem::path& file, const TableSample& sample) {
    double good = 0;
    for (const TableRow& table_row : last_half(sample)) {
        if (table_row.cells.size() != sample.cells) continue;
        std::size_t numbers = 0;
        for (const CellKind kind : table_row.kinds) numbers += kind != CellKind::kText;
        good += 0.5 + 0.5 * static_cast<double>(numbers) / static_cast<double>(sample.cells);
    }
    good /= static_cast<double>(last_half(sample).size());
    constexpr double kOneColumn = 0.45, kWithoutNames = 0.4;
    if (sample.cells == 1) good *= kOneColumn;
    return LayoutFinder(file, sample, false).is_complete() ? good : good * kWithoutNames;
}

/// Throws the error in the quotation marks or the length of a row, or the error that there is no row.
[[noreturn]] void walk_through(const std::filesystem::path& file, std::string_view text, std::size_t at,
                               std::size_t line, char separator) {
    CellScanner scanner(file, text, separator, at, line);
    while (scanner.next_row()) {
        std::size_t cells = 0;
        do {
            if (cells++ == kMaxColumns) fail_wide(file, scanner);
            scanner.next_cell();
        } while (!scanner.row_ended());
    }
    throw EnvironmentError(
        "{}: the file contains no table; expected a header line with the names of the columns, followed by rows of "
        "numbers",
        file.string());
}

}  // namespace

TableLayout find_layout(const std::filesystem::path& file, std::string_view text, std::size_t at, std::size_t line,
                        const ImportOptions& options) {
    std::optional<TableSample> best;
    const std::string_view separators = options.delimiter ? std::string_view(&*options.delimiter, 1) : "\t;,| ";
    for (const char separator : separators) {
        std::optional<TableSample> sample = sample_of(file, text, at, line, separator);
        if (!sample || sample->table_rows.empty()) continue;
        sample->cells = most_frequent_size(*sample);
        sample->score = score_of(file, *sample);
        if (!best || sample->score > best->score) best = std::move(sample);
    }
    if (!best) walk_through(file, text, at, line, separators.front());
    // In a single column, a quotation mark that is never closed, or a row without end, may hide the separator.
    const std::string_view first_line = text.substr(at, text.find('\n', at) - at);
    for (const char separator : separators)
        if (best->cells == 1 && separator != ' ' && first_line.find(separator) != std::string_view::npos &&
            !sample_of(file, text, at, line, separator))
            walk_through(file, text, at, line, separator);
    return LayoutFinder(file, *best, !options.names.empty()).layout();
}

}  // namespace dynlab::inline data_io
