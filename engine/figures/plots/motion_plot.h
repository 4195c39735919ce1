#pragma once
#include <string>

#include "figures/figure.h"
#include "figures/moving_plant.h"

namespace dynlab::inline figures {

/// What moves a rig: its parts' signals, one column a part, at instants t in seconds that rise. Either may be empty.
struct MotionRecord {
    Vector t;
    Matrix measured, simulated;
};

struct MotionAppearance {
    Vector instants;  ///< of the pictures, s; default: four, evenly spread
    Message title;
    double width_cm = 14, height_cm = 0;
};

/// So many samples a second are kept at most, of those nearer to each other the first: what eyes and screens follow.
inline constexpr double kMaxPictures = 50;

/// A rig at some instants, each standing where its instant lies on the axis of time, above the signals that move it;
/// dotted lines mark the instants. What is measured is gray, behind what is simulated. Throws InvalidArgument for sizes
/// that do not fit, instants outside the record.
Figure motion_plot(const PlantDrawing& plant, const MotionRecord& record, const MotionAppearance& look = {});

}  // namespace dynlab::inline figures
