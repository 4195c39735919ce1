#include "numerics/fit/transfer_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/error.h"
#include "numerics/fit/channel_scan.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/sampled_starts.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/start_choice.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kNestedSamples = 100'000;  // structures with fewer parameters are not fitted to longer data
constexpr double kClearly = 1.02;          // times the loss of an unstable model: less is no evidence for one

/// How far every start is followed before the best of them are taken to the end.
constexpr int kRoughIterations = 15;
constexpr double kRoughTolerance = 1e-3;
constexpr int kLastIterations = 500;    // of a search that did not settle before
constexpr int kStretch = 50;            // of them, after which its pace is looked at
constexpr double kMayStillWin = 1.1;    // of the smallest loss after so much
constexpr double kSameSolution = 0.01;  // of every parameter
constexpr std::size_t kFollowed = 3;    // to the end

FitOptions rough(const FitOptions& options) {
    return options.rough(std::min(kRoughIterations, options.max_iterations),
                         std::max(kRoughTolerance, options.tolerance));
}

/// The end of a search that began where `before` ended, with the iterations of both.
Fit continued(const Fit& before, Fit fit) {
    fit.trace.insert(fit.trace.begin(), before.trace.begin(), before.trace.end());
    return fit;
}

bool is_same_solution(const Vector& a, const Vector& b) {
    return ((a - b).array().abs() <= kSameSolution * a.array().abs().max(b.array().abs())).all();
}

/// The best joint refinement from several starts: all a little way, and those to the end that may still win.
Fit refine_from(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                const std::vector<Vector>& starts, const FitOptions& options) {
    const auto refine = [&](const Vector& start, const FitOptions& how) {
        return refine_output_error(data, structure, condition, start, how);
    };
    if (starts.size() == 1) return refine(starts.front(), options);
    std::vector<Fit> trials(starts.size());
    side_by_side(starts.size(), [&](std::size_t i) { trials[i] = refine(starts[i], rough(options)); });
    std::stable_sort(trials.begin(), trials.end(), [](const Fit& a, const Fit& b) { return a.loss < b.loss; });
    std::vector<std::size_t> followed;
    for (std::size_t i = 0; i < trials.size() && followed.size() < kFollowed; ++i) {
        if (i > 0 && !(trials[i].loss <= kMayStillWin * trials.front().loss)) break;
        const bool known = std::any_of(trials.begin(), trials.begin() + static_cast<std::ptrdiff_t>(i),
                                       [&](const Fit& t) { return is_same_solution(t.theta, trials[i].theta); });
        if (!known) followed.push_back(i);
    }
    std::vector<Fit> ends(followed.size());
    side_by_side(followed.size(), [&](std::size_t k) {
        const Fit& trial = trials[followed[k]];
        ends[k] = continued(trial, refine(trial.theta, options));
    });
    return *std::min_element(ends.begin(), ends.end(), [](const Fit& a, const Fit& b) { return a.loss < b.loss; });
}

/// One search under a start condition, and what it begins with.
class NestedFits {
  public:
    NestedFits(const IdData& data_set, const IdData& for_start, const StartCondition& condition,
               const FitOptions& options)
        : data_set_(data_set), for_start_(for_start), condition_(condition), options_(options) {}

    /// The best of the refinements from these starts and, where an initial state is estimated, from the solution of the
    /// zero state.
    Fit best(const TransferStructure& structure, std::vector<Vector> starts) const {
        if (condition_.state == InitialState::kEstimate)
            starts.push_back(
                refine_from(data_set_, structure, {InitialState::kZero, condition_.offset}, starts, rough(options_))
                    .theta);
        return refine_from(data_set_, structure, condition_, starts, options_);
    }

    /// The fit, or a better one from solutions of poorer structures that have a smaller loss: those `known`, or all
    /// that the same search finds.
    Fit no_worse(const TransferStructure& structure, Fit best, const std::vector<const Fit*>& known) const {
        if (structure.outputs > 1 || data_set_.sample_count() > kNestedSamples || !options_.fixed.empty() ||
            best.termination == Termination::kCanceled)
            return best;
        std::vector<Vector> starts;
        if (known.empty()) {
            const TransferStructure at = with_delays_of(structure, best.theta);
            const double requested = best.loss;
            NestedSearch nested(data_set_, [&](const TransferStructure& lower_order, const std::vector<Vector>& own) {
                return solution_of(lower_order, own, requested);
            });
            for (const Vector& start : nested.better_starts(at, best.loss))
                starts.push_back(structure.free_delays ? with_delays(structure, at, start) : start);
        } else {
            starts = starts_from_lower_order(data_set_, known, structure, best.loss);
        }
        if (starts.empty()) return best;
        Fit other = refine_from(data_set_, structure, condition_, starts, options_);
        return other.loss < best.loss ? other : best;
    }

