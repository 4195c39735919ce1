#include "numerics/models/frequency_data.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNyquistRounding = 1e-9;  // of frequencies that were computed to lie at pi/Ts

void check_sizes(const std::string& caller, const FrequencyData& data) {
    if (data.w.size() == 0) throw InvalidArgument("{}: the response has no frequencies", caller);
    if (data.response.size() != data.w.size())
        throw InvalidArgument("{}: the response needs one value for each frequency ({}), but has {}", caller,
                              data.w.size(), data.response.size());
    if (data.variance.size() != 0 && data.variance.size() != data.w.size())
        throw InvalidArgument("{}: the variance needs one value, or one for each frequency ({}), but has {}", caller,
                              data.w.size(), data.variance.size());
}

void check_frequencies(const std::string& caller, const FrequencyData& data) {
    const double end = data.Ts > 0 ? std::numbers::pi / data.Ts * (1 + kNyquistRounding) : kInfinity;
    for (Index k = 0; k < data.w.size(); ++k) {
        const double w = data.w[k];
        if (!std::isfinite(w)) throw InvalidArgument("{}: frequency {} is not a finite number", caller, k + 1);
        if (!(w > 0))
            throw InvalidArgument("{}: frequencies must be positive (rad/s), but frequency {} is {}; remove it", caller,
                                  k + 1, w);
        if (k > 0 && !(w > data.w[k - 1]))
            throw InvalidArgument("{}: each frequency may occur only once, but {} rad/s occurs several times", caller,
                                  w);
        if (w > end)
            throw InvalidArgument("{}: frequencies must not exceed pi/Ts = {} rad/s, but frequency {} is {}", caller,
                                  std::numbers::pi / data.Ts, k + 1, w);
    }
}

}  // namespace

InterSample inter_sample_of(Hold hold) {
    return hold == Hold::kZoh ? InterSample::kZoh : InterSample::kFoh;
}

void check_frequency_data(const std::string& caller, const FrequencyData& data) {
    check_sizes(caller, data);
    if (!(data.Ts >= 0) || !std::isfinite(data.Ts))
        throw InvalidArgument("{}: the sampling time must be nonnegative, but is {}", caller, data.Ts);
    if (data.Ts == 0 && data.inter_sample != InterSample::kBandLimited)
        throw InvalidArgument("{}: an input with zero-order hold (zoh) needs the sampling time Ts", caller);
    check_frequencies(caller, data);
    for (Index k = 0; k < data.w.size(); ++k)
        if (!std::isfinite(data.response[k].real()) || !std::isfinite(data.response[k].imag()))
            throw InvalidArgument("{}: the response at frequency {}, {} rad/s, is not a finite number", caller, k + 1,
                                  data.w[k]);
    for (Index k = 0; k < data.variance.size(); ++k)
        if (!(data.variance[k] > 0) || !std::isfinite(data.variance[k]))
            throw InvalidArgument("{}: variances must be positive, but the variance at frequency {}, {} rad/s, is {}",
                                  caller, k + 1, data.w[k], data.variance[k]);
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
