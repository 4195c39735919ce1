#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// A(q) y(k) = sum_i B_i(q) u_i(k) + v(k) with colored v, by instrumental variables in four steps:
///   1. least squares (arx);
///   2. Z'(y - Phi theta) = 0 with instruments Z made as Phi is, but from the output that the model of step 1 simulates
///      out of the inputs alone, which knows nothing of v;
///   3. an autoregression L v = e of order na + sum nb for the errors v of step 2 (of 100 at most);
///   4. step 2 once more with the model of step 2 for the instruments and everything filtered by L.
/// All equations are linear, so iv4 always converges. The estimate is consistent for any v independent of the inputs.
/// If v is autoregressive of that order, it is as precise as an instrumental-variable estimate of this structure can
/// be, and the covariance, sigma^2 (Z'Phi)^-1 Z'Z (Phi'Z)^-1 of the filtered signals, is correct. For the simulation of
/// the instruments, poles outside the unit circle are mirrored into it. iv4 assumes nothing about values before the
/// first sample, but simulates the instruments from rest. `noise_variance` and `loss` are those of v; `std` uses that
/// of e. Data, orders and errors: as arx. Also throws InvalidArgument for too few samples for step 3. Reference: Ljung
/// (1999), section 15.3 (15.21-24).
Fit iv4(const IdData& data, const PolynomialOrders& orders);

}  // namespace dynlab::inline numerics
