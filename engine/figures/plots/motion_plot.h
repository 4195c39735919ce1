#pragma once
#include <string>

#include "figures/figure.h"
#include "figures/moving_plant.h"

namespace dynlab::inline figures {

/// The signals that move a plant, one column per part, at increasing instants t in seconds. Either may be empty.
struct MotionData {
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

/// A plant at some instants, each drawing at its instant on the time axis, above the signals that move it; dotted lines
/// mark the instants. Measured motion is gray, behind simulated motion. Throws InvalidArgument for sizes that do not
/// fit, or instants outside the data.
Figure motion_plot(const PlantDrawing& plant, const MotionData& motion_data, const MotionAppearance& look = {});

}  // namespace dynlab::inline figures
