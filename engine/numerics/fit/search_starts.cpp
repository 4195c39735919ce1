#include "numerics/fit/search_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/fit/diagnosis.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kScannedSamples = 50'000;  // of a longer record, its beginning
constexpr double kScanTolerance = 1e-4;
constexpr int kScanPasses = 5, kScanIterations = 10;  // at each delay
constexpr Index kFreshStart = 8;                      // so many delays apart the cut-off frequencies are tried anew
constexpr std::size_t kValleys = 3;                   // of the loss over the delay that are looked at closely
constexpr double kFineSpacing = 2;                    // samples
constexpr Index kFewChanges = 3;                      // of an input that is a step

struct DelayPoint {
    double delay = 0;
    Vector theta = {};
    double loss = kInfinity;
};

/// One channel's loss over the delay.
class DelayCurve {
  public:
    DelayCurve(const IdData& data, TransferStructure& structure, std::size_t channel, const FitOptions& options)
        : data_(data), structure_(structure), channel_(channel), options_(options) {}

    void scan(const Vector& delays) {
        for (const double delay : delays) points_.push_back({delay});
        for (std::size_t i = 0; i < points_.size(); ++i) improve(i, i - 1, static_cast<Index>(i) % kFreshStart == 0);
        for (std::size_t i = points_.size(); i-- > 0;) improve(i, i + 1, false);
    }

    /// More delays on both sides of the lowest valleys.
    void look_closely(double spacing) {
        for (const double delay : delays_of_valleys()) {
            const auto found = std::find_if(points_.begin(), points_.end(),
                                            [&](const DelayPoint& point) { return point.delay == delay; });
            const auto i = static_cast<std::size_t>(found - points_.begin());
            if (i > 0) fill(i - 1, spacing);
            const std::size_t here = place_of(delay);
            if (here + 1 < points_.size()) fill(here, spacing);
        }
    }

    /// Places of the lowest local minima, lowest first.
    std::vector<std::size_t> valleys() const {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const bool left = i == 0 || points_[i].loss <= points_[i - 1].loss;
            const bool right = i + 1 == points_.size() || points_[i].loss < points_[i + 1].loss;
            if (left && right && std::isfinite(points_[i].loss)) places.push_back(i);
        }
        std::sort(places.begin(), places.end(), [&](auto a, auto b) { return points_[a].loss < points_[b].loss; });
        if (places.size() > kValleys) places.resize(kValleys);
        return places;
    }

    const std::vector<DelayPoint>& points() const { return points_; }

  private:
    std::size_t place_of(double delay) const {
        const auto found = std::lower_bound(points_.begin(), points_.end(), delay,
                                            [](const DelayPoint& point, double at) { return point.delay < at; });
        return static_cast<std::size_t>(found - points_.begin());
    }

    std::vector<double> delays_of_valleys() const {
        std::vector<double> delays;
        for (const std::size_t place : valleys()) delays.push_back(points_[place].delay);
        return delays;
    }

    /// Delays between point i and the next, each fitted from its neighbour towards point i and back again.
    void fill(std::size_t i, double spacing) {
        const double gap = points_[i + 1].delay - points_[i].delay;
        const auto parts = static_cast<std::size_t>(std::ceil(gap / spacing - 1e-9));
        if (parts < 2) return;
        std::vector<DelayPoint> between;
        for (std::size_t k = 1; k < parts; ++k)
            between.push_back({points_[i].delay + gap * static_cast<double>(k) / static_cast<double>(parts)});
        points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(i) + 1, between.begin(), between.end());
        for (std::size_t k = i + 1; k < i + parts; ++k) improve(k, k - 1, false);
        for (std::size_t k = i + parts; k-- > i + 1;) improve(k, k + 1, false);
    }

    /// Fits at a delay from a neighbour's solution (if there is such a point), from a filtered start where wanted.
    void improve(std::size_t i, std::size_t neighbour, bool fresh) {
        if (options_.cancel && options_.cancel()) return;
        structure_.channels[channel_].delay = points_[i].delay;
        const bool known = neighbour < points_.size() && std::isfinite(points_[neighbour].loss);
        if (known) try_start(points_[i], Vector(points_[neighbour].theta));
        if (fresh || !std::isfinite(points_[i].loss))
            try_start(points_[i], first_estimate(data_, structure_, options_));
    }

    /// A few passes; where they end above their start, a few steps of the search, which never do.
    void try_start(DelayPoint& point, const Vector& start) {
        const double before = simulation_loss(data_, structure_, start);
        if (before < point.loss) point = {point.delay, start, before};
        if (!start.allFinite()) return;
        const Vector passed =
            iterate_srivc(data_, structure_, start, options_.limited(kScanPasses, kScanTolerance)).theta;
        const double after = simulation_loss(data_, structure_, passed);
        if (after < point.loss) point = {point.delay, passed, after};
        if (after <= before || !std::isfinite(before)) return;
        const Fit fit = refine_output_error(data_, structure_, {InitialState::kZero, false}, start,
                                            options_.limited(kScanIterations, kScanTolerance));
        if (fit.loss < point.loss) point = {point.delay, fit.theta, fit.loss};
    }

    const IdData& data_;
    TransferStructure& structure_;
    std::size_t channel_;
    const FitOptions& options_;
    std::vector<DelayPoint> points_;  // in rising order of the delay
};

