#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab {

/// A table of columns with a name each. In the file: optional `# key: value` lines (units as `# unit
/// <column>: s`, sampling time as `# Ts: 0.01`), one line of column names, then rows. Separators: comma,
/// semicolon or tab, found by looking at the header line. RFC 4180 quoting.
struct CsvTable {
    std::vector<std::string> names;
    std::vector<Vector> columns;  ///< numeric columns by place; empty where `texts` holds the column
    std::map<std::string, std::vector<std::string>> texts;  ///< text columns by name
    std::map<std::string, std::string> units;               ///< column -> unit
    std::optional<double> Ts;                               ///< seconds
    std::map<std::string, std::string> remarks;             ///< the other key: value lines
};

/// Throws EnvironmentError with file, line and column: a ragged row, text where a number belongs (a column is
/// text only if its first row is), no header, no rows, NaN or infinite values.
CsvTable read_csv_file(const std::filesystem::path& file);
/// Writes numbers with 7 significant digits unless `digits` says otherwise (17 keeps every bit).
void write_csv_file(const std::filesystem::path& file, const CsvTable& table, int digits = 7);

}  // namespace dynlab
