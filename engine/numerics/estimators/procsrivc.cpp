#include "numerics/estimators/procsrivc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "numerics/criteria/process_output.h"
#include "numerics/error.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/polynomial_estimate.h"
#include "numerics/fit/process_start.h"
#include "numerics/fit/transfer_data.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerProcessParameter = 3;

struct Problem {
    IdData data;  // from which the estimate is made: without operating points, with Offset "remove"
    std::vector<OperatingPoint> removed;
    std::vector<ProcessInput> inputs;
    Vector y;                           // of all experiments
    double spread = 0;                  // sum of squares of y about each experiment's mean
    double unit = 1;                    // s, the time unit: the sampling time, or the mean step
    double least_delay, largest_delay;  // units
    double longest = 0;                 // s, of the longest record
    bool flat = true;                   // no input ever changes
};

void check_data(const IdData& data) {
    if (data.experiments.empty() || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument("procsrivc: the data must have one input and one output, and have " +
                              std::to_string(data.input_count()) + " input(s) and " +
                              std::to_string(data.output_count()) + " output(s): select one of each");
    const auto all = [&](auto&& flat) { return std::all_of(data.experiments.begin(), data.experiments.end(), flat); };
    if (all([](const Experiment& experiment) { return experiment.u.isZero(0); }))
        throw InvalidArgument(
            "procsrivc: the input is zero throughout, so it excites nothing and nothing can be learnt");
    if (all([](const Experiment& experiment) { return (experiment.y.array() == experiment.y(0, 0)).all(); }))
        throw InvalidArgument("procsrivc: the output never changes, so nothing can be learnt");
}

Problem problem_of(const IdData& data, const ProcsrivcOptions& options) {
    check_data(data);
    Problem problem{data, std::vector<OperatingPoint>(data.experiments.size()), {}, {}, 0, data.mean_step(), 0, 0, 0,
                    true};
    if (options.offset == Offset::kRemove) {
        CentredData centred = without_operating_points(data);
        problem.data = std::move(centred.data);
        for (std::size_t e = 0; e < problem.removed.size(); ++e)
            problem.removed[e] = {centred.removed[e][0].inputs[0], centred.removed[e][0].output};
    }
    problem.y.resize(data.sample_count());
    Index row = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        const Experiment& experiment = problem.data.experiments[e];
        ProcessInput input{experiment.u.col(0), data.hold, {}};
        if (!data.regular()) input.t = (experiment.t.array() - experiment.t[0]) / problem.unit;
        problem.flat = problem.flat && (input.u.array() == input.u[0]).all();
        problem.inputs.push_back(std::move(input));
        problem.y.segment(row, experiment.y.rows()) = experiment.y;
        row += experiment.y.rows();
        problem.spread += (experiment.y.array() - experiment.y.mean()).square().sum();
        problem.longest = std::max(problem.longest, data.duration(e));
    }
    TransferOptions bounds;
    bounds.TdMin = options.TdMin;
    bounds.TdMax = options.TdMax;
    const DelayRange range = delay_range(data, bounds);
    problem.least_delay = range.least / problem.unit;
    problem.largest_delay = range.largest / problem.unit;
    return problem;
}

struct Fit {
    StartCondition condition;
    OutputErrorSolution solution;
    ProcessScan scan;
    double bic = std::numeric_limits<double>::infinity();
};

Index value_count(const Problem& problem, const ProcessStructure& structure, const StartCondition& condition) {
    const Index own = initial_value_count(structure, condition) + (condition.offset ? 1 : 0);
    return static_cast<Index>(structure.parameter_names().size()) + own * static_cast<Index>(problem.inputs.size());
}

Fit fit_condition(const Problem& problem, const ProcessStructure& structure, const StartCondition& condition,
                  const ProcsrivcOptions& options) {
    const ProcessOutput model(structure, condition, problem.inputs, problem.least_delay, problem.largest_delay);
    const Index N = problem.y.size(), d = model.parameter_count();
    Fit fit{condition, {}, scan_process_grid(model, problem.y, options.NumTd)};
    fit.solution =
        minimise_output_error(model, problem.y, fit.scan.starts, {options.MaxIter, options.Tol, options.cancel});
    fit.bic = bic_of_loss(fit.solution.loss, problem.y.squaredNorm() / static_cast<double>(N), N, d);
    return fit;
}

// What the options and the inputs allow. The free motion of an integrator is a constant itself, and it has no rest but
// that at zero input.
std::vector<StartCondition> conditions_for(const Problem& problem, const ProcessStructure& structure,
                                           const ProcsrivcOptions& options) {
    std::vector<StartCondition> conditions = start_conditions(problem.data, options.initial_state, options.offset);
    if (!structure.integrator) return conditions;
    const bool rests = std::all_of(problem.inputs.begin(), problem.inputs.end(),
                                   [](const ProcessInput& input) { return input.u[0] == 0; });
    if (options.initial_state == InitialState::kSteady && !rests)
        throw InvalidArgument(
            "A process with an integrator rests at zero input only, so InitialState \"steady\" does not suit: use "
            "\"zero\", \"estimate\" or \"auto\"");
    if (options.initial_state == InitialState::kEstimate && options.offset == Offset::kEstimate)
        throw InvalidArgument(
            "The initial state of a process with an integrator holds its level already: with InitialState "
            "\"estimate\", let Offset be \"none\", \"remove\" or \"auto\"");
    std::erase_if(conditions, [&](const StartCondition& condition) {
        return (condition.state == InitialState::kEstimate && condition.offset) ||
               (condition.state == InitialState::kSteady && options.initial_state == InitialState::kAuto);
    });
    return conditions;
}

