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
/// into the signals). The products of two signals at all their lags follow from those with one of them at its first
/// lag: one product is added at the beginning and one subtracted at the end. The cost is therefore rows x columns
/// instead of rows x columns^2. If that would cost digits (a signal that grows by magnitudes), every sum is computed
/// separately. The caller must ensure that the ranges are valid.
Matrix lagged_gram(const std::vector<LaggedColumns>& columns, Index first, Index rows);

}  // namespace dynlab::inline numerics
