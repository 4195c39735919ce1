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

/// The same of a response that holds a dead time (s): without jumps of what is left when the dead time is taken off.
Vector phase_degrees_unwrapped(const ComplexVector& response, const VectorView& w, double delay);

/// The phase of G in degrees at frequencies w > 0 (rad/s), whichever they are: those of its zeros less those of its
/// poles, which change smoothly from w = 0 on, and -w delay. A negative gain counts as +180 degrees, each pole at the
/// origin (z = 1) as -90; what lies on the imaginary axis or the unit circle as just inside.
Vector phase_degrees(const TransferFunction& G, const VectorView& w);

/// Logarithmic grid (rad/s) one and a half decades around the poles and zeros, ending at pi/Ts in discrete time.
/// Throws InvalidArgument for fewer than two points.
Vector natural_frequency_grid(const TransferFunction& G, Index count = 400);

}  // namespace dynlab::inline numerics
