#pragma once
#include <string>

#include "figures/figure.h"

namespace dynlab::inline figures::style {

/// The house style, in one place. Lengths in cm on the page, type sizes and line widths in points.

inline constexpr const char* kTextFont = "Latin Modern Roman";  ///< the document's own type
inline constexpr const char* kMathFont = "Latin Modern Math";   ///< Greek and operators, which the text font lacks
inline constexpr double kTextSize = 9, kTickSize = 8, kTitleSize = 10;

inline constexpr double kPointsPerCm = 72.0 / 2.54;
inline constexpr double kTextLine = 0.42;     ///< height of a line of text with its leading
inline constexpr double kTickLine = 0.36;     ///< the same for the numbers on the axes
inline constexpr double kTickLength = 0.1;    ///< outside the frame
inline constexpr double kGap = 0.12;          ///< between neighboring parts
inline constexpr double kLegendSample = 0.8;  ///< the piece of line beside a legend's text

inline constexpr const char* kFrameColor = "#404040";
inline constexpr const char* kGridColor = "#dddddd";
inline constexpr const char* kReferenceColor = "#606060";
inline constexpr const char* kAnnotationColor = "#202020";
inline constexpr double kBandEdgeWidth = 0.4;  ///< for panels with several bands
inline constexpr double kFrameWidth = 0.45, kGridWidth = 0.3, kReferenceWidth = 0.55, kArrowWidth = 0.5;

/// Places in the marker list with a fixed meaning.
inline constexpr int kOpenCircle = 4, kCross = 8;
/// Poles are cross, plus, asterisk; zeros open circle, square, triangle: a pair for each of three models.
inline constexpr int kPoleMarkers = 3;
/// The gray beyond the palette's own eight colors, for measured data and guiding curves.
inline constexpr int kGrayColor = 8;

/// How a curve looks, by its index among its panel's curves.
struct CurveAppearance {
    std::string color;  ///< "#rrggbb"
    std::string dash;   ///< gnuplot's dash type
    int point_type;     ///< gnuplot's number
};

/// Colors after Okabe and Ito (2008), ordered so that neighbors differ in luminance and stay apart for color-blind
/// readers and in gray print; dash pattern and marker change with the color, and again where the colors repeat.
CurveAppearance appearance_of(const Curve& curve, int index);
/// Gives a curve the look of the one with this index regardless of its place, unless its color was chosen.
void fix_appearance(Curve& curve, int index);
std::string dash_pattern(int dash);
/// Size and line of a curve's markers, in gnuplot's units of size and in points: a wide line makes markers larger
/// rather than bolder.
double marker_size(const Curve& curve);
double marker_line(const Curve& curve);

}  // namespace dynlab::inline figures::style
