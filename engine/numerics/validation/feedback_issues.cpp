#include <algorithm>
#include <cmath>

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/signals/correlation.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/statistics/autoregression.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/model_issues.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kInputMemory = 10, kFeedbackLags = 10;
constexpr double kRobust = 1.4826;  // standard deviation of normal numbers over their median distance
constexpr double kCutError = 6, kCutInput = 2.5;
constexpr Index kMaxFeedbackSamples = 4000;
constexpr double kFeedbackLevel = 1e-5;
constexpr double kOneSided = 3;  // times more correlation with later inputs than with earlier ones

/// x with mean zero and mean square one, cut off at so many robust standard deviations.
Vector standardized(Vector x, double cut) {
    x.array() -= median(x);
    const double scale = kRobust * median(x.cwiseAbs().eval());
    if (scale > 0) x = x.cwiseMin(cut * scale).cwiseMax(-cut * scale);
    x.array() -= x.mean();
    const double size = std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
    if (!(size > 0)) return Vector::Zero(x.size());
    return x / size;
}

Vector white_errors(const VectorView& error) {
    const Vector centered = error.array() - error.mean();
    const Autoregression memory =
        fit_autoregression(centered, {centered.size()}, kInputMemory, AutoregressiveOrder::kBic);
    return filtered_past(memory, centered);
}

/// The part of y(k) that the past of both signals does not predict: a prediction needs no stable model.
Vector prediction_errors(const VectorView& y, const VectorView& u) {
    const Index rows = y.size() - kInputMemory;
    Matrix columns(rows, 2 * kInputMemory + 1);
    columns.col(0).setOnes();
    for (Index i = 1; i <= kInputMemory; ++i) {
        columns.col(i) = y.segment(kInputMemory - i, rows);
        columns.col(kInputMemory + i) = u.segment(kInputMemory - i, rows);
    }
    return solve_least_squares(columns, y.tail(rows)).residuals;
}

/// x one sample late.
Vector delayed(const VectorView& x) {
    Vector late(x.size());
    late[0] = x[0];
    late.tail(x.size() - 1) = x.head(x.size() - 1);
    return late;
}

/// Columns of the regression of u(k) on 1, u(k - 1), ... and x(k), x(k - 1), ..., and u(k) itself as the last.
Matrix input_regression(const VectorView& u, const VectorView& x) {
    const Index rows = u.size() - kInputMemory;
    Matrix columns(rows, 2 * kInputMemory + 3);
    columns.col(0).setOnes();
    for (Index i = 1; i <= kInputMemory; ++i) columns.col(i) = u.segment(kInputMemory - i, rows);
    for (Index i = 0; i <= kInputMemory; ++i) columns.col(kInputMemory + 1 + i) = x.segment(kInputMemory - i, rows);
    columns.rightCols(1) = u.tail(rows);
    return columns;
}

/// The part of the input that the past of input and simulated output does not predict. Jumps, for example of a
/// reference, have little weight: least squares reweighted by Tukey's biweight. Zeros if only jumps are left.
Vector input_innovations(const VectorView& u, const VectorView& x) {
    constexpr int kPasses = 8;
    constexpr double kTukey = 4.685;
    const Matrix columns = input_regression(u, x);
    const Index d = columns.cols() - 1;
    const Matrix A =
        columns.leftCols(d) * columns.leftCols(d).colwise().norm().cwiseMax(1e-300).cwiseInverse().asDiagonal();
    const Vector b = columns.col(d);
    Vector weights = Vector::Ones(b.size()), w = b;
    for (int pass = 0; pass < kPasses; ++pass) {
        const Matrix weighted = A.array().colwise() * weights.array();
        Matrix gram = weighted.transpose() * A;
        gram.diagonal().array() += 1e-12;
        w = b - A * solve_semidefinite(gram, weighted.transpose() * b);
        const double scale = kTukey * kRobust * median(w.cwiseAbs().eval());
        if (!(scale > 1e-7 * b.cwiseAbs().maxCoeff())) return Vector::Zero(b.size());
        weights = (1 - (w / scale).array().square()).cwiseMax(0).square();
    }
    return w;
}

