#pragma once
#include "numerics/linalg/types.h"
#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

/// Runs a SampledSystem over long signals. Four samples advance together: their outputs and the state after them are
/// linear in the state before and in the input samples, so one small matrix product replaces four dependent steps.
/// Orders 1 to 6, 8 and 10 have loops of fixed size, others a loop of any size. The results agree with the
/// sample-by-sample recursion to rounding.
class ExactFilter {
  public:
    explicit ExactFilter(SampledSystem system);

    Index order() const { return system_.F.rows(); }
    Index output_count() const { return system_.C.rows(); }

    /// Writes the outputs, one column each, for the N samples of `u`: `y` is N x output_count. `x` is the state at
    /// the first sample (length order()). The caller guarantees the sizes.
    void run(const VectorView& u, Vector x, Eigen::Ref<Matrix> y) const;
    /// The same from the zero state into a new matrix.
    Matrix run(const VectorView& u) const;
    /// The samples from .. from + y.rows() - 1 of a run over all of `u`. `x` is the state at the first of them, then
    /// the state behind the last.
    void advance(const VectorView& u, Index from, Vector& x, Eigen::Ref<Matrix> y) const;

    static constexpr Index kBlock = 4;  ///< samples advanced together

  private:
    void prepare_blocks();
    template <int kOrder, int kWindow>
    void run_blocks(const double* window, Index blocks, Vector& x, double* y, Index stride) const;
    template <int kOrder>
    void run_blocks(const double* window, Index blocks, Vector& x, double* y, Index stride) const;

    SampledSystem system_;
    bool sees_next_ = false, sees_previous_ = false;  // whether u[k-d+1], u[k-d-1] have weight
    Matrix block_outputs_;  // for each output kBlock x (order + window), acting on [state; input window], side by side
    Matrix block_step_;     // order x (order + window)
};

}  // namespace dynlab::inline numerics
