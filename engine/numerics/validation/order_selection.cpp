#include "numerics/validation/order_selection.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/integrated_input.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/start_choice.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/side_by_side.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/fit_measures.h"
#include "numerics/validation/uncertainty.h"

namespace dynlab::inline numerics {
namespace {

constexpr int kMaxCandidates = 2000;
// Of the output's mean square: smaller errors are those of an iteration that has settled, of some 1e-9 in the
// parameters.
constexpr double kRoundingShare = 1e-18;

Comparison comparison_of(const IdData& data, const Fit& estimate, Offset asked) {
    const Offset chosen = estimate.start.offset ? Offset::kEstimate : Offset::kNone;
    return compare_all(data, estimate.models,
                       {estimate.start.state, asked == Offset::kRemove ? Offset::kRemove : chosen});
}

/// Closer than a tenth of their distance from the origin and not distinct by three standard deviations, or closer than
/// a hundredth.
bool cancel(const RootUncertainty& pole, const RootUncertainty& zero) {
    const double gap = std::abs(pole.root - zero.root), size = std::max(std::abs(pole.root), std::abs(zero.root));
    if (gap <= 0.01 * size) return true;
    const double spread = std::sqrt(pole.covariance.trace() + zero.covariance.trace());
    return gap <= 0.1 * size && !(gap > 3 * spread);
}

/// Closer to the integrator's pole, 0, than a tenth of the slowest pole's distance and not distinct from 0 by three
/// standard deviations, or closer than a hundredth.
bool cancels_integrator(const RootUncertainty& zero, double slowest) {
    const double gap = std::abs(zero.root);
    return gap <= 0.01 * slowest || (gap <= 0.1 * slowest && !(gap > 3 * std::sqrt(zero.covariance.trace())));
}

bool has_cancellation(const Fit& estimate, bool integrator) {
    if (!estimate.covariance.allFinite()) return false;
    const UncertainModel model(estimate.models.front(), estimate.covariance);
    const std::vector<RootUncertainty> zeros = zero_uncertainty(model);
    double slowest = kInfinity;
    for (const RootUncertainty& pole : pole_uncertainty(model)) {
        slowest = std::min(slowest, std::abs(pole.root));
        for (const RootUncertainty& zero : zeros)
            if (cancel(pole, zero)) return true;
    }
    return integrator && std::any_of(zeros.begin(), zeros.end(), [slowest](const RootUncertainty& zero) {
               return cancels_integrator(zero, slowest);
           });
}

bool has_constant_inputs(const IdData& data) {
    return std::any_of(data.experiments.begin(), data.experiments.end(),
                       [](const Experiment& experiment) { return (experiment.u.array() == experiment.u(0, 0)).all(); });
}

/// Minus infinity for an unstable model that leaves the range of numbers.
double validation_fit(const IdData& data, const Fit& estimate, Offset offset) {
    // With a constant input a free motion and a constant together would hide the gain.
    const bool hidden = offset == Offset::kEstimate && has_constant_inputs(data);
    const InitialState state = hidden ? InitialState::kAuto : InitialState::kEstimate;
    const double fit = compare_all(data, estimate.models, {state, offset}).fit_percent[0];
    return std::isfinite(fit) ? fit : -std::numeric_limits<double>::infinity();
}

/// The integrator's initial state is that of the output, and takes in any offset of it.
double validation_fit_with_integrator(const IdData& data, Fit estimate) {
    append_integrator(estimate);
    return validation_fit(data, estimate, Offset::kNone);
}

/// Where each fit chose its start, what that costs counts; otherwise it is the same for all of them.
Index counted_values(const Fit& estimate, const IdData& data, const FitOptions& estimation) {
    if (!start_is_open(estimation)) return estimate.theta.size();
    return value_count(estimate.structure, estimate.start, static_cast<Index>(data.experiments.size()));
}

Offset offset_of(const Fit& estimate, const FitOptions& estimation) {
    if (!start_is_open(estimation)) return estimation.offset;
    return estimate.start.offset ? Offset::kEstimate : Offset::kNone;
}

void measure(OrderCandidate& candidate, const IdData& data, const OrderSelectionOptions& options) {
    const Fit& estimate = candidate.estimate;
    const Offset offset = offset_of(estimate, options.estimation);
    const Comparison comparison = comparison_of(data, estimate, offset);
    const LevelledOutputs outputs = levelled_outputs(data, comparison);
    const Index N = data.sample_count(), d = counted_values(estimate, data, options.estimation);
    const auto samples = static_cast<double>(N), count = static_cast<double>(d);
    const double mean_square = (outputs.measured - outputs.simulated).squaredNorm() / samples;
    const InformationCriteria criteria = information_criteria(mean_square, N, d);
    candidate.delay = estimate.models.front().delay();
    candidate.r_squared = r_squared_simulation(outputs.measured, outputs.swing);
    candidate.yic = yic(outputs.measured, outputs.swing, estimate.theta, estimate.covariance).value;
    candidate.aic = criteria.aic;
    candidate.bic = criteria.bic;
    candidate.fpe = criteria.fpe;
    candidate.log_condition = std::log10(estimate.condition_number);
    candidate.iterations = static_cast<int>(estimate.trace.size());
    candidate.fit_percent = comparison.fit_percent[0];
    const double rounding = kRoundingShare * outputs.measured.squaredNorm() / samples;
    candidate.evidence = samples * std::log(std::max(mean_square, rounding)) + count * std::log(samples);
    candidate.undetermined = undetermined_parameters(estimate.names, estimate.theta, estimate.std);
    candidate.cancellation = has_cancellation(estimate, options.estimation.integration);
    candidate.converged = estimate.termination == Termination::kConverged;
    candidate.unstable =
        !options.estimation.integration && std::any_of(estimate.models.begin(), estimate.models.end(),
                                                       [](const TransferFunction& model) { return !model.stable(); });
    if (options.validation == nullptr) return;
    candidate.validation_fit = options.estimation.integration
                                   ? validation_fit_with_integrator(*options.validation, estimate)
                                   : validation_fit(*options.validation, estimate, offset);
}

/// `lower_order`: fits of all structures that are a step poorer, or none.
OrderCandidate candidate_of(const IdData& data, const TransferStructure& structure,
                            const OrderSelectionOptions& options, std::vector<const Fit*> lower_order) {
    OrderCandidate candidate;
    candidate.poles = structure.poles.front();
    candidate.zeros = structure.channels.front().zeros;
    candidate.delay = structure.channels.front().delay;
    candidate.integrator = options.estimation.integration;
    FitOptions estimation = options.estimation;
    estimation.integration = false;  // `data` are integrated
    try {
        candidate.estimate = srivc(data, structure, estimation, {{}, {}, std::move(lower_order)});
        if (!candidate.estimate.theta.allFinite()) throw InvalidArgument("a parameter is not finite");
        measure(candidate, data, options);
    } catch (const std::exception& error) {
        candidate.failure = message_of(error);
    }
    return candidate;
}

void check_channels(const IdData& data, bool of_validation) {
    const Index inputs = data.input_count(), outputs = data.output_count();
    if (inputs == 1 && outputs == 1) return;
    throw InvalidArgument(
        of_validation
            ? Message("the validation data must have one input and one output, but they have {} and {}; select one of "
                      "each",
                      inputs, outputs)
            : Message("the data must have one input and one output, but they have {} and {}; select one of each",
                      inputs, outputs));
}

void check_selection(const IdData& data, const std::vector<TransferStructure>& candidates,
                     const OrderSelectionOptions& options) {
    check_channels(data, false);
    if (options.validation != nullptr) check_channels(*options.validation, true);
    if (options.threads < 0)
        throw InvalidArgument("the number of threads must be nonnegative, but {} was given", options.threads);
    if (candidates.empty())
        throw InvalidArgument(
            "no structure can be tried: the number of zeros must be less than the number of poles, or equal with "
            "direct "
            "feedthrough");
    for (const TransferStructure& structure : candidates) {
        structure.validate();
        if (!structure.single_channel()) throw InvalidArgument("every structure must have one input and one output");
    }
}

/// Places of the structures in the order of estimation: the structures of one list can be estimated together, because
/// all structures with fewer parameters are in lists before it.
std::vector<std::vector<std::size_t>> levels_of(const std::vector<TransferStructure>& structures) {
    std::map<int, std::vector<std::size_t>> levels;
    for (std::size_t i = 0; i < structures.size(); ++i)
        levels[structures[i].poles.front() + structures[i].channels.front().zeros].push_back(i);
    std::vector<std::vector<std::size_t>> all;
    for (auto& [sum, places] : levels) all.push_back(std::move(places));
    return all;
}

bool is_structure_of(const TransferStructure& a, const TransferStructure& b) {
    return a.poles == b.poles && a.channels.front().zeros == b.channels.front().zeros &&
           a.channels.front().delay == b.channels.front().delay && a.free_delays == b.free_delays;
}

/// The fits of the structures a step poorer than one of them; none unless all of these are among the structures.
std::vector<const Fit*> poorer_fits(const std::vector<TransferStructure>& structures, std::size_t of,
                                    const std::vector<OrderCandidate>& candidates) {
    std::vector<const Fit*> fits;
    for (const TransferStructure& lower_order : lower_order_structures(structures[of])) {
        const auto known = std::find_if(structures.begin(), structures.end(), [&](const TransferStructure& one) {
            return is_structure_of(one, lower_order);
        });
        if (known == structures.end()) return {};
        const OrderCandidate& candidate = candidates[static_cast<std::size_t>(known - structures.begin())];
        if (candidate.failure.empty()) fits.push_back(&candidate.estimate);
    }
    return fits;
}

}  // namespace

std::vector<TransferStructure> order_grid(std::pair<int, int> poles, std::pair<int, int> zeros,
                                          const std::vector<double>& delays, bool free_delay, bool feedthrough) {
    if (poles.first < 1 || poles.second < poles.first)
        throw InvalidArgument(
            "option 'poles' must be a range {from, to} with 1 <= from <= to, such as {1, 4}, or one number");
    if (zeros.first < 0 || zeros.second < zeros.first)
        throw InvalidArgument(
            "option 'zeros' must be a range {from, to} with 0 <= from <= to, such as {0, 2}, or one number");
    if (delays.empty()) throw InvalidArgument("at least one delay must be given; use 0 for no delay");
    const double requested =
        (1.0 + poles.second - poles.first) * (1.0 + zeros.second - zeros.first) * static_cast<double>(delays.size());
    if (requested > kMaxCandidates)
        throw InvalidArgument("more than {} structures would be tried: use smaller ranges", kMaxCandidates);
    std::vector<TransferStructure> grid;
    for (int n = poles.first; n <= poles.second; ++n)
        for (int m = zeros.first; m <= std::min(zeros.second, feedthrough ? n : n - 1); ++m)
            for (const double delay : delays) {
                grid.push_back(TransferStructure::single(n, m, delay));
                grid.back().free_delays = free_delay;
            }
    return grid;
}

OrderSelection select_order(const IdData& data, const std::vector<TransferStructure>& candidates,
                            const OrderSelectionOptions& options) {
    check_selection(data, candidates, options);
    const IdData integrated = options.estimation.integration ? integrated_inputs(data) : IdData();
    const IdData& seen = options.estimation.integration ? integrated : data;
    OrderSelection selection;
    selection.samples = data.sample_count();
    selection.validated = options.validation != nullptr;
    selection.candidates.resize(candidates.size());
    std::mutex callbacks;
    std::size_t done = 0;
    const auto stopped = [&] {
        const std::scoped_lock lock(callbacks);
        selection.canceled = selection.canceled || (options.cancel && options.cancel());
        return selection.canceled;
    };
    const auto try_one = [&](std::size_t i) {
        OrderCandidate& candidate = selection.candidates[i];
        if (stopped()) {
            candidate.failure = Message("the search was interrupted");
            return;
        }
        candidate = candidate_of(seen, candidates[i], options, poorer_fits(candidates, i, selection.candidates));
        const std::scoped_lock lock(callbacks);
        if (options.progress) options.progress(++done);
    };
    tbb::task_arena arena(thread_count(options.threads));
    for (const std::vector<std::size_t>& level : levels_of(candidates))
        arena.execute([&] {
            tbb::parallel_for(
                tbb::blocked_range<std::size_t>(0, level.size(), 1),
                [&](const tbb::blocked_range<std::size_t>& range) {
                    for (std::size_t i = range.begin(); i < range.end(); ++i) try_one(level[i]);
                },
                tbb::simple_partitioner());
        });
    const auto estimated = [](const OrderCandidate& candidate) { return candidate.failure.empty(); };
    if (options.estimation.integration)
        for (OrderCandidate& candidate : selection.candidates)
            if (estimated(candidate)) append_integrator(candidate.estimate);
    if (!selection.canceled && std::none_of(selection.candidates.begin(), selection.candidates.end(), estimated))
        throw InvalidArgument("none of the structures could be estimated; the first error: {}",
                              selection.candidates.front().failure);
    return selection;
}

}  // namespace dynlab::inline numerics
