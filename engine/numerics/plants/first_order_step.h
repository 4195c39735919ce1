#pragma once
#include <cstdint>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The step response of gain/(1 + time_constant s) from rest at a few instants, with its derivative, for least squares
/// by hand:
///     time_constant dy/dt + y = gain u.
/// The step comes at the first sample; every noisy value is its clean one plus white normal noise.
struct FirstOrderStepParameters {
    double gain = 2;
    double time_constant = 1;  ///< s
    double step_height = 1;    ///< of the input
    Index samples = 4;         ///< at 0, Ts, 2 Ts, ...
    double Ts = 0.5;           ///< s
    double output_noise_std = 0.05;
    double derivative_noise_std = 0.05;  ///< unit of the output per second

    /// Throws InvalidArgument naming the first value out of its range.
    void validate() const;
};

/// N values each; the derivative at the first sample is the one just after the step.
struct FirstOrderStepData {
    Vector t, u, y, ydot, y_noisy, ydot_noisy;
};

/// dy/dt = a y + b u, and exactly sampled y(k+1) = f y(k) + g u(k).
struct FirstOrderStepTruth {
    double a, b;  ///< -1/time_constant and gain/time_constant, 1/s
    double f, g;  ///< exp(-Ts/time_constant) and gain (1 - f)
};

/// True values of the quantities that the data show, computed from the parameters. Throws InvalidArgument as their
/// validate().
FirstOrderStepTruth first_order_step_truth(const FirstOrderStepParameters& parameters);

/// The noise of y is drawn before that of ydot; equal seeds give equal data.
FirstOrderStepData simulate_first_order_step(const FirstOrderStepParameters& parameters, std::uint32_t seed);

}  // namespace dynlab::inline numerics
