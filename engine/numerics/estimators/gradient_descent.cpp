#include "numerics/estimators/gradient_descent.h"

#include <cmath>
#include <limits>
#include <vector>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kRunaway = 1e12;  // times the first loss

void check(const MatrixView& Phi, const VectorView& y, const GradientDescentOptions& options) {
    options.validate();
    if (Phi.rows() != y.size() || Phi.cols() == 0 || Phi.rows() == 0)
        throw InvalidArgument(
            "Phi must have one row per value of y and at least one column, but Phi is {} x {} and y has {}", Phi.rows(),
            Phi.cols(), plural(y.size(), "{} value", "{} values"));
    if (!Phi.allFinite() || !y.allFinite()) throw InvalidArgument("Phi and y must contain only finite numbers");
    if (Phi.isZero(0)) throw InvalidArgument("All regressors are zero, so no parameters can be estimated");
    if (options.start.size() != 0 && options.start.size() != Phi.cols())
        throw InvalidArgument("The starting point must have {}, but has {}",
                              plural(Phi.cols(), "{} value", "{} values"), options.start.size());
}

Message ending_of(const GradientDescentResult& result) {
    const Message count = plural(result.iterations, "{} iteration", "{} iterations");
    switch (result.termination) {
        case Termination::kConverged:
            return Message("Gradient descent converged after {}.", count);
        case Termination::kDiverged:
            return Message(
                "Gradient descent diverged, because the step size {} is too large. The step size must be below {}.",
                result.step_size, result.largest_step);
        case Termination::kCanceled:
            return Message("Gradient descent was stopped after {}; the result is the best point so far.", count);
        default:
            return Message(
                "Gradient descent did not converge after {}, because a condition number of {} requires many "
                "iterations. Center and scale the regressors.",
                count, significant(result.condition_number, 3));
    }
}

}  // namespace

void GradientDescentOptions::validate() const {
    if (step_size && (!(*step_size > 0) || !std::isfinite(*step_size)))
        throw InvalidArgument("The step size must be positive, but is {}", *step_size);
    if (max_iterations < 0)
        throw InvalidArgument("The number of iterations must be nonnegative, but is {}", max_iterations);
    if (!(tolerance >= 0)) throw InvalidArgument("The tolerance must be nonnegative, but is {}", tolerance);
    if (!start.allFinite()) throw InvalidArgument("The starting point must contain only finite numbers");
}

GradientDescentResult gradient_descent(const MatrixView& Phi, const VectorView& y,
                                       const GradientDescentOptions& options) {
    check(Phi, y, options);
    const double N = static_cast<double>(y.size());
    const Matrix hessian = Phi.transpose() * Phi / N;
    const Vector lambda = symmetric_eigenvalues(hessian);
    const double largest = lambda[lambda.size() - 1];

    GradientDescentResult result;
    result.largest_step = 2 / largest;
    result.step_size = options.step_size.value_or(1 / largest);
    result.condition_number = lambda[0] > 0 ? largest / lambda[0] : std::numeric_limits<double>::infinity();

    Vector theta = options.start.size() ? options.start : Vector::Zero(Phi.cols());
    Vector residuals = y - Phi * theta;
    std::vector<double> losses{residuals.squaredNorm() / N};
    double least = losses.front();
    result.theta = theta;
    while (result.iterations < options.max_iterations) {
        if (options.cancel && options.cancel()) {
            result.termination = Termination::kCanceled;
            break;
        }
        const Vector change = result.step_size / N * (Phi.transpose() * residuals);
        theta += change;
        residuals = y - Phi * theta;
        const double loss = residuals.squaredNorm() / N;
        losses.push_back(loss);
        ++result.iterations;
        if (!(loss <= kRunaway * (losses.front() + std::numeric_limits<double>::min()))) {
            result.termination = Termination::kDiverged;
            break;
        }
        // Not just the least loss: near the solution rounding would pick an earlier point.
        const bool settled = change.norm() <= options.tolerance * theta.norm();
        if (loss <= least || settled) {
            least = loss;
            result.theta = theta;
        }
        if (settled) {
            result.termination = Termination::kConverged;
            break;
        }
    }
    result.loss = Vector::Map(losses.data(), static_cast<Index>(losses.size()));
    result.message = ending_of(result);
    return result;
}

}  // namespace dynlab::inline numerics
