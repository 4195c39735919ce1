#include "numerics/estimators/procsrivc.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/criteria/process_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/process_start.h"
#include "numerics/fit/refined_iteration.h"
#include "numerics/fit/start_choice.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerProcessParameter = 3;
constexpr Index kProcessTrialSamples = 20'000;  // the start for a much longer record is found on its beginning
constexpr double kToldApart = 0.25;             // of a time constant or gain: a larger standard error is no start
constexpr double kCloseEvidence = 12;           // N BIC: start conditions that near are all fitted to the whole record

/// What is fitted, under any start condition.
struct ProcessProblem {
    const ProcessStructure& structure;
    DelayRange range;
    const FitOptions& options;

    TransferOutput output(const IdData& data, const StartCondition& condition) const {
        return {transfer_structure(structure), condition, data, range.least, range.largest, structure.integrator};
    }
    Index value_count(const IdData& data, const StartCondition& condition) const {
        const Index initial =
            condition.state == InitialState::kEstimate ? structure.poles + (structure.integrator ? 1 : 0) : 0;
        return static_cast<Index>(structure.parameter_names().size()) +
               (initial + (condition.offset ? 1 : 0)) * static_cast<Index>(data.experiments.size());
    }
    bool enough(const IdData& data, const StartCondition& condition) const {
        return data.sample_count() >= kSamplesPerProcessParameter * value_count(data, condition);
    }
};

/// What came of one start condition, in seconds.
struct ProcessSolution {
    StartCondition condition;
    OutputErrorSolution search;
    ProcessScan scan;
    Termination termination;
};
using ProcessCandidate = Candidate<ProcessSolution>;

void check_process_data(const IdData& data) {
    if (data.experiments.empty() || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument("procsrivc: the data must have one input and one output, and have " +
                              std::to_string(data.input_count()) + " input(s) and " +
                              std::to_string(data.output_count()) + " output(s): select one of each");
    check_signals("procsrivc", data);
}

/// What the options and the inputs allow. The free motion of an integrator is a constant itself, and it has no rest but
/// that at zero input.
std::vector<StartCondition> conditions_for(const IdData& data, const ProcessStructure& structure,
                                           const FitOptions& options) {
    std::vector<StartCondition> conditions = start_conditions(data, options.initial_state, options.offset);
    if (!structure.integrator) return conditions;
    const bool rests = std::all_of(data.experiments.begin(), data.experiments.end(),
                                   [](const Experiment& experiment) { return experiment.u(0, 0) == 0; });
    if (options.initial_state == InitialState::kSteady && !rests)
        throw InvalidArgument(
            "A process with an integrator rests at zero input only, so `initial_state` \"steady\" does not suit: use "
            "\"zero\", \"estimate\" or \"auto\"");
    if (options.initial_state == InitialState::kEstimate && options.offset == Offset::kEstimate)
        throw InvalidArgument(
            "The initial state of a process with an integrator holds its level already: with `initial_state` "
            "\"estimate\", let `offset` be \"none\", \"remove\" or \"auto\"");
    std::erase_if(conditions, [&](const StartCondition& condition) {
        return (condition.state == InitialState::kEstimate && condition.offset) ||
               (condition.state == InitialState::kSteady && options.initial_state == InitialState::kAuto);
    });
    return conditions;
}

/// The search under one start condition, from the best points of a grid unless a start (s) is given.
ProcessCandidate fit_condition(const ProcessProblem& problem, const IdData& data, const StartCondition& condition,
                               const Vector& start = {}) {
    const TransferOutput output = problem.output(data, condition);
    const Vector y = output.target(), seconds = process_seconds(problem.structure, output);
    const FitOptions& options = problem.options;
    ProcessScan scan;
    if (start.size() > 0)
        scan.starts = {start.cwiseQuotient(seconds)};
    else
        scan = scan_process_grid(problem.structure, output, options.delay_count);
    scan.delays *= output.time_unit();
    OutputErrorSolution search = minimise_output_error(process_output(problem.structure, output), y, scan.starts,
                                                       {options.max_iterations, options.tolerance, options.cancel});
    search.theta = search.theta.cwiseProduct(seconds).eval();
    search.covariance = (seconds.asDiagonal() * search.covariance * seconds.asDiagonal()).eval();
    for (FitIteration& iteration : search.trace) iteration.theta = iteration.theta.cwiseProduct(seconds).eval();
    const Index N = y.size();
    const double bic =
        bic_of_loss(search.loss, y.squaredNorm() / static_cast<double>(N), N, problem.value_count(data, condition));
    const Termination termination = search.termination;
    return {{condition, std::move(search), std::move(scan), termination}, bic};
}

ProcessSolution best_fit(const ProcessProblem& problem, const IdData& data,
                         const std::vector<StartCondition>& conditions) {
    return smallest_bic(
        conditions, [&](const StartCondition& condition) { return problem.enough(data, condition); },
        [&](const StartCondition& condition) { return fit_condition(problem, data, condition); });
}

/// Whether a beginning of the record tells gain and time constants well enough to start from.
bool is_a_start(const ProcessProblem& problem, const OutputErrorSolution& search) {
    if (search.termination != Termination::kConverged && search.termination != Termination::kNoProgress) return false;
    if (!(search.condition_number < kAmbiguousCondition)) return false;
    const auto names = problem.structure.parameter_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Index k = static_cast<Index>(i);
        const bool scales = names[i] == "Kp" || names[i] == "Tw" || names[i].starts_with("Tp");
        const double std = std::sqrt(std::max(0.0, search.covariance(k, k)));
        if (search.at_bound[i] || (scales && !(std <= kToldApart * std::abs(search.theta[k])))) return false;
    }
    return true;
}

