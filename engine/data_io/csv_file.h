#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/tables/column_format.h"
#include "data_io/tables/import_options.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

/// A table of columns with a name each. Written, it has `# key: value` lines (units as `# unit <column>: s`, sampling
/// time as `# Ts: 0.01`), one line of column names, then rows with commas.
struct CsvTable {
    std::vector<std::string> names;
    /// Numeric columns by place, NaN where a cell is empty; a column Ts of length 1 where only its first row has a
    /// number; empty where `texts` holds the column.
    std::vector<Vector> columns;
    std::map<std::string, std::vector<std::string>> texts;  ///< text columns by name
    std::map<std::string, std::string> units;               ///< column -> unit
    std::optional<double> Ts;                               ///< seconds
    std::map<std::string, std::string> remarks;             ///< the other key: value lines
    std::map<std::string, std::string> headers = {};        ///< as the file has them -> name, where they differ
    std::map<std::string, ClockForms> clocks = {};          ///< of columns of times: seconds since midnight or 1970
    std::vector<Message> notes = {};                        ///< sentences on what was guessed and may be wrong
};

/// Reads a separated text in the variants that programs write: comma, semicolon, tab, bar or blanks between cells; RFC
/// 4180 quoting; decimal commas if the comma is no separator; lines above the table, `sep=;`, comments (# or %)
/// anywhere, a row of units, units in headers, no line of names (then c1, c2, ...), rows that end in a separator, a
/// first column without name (index), equal names (numbered), empty cells and the words for missing numbers (NaN);
/// UTF-8, UTF-16, Windows-1252. `notes` lists the assumptions, unless `options` state them. Throws EnvironmentError
/// with file, line and column, and the expected text: a row of another length, text in a column of numbers (in which at
/// least half of the first cells are numbers), values that are not finite, no rows, a unit or name for a missing
/// column.
CsvTable read_csv_file(const std::filesystem::path& file, const ImportOptions& options = {});
/// The same from the file's bytes; `file` is for messages.
CsvTable read_csv_text(const std::filesystem::path& file, std::string bytes, const ImportOptions& options = {});

/// Writes a comma-separated table, whole or not at all; throws InvalidArgument for columns of different lengths and
/// values that are not finite. Writes numbers with 7 significant digits unless `digits` says otherwise (17 keeps every
/// bit).
void write_csv_file(const std::filesystem::path& file, const CsvTable& table, int digits = 7);

}  // namespace dynlab::inline data_io
