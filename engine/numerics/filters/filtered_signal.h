#pragma once
#include <vector>

#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

/// A SampledSystem driven by a signal of N samples. The caller owns the signal.
struct FilteredSignal {
    SampledSystem system;
    Eigen::Map<const Vector> signal;
};

/// A weighted sum of outputs, of different signals as well.
struct OutputSum {
    struct Term {
        Index output;
        double weight;
    };
    std::vector<Term> terms;
};

}  // namespace dynlab::inline numerics
