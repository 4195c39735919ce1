#pragma once
#include <string>

namespace dynlab::inline base {

/// A number as messages and displays show it: that many significant digits (at most 17), no trailing zeros ("0.05"),
/// no sign of a zero, and "NaN", "Inf" or "-Inf" where there is no number.
std::string number_text(double value, int significant_digits = 5);

}  // namespace dynlab::inline base
