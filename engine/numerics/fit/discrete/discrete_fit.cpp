#include "numerics/fit/discrete/discrete_fit.h"

#include <limits>
#include <numeric>

#include "numerics/error.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/start_choice.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kScreeningIterations = 20;
constexpr double kScreeningTolerance = 1e-3;

/// All values that are estimated, samples left free among them.
Index value_count(const DiscreteOutput& model) {
    return model.parameter_count() + model.left_out();
}

/// Covariance and condition number from the sensitivities at the solution.
void add_uncertainty(Fit& estimate, const DiscreteOutput& model, const Vector& theta) {
    const Index d = estimate.theta.size();
    estimate.covariance = Matrix::Constant(d, d, std::numeric_limits<double>::infinity());
    estimate.condition_number = std::numeric_limits<double>::infinity();
    std::vector<Index> all(static_cast<std::size_t>(theta.size()));
    std::iota(all.begin(), all.end(), Index{0});
    const SensitivityPrecision precision =
        sensitivity_precision(model, theta, model.products(theta, model.target()).gram, all);
    if (precision.inverse_gram.size() > 0) {
        estimate.covariance = estimate.noise_variance[0] * precision.inverse_gram.topLeftCorner(d, d);
        estimate.condition_number = precision.condition_number;
    }
    estimate.std = estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

bool begins_at_rest(const StartCondition& condition) {
    return condition.state == InitialState::kZero && !condition.offset;
}

/// Under one start condition.
Fit fit_condition(const DiscreteOutput& model, const IdData& data, const FitOptions& options,
                  const DiscreteSearch& search) {
    const Vector y = model.target();
    InstrumentSolution solution = search(model, y);
    const double squares = solution.loss * static_cast<double>(y.size());
    const Index N = data.sample_count(), d = model.orders().parameter_count();
    Fit fit = polynomial_fit(model.orders(), solution.theta.head(d), data.Ts);
    fit.loss = squares / static_cast<double>(N);
    fit.noise_variance = Vector::Constant(1, squares / static_cast<double>(N - value_count(model)));
    fit.fit_percent = Vector::Constant(1, fit_percent_of_sums(squares, model.target_variation()));
    fit.prediction_fit_percent = fit.fit_percent[0];
    fit.start = model.condition();
    fit.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), 1);
    for (std::size_t e = 0; e < data.experiments.size() && fit.start.offset; ++e)
        fit.offsets(static_cast<Index>(e), 0) = solution.theta[model.offset_index(e)];
    fit.termination = solution.termination;
    fit.trace = std::move(solution.trace);
    add_uncertainty(fit, model, solution.theta);
    warn_of_search(fit, options);
    if (solution.reflected)
        fit.warnings.push_back(
            Message("Unstable poles occurred during the search and were reflected into the unit circle."));
    warn_of_doubtful_parameters(fit);
    warn_of_unstable_polynomials(fit);
    const Number percent = significant(fit.fit_percent[0], 4);
    fit.message = has_settled(fit) ? Message("The search converged after {} for a simulation {}: fit {} %.",
                                             iteration_count(fit), description(fit.start), percent)
                                   : Message("The search stopped after {} for a simulation {}: fit {} %.",
                                             iteration_count(fit), description(fit.start), percent);
    return fit;
}

}  // namespace

DiscreteSearch output_error_search(const FitOptions& options) {
    return [options](const DiscreteOutput& model, const Vector& y) {
        const Vector start = instrument_start(model, y, options.cancel);
        const InstrumentSolution rough =
            iterate_instruments(model, y, start, kScreeningIterations, kScreeningTolerance, options.cancel);
        const Fit end = minimize_output_error(model, y, rough.theta, options);
        return InstrumentSolution{end.theta, end.loss, end.termination, end.trace, false};
    };
}

std::vector<SampledExperiment> sampled_experiments(const IdData& data) {
    std::vector<SampledExperiment> experiments;
    for (const Experiment& experiment : data.experiments) experiments.push_back({experiment.u, experiment.y.col(0)});
    return experiments;
}

Fit fit_discrete_output(const std::string& method, const IdData& data, const PolynomialOrders& orders,
                        const FitOptions& options, const DiscreteSearch& search) {
    orders.validate();
    options.validate();
    if (orders.na + orders.nc + orders.nd > 0)
        throw InvalidArgument("{} has only the orders nb, nf and nk: na, nc and nd must be zero", method);
    check_polynomial_data(method, data, orders);
    const CenteredData data_set = centered_for(data, options.offset);
    const std::vector<SampledExperiment> experiments = sampled_experiments(data_set.data);
    const auto values = [&](const StartCondition& condition) {
        return value_count(DiscreteOutput(orders, condition, experiments));
    };
    const auto conditions = start_conditions(data_set.data, options.initial_state, options.offset);
    check_sample_count(method, data.sample_count(), values(conditions.front()));
    const auto fit_one = [&](const StartCondition& condition) {
        return fit_condition(DiscreteOutput(orders, condition, experiments), data_set.data, options, search);
    };
    if (!start_is_open(options)) {
        Fit best = fit_output_error({method, data_set.data, conditions, values, fit_one});
        add_operating_points(best, data_set.removed);
        return best;
    }
    const std::vector<StartCondition> rest{conditions.front()};
    const Fit plain = fit_output_error({method, data_set.data, rest, values, fit_one});
    if (plain.termination == Termination::kCanceled || !other_discrete_start_promises(data, plain, options))
        return plain;
    return fit_output_error({method, data_set.data, conditions, values, [&](const StartCondition& condition) {
                                 return begins_at_rest(condition) ? plain : fit_one(condition);
                             }});
}

}  // namespace dynlab::inline numerics
