#include "base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace dynlab::inline base {

std::string number_text(double value, int significant_digits) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Inf" : "-Inf";
    if (value == 0) return "0";  // without the sign of a negative zero
    std::array<char, 64> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, significant_digits);
    return {text.data(), end.ptr};
}

}  // namespace dynlab::inline base
