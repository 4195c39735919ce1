#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline figures {

/// Text of a figure in pieces of one kind. Scripts write plain Unicode; `x_{max}` and `e^{-t}` (with braces) lower and
/// raise text; all other characters are literal.
struct TextPiece {
    enum class Level { kLine, kLowered, kRaised };
    std::u32string text;
    Level level = Level::kLine;
    bool math_font = false;  ///< letters the text font lacks (Greek, operators)
};

/// Bytes that are not UTF-8 become question marks, control characters spaces; text beyond 200 characters is cut with
/// an ellipsis. Raised and lowered Unicode digits become raised and lowered pieces.
std::vector<TextPiece> text_pieces(std::string_view utf8);

/// Indices and exponents that people write without braces, marked with them: t_1, x_k, G_c, y^2, s^-1, m/s^2. An index
/// belongs to a single letter, so that names such as time_ms stay.
std::string with_marked_indices(const std::string& text);

/// Width in cm when set at `size` points in the text font.
double text_width(std::string_view utf8, double size);

/// Text broken and, where that is not enough, made smaller so that it fits a length of the page.
struct FittedText {
    std::vector<std::string> lines;
    double size;
};
/// At most two lines, broken where they come out most alike; down to 70 % of `size`, then cut.
FittedText fit_text(const std::string& text, double length, double size);
/// The same for a single line.
FittedText fit_line(const std::string& text, double length, double size);

/// The text as a gnuplot string: single quotes, inside which gnuplot substitutes nothing, with apostrophes printed as
/// LaTeX prints them and every character escaped that enhanced text mode would read as markup.
std::string gnuplot_text(std::string_view utf8);
/// For strings gnuplot does not typeset (absolute file names): quotes doubled.
std::string gnuplot_quoted(std::string_view text);

}  // namespace dynlab::inline figures
