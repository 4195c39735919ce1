#include "figures/figure_text.h"

#include <re2/re2.h>

#include <algorithm>
#include <array>

#include "figures/style.h"
#include "platform/utf8.h"

namespace dynlab::inline figures {
namespace {

using Level = TextPiece::Level;

constexpr std::size_t kMaxTextLength = 200;
constexpr double kScriptSize = 0.8;  // gnuplot's size of raised and lowered text

char32_t printable(char32_t c) {
    if (c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029) return U' ';
    if (c == kNoCharacter) return U'?';
    if (c == 0xA0 || c == 0x202F) return U' ';  // fit_text has not broken the line there
    if (c == U'\'') return U'’';  // as LaTeX prints it; and no text holds the quote that ends gnuplot's strings
    const bool directs_text = (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
    if (directs_text || c == 0xFEFF || (c & 0xFFFE) == 0xFFFE) return U' ';  // not allowed in SVG, or reorders the rest
    return c;
}

std::u32string decode(std::string_view bytes) {
    std::u32string text;
    while (!bytes.empty()) {
        if (text.size() == kMaxTextLength) return text + U'…';
        text += printable(next_character(bytes));
    }
    return text;
}

bool needs_math_font(char32_t c) {
    return (c >= 0x3AA && c <= 0x3FF) || (c >= 0x2190 && c <= 0x22FF && c != 0x2212) || (c >= 0x27C0 && c <= 0x2AFF) ||
           (c >= 0x1D400 && c <= 0x1D7FF) || c == 0x2113;
}

/// Raised and lowered digits and signs of Unicode as ordinary ones.
struct Script {
    char32_t plain;
    Level level;
};
Script script_of(char32_t c) {
    constexpr std::u32string_view kSigns = U"+−=()";
    if (c == U'⁰' || (c >= U'⁴' && c <= U'⁹')) return {U'0' + (c - U'⁰'), Level::kRaised};
    if (c == U'¹') return {U'1', Level::kRaised};
    if (c == U'²' || c == U'³') return {U'2' + (c - U'²'), Level::kRaised};
    if (c >= U'⁺' && c <= U'⁾') return {kSigns[c - U'⁺'], Level::kRaised};
    if (c >= U'₀' && c <= U'₉') return {U'0' + (c - U'₀'), Level::kLowered};
    if (c >= U'₊' && c <= U'₎') return {kSigns[c - U'₊'], Level::kLowered};
    return {c, Level::kLine};
}

void append(std::vector<TextPiece>& pieces, char32_t c, Level level) {
    const Script script = script_of(c);
    if (level == Level::kLine) level = script.level;
    const bool combining = script.plain >= 0x300 && script.plain < 0x370 && !pieces.empty();
    const bool math = combining ? pieces.back().math_font : needs_math_font(script.plain);
    if (pieces.empty() || pieces.back().level != level || pieces.back().math_font != math)
        pieces.push_back({U"", level, math});
    pieces.back().text += script.plain;
}

double character_width(char32_t c) {
    // Widths of Latin Modern Roman 10 in thousandths of the type size, from space to tilde.
    static constexpr std::array<short, 95> kWidths = {
        333, 278, 374, 833, 500, 833, 778, 278, 389, 389, 500, 778, 278, 333, 278, 500, 500, 500,  500,
        500, 500, 500, 500, 500, 500, 500, 278, 278, 778, 778, 778, 472, 778, 750, 708, 722, 764,  681,
        653, 785, 750, 361, 514, 778, 625, 917, 750, 778, 681, 778, 736, 556, 722, 750, 750, 1028, 750,
        750, 611, 278, 500, 278, 556, 750, 500, 500, 556, 444, 556, 444, 306, 500, 556, 278, 306,  528,
        278, 833, 556, 500, 556, 528, 392, 394, 389, 556, 528, 722, 528, 528, 444, 500, 278, 500,  556};
    if (c >= 0x20 && c < 0x7F) return kWidths[c - 0x20] / 1000.0;
    if (c >= 0x300 && c < 0x370) return 0;
    if (c == U'°') return 0.375;
    if (c == U'−' || c == U'×' || c == U'±' || c == U'·') return 0.778;
    if (c >= 0x2E80) return 1.0;
    return c < 0x2000 ? 0.56 : 0.7;
}

/// One line, cut with an ellipsis to fit `length` cm.
std::string cut_text(const std::string& text, double length, double size) {
    if (text_width(text, size) <= length) return text;
    std::u32string kept = decode(text);
    while (kept.size() > 1 && text_width(utf8_of(kept + U'…'), size) > length) kept.pop_back();
    return utf8_of(kept + U'…');
}

/// Smaller type for lines of which the widest is `widest` long; what is still longer than `length` is cut.
FittedText made_smaller(FittedText text, double widest, double length) {
    constexpr double kMinValue = 0.7;
    text.size *= std::clamp(length / widest, kMinValue, 1.0);
    for (std::string& line : text.lines) line = cut_text(line, length, text.size);
    return text;
}

}  // namespace

std::vector<TextPiece> text_pieces(std::string_view utf8) {
    const std::u32string text = decode(utf8);
    std::vector<TextPiece> pieces;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool opens = (text[i] == U'_' || text[i] == U'^') && i + 1 < text.size() && text[i + 1] == U'{';
        const std::size_t close = opens ? text.find(U'}', i + 2) : std::u32string::npos;
        if (close == std::u32string::npos) {
            append(pieces, text[i], Level::kLine);
            continue;
        }
        const Level level = text[i] == U'_' ? Level::kLowered : Level::kRaised;
        for (std::size_t k = i + 2; k < close; ++k) append(pieces, text[k], level);
        i = close;
    }
    return pieces;
}

std::string with_marked_indices(const std::string& text) {
    // The character after an index may precede the next one, so that the search continues at it.
    static const RE2 index(
        R"((?:^|[^A-Za-z0-9_])([A-Za-z]_|(?:[A-Za-z]*|[0-9]+)\^-?)([A-Za-z0-9]{1,2})(?:[^A-Za-z0-9_{]|$))",
        RE2::Latin1);
    const auto place = [&](const char* at) { return static_cast<std::size_t>(at - text.data()); };
    std::string marked;
    std::size_t rest = 0;
    for (re2::StringPiece part[3]; index.Match(text, rest, text.size(), RE2::UNANCHORED, part, 3);) {
        const bool minus = part[1].ends_with("-");
        marked +=
            text.substr(rest, place(part[1].end()) - minus - rest) + (minus ? "{−" : "{") + part[2].as_string() + "}";
        rest = place(part[2].end());
    }
    return marked + text.substr(rest);
}

double text_width(std::string_view utf8, double size) {
    double em = 0;
    for (const TextPiece& piece : text_pieces(utf8))
        for (const char32_t c : piece.text)
            em += character_width(c) * (piece.level == Level::kLine ? 1.0 : kScriptSize);
    return em * size / style::kPointsPerCm;
}

FittedText fit_line(const std::string& text, double length, double size) {
    return made_smaller({{text}, size}, text_width(text, size), length);
}

FittedText fit_text(const std::string& text, double length, double size) {
    FittedText fitted{{text}, size};
    double widest = text_width(text, size);
    if (widest <= length) return fitted;
    for (std::size_t space = text.find(' '); space != std::string::npos; space = text.find(' ', space + 1)) {
        const std::string first = text.substr(0, space), second = text.substr(space + 1);
        const double width = std::max(text_width(first, size), text_width(second, size));
        if (width >= widest) continue;
        widest = width;
        fitted.lines = {first, second};
    }
    return made_smaller(std::move(fitted), widest, length);
}

std::string gnuplot_quoted(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    return quoted + "'";
}

std::string gnuplot_text(std::string_view utf8) {
    std::string marked;
    for (const TextPiece& piece : text_pieces(utf8)) {
        std::string escaped;
        for (const char c : utf8_of(piece.text)) {
            if (std::string_view("\\{}^_@&~").find(c) != std::string_view::npos) escaped += '\\';
            escaped += c;
        }
        if (piece.math_font) escaped = std::string("{/'") + style::kMathFont + "' " + escaped + "}";
        if (piece.level != Level::kLine) escaped = (piece.level == Level::kRaised ? "^{" : "_{") + escaped + "}";
        marked += escaped;
    }
    return gnuplot_quoted(marked);
}

}  // namespace dynlab::inline figures
