#pragma once
#include "figures/figure_layout.h"

namespace dynlab::inline figures {

/// Left and right edges of a bar (x units): halfway to its neighbors.
std::pair<double, double> bar_edges(const Vector& centers, Index i);

/// Axes of a panel whose frame has the given size (cm): the given ranges, else ranges that hold all curves, references,
/// marks and arrows; numbers as many as there is room for, and
/// more than one where there is.
void choose_axes(const Panel& panel, double width, double height, Axis& x, Axis& y);

}  // namespace dynlab::inline figures
