#pragma once
#include <optional>
#include <string>
#include <vector>

#include "figures/curve_traces.h"

namespace dynlab::inline figures {

/// A text inside a frame: middle of its line, cm from the frame's lower left corner; with a thin line to the point it
/// belongs to when it had to move away.
struct PlacedLabel {
    std::string text;
    double x, y;
    std::optional<PagePoint> leader_from, leader_to;
};

/// Finds places for the texts of references, arrows and marks where they stay inside the frame and cover as little
/// as possible of curves, markers, lines and each other.
std::vector<PlacedLabel> place_labels(const Panel& panel, const PanelLayout& layout,
                                      const std::vector<CurveTraces>& curves);

}  // namespace dynlab::inline figures
