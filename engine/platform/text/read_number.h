#pragma once
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace dynlab::inline platform {

/// The number that the whole text is, as std::from_chars reads it ("." for decimals, no blanks and no "+" before it;
/// whole ones in `base`, default 10); nothing for other text and for numbers that the type does not hold.
template <class Number, class... Base>
std::optional<Number> read_number(std::string_view text, Base... base) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number, base...);
    return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace dynlab::inline platform
