#include "numerics/models/frequency_data.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNyquistRounding = 1e-9;  // of frequencies that were computed to lie at pi/Ts

std::string place_of(Index k) {
    return "frequency " + std::to_string(k + 1);
}

void check_sizes(const std::string& caller, const FrequencyData& data) {
    if (data.w.size() == 0) throw InvalidArgument(caller + ": there is no frequency, so no response is known");
    if (data.response.size() != data.w.size())
        throw InvalidArgument(caller + ": the response needs one value for each frequency (" +
                              std::to_string(data.w.size()) + "), and has " + std::to_string(data.response.size()));
    if (data.variance.size() != 0 && data.variance.size() != data.w.size())
        throw InvalidArgument(caller + ": the variance needs one value, or one for each frequency (" +
                              std::to_string(data.w.size()) + "), and has " + std::to_string(data.variance.size()));
}

void check_frequencies(const std::string& caller, const FrequencyData& data) {
    const double end = data.Ts > 0 ? std::numbers::pi / data.Ts * (1 + kNyquistRounding) : kInfinity;
    for (Index k = 0; k < data.w.size(); ++k) {
        const double w = data.w[k];
        if (!std::isfinite(w)) throw InvalidArgument(caller + ": " + place_of(k) + " is not a finite number");
        if (!(w > 0))
            throw InvalidArgument(caller + ": frequencies must be above zero (rad/s), but " + place_of(k) + " is " +
                                  number_text(w) + "; leave it out");
        if (k > 0 && !(w > data.w[k - 1]))
            throw InvalidArgument(caller + ": each frequency may occur once, but " + number_text(w) +
                                  " rad/s occurs more often");
        if (w > end)
            throw InvalidArgument(caller + ": frequencies end at pi/Ts = " + number_text(std::numbers::pi / data.Ts) +
                                  " rad/s, but " + place_of(k) + " is " + number_text(w));
    }
}

}  // namespace

InterSample inter_sample_of(Hold hold) {
    return hold == Hold::kZoh ? InterSample::kZoh : InterSample::kFoh;
}

void check_frequency_data(const std::string& caller, const FrequencyData& data) {
    check_sizes(caller, data);
    if (!(data.Ts >= 0) || !std::isfinite(data.Ts))
        throw InvalidArgument(caller + ": the sampling time must not be negative, and is " + number_text(data.Ts));
    if (data.Ts == 0 && data.inter_sample != InterSample::kBandLimited)
        throw InvalidArgument(caller + ": an input that is held between samples needs their sampling time Ts");
    check_frequencies(caller, data);
    for (Index k = 0; k < data.w.size(); ++k)
        if (!std::isfinite(data.response[k].real()) || !std::isfinite(data.response[k].imag()))
            throw InvalidArgument(caller + ": the response at " + place_of(k) + ", " + number_text(data.w[k]) +
                                  " rad/s, is not a finite number");
    for (Index k = 0; k < data.variance.size(); ++k)
        if (!(data.variance[k] > 0) || !std::isfinite(data.variance[k]))
            throw InvalidArgument(caller + ": variances must be positive, but that at " + place_of(k) + ", " +
                                  number_text(data.w[k]) + " rad/s, is " + number_text(data.variance[k]));
}

FrequencyData frequency_data(const ComplexVector& response, const VectorView& w, const VectorView& variance, double Ts,
                             InterSample inter_sample) {
    FrequencyData data;
    data.w = w, data.response = response, data.Ts = Ts, data.inter_sample = inter_sample;
    data.variance = variance.size() == 1 ? Vector(Vector::Constant(w.size(), variance[0])) : Vector(variance);
    check_sizes("idfrd", data);
    std::vector<Index> order(static_cast<std::size_t>(w.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&w](Index a, Index b) { return w[a] < w[b]; });
    data.w = Vector(w(order));
    data.response = ComplexVector(response(order));
    if (data.variance.size() > 0) data.variance = Vector(data.variance(order)).eval();
    check_frequency_data("idfrd", data);
    return data;
}

}  // namespace dynlab::inline numerics
