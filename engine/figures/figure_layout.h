#pragma once
#include <vector>

#include "figures/axis.h"
#include "figures/figure.h"
#include "figures/figure_text.h"

namespace dynlab::inline figures {

/// A rectangle of the page, cm from its lower left corner.
struct Rectangle {
    double left = 0, bottom = 0, right = 0, top = 0;
    double width() const { return right - left; }
    double height() const { return top - bottom; }
};

/// A legend entry: sample from x to x + style::kLegendSample at height y, text right of it.
struct LegendEntry {
    std::size_t curve;
    std::string text;
    double size;  ///< of its type, points
    double x, y;
};

/// A text with the page position of its middle.
struct CenteredText {
    FittedText text;
    double x = 0, y = 0;
};

struct PanelLayout {
    Rectangle box;  ///< the frame
    Axis x, y;
    bool x_numbers = true;  ///< false where the panel below carries them for both
    std::vector<LegendEntry> legend;
    CenteredText title, x_label, y_label;
    double exponent_x = 0, exponent_y = 0;  ///< height of the text "×10^n" of either axis
};

/// Where everything of a figure goes: frames aligned in rows and columns, margins just wide enough for the texts.
struct FigureLayout {
    double width, height;
    CenteredText title;
    std::vector<PanelLayout> panels;
};
FigureLayout lay_out(const Figure& figure);

}  // namespace dynlab::inline figures
