#include "numerics/estimators/procsrivc.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/criteria/process_output.h"
#include "numerics/error.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/process_start.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/signals/response_peaks.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerProcessParameter = 3;
constexpr Index kProcessTrialSamples = 20'000;  // for much longer data the start is found on their beginning
constexpr double kMaxRelativeStd = 0.25;        // of a time constant or gain: a larger standard error is no start
constexpr double kCloseEvidence = 12;           // N BIC: start conditions this close are all fitted to all samples

/// What is fitted, under any start condition.
struct ProcessProblem {
    const ProcessStructure& structure;
    DelayRange range;
    const FitOptions& options;
    Vector likely_delays = {};  // s

    /// With an estimated start the first `masked_seconds` seconds do not count (fit/transfer_refinement.h).
    TransferOutput output(const IdData& data, const StartCondition& condition, double masked_seconds = 0) const {
        TransferOutput model(transfer_structure(structure), condition, data, range.least, range.largest,
                             at_rest(structure));
        if (condition.state == InitialState::kEstimate) model.mask_start(masked_seconds);
        return model;
    }
    Index value_count(const IdData& data, const StartCondition& condition) const {
        const Index initial =
            condition.state == InitialState::kEstimate ? structure.poles + (structure.integrator ? 1 : 0) : 0;
        return static_cast<Index>(structure.parameter_names().size()) +
               (initial + (condition.offset ? 1 : 0)) * static_cast<Index>(data.experiments.size());
    }
    /// rad/s, where the model may have one.
    Vector resonances(const IdData& data) const {
        constexpr std::size_t kMaxResonances = 4;
        const std::vector<double> peaks =
            structure.underdamped ? response_peaks(data, kMaxResonances) : std::vector<double>();
        return Vector::Map(peaks.data(), static_cast<Index>(peaks.size()));
    }
    Fit fit(const IdData& data, const StartCondition& condition, const Fit* start = nullptr,
            double masked_seconds = 0) const;
    Fit best_fit(const IdData& data, const std::vector<StartCondition>& conditions,
                 const std::vector<Fit>& starts = {}) const;
};