  private:
    /// The best solution from these starts, or without starts the solution of a separate call. A search that will not
    /// reach a loss below `requested`, the loss of the larger structure, stops early.
    NestedSolution solution_of(const TransferStructure& structure, std::vector<Vector> starts, double requested) const {
        const auto settled = [&](Fit fit) {
            return solution(structure, followed(structure, std::move(fit), requested));
        };
        try {
            if (!starts.empty()) return settled(refine_from(data_set_, structure, condition_, starts, options_));
            // The solution of a separate call, and the one from the passes: a joint search would follow the nearer
            // optimum and miss the better one.
            const Vector start = start_from_rest(for_start_, structure, options_);
            const NestedSolution own = settled(best(structure, {start}));
            const Vector passed = iterate_srivc(for_start_, structure, start, options_).theta;
            const NestedSolution other = settled(refine_from(data_set_, structure, condition_, {passed}, options_));
            return other.loss < own.loss ? other : own;
        } catch (const InvalidArgument&) {
            return {};  // no start for this structure: the richer one has its own
        }
    }

    static NestedSolution solution(const TransferStructure& structure, const Fit& fit) {
        return {fit.theta, fit.loss, structure};
    }

    /// A search that has not settled goes on as long as it is below `requested`, or will be at its pace.
    Fit followed(const TransferStructure& structure, Fit fit, double requested) const {
        for (int left = kLastIterations; options_.extend_iterations && left > 0; left -= kStretch) {
            if (fit.termination != Termination::kIterationLimit) break;
            const double before = fit.loss;
            fit = refine_output_error(data_set_, structure, fit.start, fit.theta,
                                      options_.limited(kStretch, options_.tolerance));
            const double gained_at_this_pace = (before - fit.loss) * left / kStretch;
            if (fit.loss - gained_at_this_pace > requested) break;
        }
        return fit;
    }

    const IdData &data_set_, &for_start_;
    const StartCondition& condition_;
    const FitOptions& options_;
};

/// The solution for these delays (s) of the channels, as a start of the search for free ones.
Vector start_at_delays(const IdData& data, const TransferStructure& structure, const std::vector<double>& delays,
                       const FitOptions& options) {
    TransferStructure at = with_fixed_delays(structure);
    for (std::size_t c = 0; c < at.channels.size(); ++c) at.channels[c].delay = delays[c];
    const Vector start = start_from_rest(data, at, options);
    return with_delays(structure, at,
                       refine_output_error(data, at, {InitialState::kZero, false}, start, options).theta);
}

void check_search(const TransferStructure& structure, const FitOptions& options) {
    for (const auto& [name, value] : options.fixed)
        if (name.starts_with("Td"))
            throw InvalidArgument("{}: fix a delay with {}, not with {}", OptionName{"fixed"}, OptionName{"delay"},
                                  name);
    check_output_weights(options.output_weights, structure.outputs);
}

/// For the first estimates: counted from the operating point; where the inputs never change, from the first output.
IdData levelled_for_start(const IdData& data) {
    CenteredData centered = without_operating_points(data);
    for (Experiment& experiment : centered.data.experiments)
        if ((experiment.u.rowwise() - experiment.u.row(0)).isZero(0))
            experiment.y.rowwise() -= Eigen::RowVectorXd(experiment.y.row(0));
    return centered.data;
}

/// With an estimated start: inputs from before the first sample reach the output during the delays, so that this
/// beginning is left out and the search continues from its last point.
Fit without_masked_inputs(const IdData& data_set, const TransferStructure& structure, Fit fit,
                          const FitOptions& options) {
    constexpr int kRounds = 3;
    double left_out = 0;
    for (int round = 0; round < kRounds && fit.termination != Termination::kCanceled; ++round) {
        const double masked_seconds = masked_start(fit, data_set);
        if (masked_seconds <= left_out + data_set.mean_step()) break;
        left_out = masked_seconds;
        fit = continued(fit, refine_output_error(data_set, structure, fit.start, fit.theta, options, left_out));
    }
    return fit;
}

