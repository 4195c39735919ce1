#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Sums of products over an uninterrupted signal: entry i (0-based) is sum_k x(k + i - lags) y(k) over all k for which
/// both exist, so that the middle entry is x'y and later entries pair y with later values of x. 2 lags + 1 values, zero
/// beyond the ends. The computation is direct for few lags, and by fast Fourier transforms for many. Throws
/// InvalidArgument for lengths that differ, no samples, or negative lags.
Vector lagged_products(const VectorView& x, const VectorView& y, Index lags);

/// sum_k x(k) y(k - lag) over all samples of x, lags 0..last. `y` points at the sample that belongs to the first one of
/// x at lag 0; the caller vouches for the `last` samples before it and those beside x.
Vector products_behind(const VectorView& x, const double* y, Index last);

}  // namespace dynlab::inline numerics
