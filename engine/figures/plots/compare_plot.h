#pragma once
#include <optional>
#include <string>
#include <vector>

#include "figures/figure.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline figures {

/// What one model says about measured data.
struct ModelOutput {
    Message name;
    Matrix y;                                         ///< N x ny, at the sampling instants of the data
    Vector fit_percent;                               ///< one per output, for the legend
    std::vector<std::optional<double>> offsets = {};  ///< of each output, where y holds one that was found in the data
};

/// Measured outputs of one experiment against those of several models, one panel per output, fits and offsets in its
/// legend.
/// Throws InvalidArgument for sizes that do not fit the data.
Figure compare_plot(const IdData& data, const std::vector<ModelOutput>& models, std::size_t experiment = 0);

}  // namespace dynlab::inline figures
