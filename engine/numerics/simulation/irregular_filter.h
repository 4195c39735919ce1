#pragma once
#include <cstdint>
#include <vector>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay), one input, p outputs, at strictly increasing instants t,
/// exactly to rounding from event to event (a sampling instant, or a change of the delayed input between two). The
/// input is zero before its first sample.
///
/// A step of length h is the linear map [F G R](h) of the state, the input and its slope: a power series in h whose
/// coefficients are the same for all steps, taken for h/2^s and doubled s times, for eight steps side by side. Longer
/// steps begin with kept ones of 64 short lengths, of 64^2 times and so on, as a number is of its digits. So one matrix
/// exponential for each digit of the longest step serves them all, and no step waits for the one before it but for the
/// product with the state.
class IrregularFilter {
  public:
    IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay = 0);

    /// N x p outputs for the N samples of `u` at the instants `t`; `x` is the state at the first.
    Matrix run(const VectorView& u, const VectorView& t, const Vector& x);

  private:
    struct Step {
        double length;        ///< s
        double input, slope;  ///< at the beginning
        Index sample;         ///< that is reached, -1 for none
    };

    void set_series();
    std::vector<Step> steps(const VectorView& u, const VectorView& t, Vector& input) const;
    double slope_behind(const VectorView& u, const VectorView& t, Index segment) const;
    void run_single(const std::vector<Step>& steps, const Vector& start, Matrix& states);
    void run_cascade(const std::vector<Step>& steps, const Vector& start, Matrix& states);
    template <int kOrder, int kLeading>
    void run_sized(const std::vector<Step>& steps, const Vector& start, Matrix& states);
    template <int kOrder>
    void make_kept_steps(double length, const Step& step, Eigen::Matrix<double, kOrder, 1>& x);
    const Matrix& kept_steps(std::size_t digit);

    Vector scale_;  // of the states, which balances A
    Matrix A_, C_;
    Vector B_, D_;
    Hold hold_;
    double delay_;
    double size_;                     // a norm of A, 1/s
    double unit_;                     // s, of the shortest kept step
    std::vector<Index> entries_;      // of [F G R], those that are not always zero
    Matrix series_;                   // of them, one column each
    std::vector<Matrix> long_steps_;  // for each digit [F G R] of its steps side by side
};

}  // namespace dynlab::inline numerics