void check_process_data(const IdData& data) {
    if (data.experiments.empty() || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument(
            "procsrivc: the data must have one input and one output, but have {} and {}: select one of each",
            plural(data.input_count(), "{} input", "{} inputs"),
            plural(data.output_count(), "{} output", "{} outputs"));
    check_signals("procsrivc", data);
}

/// What the options and the inputs allow. The free motion of an integrator is a constant itself, and it has no rest but
/// that at zero input.
std::vector<StartCondition> conditions_for(const IdData& data, const ProcessStructure& structure,
                                           const FitOptions& options) {
    std::vector<StartCondition> conditions = start_conditions(data, options.initial_state, options.offset);
    // Behind a constant input a free motion and an offset fit alike with other gains: chance would choose.
    if (options.initial_state == InitialState::kAuto && options.offset == Offset::kAuto && !inputs_change(data))
        std::erase_if(conditions, [](const StartCondition& one) { return one.state != InitialState::kZero; });
    if (!structure.integrator) return conditions;
    const bool rests =
        std::ranges::all_of(data.experiments, [](const Experiment& experiment) { return experiment.u(0, 0) == 0; });
    if (options.initial_state == InitialState::kSteady && !rests)
        throw InvalidArgument(
            "A process with an integrator is at rest only for zero input, so {} = \"steady\" is unsuitable: use "
            "\"none\", \"estimate\" or \"auto\"",
            OptionName{"initial_state"});
    if (options.initial_state == InitialState::kEstimate && options.offset == Offset::kEstimate)
        throw InvalidArgument(
            "The initial state of a process with an integrator already includes the output level: with {} = "
            "\"estimate\", set {} to \"none\", \"remove\" or \"auto\"",
            OptionName{"initial_state"}, OptionName{"offset"});
    std::erase_if(conditions, [&](const StartCondition& condition) {
        return (condition.state == InitialState::kEstimate && condition.offset) ||
               (condition.state == InitialState::kSteady && options.initial_state == InitialState::kAuto);
    });
    return conditions;
}

/// The search under one start condition, from the best points of a grid unless a start is given.
Fit ProcessProblem::fit(const IdData& data, const StartCondition& condition, const Fit* start,
                        double masked_seconds) const {
    const TransferOutput model = output(data, condition, masked_seconds);
    const Vector y = model.target(), seconds = process_seconds(structure, model);
    ProcessScan scan;
    if (start != nullptr)
        scan = {{search_point(*start, model, seconds)}, start->delay_grid / model.time_unit(), start->delay_loss};
    else
        scan = scan_process_grid(structure, model, options.delay_count, likely_delays / model.time_unit(),
                                 resonances(data) * model.time_unit());
    Fit fit = minimize_output_error(process_output(structure, model), y, scan.starts, options);
    keep_parameters(fit, model, condition, seconds);
    const double squares = fit.loss * static_cast<double>(model.sample_count());
    fit.fit_percent = Vector::Constant(1, fit_percent_of_sums(squares, counted_variations(model)[0]));
    fit.delay_grid = scan.delays * model.time_unit();
    fit.delay_loss = scan.losses;
    return fit;
}

/// Over the conditions, from a start for each of them when they are given.
Fit ProcessProblem::best_fit(const IdData& data, const std::vector<StartCondition>& conditions,
                             const std::vector<Fit>& starts) const {
    return fit_output_error({"procsrivc", data, conditions,
                             [&](const StartCondition& condition) { return value_count(data, condition); },
                             [&](const StartCondition& condition) {
                                 const auto start = std::ranges::find_if(starts, [&](const Fit& one) {
                                     return one.start.state == condition.state && one.start.offset == condition.offset;
                                 });
                                 return fit(data, condition, start == starts.end() ? nullptr : &*start);
                             },
                             kSamplesPerProcessParameter});
}

/// Whether the beginning of the data determines gain and time constants well enough for a start.
bool is_a_start(const ProcessProblem& problem, const Fit& search) {
    if (search.termination != Termination::kConverged && search.termination != Termination::kNoProgress) return false;
    if (!(search.condition_number < kAmbiguousCondition)) return false;
    const auto names = problem.structure.parameter_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Index k = static_cast<Index>(i);
        const bool scales = names[i] == "Kp" || names[i] == "Tw" || names[i].starts_with("Tp");
        const double std = std::sqrt(std::max(0.0, search.covariance(k, k)));
        if (search.at_bound[i] || (scales && !(std <= kMaxRelativeStd * std::abs(search.theta[k])))) return false;
    }
    return true;
}

/// The fits to the beginning whose conditions justify a fit to all N samples. An initial state affects the beginning,
/// so that the evidence for it, n ln V of the beginning's n samples, equals that of all samples. The evidence for an
/// offset grows with the length of the data; there both conditions justify a fit.
std::vector<Fit> worth_a_fit(const std::vector<Fit>& trials, const ProcessProblem& problem, const IdData& beginning,
                             Index N) {
    const auto evidence = [&](const Fit& trial) {
        const double n = static_cast<double>(beginning.sample_count());
        const Index values = problem.value_count(beginning, trial.start);
        return n * bic_of(trial, beginning, values) +
               static_cast<double>(values) * (std::log(static_cast<double>(N)) - std::log(n));
    };
    std::vector<Fit> chosen;
    for (const Fit& trial : trials) {
        const bool behind = std::ranges::any_of(trials, [&](const Fit& other) {
            return other.start.offset == trial.start.offset && evidence(other) + kCloseEvidence < evidence(trial);
        });
        if (!behind) chosen.push_back(trial);
    }
    return chosen;
}

/// Where a transfer function of as many poles and zeros has its smallest losses: between the delays of a coarse grid
/// such a valley may be missed.
Vector likely_delays(const IdData& data, const ProcessProblem& problem) {
    constexpr double kFineGrid = 2;  // samples
    const double spacing = (problem.range.largest - problem.range.least) / problem.options.delay_count;
    if (!problem.structure.delay || spacing <= kFineGrid * data.mean_step()) return {};
    const TransferStructure transfer = transfer_structure(problem.structure);
    const CenteredData centered = without_operating_points(data);
    const DelayScan scan = scan_delays(centered.data, transfer, problem.options);
    Vector delays(scan.starts.size());
    for (std::size_t i = 0; i < scan.starts.size(); ++i)
        delays[static_cast<Index>(i)] = transfer.delay(scan.starts[i], 0, 0);
    return delays;
}