/// A search that has not settled goes on.
Fit settled(const IdData& data_set, const TransferStructure& structure, Fit fit, const FitOptions& options) {
    if (!options.extend_iterations || fit.termination != Termination::kIterationLimit) return fit;
    return continued(fit, refine_output_error(data_set, structure, fit.start, fit.theta,
                                              options.limited(kLastIterations, options.tolerance)));
}

/// Finds another valley of the delay, far from the estimate, whose loss differs from the smallest only by chance. The
/// parameters that differ between the two are then not determined, and standard errors about one of them mean nothing.
void withdraw_errors_of_rivals(Fit& fit, const IdData& data_set, const DelayScan& scan) {
    constexpr Index kCurveSamples = 50'000;  // at most
    constexpr double kRivalChance = 6.635;   // 99 % quantile of chi-square with one degree of freedom
    constexpr double kRivalSteps = 2, kRivalErrors = 3, kSameScale = 1.05, kDiffers = 2;
    const Vector& losses = scan.losses;
    if (!fit.structure.single_channel() || losses.size() < 3 || losses.minCoeff() > kSameScale * fit.loss) return;
    const Index place = fit.structure.delay_index(0, 0);
    const Index scanned = std::min(data_set.sample_count(), kCurveSamples);
    const double limit = losses.minCoeff() * std::exp(kRivalChance / static_cast<double>(scanned));
    const double far = std::max(kRivalSteps * (scan.delays[1] - scan.delays[0]), kRivalErrors * fit.std[place]);
    for (Index i = 1; i + 1 < losses.size(); ++i) {
        const bool valley = losses[i] <= losses[i - 1] && losses[i] < losses[i + 1];
        if (!valley || losses[i] > limit || !(std::abs(scan.delays[i] - fit.theta[place]) > far)) continue;
        std::vector<std::string> names;
        const auto distance = [&](const Vector& start) { return std::abs(start[place] - scan.delays[i]); };
        const Vector& other = *std::ranges::min_element(scan.starts, {}, distance);
        for (Index p = 0; p < fit.theta.size(); ++p)
            if (p == place || std::abs(other[p] - fit.theta[p]) > kDiffers * fit.std[p])
                names.push_back(fit.names[static_cast<std::size_t>(p)]);
        withdraw_errors(fit, names);
        fit.warnings.push_back(Message(
            "A delay of {} {} explains the data nearly as well, so the standard errors of {} are not available. Use "
            "your knowledge of the plant, and narrow the range of delays ({}, {}).",
            significant(scan.delays[i], 3), data_set.time_unit, listed(names), OptionName{"least_delay"},
            OptionName{"largest_delay"}));
        return;
    }
}

/// The fit, or a better one if its errors show missing dynamics: from models with other poles, and, if the errors
/// change quickly, from those of difference equations.
Fit or_from_further_starts(const IdData& data_set, const TransferStructure& structure, Fit best,
                           const FitOptions& options) {
    const bool suits = structure.inputs == 1 && structure.outputs == 1 && options.fixed.empty() &&
                       best.termination != Termination::kCanceled;
    if (!suits) return best;
    // One after the other: those that are slow to show what they lead to would be dropped beside the others.
    const auto refined = [&](const std::vector<Vector>& starts) {
        if (starts.empty()) return;
        best = settled(data_set, structure, std::move(best), options);
        Fit other = refine_from(data_set, structure, best.start, starts, options);
        if (other.loss < best.loss) best = std::move(other);
    };
    if (data_set.regular() && fast_errors_follow_input(data_set, best))
        refined(sampled_starts(data_set, structure, best, options));
    if (data_set.sample_count() <= kNestedSamples &&
        (errors_are_colored(data_set, best) || errors_follow_input(data_set, best)))
        refined(exchanged_poles(data_set, structure, best, options));
    return best;
}

}  // namespace

