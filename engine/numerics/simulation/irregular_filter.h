#pragma once

#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"
#include "numerics/simulation/companion_series.h"
#include "numerics/simulation/separate_modes.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay), one input, p outputs, at strictly increasing instants t,
/// exactly to rounding from event to event (a sampling instant, or a change of the delayed input between two). The
/// input is zero before its first sample. A is a companion matrix or two of the same in series (companion_pair.h), B
/// the first unit vector.
///
/// Events are processed in blocks of eight stretches, which run side by side: first from rest, which together with the
/// map of each complete stretch determines their initial states, then from these states. The maps of their steps are
/// also computed side by side, so that only the state depends on the previous step. The maps are computed mode by mode
/// if the modes are distinct and the system starts at rest (eight_modes.h), otherwise by power series (eight_steps.h).
/// The filter refuses nothing: the caller must provide sizes that agree and rising instants.
class IrregularFilter {
  public:
    IrregularFilter(const Matrix& A, const Vector& B, Matrix C, Vector D, Hold hold, double delay = 0);

    /// N x p outputs for the N samples of `u` at the instants `t`; `x` is the state at the first.
    Matrix run(const VectorView& u, const VectorView& t, const Vector& x) const;

  private:
    CompanionPair pair_;
    Matrix C_;
    Vector D_;
    Hold hold_;
    double delay_;
};

}  // namespace dynlab::inline numerics
