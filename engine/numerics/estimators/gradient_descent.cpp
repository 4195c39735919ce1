#include "numerics/estimators/gradient_descent.h"

#include <cmath>
#include <limits>
#include <vector>

#include "base/number_text.h"
#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kRunaway = 1e12;  // times the first loss

void check(const MatrixView& Phi, const VectorView& y, const GradientDescentOptions& options) {
    options.validate();
    if (Phi.rows() != y.size() || Phi.cols() == 0 || Phi.rows() == 0)
        throw InvalidArgument("Phi must have one row per value of y and at least one column, and is " +
                              std::to_string(Phi.rows()) + " x " + std::to_string(Phi.cols()) + " for " +
                              counted(y.size(), "value"));
    if (!Phi.allFinite() || !y.allFinite()) throw InvalidArgument("Phi and y must hold finite numbers only");
    if (Phi.isZero(0)) throw InvalidArgument("All regressors are zero, so there is no slope to descend");
    if (options.start.size() != 0 && options.start.size() != Phi.cols())
        throw InvalidArgument("The start must hold " + counted(Phi.cols(), "value") + ", and holds " +
                              std::to_string(options.start.size()));
}

std::string message_of(const GradientDescentResult& result) {
    const std::string count = counted(result.iterations, "iteration");
    switch (result.termination) {
        case Termination::kConverged:
            return "Gradient descent converged after " + count + ".";
        case Termination::kDiverged:
            return "Gradient descent diverged: the step size " + number_text(result.step_size) +
                   " is too large, it must stay below " + number_text(result.largest_step) + ".";
        case Termination::kCancelled:
            return "Gradient descent was stopped after " + count + "; the best point so far is given.";
        default:
            return "Gradient descent had not converged after " + count + ": with a condition number of " +
                   number_text(result.condition_number, 3) + " it needs many; centre and scale the regressors.";
    }
}

}  // namespace

void GradientDescentOptions::validate() const {
    if (step_size && (!(*step_size > 0) || !std::isfinite(*step_size)))
        throw InvalidArgument("The step size must be positive, and is " + number_text(*step_size));
    if (max_iterations < 0)
        throw InvalidArgument("The number of iterations must not be negative, and is " +
                              std::to_string(max_iterations));
    if (!(tolerance >= 0))
        throw InvalidArgument("The tolerance must not be negative, and is " + number_text(tolerance));
    if (!start.allFinite()) throw InvalidArgument("The start must hold finite numbers only");
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
            result.termination = Termination::kCancelled;
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
    result.message = message_of(result);
    return result;
}

}  // namespace dynlab::inline numerics
