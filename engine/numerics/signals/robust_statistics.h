#pragma once
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The middle of the values, of an even number the mean of the two in the middle. Needs at least one.
double median(std::vector<double> values);
double median(const VectorView& values);
/// The value below which `part` of the rising values lie, by linear interpolation. Needs at least one value.
double quantile_of_sorted(const VectorView& values, double part);
/// The root of the mean square of what is left without the mean.
double standard_deviation(const VectorView& x);

/// Standard deviation of white noise on a smooth signal: 1.4826 times the median of its second differences, over
/// sqrt(6). Slopes and a few outliers do not enter; 0 for fewer than three samples.
double noise_from_differences(const VectorView& x);

}  // namespace dynlab::inline numerics
