#include "platform/text/plain_words.h"

#include <cctype>

#include "platform/terminal/terminal_text.h"
#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

bool is_ascii(char c) {
    return static_cast<unsigned char>(c) < 0x80;
}

/// Of one beyond ASCII.
std::string folded_character(char32_t c) {
    if (c == 0x2018 || c == 0x2019) return "'";
    if (c >= 0x2010 && c <= 0x2015) return "-";
    if (c == 0xAD || (c >= 0x300 && c < 0x370)) return "";  // soft hyphen, combining accents
    const std::string letters = folded_letter(c);
    if (!letters.empty() && is_ascii(letters.front())) return letters;
    return " ";
}

}  // namespace

std::string folded(std::string_view utf8) {
    std::string result;
    while (!utf8.empty()) {
        if (!is_ascii(utf8.front())) {
            result += folded_character(next_character(utf8));
            continue;
        }
        result += static_cast<char>(std::tolower(utf8.front()));
        utf8.remove_prefix(1);
    }
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

std::string printable(std::string_view utf8, std::size_t max_characters) {
    std::string result;
    std::size_t count = 0;
    while (!utf8.empty()) {
        if (count++ == max_characters) return result + "…";
        const std::string_view before = utf8;
        const char32_t c = next_character(utf8);
        result += is_terminal_control(c) ? "?" : std::string(before.substr(0, before.size() - utf8.size()));
    }
    return result;
}

}  // namespace dynlab::inline platform
