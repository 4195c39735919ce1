#include "numerics/estimators/procsrivc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "numerics/error.h"
#include "numerics/kernels/polynomial_estimate.h"
#include "numerics/kernels/process_output.h"
#include "numerics/kernels/process_start.h"
#include "numerics/number_text.h"
#include "numerics/validation/fit_measures.h"

namespace dynlab {

namespace {

constexpr Index kSamplesPerParameter = 3;

struct Record {
    Vector u, y;
    Vector t;   // irregular instants in units of Ts, from 0 on
    double Ts;  // s, the mean step with irregular sampling
    Hold hold;
    OperatingPoint removed;
};

Record prepared_record(const IdData& data, const ProcsrivcOptions& options) {
    std::ostringstream text;
    if (data.experiments.size() != 1 || data.input_count() != 1 || data.output_count() != 1) {
        text << "procsrivc needs one experiment with one input and one output, and the data hold "
             << data.experiments.size() << " experiment(s), " << data.input_count() << " input(s) and "
             << data.output_count() << " output(s): select one of each";
        throw InvalidArgument(text.str());
    }
    const Experiment& experiment = data.experiments.front();
    Record record{experiment.u.col(0), experiment.y.col(0), {}, data.Ts, data.hold, {}};
    const Index steps = record.y.size() - 1;
    if (!data.regular() && steps > 0) {
        record.t = experiment.t.array() - experiment.t[0];
        record.Ts = record.t[steps] / static_cast<double>(steps);
        record.t /= record.Ts;
    }
    if (record.u.isZero(0)) throw InvalidArgument("procsrivc: the input is zero throughout, so nothing can be learnt");
    if ((record.y.array() == record.y[0]).all())
        throw InvalidArgument("procsrivc: the output never changes, so nothing can be learnt");
    if (options.offset == Offset::kRemove) {
        record.removed = operating_point(record.u, record.y);
        record.u.array() -= record.removed.input;
        record.y.array() -= record.removed.output;
    }
    return record;
}

struct DelayBounds {
    double least, largest;  // samples
};

DelayBounds delay_bounds(const Record& record, const ProcsrivcOptions& options) {
    const double duration = static_cast<double>(record.y.size() - 1) * record.Ts;
    const double largest = options.TdMax.value_or(std::max(options.TdMin, duration / 4));
    if (largest >= duration)
        throw InvalidArgument("TdMax must be shorter than the record of " + number_text(duration) + " s, and is " +
                              number_text(largest) + " s");
    return {options.TdMin / record.Ts, largest / record.Ts};
}

struct Fit {
    StartCondition condition;
    OutputErrorSolution solution;
    ProcessScan scan;
    double bic = std::numeric_limits<double>::infinity();
};

Fit fit_condition(const Record& record, const ProcessStructure& structure, const StartCondition& condition,
                  const ProcsrivcOptions& options) {
    const DelayBounds bounds = delay_bounds(record, options);
    const ProcessOutput model(structure, condition, {record.u, record.hold, record.t}, bounds.least, bounds.largest);
    const Index N = record.y.size(), d = model.parameter_count();
    if (N < kSamplesPerParameter * d)
        throw InvalidArgument("procsrivc needs at least " + std::to_string(kSamplesPerParameter * d) +
                              " samples for the " + std::to_string(d) + " values it estimates, and the record holds " +
                              std::to_string(N));
    Fit fit{condition, {}, scan_process_grid(model, record.y, options.NumTd)};
    fit.solution =
        minimise_output_error(model, record.y, fit.scan.starts, {options.MaxIter, options.Tol, options.cancel});
    fit.bic = bic_of_loss(fit.solution.loss, record.y.squaredNorm() / static_cast<double>(N), N, d);
    return fit;
}

Index initial_count(const ProcessStructure& structure, const StartCondition& condition) {
    return condition.state == InitialState::kEstimate ? structure.poles + (structure.integrator ? 1 : 0) : 0;
}

// What the options and the input allow. The free motion of an integrator is a constant itself, and it has no rest but
// that at zero input.
std::vector<StartCondition> conditions_for(const Record& record, const ProcessStructure& structure,
                                           const ProcsrivcOptions& options) {
    if (!structure.integrator) return start_conditions(record.u, options.initial_state, options.offset);
    if (options.initial_state == InitialState::kSteady && record.u[0] != 0)
        throw InvalidArgument(
            "A process with an integrator rests at zero input only, so InitialState \"steady\" does not suit: use "
            "\"zero\", \"estimate\" or \"auto\"");
    if (options.initial_state == InitialState::kEstimate && options.offset == Offset::kEstimate)
        throw InvalidArgument(
            "The initial state of a process with an integrator holds its level already: with InitialState "
            "\"estimate\", let Offset be \"none\", \"remove\" or \"auto\"");
    std::vector<StartCondition> conditions = start_conditions(record.u, options.initial_state, options.offset);
    std::erase_if(conditions, [&](const StartCondition& condition) {
        return (condition.state == InitialState::kEstimate && condition.offset) ||
               (condition.state == InitialState::kSteady && options.initial_state == InitialState::kAuto);
    });
    return conditions;
}

Fit best_fit(const Record& record, const ProcessStructure& structure, const ProcsrivcOptions& options) {
    const auto conditions = conditions_for(record, structure, options);
    Fit best = fit_condition(record, structure, conditions.front(), options);
    for (std::size_t i = 1; i < conditions.size(); ++i) {
        if (best.solution.termination == Termination::kCancelled) break;
        const Index d = static_cast<Index>(structure.parameter_names().size()) +
                        initial_count(structure, conditions[i]) + (conditions[i].offset ? 1 : 0);
        if (record.y.size() < kSamplesPerParameter * d) continue;
        Fit fit = fit_condition(record, structure, conditions[i], options);
        if (fit.bic < best.bic) best = std::move(fit);
    }
    return best;
}

// The factor from samples to seconds of each estimated value.
Vector units(const ProcessStructure& structure, const Fit& fit, double Ts) {
    Vector factor = Vector::Ones(fit.solution.theta.size());
    const auto names = structure.parameter_names();
    Index i = 0;
    for (const std::string& name : names) factor[i++] = name.front() == 'T' ? Ts : 1;
    if (structure.integrator) factor[0] = 1 / Ts;
    const Index values = initial_count(structure, fit.condition);
    for (Index j = 0; j < values; ++j) factor[i++] = std::pow(Ts, -static_cast<double>(j));
    return factor;
}

Index real_lag_count(const ProcessStructure& structure) {
    return structure.underdamped ? structure.poles - 2 : structure.poles;
}

// In falling order.
void sort_time_constants(const ProcessStructure& structure, Vector& theta, Matrix& covariance) {
    std::vector<Index> order(static_cast<std::size_t>(theta.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin() + 1, order.begin() + 1 + real_lag_count(structure),
                     [&](Index a, Index b) { return theta[a] > theta[b]; });
    theta = theta(order).eval();
    covariance = covariance(order, order).eval();
}

void warn_of_times(ProcsrivcResult& result, double Ts, double duration) {
    const ProcessStructure& structure = result.model.structure;
    for (std::size_t i = 1; i < result.names.size(); ++i) {
        const std::string& name = result.names[i];
        const double value = result.theta[static_cast<Index>(i)];
        if (name.front() != 'T' || name == "Td" || name == "Tz") continue;
        if (value < 0.1 * Ts)
            result.warnings.push_back(name +
                                      " is far below the sampling time: a structure with fewer poles is enough.");
        if (value > duration)
            result.warnings.push_back(name +
                                      " is longer than the record, which cannot tell it from the gain: record longer.");
    }
    const Index lags = real_lag_count(structure);
    for (Index i = 1; i < lags; ++i)
        if (result.theta[i] < 1.05 * result.theta[i + 1]) {
            result.warnings.push_back(
                "Two time constants are nearly equal, so their standard errors mean little: a structure with U may "
                "suit better.");
            break;
        }
    if (structure.underdamped && result.theta[lags + 2] >= 1)
        result.warnings.push_back("Zeta is at least 1, so the system does not swing: P" +
                                  std::to_string(structure.poles) + " without U suits it.");
}

void warn_of_zero(ProcsrivcResult& result) {
    const double Tz = result.model.parameter("Tz");
    for (std::size_t i = 1; i < result.names.size(); ++i) {
        const double value = result.theta[static_cast<Index>(i)];
        if (result.names[i].starts_with("Tp") && std::abs(Tz - value) < 0.02 * value)
            result.warnings.push_back("The zero nearly cancels " + result.names[i] +
                                      ": a structure with one pole less and without Z is enough.");
    }
}

void warn_of_delay(ProcsrivcResult& result, const DelayBounds& bounds, double Ts) {
    const double Td = result.theta[result.theta.size() - 1], edge = 1e-9 * (1 + bounds.largest) * Ts;
    if (Td >= bounds.largest * Ts - edge && bounds.largest > bounds.least)
        result.warnings.push_back("The delay lies at TdMax = " + number_text(bounds.largest * Ts) +
                                  " s, the edge of what was searched: raise TdMax.");
    else if (Td <= bounds.least * Ts + edge && bounds.least > 0)
        result.warnings.push_back("The delay lies at TdMin = " + number_text(bounds.least * Ts) +
                                  " s, the edge of what was searched: lower TdMin.");
    else if (Td <= edge && bounds.largest > 0)
        result.warnings.push_back("No delay is visible: a structure without D suits.");
}

void warn_of_search(ProcsrivcResult& result, double condition_number, const ProcsrivcOptions& options) {
    if (result.termination == Termination::kIterationLimit)
        result.warnings.push_back("The search had not settled after MaxIter = " + std::to_string(options.MaxIter) +
                                  " iterations; the best point so far is given.");
    if (result.termination == Termination::kCancelled)
        result.warnings.push_back("The search was stopped before its end; the best point so far is given.");
    if (!(condition_number < kAmbiguousCondition)) {
        result.warnings.push_back("The data do not tell all parameters apart (condition number " +
                                  number_text(condition_number, 2) +
                                  "): a simpler structure or a richer input is wanted.");
        return;
    }
    for (std::size_t i = 0; i < result.names.size(); ++i) {
        const Index k = static_cast<Index>(i);
        if (result.std[k] > std::abs(result.theta[k]) && result.names[i] != "Td")
            result.warnings.push_back("The data hardly determine " + result.names[i] +
                                      ": its standard error is larger than its value.");
    }
}

std::string message_of(const ProcsrivcResult& result) {
    const bool done = result.termination == Termination::kConverged || result.termination == Termination::kNoProgress;
    std::ostringstream text;
    text << "Output error " << (done ? "converged" : "stopped") << " after " << result.trace.size()
         << " iterations, simulating " << description(result.start) << ": fit " << number_text(result.fit_percent, 4)
         << " %.";
    for (const std::string& warning : result.warnings) text << ' ' << warning;
    return text.str();
}

}  // namespace

void ProcsrivcOptions::validate() const {
    OutputErrorOptions{MaxIter, Tol, {}}.validate();
    if (!(TdMin >= 0) || !std::isfinite(TdMin))
        throw InvalidArgument("TdMin must not be negative, and is " + number_text(TdMin));
    if (TdMax && (!(*TdMax >= TdMin) || !std::isfinite(*TdMax)))
        throw InvalidArgument("TdMax must be at least TdMin = " + number_text(TdMin) + ", and is " +
                              number_text(*TdMax));
    if (NumTd < 1) throw InvalidArgument("NumTd must be at least 1, and is " + std::to_string(NumTd));
}

ProcsrivcResult procsrivc(const IdData& data, const ProcessStructure& structure, const ProcsrivcOptions& options) {
    options.validate();
    const Record record = prepared_record(data, options);
    Fit fit = best_fit(record, structure, options);

    const Vector factor = units(structure, fit, record.Ts);
    Vector all = fit.solution.theta.cwiseProduct(factor);
    Matrix covariance = factor.asDiagonal() * fit.solution.covariance * factor.asDiagonal();
    sort_time_constants(structure, all, covariance);
    const auto names = structure.parameter_names();
    const Index q = static_cast<Index>(names.size());

    ProcsrivcResult result(ProcessModel(structure, all.head(q)));
    result.names = names;
    result.theta = all.head(q);
    result.covariance = covariance.topLeftCorner(q, q);
    result.std = result.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    result.noise_variance = fit.solution.noise_variance;
    result.loss = fit.solution.loss;
    result.start = fit.condition;
    result.initial_values = all.segment(q, initial_count(structure, fit.condition));
    if (fit.condition.offset) result.offset = all[all.size() - 1];
    result.removed = record.removed;
    result.output = fit.solution.output.array() + record.removed.output;
    result.fit_percent = fit_percent(record.y, fit.solution.output);
    result.delay_grid = fit.scan.delays * record.Ts;
    result.delay_loss = fit.scan.losses;
    result.termination = fit.solution.termination;
    result.trace = std::move(fit.solution.trace);
    warn_of_search(result, fit.solution.condition_number, options);
    warn_of_times(result, record.Ts, static_cast<double>(record.y.size() - 1) * record.Ts);
    if (structure.zero) warn_of_zero(result);
    if (structure.delay) warn_of_delay(result, delay_bounds(record, options), record.Ts);
    result.message = message_of(result);
    return result;
}

}  // namespace dynlab
