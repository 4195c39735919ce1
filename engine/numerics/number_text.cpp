#include "numerics/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace dynlab {

std::string number_text(double value, int significant_digits) {
    std::array<char, 64> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, significant_digits);
    return {text.data(), end.ptr};
}

std::string number_text(std::complex<double> value, int significant_digits) {
    const std::string real = number_text(value.real(), significant_digits);
    if (value.imag() == 0) return real;
    const std::string imaginary = number_text(std::abs(value.imag()), significant_digits) + "i";
    return real + (value.imag() < 0 ? " - " : " + ") + imaginary;
}

}  // namespace dynlab
