#pragma once
#include <functional>
#include <vector>

#include "numerics/criteria/output_error_model.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/termination.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

struct OutputErrorOptions {
    int max_iterations = 50;
    double tolerance = 1e-6;       ///< on the change of each parameter, relative to its size (see below)
    std::function<bool()> cancel;  ///< asked before every iteration; true stops the search

    /// Throws InvalidArgument for a negative count or a tolerance that is not positive.
    void validate() const;
};

struct OutputErrorSolution {
    Vector theta;
    Matrix covariance;            ///< noise_variance (J'J)^-1; rows and columns of parameters held at a bound are zero
    double noise_variance = 0;    ///< sum of squares/(N - d), d the parameters not held at a bound
    double loss = 0;              ///< sum of squares/N
    double condition_number = 0;  ///< of the column-scaled sensitivities
    std::vector<bool> at_bound;   ///< per parameter: the solution lies on a bound and wants to leave through it
    Vector output;                ///< N
    Termination termination = Termination::kIterationLimit;
    std::vector<FitIteration> trace;
};

/// What the sensitivities J at `theta` tell of the precision of the parameters `free`: by the sums of products while
/// these keep enough digits (a condition number below 1e3), otherwise by the QR decomposition of J itself. Without
/// meaning, an empty matrix, where J is not finite or nothing is free.
struct SensitivityPrecision {
    Matrix inverse_gram;          ///< (J'J)^-1 of the free parameters
    double condition_number = 0;  ///< of J with its columns scaled to norm one
};
SensitivityPrecision sensitivity_precision(const OutputErrorModel& model, const Vector& theta, const Matrix& gram,
                                           const std::vector<Index>& free);

/// Minimises |y - output(theta)|^2 within the bounds by damped Gauss-Newton (Levenberg-Marquardt with the columns of
/// the sensitivities scaled to norm one, More 1978); a parameter at a bound is held while the descent direction
/// points outwards, and steps are cut back at the bounds. It has converged when every parameter changes by
/// at most tolerance (|theta_i| + |y - mean(y)|/|J_i|), where the second term is the change that would move the output
/// by as much as it varies: it takes over for parameters near zero. Throws InvalidArgument when sizes do not fit or
/// there are no more samples than parameters.
OutputErrorSolution minimise_output_error(const OutputErrorModel& model, const VectorView& y, const Vector& start,
                                          const OutputErrorOptions& options = {});

/// The same from several starts (one at least): each is followed a little way, the best of them to the end.
OutputErrorSolution minimise_output_error(const OutputErrorModel& model, const VectorView& y,
                                          const std::vector<Vector>& starts, const OutputErrorOptions& options);

}  // namespace dynlab::inline numerics
