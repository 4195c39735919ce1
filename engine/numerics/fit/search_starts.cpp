#include "numerics/fit/search_starts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/criteria/transfer_output.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/response_peaks.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kWorse = 1e-9;             // relative; smaller differences are rounding
constexpr double kGained = 1e-4;            // relative; less is no reason for a richer structure
constexpr double kAddedRoots[] = {5, 100};  // over the mean sampling time
constexpr double kApart = 1.5;              // of one added root to the next
constexpr int kPlaces = 12;                 // to which poles are moved
constexpr double kSlowestPlace = 0.1;       // rad over the longest experiment
constexpr double kMovedDamping = 0.1;
constexpr std::size_t kMaxPeaks = 5;
constexpr double kDampingOfPeaks[] = {0.1, 0.02};
constexpr double kPhases[] = {-1, -0.5, 0.5, 1};  // of a quarter turn, by which a free delay moves at a peak
constexpr std::size_t kMaxExchanged = 4;
constexpr double kMayBecomeBest = 1.2;    // of the loss found, before numerator and poles move together
constexpr Index kPlacedSamples = 10'000;  // on which the places are compared

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

/// Frequencies to which poles may be moved, rad/s, up to a radian a sample.
std::vector<double> places_of_poles(const IdData& data) {
    const double fastest = 1 / data.mean_step();
    double slowest = fastest;
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
        slowest = std::min(slowest, kSlowestPlace / data.duration(e));
    std::vector<double> places;
    for (int i = 0; i < kPlaces; ++i)
        places.push_back(slowest * std::pow(fastest / slowest, static_cast<double>(i) / (kPlaces - 1)));
    return places;
}

/// Whether a polynomial with real coefficients has these roots.
bool has_whole_pairs(const ComplexVector& roots) {
    return std::abs(roots.sum().imag()) <= 1e-9 * roots.cwiseAbs().sum();
}

/// What is left of poles in order of frequency, and what takes the place of the others: one pole, or a pair.
struct PoleExchange {
    Vector kept;
    bool pair;
};

std::vector<PoleExchange> pole_exchanges(const ComplexVector& poles) {
    const Index n = poles.size();
    std::vector<PoleExchange> all;
    const auto add = [&](const ComplexVector& kept, bool pair) {
        if (has_whole_pairs(kept)) all.push_back({polynomial_from_roots(kept), pair});
    };
    for (Index i = 0; i < n; ++i) {
        ComplexVector kept(n - 1);
        kept << poles.head(i), poles.tail(n - 1 - i);
        add(kept, false);
    }
    if (n >= 2) add(poles.tail(n - 2), true);
    if (n > 2) add(poles.head(n - 2), true);
    return all;
}

Vector pair_factor(double w, double damping) {
    return Vector{{1.0, 2 * damping * w, w * w}};
}

Vector moved_factor(bool pair, double w) {
    return pair ? pair_factor(w, kMovedDamping) : Vector{{1.0, w}};
}

/// p times (s + root).
Vector with_root(const Vector& p, double root) {
    return multiply(p, Vector{{1, root}});
}

}  // namespace

std::vector<TransferStructure> lower_order_structures(const TransferStructure& structure) {
    std::vector<TransferStructure> all;
    TransferStructure poles = structure, zeros = structure;
    if (fewer_poles(poles)) all.push_back(poles);
    if (fewer_zeros(zeros)) {
        all.push_back(zeros);
        if (fewer_poles(zeros)) all.push_back(zeros);
    }
    return all;
}

