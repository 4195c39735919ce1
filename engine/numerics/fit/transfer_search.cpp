#include "numerics/fit/transfer_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/transfer_refinement.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kTrialSamples = 50'000;  // the start for a longer record is found on its beginning
constexpr double kTrialTolerance = 1e-4;
constexpr Index kNestedSamples = 100'000;  // poorer structures of longer records are not fitted

/// The best joint refinement from several starts.
Fit refine_from(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                const std::vector<Vector>& starts, const FitOptions& options) {
    Fit best;
    best.loss = kInfinity;
    for (const Vector& start : starts) {
        Fit estimate = refine_output_error(data, structure, condition, start, options);
        if (best.theta.size() == 0 || estimate.loss < best.loss) best = std::move(estimate);
        if (best.termination == Termination::kCancelled) break;
    }
    return best;
}

/// One search under a start condition, and what it begins with.
class NestedFits {
  public:
    NestedFits(const IdData& record, const IdData& for_start, const StartCondition& condition,
               const FitOptions& options)
        : record_(record), for_start_(for_start), condition_(condition), options_(options) {}

    /// The best of the refinements from these starts and, where an initial state is estimated, from the solution of the
    /// zero state.
    Fit best(const TransferStructure& structure, std::vector<Vector> starts) const {
        if (condition_.state == InitialState::kEstimate)
            starts.push_back(
                refine_from(record_, structure, {InitialState::kZero, condition_.offset}, starts, options_).theta);
        return refine_from(record_, structure, condition_, starts, options_);
    }

    /// The fit, or a better one from solutions of poorer structures that have a smaller loss.
    Fit no_worse(const TransferStructure& structure, Fit best) const {
        if (structure.outputs > 1 || record_.sample_count() > kNestedSamples ||
            best.termination == Termination::kCancelled)
            return best;
        const TransferStructure at = with_delays_of(structure, best.theta);
        NestedSearch nested(record_, [this](const TransferStructure& poorer, const std::vector<Vector>& own) {
            return solution_of(poorer, own);
        });
        for (Vector start : nested.better_starts(at, best.loss)) {
            if (structure.free_delays) start = with_delays(structure, at, start);
            Fit other = refine_output_error(record_, structure, condition_, start, options_);
            if (other.loss < best.loss) best = std::move(other);
        }
        return best;
    }

  private:
    static TransferStructure with_delays_of(const TransferStructure& structure, const Vector& theta) {
        TransferStructure at = with_fixed_delays(structure);
        std::size_t channel = 0;
        for (Index output = 0; output < structure.outputs; ++output)
            for (Index input = 0; input < structure.inputs; ++input)
                at.channels[channel++].delay = structure.delay(theta, output, input);
        return at;
    }

    NestedSolution solution_of(const TransferStructure& structure, std::vector<Vector> starts) const {
        try {
            if (starts.empty()) {
                starts = {start_from_rest(for_start_, structure, options_)};
                starts.push_back(iterate_srivc(for_start_, structure, starts.front(), options_).theta);
            }
            const Fit fit = refine_from(record_, structure, condition_, starts, options_);
            return {fit.theta, fit.loss, structure};
        } catch (const InvalidArgument&) {
            return {};  // no start for this structure: the richer one has its own
        }
    }

    const IdData &record_, &for_start_;
    const StartCondition& condition_;
    const FitOptions& options_;
};

/// Where the search for free delays begins: the valleys of the scan, and the solution for the least delay, which a scan
/// from neighbours may miss.
std::vector<Vector> starts_of_scan(const DelayScan& scan, const IdData& data, const TransferStructure& structure,
                                   const FitOptions& options) {
    TransferStructure at = with_fixed_delays(structure);
    for (TransferChannel& channel : at.channels) channel.delay = options.least_delay;
    std::vector<Vector> starts = scan.starts;
    const Vector least = start_from_rest(data, at, options);
    starts.push_back(
        with_delays(structure, at, refine_output_error(data, at, {InitialState::kZero, false}, least, options).theta));
    return starts;
}

}  // namespace

Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    const auto start_of = [&](const IdData& record) {
        const Vector theta = first_estimate(record, structure, options);
        return theta.allFinite() ? theta : best_cutoff_start(record, structure, options);
    };
    if (data.sample_count() <= 2 * kTrialSamples) return start_of(data);
    const IdData beginning = beginning_of(data, kTrialSamples);
    const SrivcSolution trial = iterate_srivc(beginning, structure, start_of(beginning),
                                              options.limited(options.max_iterations, kTrialTolerance));
    return trial.termination == Termination::kConverged ? trial.theta : start_of(data);
}

Fit search_transfer(const char* method, const IdData& data, const TransferStructure& structure, const FitOptions& given,
                    const Vector& start) {
    check_transfer_data(method, data, structure);
    FitOptions options = given;
    const bool centre = options.offset != Offset::kNone || options.initial_state != InitialState::kZero;
    const CentredData centred = centre ? without_operating_points(data) : CentredData{};
    const IdData& for_start = centre ? centred.data : data;
    const IdData& record = options.offset == Offset::kRemove ? centred.data : data;

    DelayScan scan;
    std::vector<Vector> starts;
    if (structure.free_delays) {
        scan = scan_delays(for_start, structure, options);
        options.largest_delay = scan.largest;
        starts = starts_of_scan(scan, for_start, structure, options);
    } else {
        starts = {start.size() > 0 ? start : start_from_rest(for_start, structure, options)};
    }
    const auto experiments = static_cast<Index>(record.experiments.size());
    Fit best = fit_output_error(
        {method, record, start_conditions(record, options.initial_state, options.offset),
         [&](const StartCondition& condition) { return value_count(structure, condition, experiments); },
         [&](const StartCondition& condition) {
             return NestedFits(record, for_start, condition, options).best(structure, starts);
         }});
    const StartCondition chosen = best.start;
    best = NestedFits(record, for_start, chosen, options).no_worse(structure, std::move(best));
    if (options.offset == Offset::kRemove) add_operating_points(best, centred.removed);
    best.delay_grid = scan.delays;
    best.delay_loss = scan.losses;
    return best;
}

}  // namespace dynlab::inline numerics
