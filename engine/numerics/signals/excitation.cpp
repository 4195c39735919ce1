#include "numerics/signals/excitation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "numerics/error.h"
#include "numerics/signals/checks.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

void check_count(const std::string& caller, Index count) {
    if (count < 1) throw InvalidArgument("{}: the number of samples must be at least 1, but it is {}", caller, count);
}

void check_frequency(const std::string& caller, double frequency, double Ts) {
    constexpr double kRounding = 1e-12;
    const double nyquist = 0.5 / Ts;
    if (!(frequency >= 0) || frequency > nyquist * (1 + kRounding))
        throw InvalidArgument(
            "{}: frequencies must be between 0 and half the sampling frequency, {} Hz, but one is {} Hz", caller,
            nyquist, frequency);
}

/// The instants 0, Ts, ... below `duration`.
Eigen::ArrayXd instants(const std::string& caller, double duration, double Ts) {
    check_sampling_time(caller, Ts);
    constexpr double kMaxSamples = 1e10;
    const double count = std::round(duration / Ts);
    if (!(count >= 1) || count > kMaxSamples)
        throw InvalidArgument("{}: the duration must be between 0.5 and 1e10 sampling times of {} s, but it is {} s",
                              caller, Ts, duration);
    const Index samples = static_cast<Index>(count);
    return Ts * Eigen::ArrayXd::LinSpaced(samples, 0, static_cast<double>(samples - 1));
}

/// Equal frequencies would add up to one line whose size depends on their phases.
void check_distinct(const VectorView& frequencies) {
    std::vector<double> sorted(frequencies.begin(), frequencies.end());
    std::sort(sorted.begin(), sorted.end());
    const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
    if (repeated != sorted.end())
        throw InvalidArgument("multisine: each frequency may occur only once, but {} Hz occurs several times",
                              *repeated);
}

}  // namespace

Vector step_signal(Index count, Index first, double low, double high) {
    check_count("step_signal", count);
    if (first < 1 || first > count + 1)
        throw InvalidArgument("step_signal: the step must start at a sample between 1 and {}, but it starts at {}",
                              count + 1, first);
    Vector signal = Vector::Constant(count, high);
    signal.head(first - 1).setConstant(low);
    return signal;
}

Vector sine(double frequency, double duration, double Ts, double amplitude, double phase) {
    const Eigen::ArrayXd t = instants("sine", duration, Ts);
    check_frequency("sine", frequency, Ts);
    return amplitude * (kTwoPi * frequency * t + phase).sin();
}

Vector chirp(double start_frequency, double end_frequency, double duration, double Ts, ChirpShape shape) {
    const Eigen::ArrayXd t = instants("chirp", duration, Ts);
    check_frequency("chirp", start_frequency, Ts);
    check_frequency("chirp", end_frequency, Ts);
    const double sweep = (end_frequency - start_frequency) / duration;
    const Eigen::ArrayXd wave = (kTwoPi * (start_frequency + 0.5 * sweep * t) * t).sin();
    if (shape == ChirpShape::kSine) return wave;
    return (wave >= 0).select(Eigen::ArrayXd::Ones(wave.size()), -Eigen::ArrayXd::Ones(wave.size()));
}

Vector multisine(const VectorView& frequencies, double duration, double Ts) {
    const Eigen::ArrayXd t = instants("multisine", duration, Ts);
    if (frequencies.size() == 0) throw InvalidArgument("multisine: specify at least one frequency");
    check_distinct(frequencies);
    const double count = static_cast<double>(frequencies.size());
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(t.size());
    for (Index k = 0; k < frequencies.size(); ++k) {
        check_frequency("multisine", frequencies(k), Ts);
        const double phase = -std::numbers::pi * static_cast<double>(k * (k + 1)) / count;
        sum += (kTwoPi * frequencies(k) * t + phase).cos();
    }
    return std::sqrt(2 / count) * sum;
}

Vector rbs(Index count, int hold, RandomStream& random, double low, double high) {
    check_count("rbs", count);
    if (hold < 1) throw InvalidArgument("rbs: each value must be held for at least 1 sample, but p is {}", hold);
    Vector signal(count);
    for (Index k = 0; k < count; k += hold)
        signal.segment(k, std::min<Index>(hold, count - k)).setConstant(random.uniform() < 0.5 ? low : high);
    return signal;
}

}  // namespace dynlab::inline numerics
