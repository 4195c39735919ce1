#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

#include "data_io/csv_file.h"
#include "data_io/tables/number_cell.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"

namespace dynlab::inline data_io {
namespace {

std::string quoted_where_needed(const std::string& text) {
    if (text.find_first_of(",;|\t\"\r\n#%") == std::string::npos && trimmed_cell(text) == text) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

/// Number of rows; throws unless every column has it.
std::size_t checked_rows(const CsvTable& table) {
    std::size_t rows = 0;
    std::set<std::string_view> known;
    for (std::size_t i = 0; i < table.names.size(); ++i) {
        if (!known.insert(table.names[i]).second) {
            throw InvalidArgument("two columns are named {}; each column needs a different name", table.names[i]);
        }
        const auto text = table.texts.find(table.names[i]);
        if (text == table.texts.end() && i >= table.columns.size()) {
            throw InvalidArgument("column {} has a name but no data", table.names[i]);
        }
        const std::size_t here =
            text != table.texts.end() ? text->second.size() : static_cast<std::size_t>(table.columns[i].size());
        if (i > 0 && here != rows) {
            throw InvalidArgument(
                "columns of a table must have equal lengths, but the length of {} is {} and the length of {} is {}",
                table.names[0], rows, table.names[i], here);
        }
        rows = here;
    }
    if (rows == 0) throw InvalidArgument("a table needs at least one column and one row");
    return rows;
}

void append_number(std::string& out, double number, int digits, const std::string& column, std::size_t row) {
    if (!std::isfinite(number)) {
        throw InvalidArgument("column {} has a value in row {} that is not finite", column, row + 1);
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

void write_csv_file(const std::filesystem::path& file, const CsvTable& table, int digits) {
    if (digits < 1 || digits > 17) {
        throw InvalidArgument("the number of significant digits must be from 1 to 17, but {} was given", digits);
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
