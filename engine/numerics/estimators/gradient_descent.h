#pragma once
#include <functional>
#include <optional>

#include "numerics/fit/fit.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

struct GradientDescentOptions {
    std::optional<double> step_size;  ///< default: 1/lambda_max
    int max_iterations = 10000;
    double tolerance = 1e-10;      ///< stops when |change of theta| <= tolerance |theta|
    Vector start;                  ///< d values, zero when empty
    std::function<bool()> cancel;  ///< asked before every iteration

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

struct GradientDescentResult {
    Vector theta;                 ///< the point of least loss
    Vector loss;                  ///< mean square error at the start and after every iteration
    double step_size = 0;         ///< used
    double largest_step = 0;      ///< 2/lambda_max: at and beyond it the iteration does not converge
    double condition_number = 0;  ///< lambda_max/lambda_min of Phi'Phi/N; the iterations needed grow like it
    Termination termination = Termination::kIterationLimit;
    int iterations = 0;
    Message message;  ///< one sentence
};

/// Least squares by steepest descent: J = |y - Phi theta|^2/(2 N), theta <- theta - step dJ/dtheta with
/// dJ/dtheta = -Phi'(y - Phi theta)/N; lambda are the eigenvalues of Phi'Phi/N. Phi is N x d. A step that is too large
/// makes the loss grow: the search then stops and says so. Throws InvalidArgument for sizes that do not fit,
/// values that are not finite, or regressors that are all zero. Reference: Boyd and Vandenberghe (2004), section 9.3.
GradientDescentResult gradient_descent(const MatrixView& Phi, const VectorView& y,
                                       const GradientDescentOptions& options = {});

}  // namespace dynlab::inline numerics
