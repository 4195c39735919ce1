#include "numerics/fit/transfer_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/fit/diagnosis.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kTrialSamples = 50'000;  // the start for a longer record is found on its beginning
constexpr double kTrialTolerance = 1e-4;
constexpr int kGridPasses = 4;       // at each delay of the grid
constexpr int kFreshStart = 8;       // so many delays apart the sweep over cut-off frequencies is made anew
constexpr std::size_t kValleys = 3;  // of the loss over the delay that are refined

TransferStructure fixed(TransferStructure structure) {
    structure.free_delays = false;
    return structure;
}

/// theta of fixed delays with the delays put in their places.
Vector with_delays(const TransferStructure& free, const TransferStructure& at, const Vector& theta) {
    Vector all(free.parameter_count());
    for (Index output = 0; output < free.outputs; ++output)
        for (Index input = 0; input < free.inputs; ++input) {
            const TransferChannel& channel = at.channel(output, input);
            const Index n = at.poles[static_cast<std::size_t>(channel.denominator)];
            all.segment(free.a_place(channel.denominator), n) = theta.segment(at.a_place(channel.denominator), n);
            all.segment(free.b_place(output, input), channel.zeros + 1) =
                theta.segment(at.b_place(output, input), channel.zeros + 1);
            all[free.delay_place(output, input)] = channel.delay;
        }
    return all;
}

struct DelayPoint {
    Vector theta;
    double loss = kInfinity;
};

/// The best of a few passes from each start.
DelayPoint best_after_passes(const IdData& data, const TransferStructure& structure, const std::vector<Vector>& starts,
                             const FitOptions& options) {
    DelayPoint best;
    for (const Vector& start : starts) {
        if (!start.allFinite()) continue;
        const SrivcSolution trial =
            iterate_srivc(data, structure, start, options.limited(kGridPasses, kTrialTolerance));
        const double loss = simulation_loss(data, structure, trial.theta);
        if (loss < best.loss) best = {trial.theta, loss};
    }
    return best;
}

Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    if (!options.lambda) return best_cutoff_start(data, structure, options);
    return lssvf_start(data, structure, *options.lambda, options.hold_y);
}

/// The loss over one channel's delay; `structure` has the others' delays, and leaves with the best one.
std::vector<DelayPoint> scan_channel(const IdData& data, TransferStructure& structure, std::size_t channel,
                                     const Vector& delays, const FitOptions& options) {
    std::vector<DelayPoint> found(static_cast<std::size_t>(delays.size()));
    Vector neighbour;
    for (Index i = 0; i < delays.size(); ++i) {
        if (options.cancel && options.cancel()) break;
        structure.channels[channel].delay = delays[i];
        std::vector<Vector> starts;
        if (neighbour.size() > 0) starts.push_back(neighbour);
        if (starts.empty() || i % kFreshStart == 0) starts.push_back(first_estimate(data, structure, options));
        DelayPoint& here = found[static_cast<std::size_t>(i)];
        here = best_after_passes(data, structure, starts, options);
        if (std::isfinite(here.loss)) neighbour = here.theta;
    }
    const auto best = std::min_element(found.begin(), found.end(),
                                       [](const DelayPoint& a, const DelayPoint& b) { return a.loss < b.loss; });
    structure.channels[channel].delay = delays[best - found.begin()];
    return found;
}

/// Places of the lowest local minima, lowest first.
std::vector<std::size_t> valleys(const std::vector<DelayPoint>& curve) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const bool left = i == 0 || curve[i].loss <= curve[i - 1].loss;
        const bool right = i + 1 == curve.size() || curve[i].loss < curve[i + 1].loss;
        if (left && right && std::isfinite(curve[i].loss)) places.push_back(i);
    }
    std::sort(places.begin(), places.end(), [&](auto a, auto b) { return curve[a].loss < curve[b].loss; });
    if (places.size() > kValleys) places.resize(kValleys);
    return places;
}

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

}  // namespace

