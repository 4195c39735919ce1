#pragma once
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

ComplexVector frequency_response(const TransferFunction& G, const VectorView& w);  ///< w in rad/s
Vector magnitude_db(const ComplexVector& response);
Vector phase_degrees_unwrapped(const ComplexVector& response);
/// Logarithmic grid one and a half decades around the poles and zeros, ending at pi/Ts in discrete time.
Vector natural_frequency_grid(const TransferFunction& G, Index count = 400);

}  // namespace dynlab::inline numerics
