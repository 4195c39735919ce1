#include "numerics/estimators/srivc.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/finished_fit.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/start_choice.h"
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kReweightings = 3;
constexpr double kGramTolerance = 1e-6;  // relative change of theta; standard errors change by some 20 times as much

/// (sum Z'Z/noise variance)^-1 of each denominator group; `last_gram` is sum Z'Z of the last pass, or empty.
void set_covariance(Fit& estimate, const IdData& data, const FitOptions& options, const Matrix& last_gram) {
    const TransferStructure& structure = estimate.structure;
    estimate.covariance = Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        DenominatorGroup group(data, structure, static_cast<Index>(g), options.hold_y);
        const Index d = group.parameter_count(), place = group.place();
        const double largest = estimate.noise_variance.maxCoeff();  // keeps the weights finite without noise
        for (const Index output : group.outputs())
            group.set_weight(output, largest > 0 ? largest / estimate.noise_variance[output] : 1);
        double condition = 0;
        const Matrix gram = last_gram.size() > 0 ? Matrix(last_gram.block(place, place, d, d))
                                                 : group.refined(estimate.theta.segment(place, d), true).z_z;
        estimate.covariance.block(place, place, d, d) = largest * inverse_gram(gram, &condition);
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
}

/// The passes; where outputs share a denominator, more of them with each output weighted by its noise.
SrivcSolution solve(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    SrivcExtras extras;
    extras.with_gram = structure.outputs == 1 && options.tolerance <= kGramTolerance;
    const Vector start = start_from_rest(data, structure, options, CutoffTrials::kValleys);
    SrivcSolution solution = iterate_srivc(data, structure, start, options, extras);
    for (int i = 0; structure.outputs_share_denominator() && i < kReweightings; ++i) {
        extras.weights.resize(structure.outputs);
        for (Index output = 0; output < structure.outputs; ++output)
            extras.weights[output] = 1 / simulation_squares(data, structure, solution.theta, output);
        if (!extras.weights.allFinite()) break;
        extras.weights /= extras.weights.maxCoeff();
        SrivcSolution next = iterate_srivc(data, structure, solution.theta, options, extras);
        next.trace.insert(next.trace.begin(), solution.trace.begin(), solution.trace.end());
        solution = std::move(next);
    }
    return solution;
}

}  // namespace

Fit srivc_by_passes(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    check_transfer_data("srivc", data, structure);
    Fit estimate;
    estimate.structure = structure;
    SrivcSolution solution = solve(data, structure, options);
    estimate.theta = std::move(solution.theta);
    estimate.termination = solution.termination;
    estimate.trace = std::move(solution.trace);
    measure_simulation(estimate, data);
    set_covariance(estimate, data, options, solution.mirrored ? Matrix() : solution.gram);
    describe_models(estimate);
    const Message passes = plural(static_cast<std::int64_t>(estimate.trace.size()), "{} pass", "{} passes");
    if (estimate.termination == Termination::kConverged)
        estimate.message = Message("SRIVC converged after {}: {}.", passes, simulation_text(estimate));
    else
        estimate.message = Message("SRIVC did not converge after {}; the result is from the best pass: {}.", passes,
                                   simulation_text(estimate));
    return estimate;
}

