#include "numerics/fit/fit.h"

#include <cmath>
#include <utility>

#include "numerics/error.h"

namespace dynlab::inline numerics {

Fit::Fit() = default;
Fit::Fit(const Fit&) = default;
Fit::Fit(Fit&&) noexcept = default;
Fit& Fit::operator=(const Fit&) = default;
Fit& Fit::operator=(Fit&&) noexcept = default;
Fit::~Fit() = default;

Message Fit::full_message() const {
    std::vector<Message> all;
    if (!message.empty()) all.push_back(message);
    all.insert(all.end(), warnings.begin(), warnings.end());
    // An unstable model of a loop diverges when it is simulated in open loop, and can still be correct.
    const bool stable = std::ranges::all_of(models, [](const TransferFunction& G) { return G.stable(); });
    for (Index i = 0; stable && i < fit_percent.size(); ++i) {
        if (!(fit_percent[i] < 0) || !std::isfinite(fit_percent[i])) continue;
        const Number percent = significant(fit_percent[i], 3);
        all.push_back(fit_percent.size() == 1
                          ? Message("The model fits worse than the mean of the output (fit {} %): do not use it. Check "
                                    "the data and the structure, or use other initial values.",
                                    percent)
                          : Message("The model fits output {} worse than the mean of that output (fit {} %): do not "
                                    "use it. Check the data and the structure, or use other initial values.",
                                    i + 1, percent));
    }
    return sentences(std::move(all));
}

void FitOptions::validate() const {
    if (lambda && (!(*lambda > 0) || !std::isfinite(*lambda)))
        throw InvalidArgument("lambda must be a positive number of rad/s, but is {}", *lambda);
    if (!(least_delay >= 0) || !std::isfinite(least_delay))
        throw InvalidArgument("{} must be nonnegative, but is {}", OptionName{"least_delay"}, least_delay);
    if (largest_delay && (!(*largest_delay >= least_delay) || !std::isfinite(*largest_delay)))
        throw InvalidArgument("{} must be at least {} = {}, but is {}", OptionName{"largest_delay"},
                              OptionName{"least_delay"}, least_delay, *largest_delay);
    if (delay_count < 1)
        throw InvalidArgument("{} must be at least 1, but is {}", OptionName{"delay_count"}, delay_count);
    if (max_iterations < 0)
        throw InvalidArgument("{} must be nonnegative, but is {}", OptionName{"max_iterations"}, max_iterations);
    if (!(tolerance > 0) || !std::isfinite(tolerance))
        throw InvalidArgument("{} must be positive, but is {}", OptionName{"tolerance"}, tolerance);
}

FitOptions FitOptions::started(const StartCondition& condition) const {
    FitOptions other = *this;
    other.initial_state = condition.state;
    other.offset = condition.offset ? Offset::kEstimate : Offset::kNone;
    return other;
}

FitOptions FitOptions::limited(int iterations, double limit) const {
    FitOptions other = *this;
    other.max_iterations = iterations;
    other.extend_iterations = false;
    other.tolerance = limit;
    return other;
}

FitOptions FitOptions::rough(int iterations, double limit) const {
    FitOptions other = limited(iterations, limit);
    other.precision = false;
    return other;
}

double fit_percent_of_sums(double squared_errors, double squared_variations) {
    if (!std::isfinite(squared_errors)) return -kInfinity;
    return 100 * (1 - std::sqrt(squared_errors / squared_variations));
}

Vector output_variations(const IdData& data) {
    Vector sums = Vector::Zero(data.output_count());
    for (const Experiment& experiment : data.experiments)
        for (Index output = 0; output < sums.size(); ++output) {
            const auto y = experiment.y.col(output).array();
            sums[output] += (y - y.mean()).square().sum();
        }
    return sums;
}

Vector output_powers(const IdData& data) {
    Vector sums = Vector::Zero(data.output_count());
    for (const Experiment& experiment : data.experiments) sums += experiment.y.colwise().squaredNorm().transpose();
    return sums / static_cast<double>(data.sample_count());
}

}  // namespace dynlab::inline numerics
