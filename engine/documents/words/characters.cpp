#include "documents/words/characters.h"

#include <fmt/format.h>

#include <charconv>

#include "platform/utf8.h"

namespace dynlab::inline documents {
namespace {

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

}  // namespace

PrintableCharacters PrintableCharacters::of_latex(const std::string& declarations) {
    PrintableCharacters result;
    const std::string_view declaration = "\\DeclareUnicodeCharacter{";
    for (std::size_t at = declarations.find(declaration); at != std::string::npos;
         at = declarations.find(declaration, at)) {
        at += declaration.size();
        std::uint32_t code = 0;
        std::from_chars(declarations.data() + at, declarations.data() + declarations.size(), code, 16);
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

std::optional<Message> PrintableCharacters::complaint(std::string_view text) const {
    while (!text.empty()) {
        const std::optional<char32_t> taken = take_character(text);
        if (!taken) return Message("the file is not UTF-8 text; save the file with UTF-8 encoding");
        if (is_control(*taken))
            return Message("the control character {} cannot be printed; remove the character", code_of(*taken));
    }
    return std::nullopt;
}

std::string code_of(char32_t character) {
    return fmt::format("U+{:04X}", static_cast<std::uint32_t>(character));
}

}  // namespace dynlab::inline documents
