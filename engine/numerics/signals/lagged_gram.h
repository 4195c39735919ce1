#pragma once
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Columns of a regression: the signal s late by `first_lag`, by one sample more, and so on, `count` of them:
/// weight s(k - first_lag - i) in the row k.
struct LaggedColumns {
    VectorView signal;
    Index first_lag = 0, count = 1;
    double weight = 1;
};

/// The sums of products M'M of such columns over the rows `first` .. `first` + `rows` - 1 (0-based, every lag reaches
/// into the signals). The products of two signals at all their lags follow from those with one of them at its first lag
/// by adding a product at the beginning and taking one off at the end, so the cost is rows x columns rather than
/// rows x columns^2; where that would cost digits (a signal that grows by magnitudes) every sum is made by itself.
/// The caller vouches for the ranges.
Matrix lagged_gram(const std::vector<LaggedColumns>& columns, Index first, Index rows);

}  // namespace dynlab::inline numerics
