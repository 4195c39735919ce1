#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The monic filter 1 a_1 .. a_n that leaves of a signal only what its past does not tell, from its sums of products
/// `r` at lags 0 .. n (order + 1 values at least). Levinson-Durbin recursion, which ends early (zeros follow) when less
/// than 1e-6 of the power is left to predict.
Vector whitening_filter(const Vector& r, Index order);

/// The same for one signal, counted from its mean, of the order 0 .. `highest` with the smallest BIC. No filter (order
/// 0) for a constant signal and for fewer than three samples per order.
Vector whitening_filter_of(const VectorView& x, Index highest);

/// a_0 x(k) + a_1 x(k - 1) + ... for all k whose past is recorded: x.size() - a.size() + 1 values.
Vector filtered_past(const Vector& a, const VectorView& x);

}  // namespace dynlab::inline numerics
