#include "numerics/statistics/wrapped_period.h"

#include <algorithm>
#include <cmath>

#include "numerics/signals/unwrap.h"
#include "numerics/statistics/autoregression.h"

namespace dynlab::inline numerics {

namespace {

/// Mean square error of predicting the next sample from the last ones.
double prediction_error(const Vector& x) {
    constexpr Index kMemory = 10;
    const Vector centered = x.array() - x.mean();
    return fit_autoregression(centered, {centered.size()}, kMemory, AutoregressiveOrder::kBic).variance;
}

bool is_wrapped(const VectorView& x, double period) {
    constexpr double kAngleSlack = 0.05, kFilled = 0.9, kNearEnd = 0.3;  // of the period
    constexpr double kMaxJumpShare = 0.7, kMuchBetter = 0.5;
    constexpr double kUsual = 3;  // times the largest other step
    const double low = x.minCoeff(), high = x.maxCoeff(), slack = kAngleSlack * period;
    const bool centered = low >= -period / 2 - slack && high <= period / 2 + slack;
    const bool positive = low >= -slack && high <= period + slack;
    if (!(centered || positive) || high - low < kFilled * period) return false;
    double usual = 0, across = 0;  // steps
    Index jumps = 0, from_ends = 0;
    for (Index k = 1; k < x.size(); ++k) {
        const double step = x[k] - x[k - 1];
        if (std::abs(step) <= period / 2) {
            usual = std::max(usual, std::abs(step));
            continue;
        }
        ++jumps;
        across = std::max(across, std::abs(std::remainder(step, period)));
        from_ends +=
            std::min(x[k], x[k - 1]) < low + kNearEnd * period && std::max(x[k], x[k - 1]) > high - kNearEnd * period;
    }
    // A signal that jumps anyway, as a square wave does, has no steps that unwrapping could make usual; nor does
    // unwrapping make noise or a fast sine easier to predict.
    return jumps > 0 && static_cast<double>(from_ends) >= kMaxJumpShare * static_cast<double>(jumps) && usual > 0 &&
           across < kUsual * usual && prediction_error(unwrap(x, period)) < kMuchBetter * prediction_error(x);
}

}  // namespace

std::optional<double> wrapped_period(const VectorView& x, const Vector& periods) {
    if (x.size() < 10) return std::nullopt;
    for (const double period : periods)
        if (is_wrapped(x, period)) return period;
    return std::nullopt;
}

}  // namespace dynlab::inline numerics
