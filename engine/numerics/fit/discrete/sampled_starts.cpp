#include "numerics/fit/discrete/sampled_starts.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/discrete_output.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/discrete/sriv_iteration.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kDelaysPerEquation = 4;    // delays (samples) in one difference equation
constexpr Index kMaxWindows = 8;           // so many of these, around the delay found
constexpr Index kWindowSamples = 5'000;    // on which they are compared
constexpr Index kExactSamples = 20'000;    // on which the chosen ones are fitted
constexpr double kClearlySmaller = 0.995;  // of the loss found
constexpr int kPartsOfSample = 4;          // delays that are tried in each sampling interval
constexpr std::size_t kMaxSampledStarts = 3;
constexpr int kSampledIterations = 10;
constexpr double kSampledTolerance = 1e-3;
constexpr double kAlternating = 2;  // rad a sample: where a pole on the negative real axis goes

/// A difference equation's poles in continuous time, and its loss.
struct SampledModel {
    Vector A;
    double loss = kInfinity;
};

/// Fitted for delays from `late` samples on, with `more` coefficients than one sampling interval needs.
SampledModel fit_sampled(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                         Index late, Index more, const FitOptions& options) {
    const Index n = structure.poles.front(), m = structure.channels.front().zeros;
    const Index at_once = data.hold == Hold::kZoh && m < n ? 1 : 0;  // whether the present input has no effect yet
    const auto orders = PolynomialOrders::output_error({static_cast<int>(n + 2 - at_once + more)},
                                                       {static_cast<int>(n)}, {static_cast<int>(late + at_once)});
    const std::vector<SampledExperiment> experiments = sampled_experiments(data);
    const DiscreteOutput model(orders, condition, experiments);
    const Vector y = model.target();
    if (y.size() <= model.parameter_count()) return {};
    const InstrumentSolution solution = iterate_instruments(model, y, instrument_start(model, y, options.cancel),
                                                            kSampledIterations, kSampledTolerance, options.cancel);
    if (!solution.theta.allFinite()) return {};
    ComplexVector poles = roots(monic(solution.theta.segment(orders.f_start(0), n)));
    for (Complex& z : poles) {
        if (z == 0.0) return {};
        z = z.imag() == 0 && z.real() < 0 ? Complex(-kAlternating) : std::log(z);
        z /= data.Ts;
    }
    return {polynomial_from_roots(poles), solution.loss};
}

}  // namespace

std::vector<Vector> sampled_starts(const IdData& data, const TransferStructure& structure, const Fit& found,
                                   const FitOptions& options) {
    const double Ts = data.Ts;
    const auto samples = [&](double delay) { return static_cast<Index>(std::floor(delay / Ts + 1e-9)); };
    const Index here = samples(found.structure.delay(found.theta, 0, 0));
    const IdData part = beginning_of(data, kExactSamples), few = beginning_of(data, kWindowSamples);
    Index first = here, last = here;
    if (structure.free_delays) {
        const DelayRange range = delay_range(data, options);
        const Index least = samples(range.least), max_delay = samples(range.largest);
        std::vector<Index> windows;
        for (Index window = std::max(least, here - kDelaysPerEquation * kMaxWindows / 2);
             window <= std::min(max_delay, here + kDelaysPerEquation * kMaxWindows / 2); window += kDelaysPerEquation)
            windows.push_back(window);
        std::vector<double> losses(windows.size());
        side_by_side(windows.size(), [&](std::size_t i) {
            losses[i] = fit_sampled(few, structure, found.start, windows[i], kDelaysPerEquation - 1, options).loss;
        });
        double smallest = kInfinity;
        for (std::size_t i = 0; i < windows.size(); ++i) {
            if (!(losses[i] < smallest)) continue;
            smallest = losses[i];
            first = windows[i];
            last = std::min(first + kDelaysPerEquation - 1, max_delay);
        }
    }
    std::vector<NestedSolution> all(static_cast<std::size_t>(last - first + 1));
    side_by_side(all.size(), [&](std::size_t place) {
        const Index late = first + static_cast<Index>(place);
        const SampledModel model = fit_sampled(part, structure, found.start, late, 0, options);
        if (!(model.loss < kClearlySmaller * found.loss)) return;
        for (int i = 0; i < (structure.free_delays ? kPartsOfSample : 1); ++i) {
            const double delay = structure.free_delays
                                     ? (static_cast<double>(late) + static_cast<double>(i) / kPartsOfSample) * Ts
                                     : structure.channels.front().delay;
            NestedSolution one = with_linear_part(part, structure, found.start, model.A, delay);
            if (one.loss < all[place].loss) all[place] = std::move(one);
        }
    });
    std::erase_if(all, [](const NestedSolution& one) { return one.theta.size() == 0; });
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.loss < b.loss; });
    std::vector<Vector> starts;
    for (std::size_t i = 0; i < std::min(kMaxSampledStarts, all.size()); ++i) starts.push_back(all[i].theta);
    return starts;
}

}  // namespace dynlab::inline numerics