/// For long data: fits every start condition to the beginning, then the justified ones to all samples, from their ends.
Fit best_fit_to_long(ProcessProblem problem, const IdData& data, const std::vector<StartCondition>& conditions) {
    const IdData beginning = beginning_of(data, kProcessTrialSamples);
    ProcessProblem trial = problem;
    if (!problem.options.largest_delay)
        trial.range.largest =
            std::max(problem.range.least, std::min(problem.range.largest, shortest_experiment(beginning) / 4));
    if (data.sample_count() < 2 * beginning.sample_count() || !inputs_change(beginning) ||
        shortest_experiment(beginning) <= trial.range.largest) {
        problem.likely_delays = likely_delays(data, problem);
        return problem.best_fit(data, conditions);
    }
    problem.likely_delays = trial.likely_delays = likely_delays(beginning, trial);
    std::vector<Fit> trials;
    for (const StartCondition& condition : conditions) {
        trials.push_back(trial.fit(beginning, condition));
        if (trials.back().termination == Termination::kCanceled) return problem.best_fit(data, {condition});
    }
    const std::vector<Fit> starts = worth_a_fit(trials, problem, beginning, data.sample_count());
    if (!std::ranges::all_of(starts, [&](const Fit& start) { return is_a_start(problem, start); }))
        return problem.best_fit(data, conditions);
    std::vector<StartCondition> worth;
    for (const Fit& start : starts) worth.push_back(start.start);
    return problem.best_fit(data, worth, starts);
}

/// With an estimated start: leaves out the beginning, in which inputs from before the first sample still arrive.
Fit without_masked_inputs(const ProcessProblem& problem, const IdData& data, Fit fit) {
    if (!problem.structure.delay) return fit;
    const double masked_seconds = masked_start(fit.start, fit.theta[fit.theta.size() - 1], data);
    if (masked_seconds == 0) return fit;
    Fit next = problem.fit(data, fit.start, &fit, masked_seconds);
    next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
    return next;
}

Index real_lag_count(const ProcessStructure& structure) {
    return structure.underdamped ? structure.poles - 2 : structure.poles;
}

