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
/// as possible of curves, markers, lines and each other. Where the panel wants names beside its curves and the layout
/// has no legend, those as well.
std::vector<PlacedLabel> place_labels(const Panel& panel, const PanelLayout& layout,
                                      const std::vector<CurveTraces>& curves);

/// Whether every named curve has room for its name at a place where the name covers nothing and is clearly nearer to
/// its curve than to any other. False for bands and bars, which have no line for a name.
bool names_find_places(const Panel& panel, const PanelLayout& layout);

}  // namespace dynlab::inline figures
