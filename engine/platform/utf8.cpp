#include "platform/utf8.h"

#include <unicode/utf16.h>
#include <unicode/utf8.h>

#include <array>
#include <cstdint>

namespace dynlab::inline platform {
namespace {

constexpr std::size_t kMaxCharacterBytes = 4;  ///< bytes

}  // namespace

std::optional<char32_t> take_character(std::string_view& utf8) {
    const std::string_view first = utf8.substr(0, kMaxCharacterBytes);
    const auto bytes = reinterpret_cast<const std::uint8_t*>(first.data());
    std::int32_t length = 0;
    UChar32 c = 0;
    U8_NEXT(bytes, length, static_cast<std::int32_t>(first.size()), c);
    utf8.remove_prefix(c < 0 ? 1 : static_cast<std::size_t>(length));
    return c < 0 ? std::nullopt : std::optional(static_cast<char32_t>(c));
}

bool is_utf8(std::string_view text) {
    while (!text.empty())
        if (!take_character(text)) return false;
    return true;
}

char32_t next_character(std::string_view& utf8) {
    return take_character(utf8).value_or(kNoCharacter);
}

char32_t next_character(std::u16string_view& utf16) {
    const std::u16string_view first = utf16.substr(0, 2);
    std::int32_t length = 0;
    UChar32 c = 0;
    U16_NEXT(first.data(), length, static_cast<std::int32_t>(first.size()), c);
    utf16.remove_prefix(static_cast<std::size_t>(length));
    return U_IS_SURROGATE(c) ? kNoCharacter : static_cast<char32_t>(c);
}

std::u32string characters_in(std::string_view utf8) {
    std::u32string characters;
    while (!utf8.empty()) characters += next_character(utf8);
    return characters;
}

std::u16string utf16_of(std::string_view utf8) {
    std::u16string units;
    while (!utf8.empty()) {
        const char32_t c = next_character(utf8);
        if (U_IS_SUPPLEMENTARY(c)) units += static_cast<char16_t>(U16_LEAD(c));
        units += static_cast<char16_t>(U_IS_SUPPLEMENTARY(c) ? U16_TRAIL(c) : c);
    }
    return units;
}

std::string utf8_of(char32_t character) {
    if (character > 0x10FFFF || U_IS_SURROGATE(character)) character = kNoCharacter;
    std::array<std::uint8_t, kMaxCharacterBytes> bytes{};
    std::size_t length = 0;
    U8_APPEND_UNSAFE(bytes.data(), length, static_cast<std::uint32_t>(character));
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)};
}

std::string utf8_of(std::u32string_view characters) {
    std::string utf8;
    for (const char32_t c : characters) utf8 += utf8_of(c);
    return utf8;
}

std::string utf8_of(std::u16string_view utf16) {
    std::string utf8;
    while (!utf16.empty()) utf8 += utf8_of(next_character(utf16));
    return utf8;
}

}  // namespace dynlab::inline platform
