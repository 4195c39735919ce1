#pragma once
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// G at frequencies w (rad/s; in discrete time G(exp(j w Ts))), its delay included. Throws InvalidArgument for a
/// frequency that is not finite.
ComplexVector frequency_response(const TransferFunction& G, const VectorView& w);

/// 20 log10 |response|, dB.
Vector magnitude_db(const ComplexVector& response);

/// Its angle in degrees, without jumps of more than half a turn from one frequency to the next.
Vector phase_degrees_unwrapped(const ComplexVector& response);

/// Logarithmic grid (rad/s) one and a half decades around the poles and zeros, ending at pi/Ts in discrete time.
/// Throws InvalidArgument for fewer than two points.
Vector natural_frequency_grid(const TransferFunction& G, Index count = 400);

}  // namespace dynlab::inline numerics
