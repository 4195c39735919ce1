#include "numerics/estimators/armax.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/estimators/iv4.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/discrete/prediction_fit.h"
#include "numerics/fit/equation_error.h"
#include "numerics/fit/finished_fit.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerValue = 10;  // a start is worth trying from so many on

PolynomialOrders without_noise(const PolynomialOrders& orders) {
    return PolynomialOrders::arx(orders.na, orders.nb, orders.nk);
}

/// A and B with the C that fits the errors of their equations.
Vector with_noise(const IdData& data, const PolynomialOrders& orders, const Vector& theta) {
    const PolynomialOrders own = without_noise(orders);
    Vector start(orders.parameter_count());
    start << theta,
        start_noise(ArxEquations(data, own).errors(theta), orders.nc, 0, output_power(data)).C.tail(orders.nc);
    return start;
}

/// The data with the errors of a long arx model as one more input, from where these are known on.
IdData with_errors(const IdData& data, const PolynomialOrders& longer) {
    const ArxEquations equations(data, longer);
    const std::vector<Vector> errors = equations.errors(solve_arx(equations).theta);
    IdData extended = data;
    extended.experiments.clear();
    for (std::size_t e = 0; e < errors.size(); ++e) {
        const Index rows = errors[e].size(), inputs = data.input_count();
        if (rows == 0) continue;
        Experiment experiment = data.experiments[e];
        experiment.y = data.experiments[e].y.bottomRows(rows);
        experiment.u.resize(rows, inputs + 1);
        experiment.u << data.experiments[e].u.bottomRows(rows), errors[e];
        extended.experiments.push_back(std::move(experiment));
    }
    return extended;
}

/// Start by the method of Hannan and Rissanen; no start if the data are too short for the long model.
std::vector<Vector> regression_start(const IdData& data, const PolynomialOrders& orders) {
    const auto inputs = static_cast<int>(orders.inputs());
    const double samples = static_cast<double>(data.sample_count());
    const int least = *std::max_element(orders.nb.begin(), orders.nb.end());
    const int order = std::max({orders.na + orders.nc, least, static_cast<int>(5 * std::log10(samples))});
    const Index values = static_cast<Index>(order) * (1 + inputs) + orders.parameter_count();
    if (order > 100 || data.sample_count() < kSamplesPerValue * values) return {};
    const PolynomialOrders longer = PolynomialOrders::arx(order, std::vector<int>(orders.inputs(), order), orders.nk);
    const IdData extended = with_errors(data, longer);
    PolynomialOrders regression = without_noise(orders);
    regression.nb.push_back(orders.nc);
    regression.nf.push_back(0);
    regression.nk.push_back(1);
    const ArxEquations equations(extended, regression);
    if (equations.count() <= equations.parameters()) return {};
    Vector start = solve_arx(equations).theta;
    start.tail(orders.nc) = reflect_roots_into_unit_circle(monic(start.tail(orders.nc))).tail(orders.nc);
    return {start};
}

std::vector<Vector> starts(const IdData& data, const PolynomialOrders& orders) {
    const PolynomialOrders own = without_noise(orders);
    std::vector<Vector> all{with_noise(data, orders, solve_rich_arx("armax", data, own).theta)};
    if (orders.nc == 0) return all;
    if (data.sample_count() >= kSamplesPerValue * 2 * orders.parameter_count())
        all.push_back(with_noise(data, orders, iv4(data, own).theta));
    for (Vector& start : regression_start(data, orders)) all.push_back(std::move(start));
    return all;
}

}  // namespace

Fit armax(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    orders.validate();
    options.validate();
    if (orders.nd > 0 || std::any_of(orders.nf.begin(), orders.nf.end(), [](int nf) { return nf > 0; }))
        throw InvalidArgument("armax has only the orders na, nb, nc and nk: nd and nf must be zero");
    return finished_discrete_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        check_equation_error("armax", seen, without_noise(orders));
        const StartCondition nothing_assumed{InitialState::kEstimate, false};
        const std::vector<SampledExperiment> experiments = sampled_experiments(seen);
        return fit_prediction("armax", PredictionModel(orders, nothing_assumed, experiments), nothing_assumed, seen.Ts,
                              starts(seen, orders), requested);
    });
}

}  // namespace dynlab::inline numerics
