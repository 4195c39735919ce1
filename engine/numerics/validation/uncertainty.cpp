#include "numerics/validation/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/criteria/process_output.h"
#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/simulation/time_response.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline numerics {

namespace {

void check_model(const TransferFunction& G, const Matrix& covariance) {
    if (!G.continuous())
        throw InvalidArgument("Uncertainty is computed only for continuous-time models: convert the model with d2c(G)");
    if (!G.proper())
        throw InvalidArgument(
            "Uncertainty needs a model with at least as many poles as zeros, but this model has {} and {}",
            G.pole_count(), G.zero_count());
    const Index d = G.pole_count() + G.num().size();
    if (covariance.rows() != covariance.cols() || (covariance.rows() != d && covariance.rows() != d + 1))
        throw InvalidArgument(
            "The covariance of a model with {} and {} must be {} x {}, or one larger with an estimated delay, not {} x "
            "{}",
            plural(G.pole_count(), "{} pole", "{} poles"), plural(G.zero_count(), "{} zero", "{} zeros"), d, d,
            covariance.rows(), covariance.cols());
}

// gain s^power
Vector monomial(double gain, Index power) {
    Vector p = Vector::Zero(power + 1);
    p[0] = gain;
    return p;
}

// Standard deviation of each row's combination of the parameters.
Vector std_of_rows(const Matrix& derivatives, const Matrix& covariance) {
    return (derivatives * covariance).cwiseProduct(derivatives).rowwise().sum().cwiseMax(0).cwiseSqrt();
}

// Derivatives of a root of p(x) = p_0 x^n + ... + p_n with respect to p_0..p_n.
Eigen::RowVectorXcd root_derivatives(const Vector& p, Complex root) {
    const Index n = p.size() - 1;
    Complex slope = 0;
    for (Index i = 0; i < n; ++i) slope = slope * root + static_cast<double>(n - i) * p[i];
    Eigen::RowVectorXcd derivatives(n + 1);
    for (Index i = 0; i <= n; ++i) derivatives[i] = -std::pow(root, static_cast<int>(n - i)) / slope;
    return derivatives;
}

Eigen::Matrix2d covariance_of(const Eigen::RowVectorXcd& derivatives, const Matrix& covariance) {
    Matrix parts(2, derivatives.size());
    parts << derivatives.real(), derivatives.imag();
    return parts * covariance * parts.transpose();
}

constexpr double kNear = 3;

// Whether the distance of two roots is within three of its standard deviations, along the line through them: what both
// have in common cancels.
bool lie_near(Complex one, Complex other, const Eigen::RowVectorXcd& difference, const Matrix& covariance) {
    const double distance = std::abs(other - one);
    if (!(distance > 0)) return true;
    const Complex direction = (other - one) / distance;
    const Matrix along = (difference * std::conj(direction)).real();
    const double variance = (along * covariance * along.transpose()).value();
    return !(distance > kNear * std::sqrt(std::max(0.0, variance)));
}

// A conjugate pair is near multiple when it comes close to the real axis, as any two roots that come close.
std::vector<RootUncertainty> root_uncertainty(const ComplexVector& roots, const Vector& p, const Matrix& covariance) {
    std::vector<Eigen::RowVectorXcd> derivatives;
    for (const Complex& root : roots) derivatives.push_back(root_derivatives(p, root).tail(covariance.rows()));
    std::vector<RootUncertainty> all;
    for (std::size_t i = 0; i < derivatives.size(); ++i) {
        const Complex root = roots[static_cast<Index>(i)];
        RootUncertainty next{root, covariance_of(derivatives[i], covariance)};
        next.near_multiple = !next.covariance.allFinite();
        for (std::size_t j = 0; j < derivatives.size() && !next.near_multiple; ++j)
            next.near_multiple =
                j != i && lie_near(root, roots[static_cast<Index>(j)], derivatives[j] - derivatives[i], covariance);
        all.push_back(next);
    }
    return all;
}

ModeUncertainty mode_uncertainty(const PoleDescription& mode, const std::vector<RootUncertainty>& poles) {
    const auto own = std::find_if(poles.begin(), poles.end(), [&](const auto& pole) { return pole.root == mode.pole; });
    const double x = mode.pole.real(), y = mode.pole.imag(), w = std::abs(mode.pole);
    const auto std_along = [&](double by_real, double by_imaginary) {
        const Eigen::Vector2d direction(by_real, by_imaginary);
        const double variance = direction.dot(own->covariance * direction);
        return std::isfinite(variance) ? std::sqrt(std::max(0.0, variance)) : kNaN;
    };
    // w = |p|, zeta = -Re p/|p|, T = -1/Re p
    return {mode, std_along(x / w, y / w), std_along(-y * y / (w * w * w), x * y / (w * w * w)),
            std_along(1 / (x * x), 0)};
}

/// The transfer functions dG/da_1..dG/da_n, dG/db_0..dG/db_m, each with G's delay: -s^(n-i) B/A^2 and s^(m-j)/A.
std::vector<TransferFunction> coefficient_derivatives(const TransferFunction& G) {
    const Index n = G.pole_count(), m = G.zero_count();
    const Vector square = multiply(G.den(), G.den());
    std::vector<TransferFunction> derivatives;
    for (Index i = 1; i <= n; ++i)
        derivatives.emplace_back(multiply(monomial(-1, n - i), G.num()), square, G.Ts(), G.delay());
    for (Index j = 0; j <= m; ++j) derivatives.emplace_back(monomial(1, m - j), G.den(), G.Ts(), G.delay());
    return derivatives;
}

}  // namespace

