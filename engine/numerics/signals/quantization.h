#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// How finely a signal was recorded.
struct Quantization {
    double step = 0;   ///< all samples lie on a grid of this width; 0 when they lie on none
    Index levels = 0;  ///< different values
};

/// Finds the grid of a recorded signal: the smallest distance between different samples, when all distances are whole
/// multiples of it to within 2 % of a step and the samples are at least twice as many as the different values.
Quantization quantization_of(const VectorView& x);

}  // namespace dynlab::inline numerics
