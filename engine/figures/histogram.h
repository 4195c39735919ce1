#pragma once
#include <optional>

#include "figures/figure.h"

namespace dynlab::inline figures {

/// Bins of equal width; a value on an edge belongs to the bin right of it, the largest value to the last.
struct HistogramBins {
    Vector edges;   ///< bins + 1
    Vector counts;  ///< sums to the number of values
};

/// Number of bins after Freedman and Diaconis (1981): width 2 IQR N^(-1/3), with quartiles interpolated between order
/// statistics; the square root of N where the quartiles coincide. Between 1 and 200. Needs finite values.
Index freedman_diaconis_bins(const VectorView& values);
HistogramBins histogram_bins(const VectorView& values, Index bins);
/// Bins between given edges (two or more, of equal width); a value beyond them belongs to the first or the last. There
/// may be no values.
HistogramBins histogram_bins(const VectorView& values, const Vector& edges);

struct HistogramOptions {
    Index bins = 0;               ///< after Freedman and Diaconis when 0
    std::optional<Vector> edges;  ///< of the bins, of equal width; bins is of no account then
    std::optional<double> truth;  ///< marked by a line
    Message label, x_label, y_label = Message("count"), truth_label = Message("true value");
};

/// Throws InvalidArgument for no values without edges, and for values that are not finite.
Figure histogram(const VectorView& values, const HistogramOptions& options = {});

}  // namespace dynlab::inline figures