Vector delay_grid(const IdData& data, const DelayRange& range, int most) {
    const double step = std::max(data.mean_step(), (range.largest - range.least) / std::max(1, most - 1));
    const Index count = 1 + static_cast<Index>(std::floor((range.largest - range.least) / step + 1e-9));
    Vector delays(count);
    for (Index i = 0; i < count; ++i) delays[i] = range.least + static_cast<double>(i) * step;
    return delays;
}

bool is_a_step(const Experiment& experiment, Index input) {
    const auto u = experiment.u.col(input);
    const Index N = u.size();
    return (u.tail(N - 1).array() != u.head(N - 1).array()).count() <= kFewChanges;
}

DelayScan scan_range(const IdData& data, const TransferStructure& structure, const DelayRange& range,
                     const FitOptions& options) {
    const Vector delays = delay_grid(data, range, options.delay_count);
    TransferStructure at = with_fixed_delays(structure);
    for (TransferChannel& channel : at.channels) channel.delay = range.least;
    const int rounds = at.channels.size() > 1 ? 2 : 1;
    DelayScan scan;
    scan.largest = range.largest;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t channel = 0; channel < at.channels.size(); ++channel) {
            DelayCurve curve(data, at, channel, options);
            curve.scan(delays);
            curve.look_closely(kFineSpacing * data.mean_step());
            const std::vector<DelayPoint>& points = curve.points();
            scan = {Vector(points.size()), Vector(points.size()), {}, range.largest};
            for (std::size_t i = 0; i < points.size(); ++i) {
                scan.delays[static_cast<Index>(i)] = points[i].delay;
                scan.losses[static_cast<Index>(i)] = points[i].loss;
            }
            const std::vector<std::size_t> valleys = curve.valleys();
            for (const std::size_t place : valleys) {
                at.channels[channel].delay = points[place].delay;
                scan.starts.push_back(with_delays(structure, at, points[place].theta));
            }
            at.channels[channel].delay = valleys.empty() ? range.least : points[valleys.front()].delay;
        }
    if (scan.starts.empty()) scan.starts.push_back(with_delays(structure, at, best_cutoff_start(data, at, options)));
    return scan;
}

bool lowest_at_the_end(const DelayScan& scan) {
    Index best = 0;
    scan.losses.minCoeff(&best);
    return best + 1 == scan.losses.size();
}

}  // namespace

TransferStructure with_fixed_delays(TransferStructure structure) {
    structure.free_delays = false;
    return structure;
}

Vector with_delays(const TransferStructure& free, const TransferStructure& at, const Vector& theta) {
    Vector all(free.parameter_count());
    for (Index output = 0; output < free.outputs; ++output)
        for (Index input = 0; input < free.inputs; ++input) {
            const TransferChannel& channel = at.channel(output, input);
            const Index n = at.poles[static_cast<std::size_t>(channel.denominator)];
            all.segment(free.denominator_start(channel.denominator), n) =
                theta.segment(at.denominator_start(channel.denominator), n);
            all.segment(free.numerator_start(output, input), channel.zeros + 1) =
                theta.segment(at.numerator_start(output, input), channel.zeros + 1);
            all[free.delay_index(output, input)] = channel.delay;
        }
    return all;
}

Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    if (!options.lambda) return best_cutoff_start(data, structure, options);
    return lssvf_start(data, structure, *options.lambda, options.hold_y);
}

double likely_largest_delay(const IdData& data) {
    constexpr Index kFewest = 10;
    constexpr double kMargin = 1.5, kNearlyPeak = 0.9;
    const double quarter = shortest_record(data) / 4;
    Index lags = std::numeric_limits<Index>::max();
    for (const Experiment& experiment : data.experiments) lags = std::min(lags, experiment.y.rows() / 4);
    Index furthest = kFewest;
    for (Index output = 0; output < data.output_count(); ++output)
        for (Index input = 0; input < data.input_count(); ++input) {
            Vector products = Vector::Zero(2 * lags + 1);
            for (const Experiment& experiment : data.experiments) {
                if (is_a_step(experiment, input)) return quarter;
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
    return std::min(std::ceil(steps) * data.mean_step(), std::max(quarter, data.mean_step()));
}

DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    const IdData beginning = beginning_of(data, kScannedSamples);
    if (options.largest_delay) return scan_range(beginning, structure, delay_range(data, options), options);
    const double quarter = std::max(options.least_delay, shortest_record(beginning) / 4);
    DelayRange range{options.least_delay, std::clamp(likely_largest_delay(beginning), options.least_delay, quarter)};
    DelayScan scan = scan_range(beginning, structure, range, options);
    while (range.largest < quarter && lowest_at_the_end(scan) && !(options.cancel && options.cancel())) {
        range.largest = std::min(quarter, 2 * range.largest);
        scan = scan_range(beginning, structure, range, options);
    }
    return scan;
}

namespace {

constexpr double kWorse = 1e-9;             // relative; smaller differences are rounding
constexpr double kGained = 1e-4;            // relative; less is no reason for a richer structure
constexpr double kAddedRoots[] = {5, 100};  // over the mean sampling time
constexpr double kApart = 1.5;              // of one added root to the next

bool fewer_poles(TransferStructure& structure) {
    bool any = false;
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        if (structure.poles[d] < 2) continue;
        bool fits = true;
        for (const TransferChannel& channel : structure.channels)
            if (channel.denominator == static_cast<Index>(d) && channel.zeros >= structure.poles[d] - 1) fits = false;
        if (!fits) continue;
        --structure.poles[d];
        any = true;
    }
    return any;
}

bool fewer_zeros(TransferStructure& structure) {
    bool any = false;
    for (TransferChannel& channel : structure.channels) {
        if (channel.zeros == 0) continue;
        --channel.zeros;
        any = true;
    }
    return any;
}

/// p times (s + root).
Vector with_root(const Vector& p, double root) {
    return multiply(p, Vector{{1, root}});
}

}  // namespace

