#include "numerics/fit/discrete/long_regression.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/arx_equations.h"
#include "numerics/fit/discrete/arma_noise.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMaxCoefficients = 100;        // of a polynomial
constexpr double kSamplesPerCoefficient = 10;  // at least
constexpr double kBeyondChance = 5;            // standard deviations of the excess of one variance over the other
constexpr double kLeastVariance = 1e-20;       // of the output's power: smaller errors are rounding

Index coefficient_count(const IdData& data) {
    const double N = static_cast<double>(data.sample_count());
    const double max_order = N / (kSamplesPerCoefficient * static_cast<double>(1 + data.input_count()));
    return static_cast<Index>(std::min(10 * std::log10(N), max_order));
}

/// L x, where x is `before` up to its first sample.
Vector filtered_signal(const Vector& L, const VectorView& x, double before) {
    const Index N = x.size();
    Vector result = Vector::Constant(N, L.sum() * before);
    for (Index i = 0; i < std::min(L.size(), N); ++i)
        result.tail(N - i) += L[i] * (x.head(N - i).array() - before).matrix();
    return result;
}

IdData filtered_by(const IdData& data, const Vector& L, bool from_rest) {
    IdData result = data;
    for (Experiment& experiment : result.experiments) {
        experiment.y.col(0) = filtered_signal(L, experiment.y.col(0), experiment.y(0, 0));
        for (Index input = 0; input < experiment.u.cols(); ++input)
            experiment.u.col(input) =
                filtered_signal(L, experiment.u.col(input), from_rest ? 0 : experiment.u(0, input));
    }
    return result;
}

}  // namespace

LongRegression::LongRegression(const IdData& data, Index max_delay_samples) : data_(data) {
    const Index p = coefficient_count(data);
    if (p < 2) return;
    const auto own = static_cast<int>(p), late = static_cast<int>(std::min(p + max_delay_samples, kMaxCoefficients));
    const auto inputs = static_cast<std::size_t>(data.input_count());
    orders_ = PolynomialOrders::arx(own, std::vector<int>(inputs, late), std::vector<int>(inputs, 0));
    const ArxEquations equations(data, orders_);
    const Index d = equations.parameters();
    samples_ = equations.count();
    if (samples_ < 2 * d) return;
    const Matrix gram = equations.gram();
    Vector unscale = gram.diagonal().head(d).cwiseSqrt();
    for (double& value : unscale) value = value > 0 ? 1 / value : 1;
    const Matrix scaled = unscale.asDiagonal() * gram.topLeftCorner(d, d) * unscale.asDiagonal();
    const Vector theta = unscale.asDiagonal() * solve_semidefinite(scaled, unscale.asDiagonal() * gram.col(d).head(d));
    if (!theta.allFinite()) return;
    double squares = 0;
    for (const Vector& errors : equations.errors(theta)) squares += errors.squaredNorm();
    const double variance = squares / static_cast<double>(samples_ - d);
    if (variance > kLeastVariance * gram(d, d) / static_cast<double>(samples_)) variance_ = variance;
    theta_ = theta;
}

std::vector<Vector> LongRegression::share(Index input) const {
    if (theta_.size() == 0) return {};
    PolynomialModel model(orders_, theta_, data_.Ts);
    for (std::size_t other = 0; other < model.B.size(); ++other)
        if (static_cast<Index>(other) != input) model.B[other].setZero();
    const Vector a = reflect_roots_into_unit_circle(model.A).tail(orders_.na);
    std::vector<Vector> all;
    for (const Experiment& experiment : data_.experiments)
        all.push_back(free_run(a, driven_part(model, experiment.u), Vector::Zero(experiment.y.rows()), 0));
    return all;
}

bool LongRegression::predicts_better_than(double variance) const {
    if (!(variance_ > 0)) return false;
    const double excess = static_cast<double>(samples_) * (variance / variance_ - 1);
    return !(excess <= kBeyondChance * std::sqrt(2 * static_cast<double>(theta_.size())));
}

std::vector<IdData> LongRegression::filtered_data(bool from_rest) const {
    return {filtered_by(data_, monic(theta_.head(orders_.na)), from_rest),
            filtered_by(data_, Vector{{1, -1}}, from_rest)};
}

}  // namespace dynlab::inline numerics
