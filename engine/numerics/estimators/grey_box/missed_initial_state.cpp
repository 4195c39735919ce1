#include "numerics/estimators/grey_box/missed_initial_state.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/grey_output.h"
#include "numerics/linalg/least_squares.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kStrongEvidenceOfStart = 10, kWorthPoints = 0.5, kMaxCorrelation = 0.999;

/// Of all outputs, each about its mean and in its weight.
double weighted_variation(const IdData& data, const Vector& weights) {
    return output_variations(data).dot(weights.cwiseAbs2());
}

double effective_samples(const Vector& errors) {
    const double squares = errors.squaredNorm();
    if (!(squares > 0)) return static_cast<double>(errors.size());
    const double r =
        std::clamp(errors.head(errors.size() - 1).dot(errors.tail(errors.size() - 1)) / squares, 0.0, kMaxCorrelation);
    return static_cast<double>(errors.size()) * (1 - r) / (1 + r);
}

}  // namespace

std::optional<Message> missed_initial_state(const IdData& data, const GreyFit& fit, const Vector& weights) {
    const auto estimated = std::count(fit.model.estimated_initial.begin(), fit.model.estimated_initial.end(), true);
    if (estimated > 0 || fit.fit.termination == Termination::kCanceled) return std::nullopt;
    GreyModel freed = fit.model;
    freed.estimated_initial.assign(freed.state_names.size(), true);
    const GreyOutput criterion(data, freed, fit.fit.theta, fit.initial_states, weights, fit.relative_tolerance);
    Vector output;
    Matrix J;
    criterion.simulate(criterion.start(), output, &J);
    const Vector errors = criterion.measured() - output;
    if (!errors.allFinite() || !J.allFinite() || errors.size() <= 2 * J.cols()) return std::nullopt;
    const Vector left = solve_least_squares(J, errors).residuals;
    const double now = errors.squaredNorm(), then = left.squaredNorm(), variation = weighted_variation(data, weights);
    const double N = std::max(2.0, effective_samples(left));
    const auto values = static_cast<double>(J.cols() - criterion.free_count());
    if (!(N * std::log(now / std::max(then, 1e-300)) - values * std::log(N) > kStrongEvidenceOfStart))
        return std::nullopt;
    const double fitted = fit_percent_of_sums(now, variation), better = fit_percent_of_sums(then, variation);
    if (better - fitted < kWorthPoints) return std::nullopt;
    return Message(
        "The data do not start at the initial state of the model: with {} = \"estimate\" the fit is about {} % instead "
        "of {} %.",
        OptionName{"initial_state"}, significant(better, 3), significant(fitted, 3));
}

}  // namespace dynlab::inline numerics
