#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

/// A table of columns with a name each. In the file: optional `# key: value` lines (units as `# unit
/// <column>: s`, sampling time as `# Ts: 0.01`), one line of column names, then rows. Separators: comma,
/// semicolon or tab, found by looking at the header line. RFC 4180 quoting. Numbers may be written with a decimal
/// comma where the separator is another character. A byte order mark, CR LF and blank lines are accepted.
struct CsvTable {
    std::vector<std::string> names;
    std::vector<Vector> columns;  ///< numeric columns by place; empty where `texts` holds the column
    std::map<std::string, std::vector<std::string>> texts;  ///< text columns by name
    std::map<std::string, std::string> units;               ///< column -> unit
    std::optional<double> Ts;                               ///< seconds
    std::map<std::string, std::string> remarks;             ///< the other key: value lines
};

/// Throws EnvironmentError with file, line and column: a ragged row, text where a number belongs (a column is
/// text only if its first row is), an empty cell in a column of numbers, no header, no rows, NaN or infinite values,
/// a unit for a column that does not exist.
CsvTable read_csv_file(const std::filesystem::path& file);
/// Writes a comma-separated table, whole or not at all; throws InvalidArgument for columns of different lengths and
/// values that are not finite. Writes numbers with 7 significant digits unless `digits` says otherwise (17 keeps every
/// bit).
void write_csv_file(const std::filesystem::path& file, const CsvTable& table, int digits = 7);

}  // namespace dynlab::inline data_io
