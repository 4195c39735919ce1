#pragma once
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Exact simulation of a proper y = B(p)/A(p) u(t - delay) with derivatives with respect to every coefficient:
/// A = p^n + a_1 p^(n-1) + ... + a_n, B = b_0 p^m + ... + b_m, 0 <= m <= n, n >= 1. Zero state and zero input before
/// the first sample; `hold` says how u behaves between samples. One filter of order 2n, the cascade of 1/A with itself,
/// gives everything without a discretization error:
///     dy/da_i = -p^(n-i) B/A^2 u,   dy/db_j = p^(m-j)/A u,   dy/d delay = -p B/A u.
/// With m = n - 1 the last one jumps where a zero-order-held input does: when the delay is a multiple of Ts, the
/// value just after the jump is given. With m = n the output itself jumps there, which its derivative leaves out.
/// Each function takes a sampling time (s) or the instants `t` of irregular sampling, strictly increasing;
/// all throw InvalidArgument for an improper B/A or one without poles.

/// N outputs.
Vector transfer_response(const VectorView& num, const VectorView& den, double delay, const VectorView& u, double Ts,
                         Hold hold);
Vector transfer_response(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                         const VectorView& t, Hold hold);

/// N x (n + m + 3): y, then its derivatives with respect to a_1..a_n, b_0..b_m, delay.
Matrix transfer_sensitivities(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                              double Ts, Hold hold);
Matrix transfer_sensitivities(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                              const VectorView& t, Hold hold);

/// The free responses A(p) y = 0 over N samples: column j (0-based) starts from d^j y/dt^j = 1, all other derivatives
/// below n zero. N x n.
Matrix free_responses(const VectorView& den, Index N, double Ts);
Matrix free_responses(const VectorView& den, const VectorView& t);

/// N x n: derivatives with respect to a_1..a_n of the free response that starts from d^j y/dt^j = initial[j].
Matrix free_sensitivities(const VectorView& den, const VectorView& initial, Index N, double Ts);
Matrix free_sensitivities(const VectorView& den, const VectorView& initial, const VectorView& t);

}  // namespace dynlab::inline numerics
