#include "numerics/estimators/cra.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/spectral_estimate.h"
#include "numerics/signals/correlation.h"
#include "numerics/statistics/autoregression.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinSamplesOfCra = 8;

/// Sums over all experiments of lagged_products, lags 0 .. lags.
Vector joint_products(const IdData& data, const Matrix Experiment::*x, const Matrix Experiment::*y, Index lags) {
    Vector sums = Vector::Zero(lags + 1);
    for (const Experiment& experiment : data.experiments)
        sums += lagged_products((experiment.*x).col(0), (experiment.*y).col(0), lags).tail(lags + 1);
    return sums;
}

Autoregression whitening_of(const IdData& data, Index order) {
    Vector u(data.sample_count());
    std::vector<Index> lengths;
    Index first = 0;
    for (const Experiment& experiment : data.experiments) {
        lengths.push_back(experiment.u.rows());
        u.segment(first, lengths.back()) = experiment.u.col(0);
        first += lengths.back();
    }
    return fit_autoregression(u, lengths, order, AutoregressiveOrder::kMaxInteger);
}

void whiten(IdData& data, const Autoregression& filter) {
    for (Experiment& experiment : data.experiments) {
        experiment.u = filtered_past(filter, experiment.u.col(0));
        experiment.y = filtered_past(filter, experiment.y.col(0));
    }
}

}  // namespace

void CraOptions::validate() const {
    if (whitening < 0 || whitening > 100)
        throw InvalidArgument("cra: the order of the whitening filter must be between 0 and 100, but it is {}",
                              whitening);
    normal_half_width(confidence);
}

CorrelationAnalysis cra(const IdData& data, const CraOptions& options) {
    options.validate();
    IdData data_set = nonparametric_data("cra", data, kMinSamplesOfCra + options.whitening, true);
    Index shortest = data_set.sample_count();
    for (const Experiment& experiment : data_set.experiments) shortest = std::min(shortest, experiment.y.rows());
    const Index lags = lags_or_default("cra", options.lags, shortest - options.whitening);
    CorrelationAnalysis result;
    const Autoregression whitening = whitening_of(data_set, options.whitening);
    result.whitening_filter = whitening.filter();
    whiten(data_set, whitening);
    const Vector input = joint_products(data_set, &Experiment::u, &Experiment::u, lags);
    const double output = joint_products(data_set, &Experiment::y, &Experiment::y, 0)[0];
    result.input_correlation = input / input[0];
    ImpulseEstimate& impulse = result.impulse;
    impulse.t = Vector::LinSpaced(lags + 1, 0, static_cast<double>(lags)) * data.Ts;
    impulse.response = joint_products(data_set, &Experiment::y, &Experiment::u, lags) / input[0];
    const auto count = static_cast<double>(data_set.sample_count());
    impulse.noise_variance = std::max(output - impulse.response.squaredNorm() * input[0], 0.0) / count;
    impulse.null_std = Vector::Constant(lags + 1, std::sqrt(output / (count * input[0])));
    impulse.std = impulse.null_std;
    impulse.message = Message("Impulse response over {} by correlation analysis.", plural(lags, "{} lag", "{} lags"));
    read_dead_time(impulse, data.Ts, data.time_unit, data.hold, normal_half_width(options.confidence));
    const double limit = normal_half_width(options.confidence) / std::sqrt(count);
    const double worst = input.tail(lags).cwiseAbs().maxCoeff() / input[0];
    if (worst > std::max(2 * limit, 0.2))
        impulse.warnings.push_back(
            Message("The whitened input still has an autocorrelation of up to {}, which distorts the impulse response. "
                    "Use impulseest, which does not need a white input.",
                    significant(worst, 2)));
    return result;
}

}  // namespace dynlab::inline numerics