double likely_largest_delay(const IdData& data) {
    constexpr Index kFewest = 10;
    constexpr double kMargin = 1.5, kNearlyPeak = 0.9;
    Index lags = std::numeric_limits<Index>::max();
    for (const Experiment& experiment : data.experiments) lags = std::min(lags, experiment.y.rows() / 4);
    Index furthest = kFewest;
    for (Index output = 0; output < data.output_count(); ++output)
        for (Index input = 0; input < data.input_count(); ++input) {
            Vector products = Vector::Zero(2 * lags + 1);
            for (const Experiment& experiment : data.experiments) {
                const Vector u = experiment.u.col(input).array() - experiment.u.col(input).mean();
                const Vector y = experiment.y.col(output).array() - experiment.y.col(output).mean();
                products += lagged_products(u, y, lags);
            }
            // Entry i pairs u(k + i - lags) with y(k): y late by lags - i.
            const Vector later = products.head(lags + 1).reverse().cwiseAbs();
            const double peak = later.maxCoeff();
            Index lag = 0;
            while (later[lag] < kNearlyPeak * peak) ++lag;
            furthest = std::max(furthest, lag);
        }
    const double steps =
        std::min(kMargin * static_cast<double>(furthest) + 2, static_cast<double>(std::max<Index>(1, lags)));
    const double largest = std::ceil(steps) * data.mean_step();
    return data.regular() ? largest : std::min(largest, shortest_record(data) / 4);
}

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

DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    const DelayRange range = delay_range(data, options);
    const IdData beginning = beginning_of(data, kTrialSamples);
    const double step =
        std::max(data.mean_step(), (range.largest - range.least) / std::max(1, options.delay_count - 1));
    const Index count = 1 + static_cast<Index>(std::floor((range.largest - range.least) / step + 1e-9));
    DelayScan scan;
    scan.delays.resize(count);
    for (Index i = 0; i < count; ++i) scan.delays[i] = range.least + static_cast<double>(i) * step;
    TransferStructure at = fixed(structure);
    for (TransferChannel& channel : at.channels) channel.delay = range.least;
    std::vector<DelayPoint> curve;
    std::size_t last = 0;
    const int rounds = at.channels.size() > 1 ? 2 : 1;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t channel = 0; channel < at.channels.size(); ++channel) {
            curve = scan_channel(beginning, at, channel, scan.delays, options);
            last = channel;
        }
    scan.losses.resize(count);
    for (Index i = 0; i < count; ++i) scan.losses[i] = curve[static_cast<std::size_t>(i)].loss;
    for (const std::size_t place : valleys(curve)) {
        at.channels[last].delay = scan.delays[static_cast<Index>(place)];
        scan.starts.push_back(with_delays(structure, at, curve[place].theta));
    }
    if (scan.starts.empty())
        scan.starts.push_back(with_delays(structure, at, best_cutoff_start(beginning, at, options)));
    return scan;
}

Fit search_transfer(const char* method, const IdData& data, const TransferStructure& structure, const FitOptions& given,
                    const Vector& start) {
    check_transfer_data(method, data, structure);
    FitOptions options = given;
    if (structure.free_delays && !options.largest_delay)
        options.largest_delay = std::max(options.least_delay, likely_largest_delay(data));
    const bool centre = options.offset != Offset::kNone || options.initial_state != InitialState::kZero;
    const CentredData centred = centre ? without_operating_points(data) : CentredData{};
    const IdData& for_start = centre ? centred.data : data;
    const IdData& record = options.offset == Offset::kRemove ? centred.data : data;

    DelayScan scan;
    if (structure.free_delays)
        scan = scan_delays(for_start, structure, options);
    else
        scan.starts = {start.size() > 0 ? start : start_from_rest(for_start, structure, options)};
    const auto experiments = static_cast<Index>(record.experiments.size());
    Fit best = fit_output_error(
        {method, record, start_conditions(record, options.initial_state, options.offset),
         [&](const StartCondition& condition) { return value_count(structure, condition, experiments); },
         [&](const StartCondition& condition) {
             return refine_from(record, structure, condition, scan.starts, options);
         }});
    if (options.offset == Offset::kRemove) add_operating_points(best, centred.removed);
    best.delay_grid = scan.delays;
    best.delay_loss = scan.losses;
    return best;
}

}  // namespace dynlab::inline numerics
