#include "platform/text/shell_word.h"

#include <algorithm>
#include <string_view>

namespace dynlab::inline platform {
namespace {

/// Letters of other languages among them: a shell means nothing by their bytes.
bool is_plain_to_a_shell(unsigned char c) {
    constexpr std::string_view kSigns = "_-./:@%+=,";
    return c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           kSigns.find(static_cast<char>(c)) != std::string_view::npos;
}

}  // namespace

std::string shell_word(const std::string& word) {
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain_to_a_shell)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace dynlab::inline platform
