#pragma once
#include "numerics/criteria/denominator_group.h"
#include "numerics/fit/closed_loop/loop_signals.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// The equations sum_k z(k) (p^n y_f - phi' theta) = 0 for closed-loop data: y, u and the instruments' x and u are
/// filtered by 1/E; x and y are linearly interpolated between samples.
struct LoopEquations {
    Matrix Z, Phi;               ///< N x d, experiment after experiment
    Vector y;                    ///< N, p^n y_f
    std::vector<Index> lengths;  ///< of the experiments

    /// NaN where the equations cannot be solved.
    Vector solution(double* condition_number = nullptr) const;
    /// Of the solution: its covariance with errors of any color (statistics/robust_covariance.h).
    Matrix covariance(const VectorView& theta) const;
};

/// `group` is the only one of its structure (one input, one output).
LoopEquations loop_equations(const DenominatorGroup& group, const VectorView& E, const LoopSignals::All& signals);

}  // namespace dynlab::inline numerics
