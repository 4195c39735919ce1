#include "numerics/estimators/linear_regression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline numerics {

namespace {

struct Solution {
    Vector theta;
    Matrix inverse_gram;
};

Solution solve_normal_equations(const MatrixView& Phi, const VectorView& y) {
    const Matrix gram = Phi.transpose() * Phi;
    const auto inverse = solve_by_cholesky(gram, Matrix::Identity(gram.rows(), gram.cols()));
    const auto solution = solve_by_cholesky(gram, Phi.transpose() * y);
    if (!inverse || inverse->reciprocal_condition < std::numeric_limits<double>::epsilon())
        throw InvalidArgument(
            "The normal equations have no unique solution to working precision, because the columns of Phi are "
            "linearly dependent or differ too much in scale. Use the method \"qr\", or center and scale the "
            "regressors");
    return {solution->x, inverse->x};
}

double condition_of(const MatrixView& Phi) {
    const Vector singular = singular_values(triangular_part(Phi));
    const double smallest = singular[singular.size() - 1];
    return smallest > 0 ? singular[0] / smallest : std::numeric_limits<double>::infinity();
}

void add_statistics(LinearRegression& fit, const Matrix& inverse_gram) {
    const double N = static_cast<double>(fit.residuals.size()), free = N - static_cast<double>(fit.rank);
    const double squares = fit.residuals.squaredNorm();
    fit.rmse = std::sqrt(squares / N);
    const double variance = free > 0 ? squares / free : kNaN;
    fit.sigma = std::sqrt(variance);
    fit.covariance = variance * inverse_gram;
    fit.std = fit.covariance.diagonal().cwiseSqrt();
}

Matrix powers(const Vector& x, int degree) {
    Matrix Phi = Matrix::Ones(x.size(), degree + 1);
    for (Index j = degree - 1; j >= 0; --j) Phi.col(j) = Phi.col(j + 1).cwiseProduct(x);
    return Phi;
}

// The polynomial in x whose value is that of `p` at x - center, by Horner's scheme on polynomials.
Vector shifted_back(const Vector& p, double center) {
    Vector result = p.head(1);
    for (Index i = 1; i < p.size(); ++i) {
        result = multiply(result, Vector{{1.0, -center}});
        result[result.size() - 1] += p[i];
    }
    return result;
}

Index distinct_values(const VectorView& x) {
    std::vector<double> sorted(x.begin(), x.end());
    std::sort(sorted.begin(), sorted.end());
    return std::unique(sorted.begin(), sorted.end()) - sorted.begin();
}

}  // namespace

LinearRegression lsq(const MatrixView& Phi, const VectorView& y, RegressionMethod method) {
    const LeastSquares orthogonal = solve_least_squares(Phi, y);  // checks sizes and values, computes the rank
    Solution solution{orthogonal.solution, orthogonal.inverse_gram};
    if (method == RegressionMethod::kNormal) solution = solve_normal_equations(Phi, y);
    LinearRegression fit;
    fit.theta = solution.theta;
    fit.fitted = Phi * fit.theta;
    fit.residuals = y - fit.fitted;
    fit.rank = orthogonal.rank;
    fit.condition_number = condition_of(Phi);
    add_statistics(fit, solution.inverse_gram);
    fit.message =
        fit.rank == Phi.cols()
            ? Message("Least squares with {} and {}: RMSE {}.", plural(Phi.rows(), "{} equation", "{} equations"),
                      plural(Phi.cols(), "{} parameter", "{} parameters"), fit.rmse)
            : Message(
                  "The columns of Phi are linearly dependent (rank {} of {}); the result is the minimum-norm solution.",
                  fit.rank, Phi.cols());
    return fit;
}

PolynomialFit fit_polynomial(const VectorView& x, const VectorView& y, int degree, const PolyfitOptions& options) {
    if (degree < 0) throw InvalidArgument("The degree must be nonnegative, but is {}", degree);
    if (x.size() != y.size())
        throw InvalidArgument("x and y must have the same length, but have {} and {} values", x.size(), y.size());
    if (!x.allFinite()) throw InvalidArgument("x contains a value that is not finite");
    const Index distinct = distinct_values(x);
    if (distinct <= degree)
        throw InvalidArgument(
            "A polynomial of degree {} needs at least {} distinct values of x, but the number of distinct values is {}",
            degree, degree + 1, distinct);
    PolynomialFit fit;
    fit.degree = degree;
    fit.center = options.centered ? x.mean() : 0;
    fit.regression = lsq(powers(x.array() - fit.center, degree), y, options.method);
    fit.coefficients = shifted_back(fit.regression.theta, fit.center);
    return fit;
}

Forecast forecast(const LinearRegression& regression, const VectorView& phi, double level) {
    if (phi.size() != regression.theta.size())
        throw InvalidArgument("The forecast needs {}, but the number of specified regressors is {}",
                              plural(regression.theta.size(), "{} regressor", "{} regressors"), phi.size());
    if (!(level > 0 && level < 1))
        throw InvalidArgument("The confidence level must be between 0 and 1, but {} was given; 0.95 means 95 %", level);
    const Index degrees = regression.residuals.size() - regression.rank;
    if (degrees < 1)
        throw InvalidArgument(
            "The number of measurements is not greater than the number of parameters, so the error of a forecast "
            "cannot be estimated. Use more measurements");
    Forecast result;
    result.value = phi.dot(regression.theta);
    const double variance = phi.dot(regression.covariance * phi);
    result.mean_std = std::sqrt(variance);
    result.std = std::sqrt(regression.sigma * regression.sigma + variance);
    const double t = student_t_quantile(0.5 + 0.5 * level, static_cast<double>(degrees));
    result.low = result.value - t * result.std;
    result.high = result.value + t * result.std;
    result.level = level;
    return result;
}

Forecast forecast(const PolynomialFit& fit, double x, double level) {
    return forecast(fit.regression, powers(Vector::Constant(1, x - fit.center), fit.degree).row(0).transpose(), level);
}

}  // namespace dynlab::inline numerics
