#include "documents/pdf/content_paths.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace dynlab::inline documents {
namespace {

enum class CharacterKind : std::uint8_t { kOfWords, kWhiteSpace, kDelimiter };

constexpr std::array<CharacterKind, 256> kKinds = [] {
    std::array<CharacterKind, 256> kinds{};
    for (const unsigned char c : {'\0', '\t', '\n', '\f', '\r', ' '}) kinds[c] = CharacterKind::kWhiteSpace;
    for (const unsigned char c : {'(', ')', '<', '>', '[', ']', '{', '}', '/', '%'})
        kinds[c] = CharacterKind::kDelimiter;
    return kinds;
}();

CharacterKind character_kind(char c) {
    return kKinds[static_cast<unsigned char>(c)];
}

bool is_plain_number(std::string_view word) {
    return std::ranges::all_of(word, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; });
}

/// How many numbers an operator of paths takes; nothing for any other word.
std::optional<int> numbers_of_path(std::string_view word) {
    if (word == "m" || word == "l") return 2;
    if (word == "v" || word == "y" || word == "re") return 4;
    if (word == "c") return 6;
    if (word.size() == 1 && std::string_view("hSsfFBbnW").find(word[0]) != std::string_view::npos) return 0;
    if (word == "f*" || word == "B*" || word == "b*" || word == "W*") return 0;
    return std::nullopt;
}

bool shows_strings(std::string_view word) {
    return word == "Tj" || word == "TJ" || word == "'" || word == "\"";
}

/// Where the string in parentheses that begins at `at` ends.
std::size_t end_of_literal(std::string_view content, std::size_t at) {
    int depth = 0;
    for (; at < content.size(); ++at) {
        if (content[at] == '\\')
            ++at;
        else if (content[at] == '(')
            ++depth;
        else if (content[at] == ')' && --depth == 0)
            return at + 1;
    }
    return content.size();
}

}  // namespace

std::string without_paths(std::string_view content) {
    std::string rest, open;                 // open: arrays and dictionaries
    std::size_t kept = 0;                   // up to here content is in `rest` or left out
    std::size_t operands = content.size();  // where those of the next operator begin
    int numbers = 0;                        // of them
    bool only_numbers = true, in_text = false;
    const auto is_operand = [&](std::size_t begin, bool number) {
        operands = std::min(operands, begin);
        only_numbers = only_numbers && number;
        ++numbers;
    };
    for (std::size_t at = 0; at < content.size();) {
        const char c = content[at];
        const std::string_view two = content.substr(at, 2);
        if (character_kind(c) == CharacterKind::kWhiteSpace) {
            ++at;
        } else if (c == '%') {
            at = std::min(content.find_first_of("\r\n", at), content.size());
        } else if (c == '(') {
            is_operand(at, false);
            at = end_of_literal(content, at);
        } else if (c == '[' || two == "<<") {
            is_operand(at, false);
            open += c;
            at += c == '[' ? 1 : 2;
        } else if (c == ']' || two == ">>") {
            if (!open.ends_with(c == ']' ? '[' : '<')) return std::string(content);
            open.pop_back();
            at += c == ']' ? 1 : 2;
        } else if (c == '<') {
            is_operand(at, false);
            at = std::min(content.find('>', at), content.size() - 1) + 1;
        } else if (c != '/' && character_kind(c) == CharacterKind::kDelimiter) {
            return std::string(content);
        } else {
            const std::size_t begin = at++;
            while (at < content.size() && character_kind(content[at]) == CharacterKind::kOfWords) ++at;
            const std::string_view word = content.substr(begin, at - begin);
            const bool named = c == '/' || word == "true" || word == "false" || word == "null";
            if (named || is_plain_number(word)) {
                is_operand(begin, !named);
                continue;
            }
            if (!open.empty()) return std::string(content);
            if (word == "BI") break;
            if (word == "BT" || word == "ET") in_text = word == "BT";
            if (shows_strings(word) && !in_text) return std::string(content);
            if (const std::optional<int> requested = numbers_of_path(word)) {
                if (!only_numbers || numbers != *requested || in_text) return std::string(content);
                rest.append(content, kept, std::min(operands, begin) - kept);
                kept = at;
            }
            operands = content.size();
            numbers = 0;
            only_numbers = true;
        }
    }
    return rest.append(content, kept, content.size() - kept);
}

}  // namespace dynlab::inline documents
