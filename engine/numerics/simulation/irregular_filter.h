#pragma once
#include <vector>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay), one input, p outputs, at strictly increasing instants t,
/// exactly to rounding from event to event (a change of the delayed input, from which the sampling instants up to the
/// next are reached). The input is zero before its first sample.
///
/// A step of length h is the linear map [F G R](h) of the state, the input and its slope. It is tabulated at multiples
/// of a short length with its Taylor coefficients there, which give it at every h in between as polynomials of one
/// number; longer steps begin with kept ones of 64 times that length, of 64^2 times and so on, as a number is of its
/// digits. So one matrix exponential for each digit of the longest step serves them all, and no step waits for the one
/// before it but for the product with the state.
class IrregularFilter {
  public:
    IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay = 0);

    /// N x p outputs for the N samples of `u` at the instants `t`; `x` is the state at the first.
    Matrix run(const VectorView& u, const VectorView& t, const Vector& x);

  private:
    template <int kOrder>
    struct Moment;  // the state and the straight input that follows
    template <int kOrder>
    void run_sized(const VectorView& u, const VectorView& t, const Vector& x, Matrix& y);
    template <int kOrder>
    double make_long_steps(Moment<kOrder>& moment, double length);
    template <int kRows, int kOrder>
    Eigen::Matrix<double, kRows, 1> after_short_step(const std::vector<double>& table, const Moment<kOrder>& moment,
                                                     Index rows, double length);
    void tabulate(Index entry);
    const Matrix& kept_steps(std::size_t digit);
    double slope_behind(const VectorView& u, const VectorView& t, Index segment) const;

    Vector scale_;  // of the states, which balances A
    Matrix A_, C_;
    Vector B_, D_;
    Hold hold_;
    double delay_;
    double unit_;                     // s, between two entries of the table
    Index entries_ = 0;               // tabulated so far
    std::vector<double> to_state_;    // for each entry the coefficients of [F G R], from the constant on
    std::vector<double> to_output_;   // of the output's, where there is one only
    StepMatrices one_, several_;      // units
    std::vector<Matrix> long_steps_;  // for each further digit [F G R] of its steps side by side
};

}  // namespace dynlab::inline numerics
