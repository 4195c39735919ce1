#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/fit/output_error.h"
#include "numerics/models/process_model.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

struct ProcsrivcOptions {
    InitialState initial_state = InitialState::kAuto;
    Offset offset = Offset::kAuto;
    double TdMin = 0;              ///< s
    std::optional<double> TdMax;   ///< s; a quarter of the record unless given
    int NumTd = 100;               ///< most delays on the grid between the two
    int MaxIter = 50;              ///< of the search from the best start
    double Tol = 1e-6;             ///< relative parameter change at which the search has converged
    std::function<bool()> cancel;  ///< asked before every iteration

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

struct ProcsrivcResult {
    ProcessModel model;              ///< time constants in falling order
    std::vector<std::string> names;  ///< of theta: Kp, Tp1, ... as the structure has them
    Vector theta, std;               ///< model parameters and their standard errors (s for times)
    Matrix covariance;               ///< of theta; zero for a parameter held at a bound
    double noise_variance = 0;       ///< squares/(N - d), d all estimated values, initial state and offset included
    double fit_percent = 0;  ///< simulation, 100 (1 - |y - ysim|/|y - mean(y)|), the mean of each experiment its own
    double loss = 0;         ///< mean square of the output error

    StartCondition start{};               ///< what was assumed or chosen
    std::vector<Vector> initial_values;   ///< per experiment, when estimated: y, dy/dt (per s), ... at its first
                                          ///< sample, from rest
    Vector offsets;                       ///< per experiment: estimated constant, 0 without
    std::vector<OperatingPoint> removed;  ///< per experiment: what Offset "remove" took off
    Vector output;  ///< N simulated outputs, experiment after experiment, offset and operating point included

    Vector delay_grid, delay_loss;  ///< s and mean square error: the curve the delay was first looked for on
    Termination termination = Termination::kIterationLimit;
    std::vector<OutputErrorIteration> trace;  ///< of the search that won
    std::vector<std::string> warnings;        ///< whole sentences
    std::string message;                      ///< one sentence, then the warnings

    explicit ProcsrivcResult(ProcessModel fitted) : model(std::move(fitted)) {}
};

/// Output-error estimate of a process model of any structure (P1, P2, P3, P2U, P3U, each with any of D, I, Z) from one
/// or several experiments with one input and one output, sampled regularly or not (y = G u + e with white e; the SRIVC
/// fixed point is the same optimum). Initial state and offset are each experiment's own:
///     minimise sum_k (y(k) - G(p, theta) u(k) - free motion(k) - offset)^2.
/// Start values come from a grid (no guess is needed), then damped Gauss-Newton searches with exact
/// sensitivities run from the best few, the best of them to the end; a real-valued delay is searched on a grid between
/// TdMin and TdMax and refined jointly with the rest. Inputs are taken as the data's hold says, exactly, delays between
/// samples included. For options "auto" every start condition the input allows is fitted and the smallest BIC wins.
/// With a step at sample one the input is zero before it. A process with an integrator rests at zero input only, and
/// its initial state, which is that of y itself, takes in any offset. Non-convergence and doubtful results are told in
/// `warnings`, never thrown. Throws InvalidArgument for a start condition that makes no sense, data of another shape,
/// an input that is zero, a constant one without a transient in the output, or fewer than 3 samples per estimated
/// value. References: Young, Garnier and Gilson, in Garnier and Wang (2008), chapter 4; Ljung (1999),
/// sections 10.2, 9.4.
ProcsrivcResult procsrivc(const IdData& data, const ProcessStructure& structure, const ProcsrivcOptions& options = {});

}  // namespace dynlab::inline numerics
