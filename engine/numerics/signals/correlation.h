#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Sums of products over an uninterrupted record: entry i (0-based) is sum_k x(k + i - lags) y(k) over all k for which
/// both exist, so that the middle entry is x'y and later ones have x behind y. 2 lags + 1 values, zero beyond the
/// record. Direct for few lags, by fast Fourier transforms for many. Throws InvalidArgument for lengths that differ,
/// no samples, or negative lags.
Vector lagged_products(const VectorView& x, const VectorView& y, Index lags);

}  // namespace dynlab::inline numerics
