#include "course/plain_words.h"

#include <cctype>

namespace dynlab {
namespace {

/// U+00C0 to U+00FF without accents.
constexpr std::string_view kLatin = "aaaaaaaceeeeiiiidnooooo ouuuuypsaaaaaaaceeeeiiiidnooooo ouuuuypy";

static_assert(kLatin.size() == 64);

/// Takes the first character off `text`; U+FFFD for broken UTF-8.
char32_t next_character(std::string_view& text) {
    const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    char32_t character = length == 1 ? first : length == 0 ? 0xFFFD : first & (0x7F >> length);
    bool whole = length > 0 && length <= text.size();
    for (std::size_t i = 1; whole && i < length; ++i) {
        whole = (byte(i) & 0xC0) == 0x80;
        character = character << 6 | (byte(i) & 0x3F);
    }
    text.remove_prefix(whole ? length : 1);
    return whole ? character : 0xFFFD;
}

std::string folded_character(char32_t c) {
    if (c < 0x80) return {static_cast<char>(std::isalpha(static_cast<int>(c)) ? std::tolower(static_cast<int>(c)) : c)};
    if (c == 0xC6 || c == 0xE6) return "ae";
    if (c >= 0xC0 && c <= 0xFF) return {kLatin[c - 0xC0]};
    if (c == 0x152 || c == 0x153) return "oe";
    if (c == 0x2018 || c == 0x2019) return "'";
    if (c >= 0x2010 && c <= 0x2015) return "-";
    if (c == 0xAD || (c >= 0x300 && c < 0x370)) return "";  // soft hyphen, combining accents
    constexpr const char* kLigatures[] = {"ff", "fi", "fl", "ffi", "ffl"};
    if (c >= 0xFB00 && c <= 0xFB04) return kLigatures[c - 0xFB00];
    return " ";
}

}  // namespace

std::string folded(std::string_view utf8) {
    std::string result;
    while (!utf8.empty()) result += folded_character(next_character(utf8));
    return result;
}

std::vector<std::string> plain_words(std::string_view utf8) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : folded(utf8) + " ") {
        if (std::isalnum(static_cast<unsigned char>(c))) {
            word += c;
        } else if (c != '-' && !word.empty()) {
            words.push_back(std::move(word));
            word.clear();
        }
    }
    return words;
}

std::string printable(std::string_view utf8, std::size_t most) {
    std::string result;
    std::size_t count = 0;
    while (!utf8.empty()) {
        if (count++ == most) return result + "…";
        const std::string_view before = utf8;
        const char32_t c = next_character(utf8);
        const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xFFFD || (c >= 0x200B && c <= 0x200F) ||
                             (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
        result += control ? "?" : std::string(before.substr(0, before.size() - utf8.size()));
    }
    return result;
}

}  // namespace dynlab