/// The conditions worth a fit to the whole record of N samples. An initial state shows at the beginning, so that the
/// evidence for it, n ln V of the beginning's n samples, is that of the whole; an offset shows the better the longer
/// the record, so that there both are worth it.
std::vector<ProcessSolution> worth_a_fit(std::vector<ProcessCandidate> trials, const ProcessProblem& problem,
                                         const IdData& beginning, Index N) {
    const auto evidence = [&](const ProcessCandidate& trial) {
        const double n = static_cast<double>(beginning.sample_count());
        const double values = static_cast<double>(problem.value_count(beginning, trial.result.condition));
        return n * trial.bic + values * (std::log(static_cast<double>(N)) - std::log(n));
    };
    std::vector<ProcessSolution> chosen;
    for (ProcessCandidate& trial : trials) {
        const bool behind = std::any_of(trials.begin(), trials.end(), [&](const ProcessCandidate& other) {
            return other.result.condition.offset == trial.result.condition.offset &&
                   evidence(other) + kCloseEvidence < evidence(trial);
        });
        if (!behind) chosen.push_back(trial.result);
    }
    return chosen;
}

bool input_changes(const IdData& data) {
    return std::any_of(data.experiments.begin(), data.experiments.end(),
                       [](const Experiment& e) { return (e.u.array() != e.u(0, 0)).any(); });
}