namespace {

constexpr Index kComparedSamples = 10'000;  // on which poorer structures are compared
constexpr int kComparedPasses = 4;
constexpr Index kMinComparedParameters = 4;  // parameters: of smaller models the errors show a poor end
constexpr double kComparedTolerance = 1e-3, kNoGain = 1e-3;
constexpr double kPoorFit = 20;    // per cent: where little is explained, the passes easily miss the best
constexpr double kFineFit = 99.9;  // per cent: nothing is missing that would be worth a search

/// The best of the passes from these starts, from the structure's own without any; nothing where none is found.
NestedSolution solution_by_passes(const IdData& data, const TransferStructure& structure, std::vector<Vector> starts,
                                  const FitOptions& options) {
    NestedSolution best;
    try {
        if (starts.empty()) starts = {start_from_rest(data, structure, options)};
    } catch (const InvalidArgument&) {
        return best;
    }
    for (const Vector& start : starts) {
        const SrivcSolution passed = iterate_srivc(data, structure, start, options);
        const double loss = simulation_loss(data, structure, passed);
        if (loss < best.loss) best = {passed.theta, loss, structure};
    }
    return best;
}

/// The minimum of the criterion that the passes aim at, if the search for it ends lower.
Fit better_by_search(Fit estimate, const IdData& data, const FitOptions& options, const SearchAids& aids) {
    Fit searched = search_transfer("srivc", data, estimate.structure, options, aids);
    const bool settled = estimate.termination == Termination::kConverged;
    if (!(searched.loss < (settled ? 1 - kNoGain : 1) * estimate.loss)) return estimate;
    const Message passes = plural(static_cast<std::int64_t>(estimate.trace.size()), "{} pass", "{} passes");
    searched.message =
        settled ? Message("SRIVC converged after {} to a local minimum; a further search found a lower minimum: {}.",
                          passes, simulation_text(searched))
                : Message("SRIVC did not converge after {}; the result minimizes the output error instead: {}.", passes,
                          simulation_text(searched));
    return searched;
}

/// The geometric mean of the poles' frequencies, rad/s; nothing for a pole at zero.
std::optional<double> typical_frequency(const Fit& estimate) {
    const Index n = estimate.structure.poles.front();
    const double frequency = std::pow(std::abs(estimate.theta[n - 1]), 1 / static_cast<double>(n));
    return frequency > 0 && std::isfinite(frequency) ? std::optional<double>(frequency) : std::nullopt;
}

/// Whether a structure of lower order has a loss that is only slightly larger, or smaller, by its known fit or by
/// passes on the beginning of long data: then the passes may have ended in a poor minimum.
bool gains_nothing(const Fit& estimate, const IdData& data, const FitOptions& options,
                   const std::vector<const Fit*>& lower_order) {
    const auto has_similar_loss = [&](const Fit* fit) { return fit->loss < (1 + kNoGain) * estimate.loss; };
    if (!lower_order.empty()) return std::any_of(lower_order.begin(), lower_order.end(), has_similar_loss);
    if (estimate.theta.size() < kMinComparedParameters) return false;
    const bool whole = data.sample_count() <= 2 * kComparedSamples;
    const IdData part = whole ? IdData() : beginning_of(data, kComparedSamples);
    const IdData& data_set = whole ? data : part;
    FitOptions few = options.limited(kComparedPasses, kComparedTolerance);
    if (!few.lambda) few.lambda = typical_frequency(estimate);
    const auto solve = [&](const TransferStructure& structure, const std::vector<Vector>& starts) {
        return solution_by_passes(data_set, structure, starts, few);
    };
    const double loss = whole ? estimate.loss : simulation_loss(data_set, estimate.structure, estimate.theta);
    return !NestedSearch(data_set, solve).better_starts(estimate.structure, (1 + kNoGain) * loss).empty();
}

/// Whether the errors follow the input: what is missing may be within reach of the structure.
bool leaves_dynamics(const Fit& estimate, const IdData& data) {
    const TransferStructure& structure = estimate.structure;
    if (structure.inputs > 1 || structure.outputs > 1) return false;
    if (estimate.fit_percent[0] > kFineFit) return false;
    return data.sample_count() <= 2 * kComparedSamples
               ? errors_follow_input(data, estimate)
               : errors_follow_input(beginning_of(data, kComparedSamples), estimate);
}

}  // namespace

Fit search_where_passes_fail(Fit estimate, const IdData& data, const FitOptions& options, const SearchAids& aids) {
    const bool settled = estimate.termination == Termination::kConverged;
    const bool poor = !(estimate.fit_percent.minCoeff() > kPoorFit);
    if (!settled || poor || leaves_dynamics(estimate, data) || gains_nothing(estimate, data, options, aids.lower_order))
        return better_by_search(std::move(estimate), data, options, aids);
    check_transient("srivc", data, estimate, estimate.theta.size());
    return estimate;
}

bool srivc_passes_suffice(const TransferStructure& structure, const FitOptions& options) {
    if (structure.free_delays || options.initial_state != InitialState::kZero || options.offset != Offset::kNone)
        return false;
    if (!options.fixed.empty() || options.output_weights.size() > 0) return false;
    for (Index output = 0; output < structure.outputs; ++output)
        if (!structure.inputs_share_denominator(output)) return false;
    return true;
}

Fit srivc(const IdData& data, const TransferStructure& structure, const FitOptions& options, const SearchAids& aids) {
    options.validate();
    return finished_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        const FitOptions plain = start_is_open(requested) ? requested.from_rest() : requested;
        if (!srivc_passes_suffice(structure, plain) || aids.start.size() > 0)
            return search_with_chosen_start("srivc", seen, structure, requested, aids);
        const auto passes = [&](const FitOptions& how) { return srivc_by_passes(seen, structure, how); };
        const auto finish = [&](Fit estimate, const FitOptions& how) {
            if (estimate.termination == Termination::kCanceled) return estimate;
            return search_where_passes_fail(std::move(estimate), seen, how, aids);
        };
        if (!start_is_open(requested)) return finish(passes(requested), requested);
        const auto search = [&](const FitOptions& how) { return search_transfer("srivc", seen, structure, how, aids); };
        return with_chosen_start(seen, requested, {passes, finish, search});
    });
}

}  // namespace dynlab::inline numerics
