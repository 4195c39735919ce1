#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"
#include "data_io/tables/table_layout.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

struct TableColumn {
    Vector numbers;                  ///< NaN where a cell is empty; none of a column of texts
    std::vector<std::string> texts;  ///< of a column of texts
    std::size_t missing = 0, first_missing_line = 0;
    ClockForms clocks = {};
};

/// The rows of a table.
struct TableRows {
    std::vector<TableColumn> columns;
    std::size_t count = 0;
    std::vector<Message> notes = {};  ///< on what was left out or read as another thing
};

/// Reads the rows of a laid out text. Lines below the last row that begin with a text where the table has a number,
/// such as END or a block of statistics, are left out, with a note. Throws EnvironmentError with file, line and column:
/// a row of another length, a cell that is not written as the others of its column, more memory than a file of this
/// size may take.
TableRows read_table_rows(const std::filesystem::path& file, std::string_view text, const TableLayout& layout,
                          const std::vector<std::string>& names);

}  // namespace dynlab::inline data_io
