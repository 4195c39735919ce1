#pragma once
#include <functional>
#include <vector>

#include "numerics/criteria/discrete_output.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

struct InstrumentSolution {
    Vector theta;     ///< of the DiscreteOutput
    double loss = 0;  ///< mean square of its simulation error
    Termination termination = Termination::kIterationLimit;
    std::vector<FitIteration> trace;
    bool reflected = false;  ///< poles were mirrored into the unit circle on the way
};

/// The instrumental-variable iteration of SRIV: with Psi the sensitivities of the simulated output (the instruments)
/// and Phi its regressors, both prefiltered by 1/F of the model so far,
///     theta <- theta + (Psi' Phi)^-1 Psi' (y - output(theta)),
/// which for one input is the usual solution of Psi' (F y_f - B u_f) = 0; then poles outside the unit circle are
/// mirrored into it. A step that raises the loss is shortened, to an eighth at most. It has converged when the whole
/// step changes every parameter by at most tolerance (|theta_i| + |y - mean(y)|/|Psi_i|). Without convergence the point
/// of smallest loss on the way is given.
InstrumentSolution iterate_instruments(const DiscreteOutput& model, const Vector& y, const Vector& start,
                                       int max_iterations, double tolerance, const std::function<bool()>& cancel = {});

/// Returns a start for the iteration, or for an output-error search, without initial values: least squares on the
/// equation F y = B u, with signals and initial values filtered by 1/(1 - alpha q^-1)^n for a sweep of alphas from 0 to
/// 0.98. Several inputs first share a denominator; then each channel is fitted separately. A few instrument iterations
/// follow each alpha. The result is the point of smallest simulation error. The sweep ends early when two alphas settle
/// on the same loss.
Vector instrument_start(const DiscreteOutput& model, const Vector& y, const std::function<bool()>& cancel = {});

}  // namespace dynlab::inline numerics
