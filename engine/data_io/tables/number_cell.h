#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline data_io {

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed_cell(std::string_view text);

enum class NumberStatus { kNumber, kMissing, kNotANumber, kNotFinite, kOutOfRange };

/// Reads a whole cell as a number, whatever the locale. `decimal_comma` also accepts "1,5"; an exponent may be written
/// with D. Missing (then `number` is NaN) are an empty cell and what programs write for one: NaN, NA, N/A, null, -, ?,
/// and the error values of spreadsheets (#N/A, #DIV/0!, ...).
NumberStatus parse_number(std::string_view cell, bool decimal_comma, double& number);

/// Where a cell stands, for messages.
struct CellPlace {
    const std::filesystem::path& file;
    std::size_t line;
    const std::string& column;  ///< its name
};

/// Throws EnvironmentError for a cell that is no number: says what is wrong with it, and what to write.
[[noreturn]] void refuse_cell(const CellPlace& place, std::string_view cell, bool decimal_comma);

/// Digits with both points and commas, as in "1.234,5": a number with signs between its thousands, not a text.
bool looks_grouped(std::string_view cell);

}  // namespace dynlab::inline data_io
