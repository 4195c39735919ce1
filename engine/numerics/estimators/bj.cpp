#include "numerics/estimators/bj.h"

#include "numerics/error.h"
#include "numerics/fit/discrete_fit.h"
#include "numerics/fit/prediction_fit.h"

namespace dynlab::inline numerics {

namespace {

/// What the output-error estimate leaves of the outputs, experiment by experiment.
std::vector<Vector> output_errors(const Fit& estimate, const std::vector<SampledExperiment>& experiments) {
    const PredictionModel model(estimate.orders, estimate.start, experiments);
    const Vector errors = model.target() - model.simulated(model.completed(estimate.theta));
    std::vector<Vector> records;
    Index first = 0;
    for (const Index length : model.lengths()) {
        records.push_back(errors.segment(first, length));
        first += length;
    }
    return records;
}

}  // namespace

Fit bj(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    orders.validate();
    if (orders.na > 0) throw InvalidArgument("bj has the orders nb, nc, nd, nf and nk only: na must be zero");
    const Fit first = fit_discrete_output("bj", data, PolynomialOrders::output_error(orders.nb, orders.nf, orders.nk),
                                          options, output_error_search(options));
    const CentredData centred = centred_for(data, options.offset);
    const std::vector<SampledExperiment> experiments = sampled_experiments(centred.data);
    const ArmaNoise noise = start_noise(output_errors(first, experiments), orders.nc, orders.nd, output_power(data));
    Vector start(orders.parameter_count());
    start << first.theta, noise.C.tail(orders.nc), noise.D.tail(orders.nd);
    Fit fit =
        fit_prediction("bj", PredictionModel(orders, first.start, experiments), first.start, data.Ts, {start}, options);
    add_operating_points(fit, centred.removed);
    return fit;
}

}  // namespace dynlab::inline numerics
