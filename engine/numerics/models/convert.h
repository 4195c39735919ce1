#pragma once
#include "numerics/models/state_space.h"
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

enum class Discretisation { kZoh, kFoh, kTustin };

/// Discrete-time model. zoh and foh are exact for inputs held so (foh: triangle hold of Ts seconds); a delay that is
/// not a multiple of Ts is handled exactly by the modified z-transform. Throws for a discrete G or Ts <= 0.
TransferFunction c2d(const TransferFunction& G, double Ts, Discretisation method = Discretisation::kZoh);
StateSpace c2d(const StateSpace& system, double Ts, Discretisation method = Discretisation::kZoh);

/// Inverse of c2d. Throws InvalidArgument for poles on the closed negative real axis (no continuous-time
/// equal under zoh), naming the pole.
TransferFunction d2c(const TransferFunction& G, Discretisation method = Discretisation::kZoh);

}  // namespace dynlab::inline numerics
