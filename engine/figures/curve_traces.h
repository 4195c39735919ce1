#pragma once
#include "figures/decimation.h"
#include "figures/figure_layout.h"

namespace dynlab::inline figures {

/// What is drawn of one curve, in cm from the lower left corner of its panel's frame, thinned to what 300 dots per inch
/// show. Parts that a style does not need stay empty.
struct CurveTraces {
    Trace line;
    Trace points;        ///< markers; for lines, the isolated samples between gaps
    Trace lower, upper;  ///< the edges of a band
    std::vector<Rectangle> bars;
};
CurveTraces traces_of(const Curve& curve, const PanelLayout& panel);

}  // namespace dynlab::inline figures
