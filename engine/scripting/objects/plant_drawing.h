#pragma once
#include <string>

#include "figures/moving_plant.h"

namespace dynlab::inline scripting {

/// The drawing of a moving plant, report_templates/drawings/NAME.lua with its table `motion`, as documents show it
/// (report_templates/filters/shapes.lua). Throws InvalidArgument, which lists the drawings, for a name without one.
PlantDrawing plant_drawing(const std::string& name);

}  // namespace dynlab::inline scripting
