#pragma once
#include "numerics/models/state_space.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Response of G to `u` (N samples every Ts seconds, held as `hold` says), exact at the sampling instants:
/// state-space recursion with matrix exponentials, delays that are not a multiple of Ts
/// included. The state is `x0` (controllable canonical form, length = number of poles; zero when empty) at
/// the first sample; before it u is zero. A discrete G ignores `hold` and needs G.Ts() == Ts. Returns N
/// samples. Throws for an improper G.
Vector lsim(const TransferFunction& G, const VectorView& u, double Ts, Hold hold = Hold::kZoh,
            const VectorView& x0 = Vector());
/// The same at strictly increasing, possibly unequal instants `t` (N values).
Vector lsim(const TransferFunction& G, const VectorView& u, const VectorView& t, Hold hold = Hold::kZoh,
            const VectorView& x0 = Vector());
/// Several inputs and outputs: `u` is N x nu, the result N x ny.
Matrix lsim(const StateSpace& system, const MatrixView& u, double Ts, Hold hold = Hold::kZoh,
            const VectorView& x0 = Vector());

/// Outputs of the state-variable filter: columns p^n x_f, ..., p x_f, x_f with x_f = 1/(p + lambda)^n x, zero
/// state at the first sample; N x (n+1). The highest derivative comes from p^n x_f = x - sum e_i p^(n-i) x_f.
/// (Garnier and Wang 2008, chapter 1.) n from 1 to 50, lambda in rad/s.
Matrix state_variable_filter(const VectorView& x, int n, double lambda, double Ts, Hold hold = Hold::kFoh);

}  // namespace dynlab::inline numerics
