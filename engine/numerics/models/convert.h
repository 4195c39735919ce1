#pragma once
#include <string>

#include "numerics/models/state_space.h"
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

enum class Discretization { kZoh, kFoh, kTustin };

/// Discrete-time model. zoh and foh are exact for inputs held so (foh: triangle hold of Ts seconds); a delay that is
/// not a multiple of Ts is handled exactly by the modified z-transform. Throws for a discrete G or Ts <= 0.
TransferFunction c2d(const TransferFunction& G, double Ts, Discretization method = Discretization::kZoh);
StateSpace c2d(const StateSpace& system, double Ts, Discretization method = Discretization::kZoh);

/// Inverse of c2d. Throws InvalidArgument for poles on the closed negative real axis (no continuous-time
/// equal under zoh), naming the pole.
TransferFunction d2c(const TransferFunction& G, Discretization method = Discretization::kZoh);

/// G with its delay as poles: a discrete one exactly, z^-d, a continuous one only where there is none. Throws
/// InvalidArgument that begins with `caller` and names pade() for a delay in continuous time.
TransferFunction with_rational_delay(const std::string& caller, const TransferFunction& G);

/// A continuous-time G whose delay is replaced by Pade's approximation of exp(-delay s), an all-pass P(-s)/P(s) of
/// `order` poles that agrees with it up to s^(2 order); a discrete G as with_rational_delay(). Throws InvalidArgument
/// unless order is 1 to 10: higher ones lose their digits.
TransferFunction pade(const TransferFunction& G, int order);

}  // namespace dynlab::inline numerics
