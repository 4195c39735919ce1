#pragma once
#include <vector>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay), one input, p outputs, at strictly increasing instants t,
/// exactly to rounding from event to event (a sampling instant, or a sample of the delayed input). The input is zero
/// before its first sample. A step is made of steps that are kept, of 1 to 31 times a short length, of 32 times that
/// length and so on, as a number is of its digits, and of the short rest by Taylor's series of the state itself
/// (Al-Mohy and Higham 2011): one matrix exponential for each digit of the longest step serves them all.
class IrregularFilter {
  public:
    IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay = 0);

    /// N x p outputs for the N samples of `u` at the instants `t`; `x` is the state at the first.
    Matrix run(const VectorView& u, const VectorView& t, const Vector& x);

  private:
    double input_at(const VectorView& u, const VectorView& t, Index segment, double time) const;
    template <int kOrder>
    Matrix run_sized(const VectorView& u, const VectorView& t, const Vector& x);
    template <class State>
    void advance(State& x, double from, double to, double length);
    const Matrix& kept_steps(std::size_t digit);

    Vector scale_;  // of the states, which balances A
    Matrix A_, C_;
    Vector B_, D_;
    Hold hold_;
    double delay_, size_ = 0;    // s; norm of A
    double unit_;                // s, the shortest kept step
    std::vector<Matrix> kept_;   // for each digit [F G R] of its steps side by side
    std::vector<double> units_;  // s, the shortest of them
};

}  // namespace dynlab::inline numerics
