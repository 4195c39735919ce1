#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// The data counted from each experiment's operating point, and those points: [experiment][output].
struct CenteredData {
    IdData data;
    std::vector<std::vector<JointOperatingPoint>> removed;
};
CenteredData without_operating_points(const IdData& data);
/// The data as they are, and no points, unless `offset` is kRemove.
CenteredData centered_for(const IdData& data, Offset offset);
/// Adds the removed outputs to the fit's offsets and keeps the points.
void add_operating_points(Fit& fit, std::vector<std::vector<JointOperatingPoint>> removed);

}  // namespace dynlab::inline numerics
