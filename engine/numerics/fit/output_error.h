#pragma once
#include <functional>
#include <string>
#include <vector>

#include "numerics/criteria/output_error_model.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Minimizes |y - output(theta)|^2 within the bounds by damped Gauss-Newton (Levenberg-Marquardt with the columns of
/// the sensitivities scaled to norm one, More 1978); a parameter at a bound is held while the descent direction
/// points outwards or both bounds are equal, and steps are cut back at the bounds. It has converged when every
/// parameter changes by at most tolerance (|theta_i| + |y - mean(y)|/|J_i|), where the second term is the change that
/// would move the output by as much as it varies: it takes over for parameters near zero. Of the options
/// max_iterations, tolerance and cancel count. Gives theta, covariance (zero for parameters held at a bound),
/// noise_variance (sum of squares/(N - d), d the parameters not held), loss, condition_number, at_bound, termination
/// and trace of a Fit, in the model's own parameters. Throws InvalidArgument for bad options, when sizes do not fit or
/// there are no more samples than parameters.
Fit minimize_output_error(const OutputErrorModel& model, const VectorView& y, const Vector& start,
                          const FitOptions& options = {});

/// The same from several starts (one at least): each is followed a little way, the best of them to the end.
Fit minimize_output_error(const OutputErrorModel& model, const VectorView& y, const std::vector<Vector>& starts,
                          const FitOptions& options);

/// The precision of the parameters `free` that follows from the sensitivities J at `theta`: by the sums of products
/// while these keep enough digits (a condition number below 1e3), otherwise by the QR decomposition of J itself.
/// Undefined, with an empty matrix, if J is not finite or no parameter is free.
struct SensitivityPrecision {
    Matrix inverse_gram;          ///< (J'J)^-1 of the free parameters
    double condition_number = 0;  ///< of J with its columns scaled to norm one
};
SensitivityPrecision sensitivity_precision(const OutputErrorModel& model, const Vector& theta, const Matrix& gram,
                                           const std::vector<Index>& free);

/// Of a minimum whose rows have errors of different variances, where `covariance` = variance (J'J)^-1 was found as if
/// they were alike: (J'J)^-1 (sum_r v_r j_r j_r') (J'J)^-1, j_r the rows of the sensitivities J and v_r the variances
/// of their errors. As it was where J is not finite.
Matrix covariance_of_unequal_rows(const Matrix& covariance, double variance, const Matrix& J, const Vector& variances);

/// Throws InvalidArgument unless weights that are given are positive and as many as the outputs.
void check_output_weights(const Vector& weights, Index outputs);

/// A criterion and a search for its minimum under every start condition that comes into question.
struct FitProblem {
    std::string method;                                       ///< begins messages
    const IdData& data;                                       ///< counted from where the search counts them
    std::vector<StartCondition> conditions;                   ///< one at least
    std::function<Index(const StartCondition&)> value_count;  ///< of all values that are estimated
    std::function<Fit(const StartCondition&)> fit;            ///< the search under one of them
    Index samples_per_value = 1;  ///< as many are wanted of all outputs together, and one more
};

/// What every output-error method does: the fit of smallest BIC among the start conditions. Conditions that leave too
/// few samples are left out, but for the first; a canceled fit ends the choice. Throws InvalidArgument for inputs that
/// never change and outputs that show no transient (check_transient).
Fit fit_output_error(const FitProblem& problem);

/// ln V + d ln(N)/N of a fit with so many estimated values to N samples: of all outputs together, each with its own
/// noise.
double bic_of(const Fit& fit, const IdData& data, Index values);

}  // namespace dynlab::inline numerics
