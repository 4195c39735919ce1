#include "numerics/estimators/bj.h"

#include <algorithm>

#include "numerics/error.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/discrete/long_regression.h"
#include "numerics/fit/discrete/prediction_fit.h"
#include "numerics/fit/finished_fit.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/start_choice.h"

namespace dynlab::inline numerics {

namespace {

/// What the output-error estimate leaves of the outputs, experiment by experiment.
std::vector<Vector> output_errors(const Fit& estimate, const std::vector<SampledExperiment>& experiments) {
    const PredictionModel model(*estimate.orders, estimate.start, experiments);
    const Vector errors = model.target() - model.simulated(model.completed(estimate.theta));
    std::vector<Vector> data_sets;
    Index first = 0;
    for (const Index length : model.lengths()) {
        data_sets.push_back(errors.segment(first, length));
        first += length;
    }
    return data_sets;
}

double mean_square(const std::vector<Vector>& data_sets) {
    double squares = 0, count = 0;
    for (const Vector& data_set : data_sets) {
        squares += data_set.squaredNorm();
        count += static_cast<double>(data_set.size());
    }
    return squares / count;
}

struct OutputErrorStart {
    Fit fit;
    std::vector<Vector> errors;
};

/// The output-error estimate from which the search starts. For long data the estimate from their beginning is used if
/// its model explains all samples as well as the beginning.
OutputErrorStart output_error_start(const IdData& data, const std::vector<SampledExperiment>& experiments,
                                    const PolynomialOrders& orders, const FitOptions& options) {
    constexpr Index kLong = 400000, kBeginning = 100000;
    constexpr double kAsWell = 1.2;
    const PolynomialOrders system = PolynomialOrders::output_error(orders.nb, orders.nf, orders.nk);
    const auto fit_to = [&](const IdData& data_set) {
        return fit_discrete_output("bj", data_set, system, options, output_error_search(options));
    };
    if (data.experiments.size() == 1 && data.sample_count() >= kLong) {
        try {
            const Fit fit = fit_to(data.range(1, kBeginning));
            const std::vector<Vector> errors = output_errors(fit, experiments);
            if (mean_square(errors) < kAsWell * fit.loss) return {fit, errors};
        } catch (const InvalidArgument&) {
            // too little happens there
        }
    }
    const Fit fit = fit_to(data);
    return {fit, output_errors(fit, experiments)};
}

/// The search from the system of `first`, fitted to these outputs or to filtered ones, with the noise that it leaves.
Fit search_from(const Fit& first, const std::vector<Vector>& errors, const PredictionModel& model, const IdData& data,
                const FitOptions& options) {
    const PolynomialOrders& orders = model.orders();
    const ArmaNoise noise = start_noise(errors, orders.nc, orders.nd, output_power(data));
    Vector start(orders.parameter_count());
    start << first.theta, noise.C.tail(orders.nc), noise.D.tail(orders.nd);
    return fit_prediction("bj", model, first.start, data.Ts, {start}, options);
}

/// The fit, or a better one where a long regression predicts better than it does: from systems of filtered data, whose
/// output error a drift does not dominate.
Fit or_from_filtered_data(Fit best, const IdData& data, const PredictionModel& model, const FitOptions& options) {
    const PolynomialOrders& orders = model.orders();
    const StartCondition condition = best.start;
    if (orders.nd == 0 || best.termination == Termination::kCanceled) return best;
    const LongRegression regression(data, *std::max_element(orders.nk.begin(), orders.nk.end()));
    if (!regression.predicts_better_than(best.noise_variance[0])) return best;
    const FitOptions plain = options.started({condition.state, false});
    const PolynomialOrders system = PolynomialOrders::output_error(orders.nb, orders.nf, orders.nk);
    for (const IdData& filtered : regression.filtered_data(condition.state == InitialState::kZero)) {
        Fit first;
        try {
            first = fit_discrete_output("bj", filtered, system, plain, output_error_search(options));
        } catch (const InvalidArgument&) {
            continue;  // too little happens in the filtered inputs
        }
        first.start = condition;
        Fit other = search_from(first, output_errors(first, model.experiments()), model, data, options);
        if (other.termination == Termination::kCanceled) break;
        if (other.noise_variance[0] < best.noise_variance[0]) best = std::move(other);
        if (!regression.predicts_better_than(best.noise_variance[0])) break;
    }
    return best;
}

Fit bj_fit(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    const CenteredData centered = centered_for(data, options.offset);
    const std::vector<SampledExperiment> experiments = sampled_experiments(centered.data);
    const auto [first, errors] = output_error_start(data, experiments, orders, options);
    const PredictionModel model(orders, first.start, experiments);
    Fit fit = or_from_filtered_data(search_from(first, errors, model, data, options), centered.data, model, options);
    add_operating_points(fit, centered.removed);
    return fit;
}

}  // namespace

Fit bj(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    orders.validate();
    if (orders.na > 0) throw InvalidArgument("bj has only the orders nb, nc, nd, nf and nk: na must be zero");
    return finished_discrete_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        const auto fit_with = [&](const FitOptions& how) { return bj_fit(seen, orders, how); };
        return best_predicting_start(fit_with(requested), requested, fit_with);
    });
}

}  // namespace dynlab::inline numerics
