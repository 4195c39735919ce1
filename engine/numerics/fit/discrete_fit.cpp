#include "numerics/fit/discrete_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numerics/error.h"
#include "numerics/fit/output_error.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kScreeningIterations = 20;
constexpr double kScreeningTolerance = 1e-3;

struct DiscreteRecord {
    std::vector<SampledExperiment> experiments;
    Vector removed_outputs;  ///< per experiment
    Index samples = 0;
    double power = 0;  ///< mean square of the output
};

void remove_operating_point(SampledExperiment& experiment, double& removed_output) {
    const bool single = experiment.u.cols() == 1;
    removed_output = experiment.y.mean();
    for (Index input = 0; input < experiment.u.cols(); ++input) {
        OperatingPoint point{experiment.u.col(input).mean(), removed_output};
        if (single) point = operating_point(experiment.u.col(input), experiment.y);
        experiment.u.col(input).array() -= point.input;
        removed_output = point.output;
    }
    experiment.y.array() -= removed_output;
}

DiscreteRecord prepared_record(const IdData& data, Offset offset) {
    DiscreteRecord record;
    record.experiments = sampled_experiments(data, offset, &record.removed_outputs);
    for (const SampledExperiment& experiment : record.experiments) {
        record.samples += experiment.y.size();
        record.power += experiment.y.squaredNorm();
    }
    record.power /= static_cast<double>(record.samples);
    return record;
}

/// Two samples that say what start_conditions asks of an input, for all inputs together: whether the first
/// samples are zero, and whether anything changes.
Vector summary_of_inputs(const DiscreteRecord& record) {
    double first = 0, change = 0;
    for (const SampledExperiment& experiment : record.experiments) {
        first = std::max(first, experiment.u.row(0).cwiseAbs().maxCoeff());
        change = std::max(change, (experiment.u.rowwise() - experiment.u.row(0)).cwiseAbs().maxCoeff());
    }
    return Eigen::Vector2d(first, first + change);
}

struct DiscreteFit {
    StartCondition condition;
    InstrumentSolution solution;
    double squared_errors = 0, squared_variation = 0;
    Index values = 0;  ///< all that were estimated, samples left free among them
    double bic = std::numeric_limits<double>::infinity();
};

Index value_count(const DiscreteOutput& model) {
    return model.parameter_count() + model.left_out();
}

DiscreteFit fit_condition(const DiscreteRecord& record, const DiscreteOutput& model, const DiscreteSearch& search) {
    DiscreteFit fit;
    fit.condition = model.condition();
    const Vector y = model.target();
    fit.solution = search(model, y);
    fit.squared_errors = fit.solution.loss * static_cast<double>(y.size());
    fit.squared_variation = model.target_variation();
    fit.values = value_count(model);
    fit.bic =
        bic_of_loss(fit.squared_errors / static_cast<double>(record.samples), record.power, record.samples, fit.values);
    return fit;
}

StepFit step_fit(const DiscreteRecord& record, const DiscreteFit& fit) {
    const double N = static_cast<double>(record.samples);
    double spread = 0;
    for (const SampledExperiment& experiment : record.experiments)
        spread += (experiment.y.array() - experiment.y.mean()).square().sum();
    return {fit.squared_errors / N, spread / N, record.power,
            record.samples,         fit.values, static_cast<Index>(record.experiments.size())};
}

void require_samples(const std::string& method, const DiscreteRecord& record, Index values) {
    if (record.samples > values) return;
    throw InvalidArgument(method + " needs more samples than the " + std::to_string(values) +
                          " values it estimates, and the record holds " + std::to_string(record.samples));
}

DiscreteFit best_fit(const std::string& method, const DiscreteRecord& record, const PolynomialOrders& orders,
                     const PolynomialOptions& options, const DiscreteSearch& search) {
    const auto conditions = start_conditions(summary_of_inputs(record), options.initial_state, options.offset);
    DiscreteFit best;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const DiscreteOutput model(orders, conditions[i], record.experiments);
        if (i == 0) require_samples(method, record, value_count(model));
        if (record.samples <= value_count(model)) continue;
        DiscreteFit fit = fit_condition(record, model, search);
        if (i == 0 || fit.bic < best.bic) best = std::move(fit);
        if (best.solution.termination == Termination::kCancelled) break;
    }
    return best;
}

