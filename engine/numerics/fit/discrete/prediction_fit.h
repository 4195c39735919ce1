#pragma once
#include <optional>
#include <string>
#include <vector>

#include "numerics/fit/discrete/polynomial_fit.h"
#include "numerics/fit/discrete/prediction_model.h"

namespace dynlab::inline numerics {

/// What armax and bj have in common: minimizes the prediction error from the `starts` (values of the orders'
/// parameters; each is followed a little way, the best to the end) by damped Gauss-Newton with exact sensitivities, and
/// describes the result. Throws InvalidArgument, which begins with `method`,
/// when there are no more samples than values to estimate.
Fit fit_prediction(const std::string& method, const PredictionModel& model, const StartCondition& start, double Ts,
                   const std::vector<Vector>& starts, const FitOptions& options);

/// The coefficients of C or D that have no standard errors, and a sentence that says so.
struct UndeterminedRoot {
    std::vector<std::string> names;
    Message warning;
};
/// Where a root r of the polynomial C or D is within four standard errors sqrt(2 (1 - r)/N) of the unit circle, in C
/// within 5.7: there estimates pile up on it, and their scatter is not normal.
std::optional<UndeterminedRoot> undetermined_root(char letter, const Vector& p, Index samples);

/// The noise model of the errors of a first model, for a start; white when they are nothing but rounding against
/// outputs of mean square `output_power`.
ArmaNoise start_noise(const std::vector<Vector>& errors, int nc, int nd, double output_power);

/// Mean square of all outputs.
double output_power(const IdData& data);

}  // namespace dynlab::inline numerics
