#include "numerics/fit/srivc_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/sampled_starts.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kComparedSamples = 10'000;  // on which poorer structures are compared
constexpr int kComparedPasses = 4;
constexpr Index kFewestToCompare = 4;  // parameters: smaller models were not seen to end in bad minima
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
    const std::string passes = std::to_string(estimate.trace.size()) + " passes";
    set_message(searched, (settled ? "SRIVC converged after " + passes +
                                         " to a local minimum; a further search found this lower one: "
                                   : "SRIVC had not settled after " + passes +
                                         "; this is the minimum of the output error, which they aim at: ") +
                              simulation_text(searched) + ".");
    return searched;
}

/// The geometric mean of the poles' frequencies, rad/s; nothing for a pole at zero.
std::optional<double> typical_frequency(const Fit& estimate) {
    const Index n = estimate.structure.poles.front();
    const double frequency = std::pow(std::abs(estimate.theta[n - 1]), 1 / static_cast<double>(n));
    return frequency > 0 && std::isfinite(frequency) ? std::optional<double>(frequency) : std::nullopt;
}

/// Whether a poorer structure has a loss hardly larger or smaller, by its known fit or by passes on the beginning of a
/// long record: then the passes may have ended in a bad minimum.
bool gains_nothing(const Fit& estimate, const IdData& data, const FitOptions& options,
                   const std::vector<const Fit*>& poorer) {
    const auto hardly_larger = [&](const Fit* fit) { return fit->loss < (1 + kNoGain) * estimate.loss; };
    if (!poorer.empty()) return std::any_of(poorer.begin(), poorer.end(), hardly_larger);
    if (estimate.theta.size() < kFewestToCompare) return false;
    const bool whole = data.sample_count() <= 2 * kComparedSamples;
    const IdData part = whole ? IdData() : beginning_of(data, kComparedSamples);
    const IdData& record = whole ? data : part;
    FitOptions few = options.limited(kComparedPasses, kComparedTolerance);
    if (!few.lambda) few.lambda = typical_frequency(estimate);
    const auto solve = [&](const TransferStructure& structure, const std::vector<Vector>& starts) {
        return solution_by_passes(record, structure, starts, few);
    };
    const double loss = whole ? estimate.loss : simulation_loss(record, estimate.structure, estimate.theta);
    return !NestedSearch(record, solve).better_starts(estimate.structure, (1 + kNoGain) * loss).empty();
}

/// Whether the errors follow the input: what is missing may be within reach of the structure.
bool leaves_dynamics(const Fit& estimate, const IdData& data) {
    const TransferStructure& structure = estimate.structure;
    if (structure.inputs > 1 || structure.outputs > 1 || estimate.theta.size() < kFewestToCompare) return false;
    if (estimate.fit_percent[0] > kFineFit) return false;
    return data.sample_count() <= 2 * kComparedSamples
               ? errors_follow_input(data, estimate)
               : errors_follow_input(beginning_of(data, kComparedSamples), estimate);
}

}  // namespace

Fit search_where_passes_fail(Fit estimate, const IdData& data, const FitOptions& options, const SearchAids& aids) {
    const bool settled = estimate.termination == Termination::kConverged;
    const bool poor = !(estimate.fit_percent.minCoeff() > kPoorFit);
    const bool alone = aids.poorer.empty();
    if (!settled || poor || (alone && leaves_dynamics(estimate, data)) ||
        gains_nothing(estimate, data, options, aids.poorer))
        return better_by_search(std::move(estimate), data, options, aids);
    check_transient("srivc", data, estimate, estimate.theta.size());
    return estimate;
}

}  // namespace dynlab::inline numerics