Fit search_transfer(const char* method, const IdData& data, const TransferStructure& structure, const FitOptions& given,
                    const SearchAids& aids) {
    check_transfer_data(method, data, structure, given.offset);
    check_search(structure, given);
    FitOptions options = given;
    const bool center = options.offset != Offset::kNone || options.initial_state != InitialState::kZero;
    const bool remove = options.offset == Offset::kRemove;
    const CenteredData centered = remove ? without_operating_points(data) : CenteredData{};
    const IdData& data_set = remove ? centered.data : data;
    const IdData levelled = center ? levelled_for_start(data) : IdData();
    const IdData& for_start = center ? levelled : data;

    DelayScan scan;
    std::vector<Vector> starts;
    if (aids.start.size() > 0) {
        starts = {aids.start};
    } else if (!structure.free_delays) {
        starts = {start_from_rest(for_start, structure, options)};
    } else if (!aids.delays.empty()) {
        starts = {start_at_delays(for_start, structure, aids.delays, options)};
    } else {
        scan = has_separate_channels(structure) && options.fixed.empty() ? scan_channels(for_start, structure, options)
                                                                         : scan_delays(for_start, structure, options);
        options.largest_delay = scan.largest;
        starts = scan.starts;
        // A scan from neighbors may miss the solution for the least delay.
        const std::vector<double> least(structure.channels.size(), options.least_delay);
        starts.push_back(start_at_delays(for_start, structure, least, options));
    }
    const auto experiments = static_cast<Index>(data_set.experiments.size());
    Fit best = fit_output_error(
        {method, data_set, start_conditions(data_set, options.initial_state, options.offset),
         [&](const StartCondition& condition) { return value_count(structure, condition, experiments); },
         [&](const StartCondition& condition) {
             return NestedFits(data_set, for_start, condition, options).best(structure, starts);
         }});
    const StartCondition chosen = best.start;
    const auto search = [&](const FitOptions& how, Fit found) {
        const NestedFits fits(data_set, for_start, chosen, how);
        if (found.theta.size() == 0) found = fits.best(structure, starts);
        return fits.no_worse(structure, std::move(found), aids.lower_order);
    };
    best = search(options, std::move(best));
    const auto further = [&](const FitOptions& how, Fit found) {
        return aids.start.size() > 0 ? found : or_from_further_starts(data_set, structure, std::move(found), how);
    };
    // Where errors still follow the input, a free delay may have led away from the best model without one.
    const auto or_without_delay = [&](Fit found) {
        if (!structure.free_delays || !structure.single_channel() || aids.start.size() > 0 || !given.fixed.empty() ||
            found.termination == Termination::kCanceled || !errors_follow_input(data_set, found))
            return found;
        TransferStructure at = with_fixed_delays(structure);
        at.channels.front().delay = options.least_delay;
        FitOptions how = options.started(chosen);
        how.precision = false;
        const Fit fixed = search_transfer(method, data_set, at, how);
        Fit other = refine_from(data_set, structure, chosen, {with_delays(structure, at, fixed.theta)}, options);
        return other.loss < found.loss ? other : found;
    };
    const Vector first_end = best.theta;
    best = or_without_delay(further(options, std::move(best)));
    const bool unstable = std::any_of(best.models.begin(), best.models.end(), has_unstable_pole);
    if (!options.stable && unstable && best.termination != Termination::kCanceled) {
        FitOptions stable = options;
        stable.stable = true;
        starts.insert(starts.end(), {first_end, best.theta});
        if (Fit other = further(stable, search(stable, {})); other.loss <= kClearly * best.loss) {
            if (best.loss < other.loss)
                other.warnings.push_back(
                    Message("The loss of an unstable model is {} % smaller, which is not significant. To allow "
                            "unstable models, set {} = false.",
                            significant(100 * (1 - best.loss / other.loss), 2), OptionName{"stable"}));
            best = std::move(other);
        }
    }
    best = settled(data_set, structure, std::move(best), options);
    best = without_masked_inputs(data_set, structure, std::move(best), options);
    best.message = output_error_message(best);
    if (remove) add_operating_points(best, centered.removed);
    withdraw_errors_of_rivals(best, data_set, scan);
    warn_of_later_responses(best, data_set, options);
    best.delay_grid = scan.delays;
    best.delay_loss = scan.losses;
    return best;
}

Fit search_with_chosen_start(const char* method, const IdData& data, const TransferStructure& structure,
                             const FitOptions& options, const SearchAids& aids) {
    const auto search = [&](const FitOptions& how) { return search_transfer(method, data, structure, how, aids); };
    if (aids.start.size() > 0) return search(options);
    return with_chosen_start(data, options, {search, [](Fit found, const FitOptions&) { return found; }, search});
}

}  // namespace dynlab::inline numerics
