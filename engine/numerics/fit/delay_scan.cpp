#include "numerics/fit/delay_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "numerics/criteria/transfer_output.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kScannedSamples = 50'000;   // of longer data, their beginning
constexpr Index kScannedIrregular = 1'500;  // of irregularly sampled data, whose filters take several times as long
constexpr double kAsLively = 0.5;           // least ratio of the deviations of the beginning's inputs and of all inputs
constexpr double kScanTolerance = 1e-4;
constexpr int kScanPasses = 5, kScanIterations = 10;  // at each delay
constexpr Index kFreshStart = 8;                      // so many delays apart the cutoff frequencies are tried again
constexpr std::size_t kValleys = 3;                   // of the loss over the delay that are looked at closely
constexpr std::size_t kMaxBeginnings = 5;             // of joint searches
constexpr double kFineSpacing = 2;                    // samples
constexpr Index kFewChanges = 3;                      // of an input that is a step

struct DelayPoint {
    double delay = 0;
    Vector theta = {};
    double loss = kInfinity;
};

/// A minimum of the loss over the delay between two neighboring points, predicted from their slopes.
struct Valley {
    std::size_t left = 0;  ///< its points: this and the next, unless it is the last
    double loss = 0;       ///< expected there
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
            const auto found = std::ranges::find(points_, delay, &DelayPoint::delay);
            const auto i = static_cast<std::size_t>(found - points_.begin());
            if (i > 0) fill(i - 1, spacing);
            const std::size_t here = place_of(delay);
            if (here + 1 < points_.size()) fill(here, spacing);
        }
    }

    /// Where joint searches begin, best first: on both sides of the lowest minimum, and at the next ones. Solutions of
    /// neighboring delays may lie on different branches, so that a minimum between two points need not show in their
    /// losses.
    std::vector<DelayPoint> beginnings() const {
        std::vector<Valley> all = valleys_between();
        std::ranges::stable_sort(all, {}, &Valley::loss);
        std::set<std::size_t> places;
        std::vector<DelayPoint> chosen;
        const auto choose = [&](std::size_t place) {
            if (place < points_.size() && std::isfinite(points_[place].loss) && places.insert(place).second)
                chosen.push_back(points_[place]);
        };
        if (!all.empty()) {
            choose(all[0].left);
            choose(all[0].left + 1);
        }
        for (std::size_t i = 1; i < std::min(kValleys, all.size()); ++i)
            choose(all[i].left + (points_[all[i].left + 1].loss < points_[all[i].left].loss ? 1 : 0));
        for (const std::size_t place : valleys())
            if (chosen.size() < kMaxBeginnings) choose(place);
        return chosen;
    }

    /// Places of the lowest local minima of the points, lowest first.
    std::vector<std::size_t> valleys() const {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const bool left = i == 0 || points_[i].loss <= points_[i - 1].loss;
            const bool right = i + 1 == points_.size() || points_[i].loss < points_[i + 1].loss;
            if (left && right && std::isfinite(points_[i].loss)) places.push_back(i);
        }
        std::ranges::sort(places, [&](auto a, auto b) { return points_[a].loss < points_[b].loss; });
        if (places.size() > kValleys) places.resize(kValleys);
        return places;
    }

    const std::vector<DelayPoint>& points() const { return points_; }

  private:
    /// d loss/d delay at a point, where the other parameters have no slope.
    double slope(const DelayPoint& point) const {
        TransferStructure at = structure_;
        at.channels[channel_].delay = point.delay;
        TransferStructure free = at;
        free.free_delays = true;
        const Vector theta = with_delays(free, at, point.theta);
        double furthest = point.delay;
        for (const TransferChannel& channel : free.channels) furthest = std::max(furthest, channel.delay);
        const TransferOutput model(free, {InitialState::kZero, false}, data_, 0, furthest);
        const Index inputs = free.inputs, channel = static_cast<Index>(channel_);
        const Index place = free.delay_index(channel / inputs, channel % inputs);
        const Vector y = model.target();
        const OutputErrorProducts sums = model.products(theta.cwiseQuotient(model.seconds()), y);
        return -2 * sums.descent[place] / (static_cast<double>(y.size()) * model.seconds()[place]);
    }

    std::vector<Valley> valleys_between() const {
        std::vector<Valley> all;
        std::vector<double> slopes;
        for (const DelayPoint& point : points_)
            slopes.push_back(std::isfinite(point.loss) ? slope(point) : std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const double down = -slopes[i], up = slopes[i + 1];
            if (!(down > 0 && up > 0)) continue;
            const double gap = points_[i + 1].delay - points_[i].delay, fall = 0.5 * gap / (down + up);
            all.push_back({i, std::min(points_[i].loss - down * down * fall, points_[i + 1].loss - up * up * fall)});
        }
        return all;
    }

    std::size_t place_of(double delay) const {
        const auto found = std::ranges::lower_bound(points_, delay, {}, &DelayPoint::delay);
        return static_cast<std::size_t>(found - points_.begin());
    }

    std::vector<double> delays_of_valleys() const {
        std::vector<double> delays;
        for (const std::size_t place : valleys()) delays.push_back(points_[place].delay);
        return delays;
    }

    /// Delays between point i and the next, each fitted from its neighbor towards point i and back again.
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

    /// Fits at a delay from a neighbor's solution (if there is such a point), from a filtered start where wanted.
    void improve(std::size_t i, std::size_t neighbor, bool fresh) {
        if (options_.cancel && options_.cancel()) return;
        structure_.channels[channel_].delay = points_[i].delay;
        const bool known = neighbor < points_.size() && std::isfinite(points_[neighbor].loss);
        if (known) try_start(points_[i], Vector(points_[neighbor].theta));
        if (fresh || !std::isfinite(points_[i].loss))
            try_start(points_[i], first_estimate(data_, structure_, options_));
    }

    /// A few passes; where they end above their start, a few steps of the search, which never do.
    void try_start(DelayPoint& point, const Vector& start) {
        const double before = simulation_loss(data_, structure_, start);
        if (before < point.loss && options_.fixed.empty()) point = {point.delay, start, before};
        if (!start.allFinite()) return;
        if (!options_.fixed.empty()) return search_from(point, start);
        const SrivcSolution passed =
            iterate_srivc(data_, structure_, start, options_.limited(kScanPasses, kScanTolerance));
        const double after = simulation_loss(data_, structure_, passed);
        if (after < point.loss) point = {point.delay, passed.theta, after};
        if (after <= before || !std::isfinite(before)) return;
        search_from(point, start);
    }

    void search_from(DelayPoint& point, const Vector& start) {
        const Fit fit = refine_output_error(data_, structure_, {InitialState::kZero, false}, start,
                                            options_.rough(kScanIterations, kScanTolerance));
        if (fit.loss < point.loss) point = {point.delay, fit.theta, fit.loss};
    }

    const IdData& data_;
    TransferStructure& structure_;
    std::size_t channel_;
    const FitOptions& options_;
    std::vector<DelayPoint> points_;  // in rising order of the delay
};

