#include "platform/terminal/terminal_text.h"

#include <algorithm>

#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

/// Letters of other languages among them: a shell means nothing by their bytes.
bool is_plain_to_a_shell(unsigned char c) {
    constexpr std::string_view kSigns = "_-./:@%+=,";
    return c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           kSigns.find(static_cast<char>(c)) != std::string_view::npos;
}

}  // namespace

bool is_terminal_control(char32_t c) {
    const bool invisible = (c >= 0x2060 && c <= 0x2064) || c == 0x180E || c == 0xFEFF || c == 0x115F || c == 0x1160 ||
                           c == 0x3164 || c == 0xFFA0 || (c >= 0xE0000 && c <= 0xE007F);
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x061C || (c >= 0x200B && c <= 0x200F) ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == kNoCharacter || invisible;
}

std::string terminal_text(std::string_view utf8) {
    std::string result;
    while (!utf8.empty()) {
        const std::string_view before = utf8;
        const char32_t c = next_character(utf8);
        if (is_terminal_control(c) && c != U'\n' && c != U'\t')
            result += '?';
        else
            result += before.substr(0, before.size() - utf8.size());
    }
    return result;
}

std::string terminal_line(std::string_view utf8) {
    std::string line = terminal_text(utf8);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    return line;
}

std::string shell_word(const std::string& word) {
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain_to_a_shell)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace dynlab::inline platform