Fit best_fit(const Problem& problem, const ProcessStructure& structure, const ProcsrivcOptions& options) {
    const auto conditions = conditions_for(problem, structure, options);
    const Index N = problem.y.size(),
                fewest = kSamplesPerProcessParameter * value_count(problem, structure, conditions[0]);
    if (N < fewest)
        throw InvalidArgument("procsrivc: at least " + std::to_string(fewest) + " samples are needed for " +
                              std::to_string(fewest / kSamplesPerProcessParameter) + " values, and the data hold " +
                              std::to_string(N));
    Fit best = fit_condition(problem, structure, conditions.front(), options);
    for (std::size_t i = 1; i < conditions.size(); ++i) {
        if (best.solution.termination == Termination::kCancelled) break;
        if (N < kSamplesPerProcessParameter * value_count(problem, structure, conditions[i])) continue;
        Fit fit = fit_condition(problem, structure, conditions[i], options);
        if (fit.bic < best.bic) best = std::move(fit);
    }
    if (problem.flat && best.solution.termination != Termination::kCancelled)
        require_transient("procsrivc",
                          {best.solution.loss, problem.spread / static_cast<double>(N),
                           problem.y.squaredNorm() / static_cast<double>(N), N,
                           value_count(problem, structure, best.condition), static_cast<Index>(problem.inputs.size())});
    return best;
}

// The factor from time units to seconds of each estimated value.
Vector units(const Problem& problem, const ProcessStructure& structure, const Fit& fit) {
    Vector factor = Vector::Ones(fit.solution.theta.size());
    const auto names = structure.parameter_names();
    Index i = 0;
    for (const std::string& name : names) factor[i++] = name.front() == 'T' ? problem.unit : 1;
    if (structure.integrator) factor[0] = 1 / problem.unit;
    for (std::size_t e = 0; e < problem.inputs.size(); ++e)
        for (Index j = 0; j < initial_value_count(structure, fit.condition); ++j)
            factor[i++] = std::pow(problem.unit, -static_cast<double>(j));
    return factor;
}

void set_start_values(ProcsrivcResult& result, const Problem& problem, const Fit& fit, const Vector& all) {
    const Index values = initial_value_count(result.model.structure, fit.condition);
    const auto experiments = static_cast<Index>(problem.inputs.size());
    for (Index e = 0; values > 0 && e < experiments; ++e)
        result.initial_values.emplace_back(all.segment(result.theta.size() + e * values, values));
    result.offsets = fit.condition.offset ? Vector(all.tail(experiments)) : Vector(Vector::Zero(experiments));
    result.output = fit.solution.output;
    Index row = 0;
    for (std::size_t e = 0; e < problem.inputs.size(); ++e) {
        result.output.segment(row, problem.inputs[e].u.size()).array() += problem.removed[e].output;
        row += problem.inputs[e].u.size();
    }
    result.removed = problem.removed;
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

void warn_of_times(ProcsrivcResult& result, double Ts, double longest) {
    const ProcessStructure& structure = result.model.structure;
    for (std::size_t i = 1; i < result.names.size(); ++i) {
        const std::string& name = result.names[i];
        const double value = result.theta[static_cast<Index>(i)];
        if (name.front() != 'T' || name == "Td" || name == "Tz") continue;
        if (value < 0.1 * Ts)
            result.warnings.push_back(name +
                                      " is far below the sampling time: a structure with fewer poles is enough.");
        if (value > longest)
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

void warn_of_delay(ProcsrivcResult& result, double least, double largest) {
    const double Td = result.theta[result.theta.size() - 1], edge = 1e-9 * largest;
    if (Td >= largest - edge && largest > least)
        result.warnings.push_back("The delay lies at TdMax = " + number_text(largest) +
                                  " s, the edge of what was searched: raise TdMax.");
    else if (Td <= least + edge && least > 0)
        result.warnings.push_back("The delay lies at TdMin = " + number_text(least) +
                                  " s, the edge of what was searched: lower TdMin.");
    else if (Td <= edge && largest > 0)
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
    text << "Output error " << (done ? "converged" : "stopped") << " after " << iterations_text(result.trace.size())
         << ", simulating " << description(result.start) << ": fit " << number_text(result.fit_percent, 4) << " %.";
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
    const Problem problem = problem_of(data, options);
    Fit fit = best_fit(problem, structure, options);

    const Vector factor = units(problem, structure, fit);
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
    set_start_values(result, problem, fit, all);
    result.fit_percent = 100 * (1 - (problem.y - fit.solution.output).norm() / std::sqrt(problem.spread));
    result.delay_grid = fit.scan.delays * problem.unit;
    result.delay_loss = fit.scan.losses;
    result.termination = fit.solution.termination;
    result.trace = std::move(fit.solution.trace);
    warn_of_search(result, fit.solution.condition_number, options);
    warn_of_times(result, problem.unit, problem.longest);
    if (structure.zero) warn_of_zero(result);
    if (structure.delay)
        warn_of_delay(result, problem.least_delay * problem.unit, problem.largest_delay * problem.unit);
    result.message = message_of(result);
    return result;
}

}  // namespace dynlab::inline numerics