Vector delay_grid(const IdData& data, const DelayRange& range, int max_count) {
    const double step = std::max(data.mean_step(), (range.largest - range.least) / std::max(1, max_count - 1));
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
            for (const DelayPoint& point : curve.beginnings()) {
                at.channels[channel].delay = point.delay;
                scan.starts.push_back(with_delays(structure, at, point.theta));
            }
            const std::vector<std::size_t> valleys = curve.valleys();
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

/// Sums over all experiments of the products of x with y up to `lags` samples later.
Vector later_products(const IdData& data, Index lags, const auto& x_of, const auto& y_of) {
    Vector products = Vector::Zero(lags + 1);
    for (const Experiment& experiment : data.experiments) {
        const Vector x = x_of(experiment).array() - x_of(experiment).mean();
        const Vector y = y_of(experiment).array() - y_of(experiment).mean();
        products += lagged_products(x, y, lags).head(lags + 1).reverse();
    }
    return products;
}

}  // namespace

std::optional<double> later_response(const IdData& given, Index output, Index input, double largest) {
    constexpr double kChance = 5, kMoreClearly = 1.5;  // standard deviations; ratio
    if (!given.regular()) return std::nullopt;
    const IdData data = beginning_of(given, kScannedSamples);
    Index shortest = std::numeric_limits<Index>::max();
    for (const Experiment& experiment : data.experiments) {
        if (is_a_step(experiment, input)) return std::nullopt;
        shortest = std::min(shortest, experiment.y.rows());
    }
    const auto u = [input](const Experiment& experiment) { return experiment.u.col(input); };
    const auto y = [output](const Experiment& experiment) { return experiment.y.col(output); };
    const Index lags = 3 * shortest / 4, first = static_cast<Index>(std::ceil(largest / data.Ts)) + 1;
    if (first > lags) return std::nullopt;
    const Vector both = later_products(data, lags, u, y);
    const Vector of_u = later_products(data, shortest / 4, u, u), of_y = later_products(data, shortest / 4, y, y);
    const double power = of_u[0] * of_y[0];
    if (!(power > 0 && std::isfinite(power))) return std::nullopt;
    // Bartlett: the variance of a correlation of unrelated signals, times the number of products
    const double spread = std::max(1.0, 2 * of_u.dot(of_y) / power - 1);
    const auto samples = static_cast<double>(data.sample_count());
    Vector clearness(lags + 1);
    for (Index lag = 0; lag <= lags; ++lag) {
        const double count = samples - static_cast<double>(lag) * static_cast<double>(data.experiments.size());
        clearness[lag] = std::abs(both[lag]) * samples / std::sqrt(count * power * spread);
    }
    Index place = 0;
    const double beyond = clearness.tail(lags + 1 - first).maxCoeff(&place);
    if (!(beyond > kChance && beyond > kMoreClearly * clearness.head(first).maxCoeff())) return std::nullopt;
    return static_cast<double>(first + place) * data.Ts;
}

