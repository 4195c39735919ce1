#include "numerics/statistics/whiteness.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/statistics/distributions.h"
#include "numerics/statistics/lagged_sums.h"

namespace dynlab::inline numerics {

namespace {

Message white_message(ModelError kind, const Message& probability, Index lags) {
    if (kind == ModelError::kPrediction)
        return Message("The prediction error is white (Ljung-Box {} over {}).", probability,
                       plural(lags, "{} lag", "{} lags"));
    return Message("The output error is white (Ljung-Box {} over {}).", probability, plural(lags, "{} lag", "{} lags"));
}

Message colored_message(ModelError kind, const Message& probability, Index outside, Index lags, double confidence) {
    const Number percent = significant(100 * confidence, 4);
    if (kind == ModelError::kPrediction)
        return Message(
            "The prediction error is not white (Ljung-Box {}; at {} of {} lags, the autocorrelation exceeds the {} % "
            "bound).",
            probability, outside, lags, percent);
    return Message(
        "The output error is not white (Ljung-Box {}; at {} of {} lags, the autocorrelation exceeds the {} % bound).",
        probability, outside, lags, percent);
}

// The variance of the lag's sample autocorrelation of a white signal, times N + 2 over N (Ljung and Box 1978).
double lag_variance(const std::vector<Vector>& e, Index lag) {
    double pairs = 0;
    for (const Vector& x : e) pairs += static_cast<double>(std::max<Index>(0, x.size() - lag));
    const double N = total_size(e);
    return pairs / (N * (N + 2));
}

}  // namespace

Message probability_text(double p) {
    return p < 0.001 ? Message("p < {}", 0.001) : Message("p = {}", significant(p, 2));
}

WhitenessTest whiteness_of_covariances(const std::vector<Vector>& e, const VectorView& R, double confidence,
                                       ModelError kind) {
    WhitenessTest test;
    const Index lags = R.size() - 1;
    if (R[0] == 0) return test;  // nothing but a constant
    test.correlation = R / R[0];
    test.bound = normal_half_width(confidence) / std::sqrt(total_size(e));
    for (Index lag = 1; lag <= lags; ++lag) {
        const double variance = lag_variance(e, lag);
        if (variance == 0) continue;
        ++test.degrees;
        test.statistic += test.correlation[lag] * test.correlation[lag] / variance;
        if (std::abs(test.correlation[lag]) > test.bound) ++test.outside;
    }
    if (test.degrees == 0) return test;
    test.p_value = chi_squared_upper_tail(test.statistic, static_cast<double>(test.degrees));
    test.white = test.p_value >= 1 - confidence;
    const Message probability = probability_text(test.p_value);
    test.verdict = test.white ? white_message(kind, probability, lags)
                              : colored_message(kind, probability, test.outside, lags, confidence);
    return test;
}

void ResidualOptions::validate() const {
    if (lags < 1) throw InvalidArgument("the number of lags must be at least 1, but is {}", lags);
    if (!(confidence > 0 && confidence < 1))
        throw InvalidArgument("the confidence level must be between 0 and 1, such as 0.99, but is {}", confidence);
}

WhitenessTest whiteness_test(const std::vector<Vector>& errors, const ResidualOptions& options) {
    options.validate();
    std::vector<Vector> e;
    Index longest = 0;
    for (const Vector& data_set : errors) {
        e.emplace_back(data_set.array() - data_set.mean());
        longest = std::max(longest, data_set.size());
    }
    const Index lags = std::max<Index>(1, std::min(options.lags, longest / 2));
    return whiteness_of_covariances(e, lagged_covariances(e, e, lags).tail(lags + 1), options.confidence,
                                    ModelError::kOutput);
}

}  // namespace dynlab::inline numerics