/// Covariance and condition number from the sensitivities at the solution.
void add_uncertainty(PolynomialEstimate& estimate, const DiscreteOutput& model, const Vector& theta) {
    const Index d = estimate.theta.size();
    estimate.covariance = Matrix::Constant(d, d, std::numeric_limits<double>::infinity());
    estimate.condition_number = std::numeric_limits<double>::infinity();
    std::vector<Index> all(static_cast<std::size_t>(theta.size()));
    std::iota(all.begin(), all.end(), Index{0});
    const SensitivityPrecision precision =
        sensitivity_precision(model, theta, model.products(theta, model.target()).gram, all);
    if (precision.inverse_gram.size() > 0) {
        estimate.covariance = estimate.noise_variance * precision.inverse_gram.topLeftCorner(d, d);
        estimate.condition_number = precision.condition_number;
    }
    estimate.std = estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

void add_warnings(PolynomialEstimate& estimate, const DiscreteFit& fit, const PolynomialOptions& options) {
    auto& warnings = estimate.warnings;
    warn_of_termination(estimate, options.MaxIter);
    if (fit.solution.reflected)
        warnings.push_back("Unstable poles turned up on the way and were mirrored into the unit circle.");
    warn_of_doubtful_parameters(estimate);
    for (std::size_t input = 0; input < estimate.orders.inputs(); ++input)
        if (!estimate.model.transfer_function(input).stable())
            warnings.push_back("The model has a pole outside or on the unit circle.");
}

std::string message_of_fit(const PolynomialEstimate& estimate) {
    std::string text = ending_text(estimate) + ", simulating " + description(estimate.start) + ": fit " +
                       number_text(estimate.fit_percent, 4) + " %.";
    for (const std::string& warning : estimate.warnings) text += ' ' + warning;
    return text;
}

}  // namespace

DiscreteSearch output_error_search(const PolynomialOptions& options) {
    return [options](const DiscreteOutput& model, const Vector& y) {
        const Vector start = instrument_start(model, y, options.cancel);
        const InstrumentSolution rough =
            iterate_instruments(model, y, start, kScreeningIterations, kScreeningTolerance, options.cancel);
        const OutputErrorSolution end =
            minimise_output_error(model, y, rough.theta, {options.MaxIter, options.Tol, options.cancel});
        InstrumentSolution solution;
        solution.theta = end.theta;
        solution.loss = end.loss;
        solution.termination = end.termination;
        for (const OutputErrorIteration& iteration : end.trace)
            solution.trace.push_back({iteration.loss, iteration.change});
        return solution;
    };
}

std::vector<SampledExperiment> sampled_experiments(const IdData& data, Offset offset, Vector* removed_outputs) {
    std::vector<SampledExperiment> experiments;
    Vector removed = Vector::Zero(static_cast<Index>(data.experiments.size()));
    for (const Experiment& experiment : data.experiments) {
        experiments.push_back({experiment.u, experiment.y.col(0)});
        if (offset == Offset::kRemove)
            remove_operating_point(experiments.back(), removed[static_cast<Index>(experiments.size()) - 1]);
    }
    if (removed_outputs != nullptr) *removed_outputs = removed;
    return experiments;
}

PolynomialEstimate fit_discrete_output(const std::string& method, const IdData& data, const PolynomialOrders& orders,
                                       const PolynomialOptions& options, const DiscreteSearch& search) {
    orders.validate();
    options.validate();
    if (orders.na + orders.nc + orders.nd > 0)
        throw InvalidArgument(method + " has the orders nb, nf and nk only: na, nc and nd must be zero");
    check_polynomial_data(method, data, orders);
    const DiscreteRecord record = prepared_record(data, options.offset);
    const DiscreteFit fit = best_fit(method, record, orders, options, search);
    const Vector summary = summary_of_inputs(record);
    if (summary[0] == summary[1] && fit.solution.termination != Termination::kCancelled)
        require_transient(method, step_fit(record, fit));
    const DiscreteOutput model(orders, fit.condition, record.experiments);

    const Vector& theta = fit.solution.theta;
    PolynomialEstimate estimate(orders, theta.head(orders.parameter_count()), data.Ts);
    estimate.loss = fit.squared_errors / static_cast<double>(record.samples);
    estimate.noise_variance = fit.squared_errors / static_cast<double>(record.samples - fit.values);
    estimate.fit_percent = fit_percent_of_sums(fit.squared_errors, fit.squared_variation);
    estimate.prediction_fit_percent = estimate.fit_percent;
    add_uncertainty(estimate, model, theta);
    estimate.start = fit.condition;
    estimate.offsets = record.removed_outputs;
    if (fit.condition.offset)
        for (std::size_t e = 0; e < record.experiments.size(); ++e)
            estimate.offsets[static_cast<Index>(e)] += theta[model.offset_place(e)];
    estimate.termination = fit.solution.termination;
    estimate.trace = fit.solution.trace;
    add_warnings(estimate, fit, options);
    estimate.message = message_of_fit(estimate);
    return estimate;
}

}  // namespace dynlab::inline numerics
