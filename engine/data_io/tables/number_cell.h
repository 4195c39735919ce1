#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline data_io {

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed_cell(std::string_view text);

enum class NumberStatus { kNumber, kMissing, kNotANumber, kNotFinite, kOutOfRange };

/// Reads a whole cell as a number, whatever the locale: also "1,5", and an exponent written with D. Missing (then
/// `number` is NaN) are an empty cell and what programs write for one: NaN, NA, N/A, null, -, ?, and the error values
/// of spreadsheets (#N/A, #DIV/0!, ...).
NumberStatus parse_number(std::string_view cell, double& number);

/// A number with signs between its thousands: "1,234.5", "1.234,5", "1 234,5" (any blank), "1'234.5".
struct GroupedNumber {
    char sign;           ///< , . ' or a blank, of whatever width
    std::size_t groups;  ///< of three digits
    double number;
};
std::optional<GroupedNumber> grouped_number(std::string_view cell);

/// A number and what follows it: "12.5 %" and "3.2V". `rest` is empty for other texts.
struct NumberAndRest {
    double number = 0;
    std::string_view rest = {};
};
NumberAndRest number_and_rest(std::string_view cell);

}  // namespace dynlab::inline data_io