std::vector<TransferStructure> poorer_structures(const TransferStructure& structure) {
    std::vector<TransferStructure> all;
    TransferStructure poles = structure, zeros = structure;
    if (fewer_poles(poles)) all.push_back(poles);
    if (fewer_zeros(zeros)) {
        all.push_back(zeros);
        if (fewer_poles(zeros)) all.push_back(zeros);
    }
    return all;
}

Vector enriched(const TransferStructure& poorer, const Vector& poorer_theta, const TransferStructure& structure,
                double fast, double middle) {
    Vector theta = Vector::Zero(structure.parameter_count());
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        const int added_poles = structure.poles[d] - poorer.poles[d];
        int shared = added_poles;  // poles that meet a zero in every channel
        for (std::size_t c = 0; c < structure.channels.size(); ++c)
            if (structure.channels[c].denominator == static_cast<Index>(d))
                shared = std::min(shared, structure.channels[c].zeros - poorer.channels[c].zeros);
        for (Index output = 0; output < structure.outputs; ++output)
            for (Index input = 0; input < structure.inputs; ++input) {
                const TransferChannel& channel = structure.channel(output, input);
                if (channel.denominator != static_cast<Index>(d)) continue;
                Vector A = poorer.denominator(poorer_theta, output, input);
                Vector B = poorer.numerator(poorer_theta, output, input);
                const int added_zeros = channel.zeros - poorer.channel(output, input).zeros;
                const auto added_root = [&](int i) {
                    return i < shared ? middle * std::pow(kApart, i) : fast * std::pow(kApart, i - shared);
                };
                for (int i = 0; i < added_poles; ++i) A = with_root(A, added_root(i));
                for (int i = 0; i < added_zeros; ++i) B = with_root(B, added_root(i));
                for (int i = shared; i < added_poles; ++i) B *= added_root(i);
                for (int i = shared; i < added_zeros; ++i) B /= added_root(i);
                theta.segment(structure.denominator_start(channel.denominator), A.size() - 1) = A.tail(A.size() - 1);
                theta.segment(structure.numerator_start(output, input), B.size()) = B;
            }
    }
    return theta;
}

NestedSearch::NestedSearch(const IdData& data, Solve solve) : solve_(std::move(solve)) {
    constexpr double kSlow = 4;
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    rate_ = 1 / data.mean_step();
    slowest_ = kSlow / (longest + data.mean_step());
}

std::vector<Vector> NestedSearch::better_starts(const TransferStructure& structure, double loss) {
    std::vector<Vector> starts;
    for (const TransferStructure& poorer : poorer_structures(structure)) {
        const NestedSolution& solution = best(poorer);
        if (!(solution.loss < (1 - kWorse) * loss)) continue;
        for (const double speed : kAddedRoots) {
            const double fast = speed * rate_;
            starts.push_back(enriched(solution.structure, solution.theta, structure, fast, std::sqrt(fast * slowest_)));
        }
    }
    return starts;
}

const NestedSolution& NestedSearch::best(const TransferStructure& structure) {
    std::vector<int> key = structure.poles;
    for (const TransferChannel& channel : structure.channels) key.push_back(channel.zeros);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    NestedSolution solution = solve_(structure, {});
    solution.structure = structure;
    const std::vector<Vector> starts = better_starts(structure, solution.loss);
    if (!starts.empty()) {
        NestedSolution other = solve_(structure, starts);
        if (other.loss < solution.loss) solution = {std::move(other.theta), other.loss, structure};
    }
    for (const TransferStructure& poorer : poorer_structures(structure))
        if (const NestedSolution& less = best(poorer); (1 - kGained) * less.loss <= solution.loss) solution = less;
    return found_.emplace(std::move(key), std::move(solution)).first->second;
}

}  // namespace dynlab::inline numerics
