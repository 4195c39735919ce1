#pragma once
#include <unordered_map>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay), one input, p outputs, at strictly increasing instants t:
/// exact matrix exponentials from event to event (a sampling instant, or a sample of the delayed input), kept per
/// distinct step. The input is zero before its first sample.
class IrregularFilter {
  public:
    IrregularFilter(Matrix A, Vector B, Matrix C, Vector D, Hold hold, double delay = 0);

    /// N x p outputs for the N samples of `u` at the instants `t`; `x` is the state at the first.
    Matrix run(const VectorView& u, const VectorView& t, Vector x);

  private:
    double input_at(const VectorView& u, const VectorView& t, Index segment, double time) const;
    const StepMatrices& step(double length);

    Matrix A_, C_;
    Vector B_, D_;
    Hold hold_;
    double delay_;
    std::unordered_map<double, StepMatrices> steps_;
};

}  // namespace dynlab::inline numerics