Vector enriched(const TransferStructure& lower_order, const Vector& lower_order_theta,
                const TransferStructure& structure, double fast, double middle) {
    Vector theta = Vector::Zero(structure.parameter_count());
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        const int added_poles = structure.poles[d] - lower_order.poles[d];
        int shared = added_poles;  // poles that meet a zero in every channel
        for (std::size_t c = 0; c < structure.channels.size(); ++c)
            if (structure.channels[c].denominator == static_cast<Index>(d))
                shared = std::min(shared, structure.channels[c].zeros - lower_order.channels[c].zeros);
        for (Index output = 0; output < structure.outputs; ++output)
            for (Index input = 0; input < structure.inputs; ++input) {
                const TransferChannel& channel = structure.channel(output, input);
                if (channel.denominator != static_cast<Index>(d)) continue;
                Vector A = lower_order.denominator(lower_order_theta, output, input);
                Vector B = lower_order.numerator(lower_order_theta, output, input);
                const int added_zeros = channel.zeros - lower_order.channel(output, input).zeros;
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

AddedRoots::AddedRoots(const IdData& data) {
    constexpr double kSlow = 4;
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    rate_ = 1 / data.mean_step();
    slowest_ = kSlow / (longest + data.mean_step());
}

std::vector<Vector> AddedRoots::starts(const TransferStructure& lower_order, const Vector& theta,
                                       const TransferStructure& structure) const {
    std::vector<Vector> starts;
    for (const double speed : kAddedRoots) {
        const double fast = speed * rate_;
        starts.push_back(enriched(lower_order, theta, structure, fast, std::sqrt(fast * slowest_)));
    }
    return starts;
}

std::vector<Vector> starts_from_lower_order(const IdData& data, const std::vector<const Fit*>& lower_order,
                                            const TransferStructure& structure, double loss) {
    const AddedRoots added(data);
    std::vector<Vector> all;
    for (const Fit* fit : lower_order) {
        if (!(fit->loss < (1 - kWorse) * loss)) continue;
        TransferStructure at = with_fixed_delays(structure);
        const TransferStructure theirs = with_delays_of(fit->structure, fit->theta);
        for (std::size_t c = 0; c < at.channels.size(); ++c) at.channels[c].delay = theirs.channels[c].delay;
        for (const Vector& start : added.starts(fit->structure, fit->theta, at))
            all.push_back(structure.free_delays ? with_delays(structure, at, start) : start);
    }
    return all;
}

NestedSearch::NestedSearch(const IdData& data, Solve solve) : solve_(std::move(solve)), added_(data) {}

std::vector<Vector> NestedSearch::better_starts(const TransferStructure& structure, double loss) {
    std::vector<Vector> starts;
    for (const TransferStructure& lower_order : lower_order_structures(structure)) {
        const NestedSolution& solution = best(lower_order);
        if (!(solution.loss < (1 - kWorse) * loss)) continue;
        for (Vector& start : added_.starts(solution.structure, solution.theta, structure))
            starts.push_back(std::move(start));
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
    for (const TransferStructure& lower_order : lower_order_structures(structure))
        if (const NestedSolution& less = best(lower_order); (1 - kGained) * less.loss <= solution.loss) solution = less;
    return found_.emplace(std::move(key), std::move(solution)).first->second;
}

NestedSolution with_linear_part(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                                const VectorView& A, double delay) {
    TransferStructure at = with_fixed_delays(structure);
    at.channels.front().delay = delay;
    const TransferOutput model(at, condition, data, 0, shortest_experiment(data));
    const Index n = A.size() - 1, rest = model.parameter_count() - n;
    Vector point = Vector::Zero(model.parameter_count()), output;
    point.head(n) = A.tail(n).cwiseQuotient(model.seconds().head(n));
    Matrix sensitivities;
    model.simulate(point, output, &sensitivities);
    if (!sensitivities.allFinite()) return {};
    const Vector y = model.target();
    const LeastSquares linear = solve_least_squares(sensitivities.rightCols(rest), y);
    const Index numerator = at.channels.front().zeros + 1;
    Vector theta(at.parameter_count());
    theta << A.tail(n), linear.solution.head(numerator).cwiseProduct(model.seconds().segment(n, numerator));
    const double loss =
        (y - sensitivities.rightCols(rest) * linear.solution).squaredNorm() / static_cast<double>(y.size());
    return {structure.free_delays ? with_delays(structure, at, theta) : theta, loss, structure};
}

namespace {

/// The valleys of the loss over the frequencies to which poles are moved.
std::vector<NestedSolution> valleys_over_places(const IdData& data, const TransferStructure& structure,
                                                const Fit& found, const std::vector<PoleExchange>& exchanges) {
    const double delay = structure.delay(found.theta, 0, 0);
    const std::vector<double> places = places_of_poles(data);
    std::vector<NestedSolution> all;
    for (const PoleExchange& exchange : exchanges) {
        std::vector<NestedSolution> tried;
        for (const double w : places) {
            const Vector A = multiply(exchange.kept, moved_factor(exchange.pair, w));
            tried.push_back(with_linear_part(data, structure, found.start, A, delay));
        }
        for (std::size_t i = 0; i < tried.size(); ++i) {
            const bool valley = tried[i].loss < kMayBecomeBest * found.loss &&
                                (i == 0 || tried[i].loss < tried[i - 1].loss) &&
                                (i + 1 == tried.size() || tried[i].loss <= tried[i + 1].loss);
            if (valley) all.push_back(tried[i]);
        }
    }
    return all;
}

/// The delay found, the least one, and those by which the phase at a frequency moves; the found one where it is fixed.
std::vector<double> delays_at_peak(const IdData& data, const TransferStructure& structure, const Fit& found, double w,
                                   const FitOptions& options) {
    const double delay = structure.delay(found.theta, 0, 0);
    if (!structure.free_delays) return {delay};
    const DelayRange range = delay_range(data, options);
    std::vector<double> delays = {delay, range.least};
    for (const double phase : kPhases) {
        const double moved = delay + phase * std::numbers::pi / (2 * w);
        if (moved > range.least && moved < range.largest) delays.push_back(moved);
    }
    return delays;
}

/// Pairs at each peak of the measured frequency response.
std::vector<NestedSolution> pairs_at_peaks(const IdData& data, const TransferStructure& structure, const Fit& found,
                                           const std::vector<PoleExchange>& exchanges, const FitOptions& options) {
    std::vector<NestedSolution> all;
    for (const double w : response_peaks(data, kMaxPeaks))
        for (const PoleExchange& exchange : exchanges) {
            if (!exchange.pair) continue;
            NestedSolution best;
            for (const double damping : kDampingOfPeaks)
                for (const double delay : delays_at_peak(data, structure, found, w, options)) {
                    const Vector A = multiply(exchange.kept, pair_factor(w, damping));
                    NestedSolution one = with_linear_part(data, structure, found.start, A, delay);
                    if (one.loss < best.loss) best = std::move(one);
                }
            if (std::isfinite(best.loss)) all.push_back(std::move(best));
        }
    return all;
}

void append_best(std::vector<Vector>& starts, std::vector<NestedSolution> solutions) {
    std::ranges::stable_sort(solutions, {}, &NestedSolution::loss);
    for (std::size_t i = 0; i < std::min(kMaxExchanged, solutions.size()); ++i)
        starts.push_back(std::move(solutions[i].theta));
}

}  // namespace

std::vector<Vector> exchanged_poles(const IdData& data, const TransferStructure& structure, const Fit& found,
                                    const FitOptions& options) {
    ComplexVector poles = roots(structure.denominator(found.theta, 0, 0));
    std::stable_sort(poles.begin(), poles.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    const IdData part = beginning_of(data, kPlacedSamples);
    const std::vector<PoleExchange> exchanges = pole_exchanges(poles);
    std::vector<Vector> starts;
    append_best(starts, valleys_over_places(part, structure, found, exchanges));
    append_best(starts, pairs_at_peaks(part, structure, found, exchanges, options));
    return starts;
}

}  // namespace dynlab::inline numerics
