#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// Replaces each byte that is not UTF-8 (RFC 3629: overlong forms, surrogates and values beyond U+10FFFF are not) and
/// each half of a pair in UTF-16.
inline constexpr char32_t kNoCharacter = 0xFFFD;

/// Takes the first character off `utf8`, which is not empty; nothing, and one byte taken, where it is not UTF-8.
std::optional<char32_t> take_character(std::string_view& utf8);
bool is_utf8(std::string_view text);
/// The same with kNoCharacter for what is not UTF-8; of UTF-16, with kNoCharacter for half a pair.
char32_t next_character(std::string_view& utf8);
char32_t next_character(std::u16string_view& utf16);

std::u32string characters_in(std::string_view utf8);
std::u16string utf16_of(std::string_view utf8);

/// UTF-8 of characters; kNoCharacter for what is none.
std::string utf8_of(char32_t character);
std::string utf8_of(std::u32string_view characters);
std::string utf8_of(std::u16string_view utf16);

/// Cells of a terminal that a text takes: none for combining accents and signs without width, two for wide characters
/// of East Asian scripts (UAX #11).
std::size_t columns_of(char32_t character);
std::size_t columns_of(std::string_view utf8);

/// A letter without accent, in lower case: "É" -> "e", "Ł" -> "l", "Æ" -> "ae"; ligatures, full-width and mathematical
/// letters as their plain letters (the compatibility decomposition of Unicode, UAX #15); decimal digits of any script
/// -> 0 to 9 (UTF-8). Letters without a plain form are returned unchanged; "" for any other character, also raised and
/// lowered ones, which mark a footnote.
std::string folded_letter(char32_t character);

/// What leaves no trace when letters are compared: accents on their own or combining, the soft hyphen, signs without
/// width and those that direct the text.
bool is_ignorable(char32_t character);

/// A script by its name and its code (UAX #24, ISO 15924): "Devanagari", "Deva". Both are empty for characters that
/// several scripts share: digits, signs, most accents.
struct Script {
    std::string name, code;
};
Script script_of(char32_t character);

bool is_right_to_left(char32_t character);  ///< a letter of a script that is written so
bool is_mark(char32_t character);           ///< an accent or a vowel sign that combines with the letter before it
bool is_capital(char32_t character);        ///< of a script that knows capitals
bool is_ideograph(char32_t character);      ///< of a script that writes words without spaces: each is a word

}  // namespace dynlab::inline platform
