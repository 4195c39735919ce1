#pragma once
#include <cstdint>
#include <string>

namespace dynlab::inline base {

/// A number as messages and displays show it: that many significant digits (at most 17), no trailing zeros ("0.05"),
/// no sign of a zero, and "NaN", "Inf" or "-Inf" where there is no number.
std::string number_text(double value, int significant_digits = 5);

/// "1 sample", "2 samples"; with `many` where that is not `one` and an s: "2 people".
std::string counted(std::int64_t count, const std::string& one, const std::string& many = "");

}  // namespace dynlab::inline base
