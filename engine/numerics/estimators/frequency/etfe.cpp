#include "numerics/estimators/frequency/etfe.h"

#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/fourier.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinSamplesOfEtfe = 8;

/// Weights 1 + cos over -m..m, none of them zero, of sum one.
Vector hann_weights(Index m) {
    Vector weights(2 * m + 1);
    for (Index i = -m; i <= m; ++i)
        weights[i + m] = 1 + std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(m + 1));
    return weights / weights.sum();
}

/// Smoothed spectra around line k; the transforms of real signals go on periodically. The mean (k = 0) is left out when
/// it was removed.
SpectralPoint smoothed_point(const ComplexVector& U, const ComplexVector& Y, Index k, const Vector& weights,
                             bool means_removed) {
    const Index N = U.size(), m = weights.size() / 2;
    double input = 0, output = 0, sum = 0, squares = 0, conjugates = 0;
    Complex cross = 0;
    for (Index i = -m; i <= m; ++i) {
        const Index line = ((k + i) % N + N) % N;
        if (line == 0 && means_removed) continue;
        // where the line -(k + i), whose values are the conjugates, lies in the window: beyond 0 or beyond pi/Ts
        const Index twin = k < N / 4 ? -2 * k - i : N - 2 * k - i;
        const double weight = weights[i + m];
        input += weight * std::norm(U[line]);
        output += weight * std::norm(Y[line]);
        cross += weight * Y[line] * std::conj(U[line]);
        sum += weight, squares += weight * weight;
        if (std::abs(twin) <= m) conjugates += weight * weights[twin + m];
    }
    SpectralPoint point =
        spectral_point(input / sum, output / sum, cross / sum, sum * sum / squares, (1 + conjugates / squares) / 2);
    point.noise /= static_cast<double>(N);
    return point;
}

void set_size(SpectralEstimate& estimate, Index count, bool smoothed) {
    estimate.w.resize(count), estimate.response.resize(count);
    if (!smoothed) return;
    estimate.std.resize(count), estimate.coherence.resize(count), estimate.noise_spectrum.resize(count);
}

void describe(SpectralEstimate& estimate, const EtfeOptions& options, Index lines) {
    estimate.message = options.smooth > 0 ? Message(
                                                "Empirical transfer function estimate at {} of {} frequencies, "
                                                "smoothed over {} neighboring frequencies.",
                                                estimate.w.size(), lines, 2 * options.smooth + 1)
                                          : Message("Empirical transfer function estimate at {} of {} frequencies.",
                                                    estimate.w.size(), lines);
    if (estimate.w.size() < lines)
        estimate.message =
            sentences({estimate.message, Message("At the other frequencies, the amplitude of the input is below {} % "
                                                 "of its maximum, and the estimate would show only noise.",
                                                 significant(100 * options.least_input, 3))});
    if (estimate.w.size() < 3)
        estimate.warnings.push_back(
            plural(estimate.w.size(),
                   "The input excites only {} frequency, so the response is estimated only at this frequency.",
                   "The input excites only {} frequencies, so the response is estimated only at these frequencies."));
}

}  // namespace

void EtfeOptions::validate() const {
    if (smooth < 0)
        throw InvalidArgument(
            "etfe: the number of frequencies on each side for smoothing must be nonnegative, but is {}", smooth);
    if (!(least_input >= 0 && least_input < 1))
        throw InvalidArgument(
            "etfe: the threshold for the amplitude of the input must be at least 0 and less than 1, but is {}",
            least_input);
}

SpectralEstimate etfe(const IdData& data, const EtfeOptions& options) {
    options.validate();
    if (data.experiments.size() != 1)
        throw InvalidArgument(
            "etfe: the data must have one experiment, but they have {}; select one with data:experiment(k), or use "
            "spa, which combines experiments",
            data.experiments.size());
    const Experiment data_set =
        nonparametric_data("etfe", data, kMinSamplesOfEtfe, options.remove_mean).experiments.front();
    const ComplexVector U = fourier_transform(data_set.u.col(0)), Y = fourier_transform(data_set.y.col(0));
    const Index N = U.size(), lines = N / 2;
    if (2 * options.smooth + 1 > lines)
        throw InvalidArgument(
            "etfe: smoothing over {} frequencies is not possible, because the data have only {} frequencies. Use less "
            "smoothing or more data",
            2 * options.smooth + 1, lines);
    const Vector amplitudes = U.segment(1, lines).cwiseAbs();
    const double least = options.least_input * amplitudes.maxCoeff();
    const Vector weights = hann_weights(options.smooth);
    SpectralEstimate estimate;
    set_size(estimate, lines, options.smooth > 0);
    Index kept = 0;
    for (Index k = 1; k <= lines; ++k) {
        const SpectralPoint point = smoothed_point(U, Y, k, weights, options.remove_mean);
        if (options.smooth == 0 && amplitudes[k - 1] < least) continue;
        estimate.w[kept] = 2 * std::numbers::pi * static_cast<double>(k) / (static_cast<double>(N) * data.Ts);
        estimate.response[kept] = point.response;
        if (options.smooth > 0) {
            estimate.std[kept] = point.std;
            estimate.coherence[kept] = point.coherence;
            estimate.noise_spectrum[kept] = point.noise;
        }
        ++kept;
    }
    estimate.w.conservativeResize(kept), estimate.response.conservativeResize(kept);
    describe(estimate, options, lines);
    return estimate;
}

}  // namespace dynlab::inline numerics
