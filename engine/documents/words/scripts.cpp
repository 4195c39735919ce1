#include "documents/words/scripts.h"

#include <algorithm>

#include "platform/utf8.h"

namespace dynlab::inline documents {
namespace {

constexpr int kMinGreekWordLength = 4;  // letters; shorter ones are symbols: Δω
constexpr char32_t kLeftToRightMark = 0x200E;
const std::set<std::string> kOfSigns = {"Symbols=zyyy", "Symbols2=zyyy"};  // arrows, pictures, dingbats

bool is_greek(char32_t c) {
    return c > 0x7F && script_of(c).code == "Grek";
}

/// The first letter of the first Greek word.
std::optional<char32_t> first_greek_word(std::string_view text) {
    char32_t first = 0;
    int letters = 0;
    while (!text.empty()) {
        const char32_t c = next_character(text);
        if (!is_greek(c)) {
            letters = 0;
            continue;
        }
        if (letters == 0) first = c;
        if (++letters == kMinGreekWordLength) return first;
    }
    return std::nullopt;
}

std::optional<char32_t> first_unprintable(const PrintableCharacters& pdflatex, std::string_view text) {
    while (!text.empty())
        if (const char32_t c = next_character(text); c > 0x7F && !pdflatex.can_print(c)) return c;
    return std::nullopt;
}

bool has_greek_words(const PrintableCharacters& pdflatex, std::string_view text) {
    const auto beyond = letters_beyond(pdflatex, text);
    return std::ranges::any_of(beyond, is_greek) || first_greek_word(text);
}

/// The characters that may separate two words of one name.
bool is_between_words(char32_t c) {
    return c == ' ' || c == '~' || c == '-' || c == '\'' || c == '.';
}

/// Bytes from the right-to-left letter at the beginning of `text` to the last one of its phrase.
std::size_t length_of_phrase(std::string_view text) {
    std::size_t length = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const char32_t c = next_character(rest);
        if (is_right_to_left(c) || is_mark(c))
            length = text.size() - rest.size();
        else if (!is_between_words(c))
            break;
    }
    return length;
}

bool is_row(std::string_view line) {
    return line.find(" & ") != std::string_view::npos;
}

}  // namespace

std::optional<char32_t> first_beyond(const PrintableCharacters& pdflatex, std::string_view text) {
    const auto letter = first_unprintable(pdflatex, text);
    return letter ? letter : first_greek_word(text);
}

std::set<char32_t> letters_beyond(const PrintableCharacters& pdflatex, std::string_view text) {
    std::set<char32_t> letters;
    while (!text.empty())
        if (const char32_t c = next_character(text); c > 0x7F && !pdflatex.can_print(c)) letters.insert(c);
    return letters;
}

std::set<std::string> scripts_of(const PrintableCharacters& pdflatex, std::string_view text) {
    const bool greek = has_greek_words(pdflatex, text);
    std::set<std::string> scripts;
    while (!text.empty()) {
        const char32_t c = next_character(text);
        if (c <= 0x7F) continue;
        Script script = script_of(c);
        if (script.name.empty() && !pdflatex.can_print(c)) scripts.insert(kOfSigns.begin(), kOfSigns.end());
        if (script.name.empty() || script.name == "Latin" || (script.name == "Greek" && !greek)) continue;
        script.code[0] = static_cast<char>(script.code[0] - 'A' + 'a');
        scripts.insert(script.name + "=" + script.code);
    }
    return scripts;
}

std::string without_directions(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::string_view before = text;
        const char32_t c = next_character(text);
        const bool directs =
            (c >= 0x200C && c <= 0x200F) || (c >= 0x202A && c <= 0x202E) || (c >= 0x2060 && c <= 0x2069) || c == 0xFEFF;
        if (!directs) result += before.substr(0, before.size() - text.size());
    }
    return result;
}

std::set<char32_t> characters_beyond_ascii(std::string_view text) {
    std::set<char32_t> characters;
    while (!text.empty())
        if (const char32_t c = next_character(text); c > 0x7F) characters.insert(c);
    return characters;
}

std::string with_direction_marks(std::string_view latex) {
    constexpr std::string_view kLink = "\\href{";
    const std::string mark = utf8_of(kLeftToRightMark);
    std::string result;
    std::size_t after_line = latex.size() + 1;  // bytes that are left behind the line that `row` is about
    bool row = false;
    while (!latex.empty()) {
        if (latex.size() < after_line) {
            const std::string_view line = latex.substr(0, latex.find('\n'));
            row = is_row(line);
            after_line = latex.size() - line.size();
        }
        if (latex.starts_with(kLink)) {
            const std::size_t end = std::min(latex.find('}'), latex.size());
            result += latex.substr(0, end);
            latex.remove_prefix(end);
            continue;
        }
        std::string_view rest = latex;
        if (is_right_to_left(next_character(rest))) {
            const std::size_t length = length_of_phrase(latex);
            const std::string phrase = mark + std::string(latex.substr(0, length)) + mark;
            result += row ? "\\mbox{" + phrase + "}" : phrase;
            latex.remove_prefix(length);
        } else {
            result += latex.substr(0, latex.size() - rest.size());
            latex = rest;
        }
    }
    return result;
}

std::string without_letters(std::string_view text, const std::set<char32_t>& letters) {
    std::string result;
    while (!text.empty()) {
        const std::string_view before = text;
        const char32_t c = next_character(text);
        if (!letters.contains(c))
            result += before.substr(0, before.size() - text.size());
        else if (!is_mark(c))
            result += "?";
    }
    return result;
}

}  // namespace dynlab::inline documents
