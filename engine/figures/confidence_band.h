#pragma once
#include <limits>

#include "figures/figure.h"
#include "figures/named_model.h"

namespace dynlab::inline figures {

/// "99 % confidence"
Message confidence_text(double level);

/// Adds the band value +- half width around the curve `line` of a panel, in its color. The first band of a panel is
/// named in the legend. Samples without a width of at most `max_half_width` become gaps: what is not determined is no
/// band.
void add_confidence_band(Panel& panel, std::size_t line, const Vector& half_width, double level,
                         double max_half_width = std::numeric_limits<double>::max());

/// If the uncertainty is large, the panel shows only the part of the bands that keeps its first `lines` curves
/// readable: half their height, and at least `min_padding`, beyond them.
void limit_to_readable(Panel& panel, std::size_t lines, double min_padding);

/// Numbers on a phase axis every 15, 30, 45, 90 ... degrees, at least four of them, over at least 60 degrees.
void choose_phase_axis(Panel& phase);

/// Gives every curve of the panel the color of its index, which bands added later must not move.
void fix_colors(Panel& panel);

}  // namespace dynlab::inline figures