/// A long record: every start condition on its beginning, then those worth it on the whole, from where these ended.
ProcessSolution best_fit_to_long(const ProcessProblem& problem, const IdData& data,
                                 const std::vector<StartCondition>& conditions) {
    const IdData beginning = beginning_of(data, kProcessTrialSamples);
    ProcessProblem trial = problem;
    if (!problem.options.largest_delay)
        trial.range.largest =
            std::max(problem.range.least, std::min(problem.range.largest, shortest_record(beginning) / 4));
    if (data.sample_count() < 2 * beginning.sample_count() || !input_changes(beginning) ||
        shortest_record(beginning) <= trial.range.largest)
        return best_fit(problem, data, conditions);
    std::vector<ProcessCandidate> trials;
    for (const StartCondition& condition : conditions) {
        trials.push_back(fit_condition(trial, beginning, condition));
        if (trials.back().result.termination == Termination::kCancelled) return best_fit(problem, data, {condition});
    }
    std::vector<ProcessSolution> starts = worth_a_fit(std::move(trials), problem, beginning, data.sample_count());
    if (!std::all_of(starts.begin(), starts.end(),
                     [&](const ProcessSolution& start) { return is_a_start(problem, start.search); }))
        return best_fit(problem, data, conditions);
    std::vector<StartCondition> worth;
    for (const ProcessSolution& start : starts) worth.push_back(start.condition);
    std::size_t next = 0;
    return smallest_bic(
        worth, [](const StartCondition&) { return true; },
        [&](const StartCondition& condition) {
            ProcessSolution& start = starts[next++];
            ProcessCandidate candidate = fit_condition(problem, data, condition, start.search.theta);
            candidate.result.scan = std::move(start.scan);
            return candidate;
        });
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

void warn_of_times(Fit& result, double Ts, double longest) {
    const ProcessStructure& structure = result.process->structure;
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

void warn_of_zero(Fit& result) {
    const double Tz = result.process->parameter("Tz");
    for (std::size_t i = 1; i < result.names.size(); ++i) {
        const double value = result.theta[static_cast<Index>(i)];
        if (result.names[i].starts_with("Tp") && std::abs(Tz - value) < 0.02 * value)
            result.warnings.push_back("The zero nearly cancels " + result.names[i] +
                                      ": a structure with one pole less and without Z is enough.");
    }
}

std::string process_message(const Fit& fit) {
    return "Output error " + ending_text(fit) + ", simulating " + description(fit.start) + ": fit " +
           number_text(fit.fit_percent[0], 4) + " %.";
}

/// With the time constants in order.
Fit fit_of(const ProcessProblem& problem, const IdData& data, ProcessSolution solution) {
    const TransferOutput output = problem.output(data, solution.condition);
    Vector all = solution.search.theta;
    Matrix covariance = solution.search.covariance;
    sort_time_constants(problem.structure, all, covariance);
    const Index linear = output.linear_count(), q = all.size() - linear;
    Fit fit;
    fit.process.emplace(problem.structure, all.head(q));
    fit.models = {fit.process->transfer_function()};
    fit.names = problem.structure.parameter_names();
    fit.theta = all.head(q);
    fit.covariance = covariance.topLeftCorner(q, q);
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    fit.noise_variance = Vector::Constant(1, solution.search.noise_variance);
    fit.loss = solution.search.loss;
    fit.condition_number = solution.search.condition_number;
    fit.start = solution.condition;
    const Index first = output.parameter_count() - linear;  // of what is not the process's own, in output's parameters
    fit.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), 1);
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        if (output.initial_count(0) > 0)
            fit.initial_values.emplace_back(
                all.segment(q + output.initial_place(e, 0) - first, output.initial_count(0)));
        if (solution.condition.offset)
            fit.offsets(static_cast<Index>(e), 0) = all[q + output.offset_place(e, 0) - first];
    }
    fit.fit_percent = Vector::Constant(
        1, fit_percent_of_sums(fit.loss * static_cast<double>(data.sample_count()), output_variations(data)[0]));
    fit.output = std::move(solution.search.output);
    fit.delay_grid = solution.scan.delays;
    fit.delay_loss = solution.scan.losses;
    fit.termination = solution.termination;
    fit.trace = std::move(solution.search.trace);
    return fit;
}

}  // namespace

Fit procsrivc(const IdData& data, const ProcessStructure& structure, const ProcsrivcOptions& options) {
    options.validate();
    check_process_data(data);
    const CentredData record = centred_for(data, options.offset);
    const ProcessProblem problem{structure, delay_range(data, options), options};
    const auto conditions = conditions_for(record.data, structure, options);
    const Index values = problem.value_count(data, conditions[0]), fewest = kSamplesPerProcessParameter * values;
    if (data.sample_count() < fewest)
        throw InvalidArgument("procsrivc: at least " + std::to_string(fewest) + " samples are needed for " +
                              std::to_string(values) + " values, and the data hold " +
                              std::to_string(data.sample_count()));
    Fit fit = fit_of(problem, record.data, best_fit_to_long(problem, record.data, conditions));
    check_transient("procsrivc", record.data, fit, problem.value_count(data, fit.start));
    Index row = 0;
    for (std::size_t e = 0; e < record.removed.size(); ++e) {
        fit.output.segment(row, data.sample_count(e)).array() += record.removed[e][0].output;
        row += data.sample_count(e);
    }
    fit.removed = record.removed;
    warn_of_search(fit, options);
    warn_of_doubtful_parameters(fit);
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    warn_of_times(fit, data.mean_step(), longest);
    if (structure.zero) warn_of_zero(fit);
    if (structure.delay) warn_of_delay(fit, fit.theta[fit.theta.size() - 1], problem.range, "");
    set_message(fit, process_message(fit));
    return fit;
}

}  // namespace dynlab::inline numerics