/// Correlations r with a signal that is not quite white, of which `R` are the correlations: N r' P^-1 r, P_ij =
/// R(i - j), is chi-squared with as many degrees of freedom as P has eigenvalues that count.
struct JointTest {
    double statistic = 0;
    Index degrees = 0;
};

JointTest joint_test(const Vector& r, const Vector& R, double N) {
    constexpr double kCounts = 1e-3;
    Matrix P(r.size(), r.size());
    for (Index i = 0; i < r.size(); ++i)
        for (Index j = 0; j < r.size(); ++j) P(i, j) = R[std::abs(i - j)];
    const auto [values, vectors] = symmetric_eigen(P);
    JointTest test;
    for (Index i = 0; i < r.size(); ++i) {
        if (!(values[i] > kCounts * values[r.size() - 1])) continue;
        test.statistic += N * std::pow(vectors.col(i).dot(r), 2) / values[i];
        ++test.degrees;
    }
    return test;
}

Message remedy_for_feedback(const Experiment& experiment) {
    if (experiment.r.cols() == 0)
        return Message("Record data in open loop, or add the reference to iddata for clsrivc and clivsvf.");
    if ((experiment.r.array() == experiment.r(0, 0)).all())
        return Message("The reference never changes, so clsrivc and clivsvf cannot use it: vary the reference.");
    return Message("The data contain the reference of the loop, which clsrivc and clivsvf use.");
}

}  // namespace

void find_feedback(const FittedData& fit, DataIssues& findings) {
    const Index first = fit.window.first, count = std::min<Index>(fit.error.size() - first, kMaxFeedbackSamples);
    if (count < 20 * kInputMemory) return;
    const Vector u = fit.u().segment(first, count);
    const bool predicts = !fit.model().stable() || fit.runs_away();
    const Vector e = standardized(
        predicts ? prediction_errors(fit.y().segment(first, count), u) : white_errors(fit.error.segment(first, count)),
        kCutError);
    const Vector x = predicts ? delayed(fit.y().segment(first, count)) : fit.simulation.output.segment(first, count);
    const Vector w = standardized(input_innovations(u, x), kCutInput);
    const Index common = std::min(e.size(), w.size());
    if (w.isZero()) return;
    const auto samples = static_cast<double>(common);
    const Vector products = lagged_products(w.tail(common), e.tail(common), kFeedbackLags) / samples;
    const Vector R = lagged_products(w, w, kFeedbackLags).tail(kFeedbackLags + 1) / static_cast<double>(w.size());
    const JointTest later = joint_test(products.tail(kFeedbackLags + 1), R, samples);
    const JointTest earlier = joint_test(products.head(kFeedbackLags), R, samples);
    if (later.statistic < kOneSided * earlier.statistic) return;  // the model lacks something: no noise alone is left
    if (chi_squared_upper_tail(later.statistic, static_cast<double>(later.degrees)) > kFeedbackLevel) return;
    Index lag = 0;
    const double largest = products.tail(kFeedbackLags + 1).cwiseAbs().maxCoeff(&lag);
    const Message when = lag == 0 ? Message("at the same sample") : plural(lag, "{} sample later", "{} samples later");
    const Message seen = Message(
        "{} responds to disturbances of {} (correlation {}, {}): a controller was active. Noise then enters the input, "
        "which biases lssvf, arx, ivsvf and srivc.",
        fit.input(), fit.output(), rounded(largest, 2), when);
    findings.push_back(about(fit, "feedback", Weight::kWarning,
                             sentences({seen, remedy_for_feedback(fit.data.experiments.front())}), largest));
}

bool find_runaway(const FittedData& fit, DataIssues& findings) {
    if (!fit.runs_away()) return false;
    findings.push_back(
        about(fit, "unstable", Weight::kWarning,
              Message("The best linear model from {} to {} is unstable, and its simulation diverges from the data, so "
                      "other checks are not possible. If the plant is unstable, a controller was active: add the "
                      "reference to iddata and use clsrivc, or predict (armax, pe) instead of simulating.",
                      fit.input(), fit.output()),
              fit.simulation.fit_percent));
    return true;
}

}  // namespace dynlab::inline numerics
