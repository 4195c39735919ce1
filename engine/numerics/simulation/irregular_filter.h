#pragma once
#include <vector>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay), one input, p outputs, at strictly increasing instants t,
/// exactly to rounding from event to event (a sampling instant, or a sample of the delayed input). The input is zero
/// before its first sample. A step is one to the next of equally spaced lengths, whose matrix exponentials are kept,
/// and from there the short rest by Taylor's series of the state itself (Al-Mohy and Higham 2011): no exponential is
/// made for a single step.
class IrregularFilter {
  public:
    IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay = 0);

    /// N x p outputs for the N samples of `u` at the instants `t`; `x` is the state at the first.
    Matrix run(const VectorView& u, const VectorView& t, const Vector& x);

  private:
    void set_spacing(const VectorView& t);
    double input_at(const VectorView& u, const VectorView& t, Index segment, double time) const;
    template <int kOrder>
    Matrix run_sized(const VectorView& u, const VectorView& t, const Vector& x);
    template <class State>
    void advance(State& x, double from, double to, double length);
    const StepMatrices& kept_step(std::size_t number);

    Vector scale_;  // of the states, which balances A
    Matrix A_, C_;
    Vector B_, D_;
    Hold hold_;
    double delay_, size_ = 0;         // s; norm of A
    double spacing_ = 0;              // s
    std::vector<StepMatrices> kept_;  // of length i spacing_ at place i, empty until wanted
};

}  // namespace dynlab::inline numerics
