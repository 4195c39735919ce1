#pragma once
#include "numerics/models/transfer_function.h"

namespace dynlab {

/// y at the instants t (s) after a unit step, or a unit impulse, at time zero.
struct TimeResponse {
    Vector t, y;
};

TimeResponse step_response(const TransferFunction& G, const VectorView& t);
TimeResponse impulse_response(const TransferFunction& G, const VectorView& t);
/// Instants 0..T, chosen from the poles so that the response settles within about 80 % of the window.
Vector natural_time_grid(const TransferFunction& G, Index count = 400);

}  // namespace dynlab
