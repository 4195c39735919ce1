#include "documents/characters.h"

#include <fmt/format.h>

#include <charconv>

namespace dynlab::inline documents {
namespace {

constexpr char32_t kInvalid = 0xFFFFFFFF;

/// Takes the first character off `text` (not empty); kInvalid, taking one byte, when it is not UTF-8.
char32_t next_character(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
    char32_t character = length <= 1 ? first : first & (0x7Fu >> length);
    bool valid = length > 0 && length <= text.size();
    for (std::size_t i = 1; valid && i < length; ++i) {
        valid = byte(i) >> 6 == 2;
        character = (character << 6) | (byte(i) & 0x3Fu);
    }
    const char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    valid = valid && character >= least[length] && character <= 0x10FFFF && (character < 0xD800 || character > 0xDFFF);
    text.remove_prefix(valid ? length : 1);
    return valid ? character : kInvalid;
}

bool is_control(char32_t c) {
    return (c < 0x20 && c != '\n' && c != '\t' && c != '\r') || (c >= 0x7F && c < 0xA0);
}

/// The T1 and TS1 encodings as LaTeX declares them (t1enc.dfu, ts1enc.dfu), as ranges.
bool is_in_latex_fonts(char32_t c) {
    static const std::pair<char32_t, char32_t> ranges[] = {
        {0x00A0, 0x0125}, {0x0128, 0x0130}, {0x0134, 0x0137}, {0x0139, 0x013E}, {0x0141, 0x0148}, {0x014A, 0x0165},
        {0x0168, 0x017E}, {0x0218, 0x021B}, {0x2012, 0x2016}, {0x2018, 0x201A}, {0x201C, 0x201E}, {0x2020, 0x2022},
        {0x2030, 0x2030}, {0x2039, 0x203A}, {0x20AC, 0x20AC}, {0xFB00, 0xFB04}};
    for (const auto& [first, last] : ranges)
        if (c >= first && c <= last) return true;
    return false;
}

std::string shown(char32_t c) {
    std::string utf8;
    if (c < 0x800) {
        utf8 = {static_cast<char>(0xC0 | (c >> 6)), static_cast<char>(0x80 | (c & 0x3F))};
    } else if (c < 0x10000) {
        utf8 = {static_cast<char>(0xE0 | (c >> 12)), static_cast<char>(0x80 | ((c >> 6) & 0x3F)),
                static_cast<char>(0x80 | (c & 0x3F))};
    } else {
        utf8 = {static_cast<char>(0xF0 | (c >> 18)), static_cast<char>(0x80 | ((c >> 12) & 0x3F)),
                static_cast<char>(0x80 | ((c >> 6) & 0x3F)), static_cast<char>(0x80 | (c & 0x3F))};
    }
    return utf8;
}

}  // namespace

PrintableCharacters PrintableCharacters::of_latex(const std::string& characters_tex) {
    PrintableCharacters result;
    const std::string_view declaration = "\\DeclareUnicodeCharacter{";
    for (std::size_t at = characters_tex.find(declaration); at != std::string::npos;
         at = characters_tex.find(declaration, at)) {
        at += declaration.size();
        std::uint32_t code = 0;
        std::from_chars(characters_tex.data() + at, characters_tex.data() + characters_tex.size(), code, 16);
        result.declared_.insert(static_cast<char32_t>(code));
    }
    return result;
}

PrintableCharacters PrintableCharacters::of_html() {
    PrintableCharacters result;
    result.everything_ = true;
    return result;
}

bool PrintableCharacters::can_print(char32_t c) const {
    if (is_control(c)) return false;
    return everything_ || c < 0x7F || is_in_latex_fonts(c) || declared_.count(c) > 0;
}

std::optional<std::string> PrintableCharacters::complaint(std::string_view text) const {
    while (!text.empty()) {
        const char32_t c = next_character(text);
        if (c == kInvalid) return "this is not UTF-8 text; save the file with the encoding UTF-8";
        if (can_print(c)) continue;
        const std::string code = fmt::format("U+{:04X}", static_cast<std::uint32_t>(c));
        if (is_control(c)) return "the control character " + code + " cannot be printed; remove it";
        if (c >= 0x0300 && c <= 0x036F)
            return "the combining accent " + code +
                   " cannot be printed; type the letter with its accent as one character";
        return "the character \"" + shown(c) + "\" (" + code +
               ") cannot be printed by LaTeX; write it in words or as a formula between dollar signs";
    }
    return std::nullopt;
}

}  // namespace dynlab::inline documents
