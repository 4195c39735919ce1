#include "figures/style.h"

#include <algorithm>
#include <array>

namespace dynlab::inline figures::style {
namespace {

constexpr std::array kPalette = {"#0072B2", "#E69F00", "#202020", "#009E73", "#882255",
                                 "#56B4E9", "#D55E00", "#CC79A7", "#8C8C8C"};
constexpr std::array kDashOfColor = {0, 1, 3, 2, 4, 5, 6, 7, 0};
/// Filled circle, square, triangle, diamond, the same four open, cross, plus, asterisk.
constexpr std::array kPointTypes = {7, 5, 9, 13, 6, 4, 8, 12, 2, 1, 3};
/// The markers of curves; in clouds of small points a diamond looks like a circle, plus and asterisk do not.
constexpr std::array kMarkerOfColor = {0, 5, 2, 9, 1, 4, 10, 6, 0};

template <class List>
auto pick(const List& list, int index) {
    const int size = static_cast<int>(list.size());
    return list[static_cast<std::size_t>(((index % size) + size) % size)];
}

}  // namespace

std::string dash_pattern(int dash) {
    static constexpr std::array kPatterns = {"solid",  "(9,4)",         "(2,3)", "(9,3,2,3)",
                                             "(16,9)", "(9,3,2,3,2,3)", "(4,5)", "(18,3,2,3)"};
    return pick(kPatterns, dash);
}

CurveAppearance appearance_of(const Curve& curve, int index) {
    const int color = curve.color.value_or(index % kGrayColor);
    const int round = curve.color ? 0 : index / kGrayColor;  // the ninth curve has the first one's color alone
    return {pick(kPalette, color), dash_pattern(curve.dash.value_or(pick(kDashOfColor, color) + round)),
            pick(kPointTypes, curve.marker.value_or(pick(kMarkerOfColor, color + round)))};
}

void fix_appearance(Curve& curve, int index) {
    const int color = index % kGrayColor, round = index / kGrayColor;
    if (curve.color) return;
    curve.color = color;
    if (round == 0) return;
    if (!curve.dash) curve.dash = pick(kDashOfColor, color) + round;
    if (!curve.marker) curve.marker = pick(kMarkerOfColor, color + round);
}

double marker_size(const Curve& curve) {
    return 0.4 * std::clamp(curve.line_width / 0.9, 0.7, 3.0);
}

double marker_line(const Curve& curve) {
    return std::clamp(0.8 * curve.line_width, 0.6, 0.9);
}

}  // namespace dynlab::inline figures::style