void warn_of_later_response(Fit& fit, const IdData& data, Index output, Index input, double delay, double largest) {
    if (!explains_little(fit.fit_percent[output]) || !(delay < largest * (1 - 1e-9))) return;
    const std::optional<double> later = later_response(data, output, input, largest);
    if (!later) return;
    const OptionName limit{"largest_delay"};
    const Number seconds = significant(*later, 3);
    fit.warnings.push_back(
        data.input_count() == 1 && data.output_count() == 1
            ? Message("The output responds about {} {} after the input, beyond the limit of the search ({} = {} {}): "
                      "increase {}.",
                      seconds, data.time_unit, limit, largest, data.time_unit, limit)
            : Message("Output {} responds about {} {} after input {}, beyond the limit of the search ({} = {} {}): "
                      "increase {}.",
                      output + 1, seconds, data.time_unit, input + 1, limit, largest, data.time_unit, limit));
}

void warn_of_later_responses(Fit& fit, const IdData& data, const FitOptions& options) {
    if (!fit.structure.free_delays || fit.termination == Termination::kCanceled) return;
    const double largest = delay_range(data, options).largest;
    for (Index output = 0; output < fit.structure.outputs; ++output)
        for (Index input = 0; input < fit.structure.inputs; ++input)
            warn_of_later_response(fit, data, output, input, fit.structure.delay(fit.theta, output, input), largest);
}

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

TransferStructure with_delays_of(const TransferStructure& structure, const Vector& theta) {
    TransferStructure at = with_fixed_delays(structure);
    std::size_t channel = 0;
    for (Index output = 0; output < structure.outputs; ++output)
        for (Index input = 0; input < structure.inputs; ++input)
            at.channels[channel++].delay = structure.delay(theta, output, input);
    return at;
}

double likely_largest_delay(const IdData& data) {
    constexpr Index kMinCount = 10;
    constexpr double kMargin = 1.5, kNearlyPeak = 0.9;
    const double quarter = shortest_experiment(data) / 4;
    Index lags = std::numeric_limits<Index>::max();
    for (const Experiment& experiment : data.experiments) lags = std::min(lags, experiment.y.rows() / 4);
    Index furthest = kMinCount;
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

namespace {

/// Whether the inputs of the beginning vary about as much as all inputs.
bool is_as_lively(const IdData& beginning, const IdData& data) {
    const auto deviation = [](const VectorView& u) { return std::sqrt((u.array() - u.mean()).square().mean()); };
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
        for (Index input = 0; input < data.input_count(); ++input)
            if (deviation(beginning.experiments[e].u.col(input)) <
                kAsLively * deviation(data.experiments[e].u.col(input)))
                return false;
    return true;
}

/// With delays up to `likely` at first (s).
DelayScan scan_growing_range(const IdData& data, const TransferStructure& structure, double likely,
                             const FitOptions& options) {
    const double quarter = std::max(options.least_delay, shortest_experiment(data) / 4);
    DelayRange range{options.least_delay, std::clamp(likely, options.least_delay, quarter)};
    DelayScan scan = scan_range(data, structure, range, options);
    while (range.largest < quarter && lowest_at_the_end(scan) && !(options.cancel && options.cancel())) {
        range.largest = std::min(quarter, 2 * range.largest);
        scan = scan_range(data, structure, range, options);
    }
    return scan;
}

}  // namespace

DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    const IdData beginning = beginning_of(data, kScannedSamples);
    if (options.largest_delay) return scan_range(beginning, structure, delay_range(data, options), options);
    const double likely = likely_largest_delay(beginning);
    if (!data.regular() && data.sample_count() > 2 * kScannedIrregular) {
        const IdData part = beginning_of(data, kScannedIrregular);
        if (likely <= shortest_experiment(part) / 4 && is_as_lively(part, beginning)) {
            DelayScan scan = scan_growing_range(part, structure, likely, options);
            if (!lowest_at_the_end(scan)) return scan;
        }
    }
    return scan_growing_range(beginning, structure, likely, options);
}

}  // namespace dynlab::inline numerics
