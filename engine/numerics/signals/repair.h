#pragma once
#include <optional>
#include <vector>

#include "numerics/signals/segments.h"

namespace dynlab::inline numerics {

/// A signal with some samples replaced, and which these were.
struct RepairedSignal {
    Vector signal;
    std::vector<Index> replaced;     ///< 1-based, increasing
    std::vector<Segment> stretches;  ///< the same, neighbors joined
};

enum class FillMethod { kLinear, kPrevious };

/// Samples that are not finite numbers (NaN marks a missing one) become points of the straight line between their
/// neighbors (kLinear, for a sampled output), or hold the sample before them (kPrevious, for an input that is logged
/// when it changes); at the ends the nearest sample. `t` holds increasing instants, or nothing for regular sampling.
/// Throws InvalidArgument when there is no finite sample, for instants of another number or order, and for a gap of
/// more than `max_gap` samples, 10 for kLinear by default: a straight line over a long gap is invention.
RepairedSignal fill_missing(const VectorView& x, const VectorView& t = Vector(), std::optional<Index> max_gap = {},
                            FillMethod method = FillMethod::kLinear);

struct OutlierOptions {
    Index window = 7;      ///< samples of the moving median, odd, at least 3; groups of up to (window - 1)/2 are found
    double threshold = 6;  ///< robust standard deviations that an outlier lies off the median
    std::optional<double> quantization = {};  ///< step on which the samples lie, 0 for none; default: detected

    void validate() const;
};

/// Hampel's rule: a sample is an outlier if its distance from the median of the samples around it exceeds the threshold
/// times the scatter. Linear interpolation between its good neighbors replaces it. The scatter is the larger of 1.4826
/// times the median distance inside the window (so that fast parts of the signal are not suspected) and the noise of
/// the entire signal, 1.4826 times the median of its second differences over sqrt(6). A change of up to one and a half
/// quantization steps never counts, except in a constant signal from which one sample in a hundred or fewer differ. A
/// step stays, because a median does not change it. Throws InvalidArgument for samples that are not finite. Reference:
/// Pearson (2002), Outliers in process modeling and identification, IEEE Transactions on Control Systems Technology 10.
RepairedSignal replace_outliers(const VectorView& x, const OutlierOptions& options = {});

}  // namespace dynlab::inline numerics