UncertainModel::UncertainModel(TransferFunction model, Matrix parameter_covariance)
    : G(std::move(model)), covariance(std::move(parameter_covariance)) {
    check_model(G, covariance);
}

UncertainModel::UncertainModel(const ProcessModel& process, const MatrixView& parameter_covariance)
    : G(process.transfer_function()) {
    const Index q = process.parameters.size();
    if (parameter_covariance.rows() != q || parameter_covariance.cols() != q)
        throw InvalidArgument("The covariance of {} parameters must be {} x {}, not {} x {}", q, q, q,
                              parameter_covariance.rows(), parameter_covariance.cols());
    const Matrix J = coefficients_by_parameter(process);
    covariance = J * parameter_covariance * J.transpose();
    check_model(G, covariance);
}

Vector step_response_std(const UncertainModel& model, const VectorView& t) {
    Matrix derivatives(t.size(), model.covariance.rows());
    Index column = 0;
    for (const TransferFunction& derivative : coefficient_derivatives(model.G))
        derivatives.col(column++) = step_response(derivative, t).y;
    if (model.free_delay()) derivatives.col(column) = -impulse_response(model.G, t).y;
    return std_of_rows(derivatives, model.covariance);
}

FrequencyUncertainty frequency_response_std(const UncertainModel& model, const VectorView& w) {
    const TransferFunction& G = model.G;
    const Index n = G.pole_count(), m = G.zero_count(), d = model.covariance.rows();
    Matrix logarithm(w.size(), d), angle(w.size(), d);
    for (Index k = 0; k < w.size(); ++k) {
        const Complex s(0, w[k]), A = evaluate(G.den(), s), B = evaluate(G.num(), s);
        Eigen::RowVectorXcd derivatives(d);
        for (Index i = 1; i <= n; ++i) derivatives[i - 1] = -std::pow(s, static_cast<int>(n - i)) / A;
        for (Index j = 0; j <= m; ++j) derivatives[n + j] = std::pow(s, static_cast<int>(m - j)) / B;
        if (model.free_delay()) derivatives[d - 1] = -s;
        logarithm.row(k) = derivatives.real();
        angle.row(k) = derivatives.imag();
    }
    return {20 / std::numbers::ln10 * std_of_rows(logarithm, model.covariance),
            180 / std::numbers::pi * std_of_rows(angle, model.covariance)};
}

std::vector<RootUncertainty> pole_uncertainty(const UncertainModel& model) {
    const Index n = model.G.pole_count();
    return root_uncertainty(model.G.poles(), model.G.den(), model.covariance.topLeftCorner(n, n));
}

std::vector<RootUncertainty> zero_uncertainty(const UncertainModel& model) {
    const Index n = model.G.pole_count(), count = model.G.num().size();
    return root_uncertainty(model.G.zeros(), model.G.num(), model.covariance.block(n, n, count, count));
}

Matrix confidence_region(const RootUncertainty& root, double confidence, Index count) {
    const double x = root.root.real(), y = root.root.imag();
    if (y == 0) {
        const double half = normal_half_width(confidence) * std::sqrt(root.covariance(0, 0));
        return Matrix{{x - half, 0}, {x + half, 0}};
    }
    const auto [values, vectors] = symmetric_eigen(root.covariance);
    const Eigen::Matrix2d axes =
        std::sqrt(chi_squared_quantile(confidence, 2)) * vectors * values.cwiseMax(0).cwiseSqrt().asDiagonal();
    const Vector angle = Vector::LinSpaced(count, 0, 2 * std::numbers::pi);
    Matrix circle(2, count);
    circle << angle.array().cos().matrix().transpose(), angle.array().sin().matrix().transpose();
    return ((axes * circle).colwise() + Eigen::Vector2d(x, y)).transpose();
}

ModelUncertainty describe_uncertainty(const UncertainModel& model) {
    const TransferFunction& G = model.G;
    const Index n = G.pole_count(), b_last = n + G.zero_count();
    ModelUncertainty result;
    result.gain = G.dc_gain();
    result.gain_std = kNaN;
    if (std::isfinite(result.gain)) {
        Vector derivatives = Vector::Zero(model.covariance.rows());
        derivatives[b_last] = 1 / G.den()[n];
        if (n > 0) derivatives[n - 1] = -result.gain / G.den()[n];
        result.gain_std = std_of_rows(derivatives.transpose(), model.covariance)[0];
    }
    const auto poles = pole_uncertainty(model);
    for (const PoleDescription& mode : damping(G)) result.modes.push_back(mode_uncertainty(mode, poles));
    if (std::any_of(poles.begin(), poles.end(), [](const auto& pole) { return pole.near_multiple; }))
        result.warnings.push_back(
            Message("Some poles are closer together than their standard errors, so the standard errors of poles, "
                    "damping and time constants are unreliable: fewer poles may be sufficient."));
    return result;
}

}  // namespace dynlab::inline numerics
