#pragma once
#include <string>

#include "base/reader.h"

namespace dynlab::inline figures {
struct Figure;
}

namespace dynlab::inline documents {

/// A figure as report_templates/html/plot.js draws it: JSON (ASCII, nothing in it can end an HTML element) with the
/// layout of the printed figure in cm from the lower left corner (figures/figure_layout.h), its texts, ticks and looks,
/// and the samples of its curves in their units, rounded to 1e-5 of the axis range. A curve with more than 4000 samples
/// keeps those that a frame of 1000 columns needs (figures/decimation.h), from half a frame left of it to half a frame
/// right of it, and states its original number of samples. A figure with a moving plant contains the plant's parts and
/// pieces, for motion.js. Texts and numbers are the reader's. Throws the errors of Figure::validate for a figure that
/// cannot be drawn.
std::string plot_data(const Figure& figure, const Reader& reader = {});

}  // namespace dynlab::inline documents
