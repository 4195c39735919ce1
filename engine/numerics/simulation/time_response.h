#pragma once
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// y at the instants t (s) after a unit step, or a unit impulse, at time zero.
struct TimeResponse {
    Vector t, y;
};

/// Exact at the instants `t`, which must not be negative and must increase strictly; for a discrete G they must be
/// multiples of Ts. The impulse response leaves out the impulse that a direct feed-through passes on; a discrete
/// unit impulse is one sample of height 1/Ts. Throws InvalidArgument for an improper G.
TimeResponse step_response(const TransferFunction& G, const VectorView& t);
TimeResponse impulse_response(const TransferFunction& G, const VectorView& t);

/// Instants 0..T, chosen from the poles so that the response settles within about 80 % of the window; an unstable
/// one grows about a hundredfold. `count` instants, for a discrete G the multiples of Ts up to T (at most 10000).
Vector natural_time_grid(const TransferFunction& G, Index count = 400);

}  // namespace dynlab::inline numerics
