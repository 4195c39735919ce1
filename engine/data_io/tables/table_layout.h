#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "data_io/tables/column_format.h"
#include "data_io/tables/import_options.h"

namespace dynlab::inline data_io {

/// How the table in a separated text is laid out.
struct TableLayout {
    char separator = ',';               ///< ' ' for blanks and tabs
    std::vector<std::string> names;     ///< as the file has them, some perhaps empty; none when it has no line of names
    std::vector<std::string> units;     ///< of the row below the names, one a column; none when there is no such row
    std::vector<ColumnFormat> formats;  ///< of the columns; rows may have more cells, which are empty
    bool numbered_rows = false;         ///< the first column holds the rows' numbers and has no name
    bool named_by_comment = false;      ///< a comment directly above the rows contains the names
    std::size_t rows_at = 0, rows_line = 1;       ///< where the rows begin: byte and line
    std::size_t table_line = 1;                   ///< of the names, or of the first row without such a line
    std::size_t passed_over = 0, units_line = 0;  ///< lines above the table; line of the row of units
};

/// Finds separator, names, units and rows from the first 300 lines or so, beginning at byte `at` in line `line`. The
/// separator is the one (of tab ; , | and blanks) with which most cells of the last half of these lines are numbers in
/// equally long rows; the line of names is the last one without numbers above the first whole row. Throws
/// EnvironmentError with file and line: no rows, names of another number than the cells below.
TableLayout find_layout(const std::filesystem::path& file, std::string_view text, std::size_t at, std::size_t line,
                        const ImportOptions& options);

}  // namespace dynlab::inline data_io
