#include "numerics/signals/resample.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/error.h"
#include "numerics/signals/extension.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMaxFactor = 1000;
constexpr double kKaiserShape = 10.06;  // 0.1102 (A - 8.7) for an attenuation A of 100 dB
constexpr double kCutOff = 0.9;         // of half the lower rate; the transition reaches from 0.8 to 1

/// Modified Bessel function I0 by its series.
double bessel_i0(double x) {
    double sum = 1, term = 1;
    for (int k = 1; term > 1e-18 * sum; ++k) {
        term *= (x / (2 * k)) * (x / (2 * k));
        sum += term;
    }
    return sum;
}

/// Impulse response of the low-pass filter at t lower-rate samples.
double windowed_sinc(double t) {
    const double place = t / static_cast<double>(kResampleReach);
    if (std::abs(place) >= 1) return 0;
    const double phase = std::numbers::pi * kCutOff * t;
    const double sinc = phase == 0 ? 1 : std::sin(phase) / phase;
    return sinc * bessel_i0(kKaiserShape * std::sqrt(1 - place * place));
}

void check_factor(const char* name, Index factor) {
    if (factor < 1 || factor > kMaxFactor)
        throw InvalidArgument("resample: the factor '{}' must be between 1 and {}, but it is {}", name, kMaxFactor,
                              factor);
}

/// Column p holds the weights of the old samples -reach..reach around an instant that lies p/up behind an old sample.
Matrix weights_of_phases(Index up, Index down, Index reach) {
    const double scale = std::min(1.0, static_cast<double>(up) / static_cast<double>(down));
    Matrix weights(2 * reach + 1, up);
    for (Index p = 0; p < up; ++p) {
        const double ahead = static_cast<double>(p) / static_cast<double>(up);
        for (Index k = -reach; k <= reach; ++k)
            weights(k + reach, p) = windowed_sinc(scale * (static_cast<double>(k) - ahead));
        weights.col(p) /= weights.col(p).sum();
    }
    return weights;
}

Index resampled_count(Index count, Index up, Index down) {
    return (count - 1) * up / down + 1;
}

}  // namespace

Vector resample_signal(const VectorView& x, Index up, Index down) {
    check_factor("up", up);
    check_factor("down", down);
    const Index divisor = std::gcd(up, down);
    up /= divisor, down /= divisor;
    if (x.size() == 0 || (up == 1 && down == 1)) return x;
    const Index reach = (kResampleReach * std::max(up, down) + up - 1) / up + 1;
    const Matrix weights = weights_of_phases(up, down, reach);
    const Vector extended = point_reflected(x, reach);
    Vector result(resampled_count(x.size(), up, down));
    for (Index m = 0; m < result.size(); ++m)
        result[m] = weights.col(m * down % up).dot(extended.segment(m * down / up, 2 * reach + 1));
    return result;
}

IdData resample(const IdData& data, Index up, Index down) {
    check_factor("up", up);
    check_factor("down", down);
    if (!data.regular())
        throw InvalidArgument(
            "resample: the data are sampled irregularly; interpolate them at equally spaced instants first (interp1)");
    IdData result = data;
    result.Ts = data.Ts * static_cast<double>(down) / static_cast<double>(up);
    for (Experiment& experiment : result.experiments) {
        const Index count = resampled_count(experiment.y.rows(), up, down);
        if (count < 2)
            throw InvalidArgument("resample: fewer than 2 of {} would remain; specify a smaller value of 'down'",
                                  plural(experiment.y.rows(), "{} sample", "{} samples"));
        for (Matrix* signals : {&experiment.y, &experiment.u, &experiment.r}) {
            Matrix resampled(count, signals->cols());
            for (Index i = 0; i < signals->cols(); ++i) resampled.col(i) = resample_signal(signals->col(i), up, down);
            *signals = std::move(resampled);
        }
    }
    return result;
}

}  // namespace dynlab::inline numerics
