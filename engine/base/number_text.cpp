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

std::string counted(std::int64_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

}  // namespace dynlab::inline base