// In falling order.
void sort_time_constants(Fit& fit, const ProcessStructure& structure) {
    std::vector<Index> order(static_cast<std::size_t>(fit.theta.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin() + 1, order.begin() + 1 + real_lag_count(structure),
                     [&](Index a, Index b) { return fit.theta[a] > fit.theta[b]; });
    fit.theta = fit.theta(order).eval();
    fit.covariance = fit.covariance(order, order).eval();
    const std::vector<bool> at_bound = fit.at_bound;
    for (std::size_t i = 0; i < order.size(); ++i) fit.at_bound[i] = at_bound[static_cast<std::size_t>(order[i])];
}

void warn_of_times(Fit& result, double Ts, double longest) {
    const ProcessStructure& structure = result.process->structure;
    for (std::size_t i = 1; i < result.names.size(); ++i) {
        const std::string& name = result.names[i];
        const double value = result.theta[static_cast<Index>(i)];
        if (name.front() != 'T' || name == "Td" || name == "Tz") continue;
        if (value < 0.1 * Ts)
            result.warnings.push_back(Message(
                "{} is much smaller than the sampling time: a structure with fewer poles is sufficient.", name));
        if (value > longest)
            result.warnings.push_back(
                Message("{} is longer than the duration of the data and cannot be distinguished from the gain: record "
                        "a longer experiment.",
                        name));
    }
    const Index lags = real_lag_count(structure);
    for (Index i = 1; i < lags; ++i)
        if (result.theta[i] < 1.05 * result.theta[i + 1]) {
            result.warnings.push_back(
                Message("Two time constants are nearly equal, so their standard errors are unreliable: a structure "
                        "with U may be better."));
            break;
        }
    if (structure.underdamped && result.theta[lags + 2] >= 1)
        result.warnings.push_back(
            Message("Zeta is at least 1, so the system does not oscillate: use P{} without U.", structure.poles));
}

void warn_of_zero(Fit& result) {
    const double Tz = result.process->parameter("Tz");
    for (std::size_t i = 1; i < result.names.size(); ++i) {
        const double value = result.theta[static_cast<Index>(i)];
        if (result.names[i].starts_with("Tp") && std::abs(Tz - value) < 0.02 * value)
            result.warnings.push_back(
                Message("The zero nearly cancels {}: a structure with one fewer pole and without Z is sufficient.",
                        result.names[i]));
    }
}

Message process_message(const Fit& fit) {
    const Number percent = significant(fit.fit_percent[0], 4);
    return has_settled(fit) ? Message("The output-error search converged after {} for a simulation {}: fit {} %.",
                                      iteration_count(fit), description(fit.start), percent)
                            : Message("The output-error search stopped after {} for a simulation {}: fit {} %.",
                                      iteration_count(fit), description(fit.start), percent);
}

/// The model of a fit, with its time constants in order.
void set_process(Fit& fit, const ProcessStructure& structure) {
    sort_time_constants(fit, structure);
    fit.process = std::make_shared<ProcessModel>(structure, fit.theta);
    fit.models = {fit.process->transfer_function()};
    fit.names = structure.parameter_names();
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

/// Of what has no standard errors.
void warn_of_undetermined(Fit& fit, const IdData& data, const FitOptions& options) {
    if (fit.process->structure.delay && has_ambiguous_delay(fit.models.front(), data)) {
        withdraw_errors(fit, {"Tz", "Td"});
        fit.warnings.push_back(
            Message("Tz and Td cannot be distinguished within one sampling time for any input. They have no standard "
                    "errors, because the input has a zero-order hold and the model has as many zeros as poles. Use a "
                    "structure without D or Z."));
    } else if (!withdraw_errors_of_gain(fit, data))
        warn_of_doubtful_parameters(fit);
    withdraw_errors_at_bounds(fit, options);
}

/// The simulated output of all experiments, its operating points included.
Vector simulated(const Fit& fit, const ProcessProblem& problem, const CenteredData& data_set) {
    const TransferOutput model = problem.output(data_set.data, fit.start);
    const Vector seconds = process_seconds(problem.structure, model);
    Vector output = process_output(problem.structure, model).output_at(search_point(fit, model, seconds));
    for (std::size_t e = 0; e < data_set.removed.size(); ++e)
        output.segment(model.row(e, 0), model.rows(e)).array() += data_set.removed[e][0].output;
    return output;
}

}  // namespace

Fit procsrivc(const IdData& data, const ProcessStructure& structure, const ProcsrivcOptions& options) {
    options.validate();
    check_process_data(data);
    const CenteredData data_set = centered_for(data, options.offset);
    const ProcessProblem problem{structure, delay_range(data, options), options};
    const auto conditions = conditions_for(data_set.data, structure, options);
    const Index values = problem.value_count(data, conditions[0]), min_samples = kSamplesPerProcessParameter * values;
    if (data.sample_count() < min_samples)
        throw InvalidArgument("procsrivc: at least {} samples are needed to estimate {} values, but the data have {}",
                              min_samples, values, data.sample_count());
    Fit fit = best_fit_to_long(problem, data_set.data, conditions);
    fit = without_masked_inputs(problem, data_set.data, std::move(fit));
    set_process(fit, structure);
    fit.output = simulated(fit, problem, data_set);
    add_operating_points(fit, data_set.removed);
    warn_of_search(fit, options);
    warn_of_undetermined(fit, data, options);
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    warn_of_times(fit, data.mean_step(), longest);
    if (structure.zero) warn_of_zero(fit);
    if (structure.delay) {
        const double delay = fit.theta[fit.theta.size() - 1];
        warn_of_delay(fit, delay, problem.range);
        warn_of_later_response(fit, data, 0, 0, delay, problem.range.largest);
    }
    fit.message = process_message(fit);
    return fit;
}

}  // namespace dynlab::inline numerics
