#include "platform/terminal/terminal_text.h"

namespace dynlab::inline platform {

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

bool is_obeyed(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x061C || (c >= 0x200B && c <= 0x200F) ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0xFFFD;
}

std::string terminal_text(std::string_view utf8) {
    std::string result;
    while (!utf8.empty()) {
        const std::string_view before = utf8;
        const char32_t c = next_character(utf8);
        if (is_obeyed(c) && c != U'\n' && c != U'\t')
            result += '?';
        else
            result += before.substr(0, before.size() - utf8.size());
    }
    return result;
}

}  // namespace dynlab::inline platform
