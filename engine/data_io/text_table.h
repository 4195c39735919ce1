#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline data_io {

/// A table of texts: rosters, deadlines, mark lists. Nothing is taken for a number, so that "007" stays what it is.
struct TextTable {
    std::vector<std::string> names;              ///< of the columns, lower case, as the first line has them
    std::vector<std::vector<std::string>> rows;  ///< as long as `names` each
    std::vector<int> lines;                      ///< of the file, on which each row begins
    bool converted = false;                      ///< the file was not UTF-8 and was read as Windows-1252 (Latin-1)

    std::optional<std::size_t> column(std::string_view name) const;
};

/// Reads comma, semicolon or tab separated text (RFC 4180 quoting, CR LF; UTF-8 with or without byte order mark, else
/// Windows-1252, as spreadsheets save it). Blanks around cells are taken off; short rows are filled with empty cells.
/// Throws EnvironmentError with file and line: no header, a column name twice, a row that is too long, quotes that do
/// not close, UTF-16.
TextTable read_text_table(const std::filesystem::path& file);

/// The number in a whole cell, with a point or a comma before its decimals; nothing for anything else.
std::optional<double> number_in_cell(const std::string& cell);

/// RFC 4180 text with commas and CR LF. What a spreadsheet would take for a formula (= + - @, tab or CR first, also
/// behind a semicolon, tab or line end within a cell, where other countries' settings begin a new one) gets an
/// apostrophe in front, plain numbers excepted.
std::string csv_text(const TextTable& table);
/// One cell of such a text.
std::string csv_cell(const std::string& given);
/// What csv_text was given for a cell that read_text_table has read: without those apostrophes.
std::string as_written(const std::string& cell);

}  // namespace dynlab::inline data_io
