#include "numerics/estimators/impulseest.h"

#include <algorithm>

#include "numerics/error.h"
#include "numerics/fit/spectral_estimate.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/signals/lagged_gram.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinSamplesOfImpulseest = 8, kMaxLags = 400;

/// Rows [u(k) u(k-1) .. u(k-n)] and y(k) of an experiment, without their means over it (which estimates c).
class CenteredRows {
  public:
    CenteredRows(const Experiment& experiment, Index n)
        : u_(experiment.u.col(0)), y_(experiment.y.col(0).tail(experiment.y.rows() - n)), means_(n + 1) {
        for (Index i = 0; i <= n; ++i) means_[i] = u_.segment(n - i, y_.size()).mean();
        mean_ = y_.mean();
    }
    Index count() const { return y_.size(); }
    void put(Index first, Eigen::Ref<Matrix> Phi, Eigen::Ref<Vector> y) const {
        const Index n = means_.size() - 1;
        for (Index i = 0; i <= n; ++i) Phi.col(i) = u_.segment(first + n - i, Phi.rows()).array() - means_[i];
        y = y_.segment(first, y.size()).array() - mean_;
    }

  private:
    VectorView u_, y_;
    Vector means_;
    double mean_ = 0;
};

struct Regression {
    Matrix Phi;
    Vector y;
};
Regression regression_of(const IdData& data, Index n) {
    Index rows = 0, at = 0;
    for (const Experiment& experiment : data.experiments) rows += experiment.y.rows() - n;
    Regression regression{Matrix(rows, n + 1), Vector(rows)};
    for (const Experiment& experiment : data.experiments) {
        const CenteredRows of(experiment, n);
        of.put(0, regression.Phi.middleRows(at, of.count()), regression.y.segment(at, of.count()));
        at += of.count();
    }
    return regression;
}

/// The signals of an experiment counted from their means, so that the sums below keep their digits.
struct LevelSignals {
    Vector u, y;
};
LevelSignals level_signals(const Experiment& experiment) {
    return {experiment.u.col(0).array() - experiment.u.col(0).mean(),
            experiment.y.col(0).array() - experiment.y.col(0).mean()};
}

/// Products of all rows, with the mean of each experiment subtracted: the means cost at most one row per lag.
ResponseSums sums_of(const IdData& data, Index n) {
    Matrix joint = Matrix::Zero(n + 2, n + 2);
    double count = 0;
    for (const Experiment& experiment : data.experiments) {
        const LevelSignals signals = level_signals(experiment);
        const Index rows = signals.y.size() - n;
        Vector means(n + 2);
        for (Index i = 0; i <= n; ++i) means[i] = signals.u.segment(n - i, rows).mean();
        means[n + 1] = signals.y.tail(rows).mean();
        joint += lagged_gram({{signals.u, 0, n + 1}, {signals.y, 0, 1}}, n, rows);
        joint -= static_cast<double>(rows) * means * means.transpose();
        count += static_cast<double>(rows - 1);
    }
    return {joint.topLeftCorner(n + 1, n + 1), joint.col(n + 1).head(n + 1), joint(n + 1, n + 1), count};
}

void fit_plainly(const IdData& data, Index n, double count, RegressedResponse& estimate) {
    const Regression regression = regression_of(data, n);
    const LeastSquares fit = solve_least_squares(regression.Phi, regression.y);
    if (fit.rank < regression.Phi.cols() || fit.condition_number > 1e8)
        throw InvalidArgument(
            "impulseest: the input is not persistently exciting of order {}, the number of samples of the impulse "
            "response. Use the regularized estimate, use fewer lags, or resample the data to a lower rate first",
            regression.Phi.cols());
    estimate.response = fit.solution;
    estimate.noise_variance = fit.residuals.squaredNorm() / std::max(count - static_cast<double>(n + 1), 1.0);
    estimate.covariance = estimate.noise_variance * fit.inverse_gram;
    estimate.std = estimate.covariance.diagonal().cwiseSqrt();
    estimate.null_std = estimate.std;
}

void fit_smoothly(const ResponseSums& sums, ResponseKernel kernel, RegressedResponse& estimate) {
    const ResponsePrior prior = most_likely_prior(sums, kernel);
    const ResponsePosterior posterior = response_posterior(sums, prior);
    estimate.response = posterior.mean;
    estimate.noise_variance = posterior.noise_variance;
    estimate.covariance = posterior.covariance;
    estimate.std = posterior.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    estimate.null_std = posterior.null_std;
    estimate.prior = prior;
    estimate.prior_scale = posterior.scale;
}

}  // namespace

void ImpulseestOptions::validate() const {
    if (lags < 0 || lags > kMaxLags)
        throw InvalidArgument(
            "impulseest: the number of lags must be between 1 and {}, but is {}; resample the data to a lower rate if "
            "the response lasts longer",
            kMaxLags, lags);
    normal_half_width(confidence);
}

RegressedResponse impulseest(const IdData& data, const ImpulseestOptions& options) {
    options.validate();
    const IdData data_set = nonparametric_data("impulseest", data, kMinSamplesOfImpulseest, false);
    Index shortest = data_set.sample_count();
    for (const Experiment& experiment : data_set.experiments) shortest = std::min(shortest, experiment.y.rows());
    const Index n = lags_or_default("impulseest", options.lags, shortest);
    const ResponseSums sums = sums_of(data_set, n);
    if (!(sums.gram.diagonal().maxCoeff() > 0) || !(sums.energy > 0))
        throw InvalidArgument("impulseest: the input or the output is constant after the first {}; use fewer lags",
                              plural(n, "{} sample", "{} samples"));
    RegressedResponse estimate;
    estimate.t = Vector::LinSpaced(n + 1, 0, static_cast<double>(n)) * data.Ts;
    options.smooth ? fit_smoothly(sums, options.kernel, estimate) : fit_plainly(data_set, n, sums.count, estimate);
    const Message lags = plural(n, "{} lag", "{} lags");
    estimate.message = options.smooth ? Message("Impulse response over {} by regularized least squares.", lags)
                                      : Message("Impulse response over {} by ordinary least squares.", lags);
    read_dead_time(estimate, data.Ts, data.time_unit, data.hold, normal_half_width(options.confidence));
    const Index tail = std::max<Index>(n / 10, 1);
    if (estimate.response.tail(tail).cwiseAbs().maxCoeff() > 0.1 * estimate.response.cwiseAbs().maxCoeff())
        estimate.warnings.push_back(Message(
            "The response has not decayed at the last lag: use more lags, or resample the data to a lower rate."));
    return estimate;
}

}  // namespace dynlab::inline numerics
