#pragma once
#include <complex>
#include <string>

namespace dynlab {

/// A number as messages and model displays show it: so many significant digits, no trailing zeros ("0.05").
std::string number_text(double value, int significant_digits = 5);
/// "-1 + 2i"; a real number when the imaginary part is zero.
std::string number_text(std::complex<double> value, int significant_digits = 5);

}  // namespace dynlab
