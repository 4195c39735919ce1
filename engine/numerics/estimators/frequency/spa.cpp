#include "numerics/estimators/frequency/spa.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinSamplesOfSpa = 8, kDefaultWindow = 30, kDefaultFrequencies = 128;
constexpr double kPoorInput = 1e-4;    // part of the largest input power below which the input counts as not exciting
constexpr double kLeastInput = 1e-10;  // what the response is divided by at least

Index window_of(const SpaOptions& options, Index shortest) {
    if (options.window == 0) return std::max<Index>(2, std::min(shortest / 10, kDefaultWindow));
    if (options.window < 2 || options.window >= shortest)
        throw InvalidArgument(
            "spa: the lag window must have at least 2 samples and fewer samples than the shortest experiment ({}), but "
            "has {}",
            shortest, options.window);
    return options.window;
}

Vector frequencies_of(const SpaOptions& options, Index window, double Ts) {
    const double end = std::numbers::pi / Ts;
    if (options.w.size() == 0) {
        const double first = std::min(1 / (static_cast<double>(window) * Ts), 0.1 * end);
        Vector w = Vector::LinSpaced(kDefaultFrequencies, std::log(first), std::log(end)).array().exp();
        w[w.size() - 1] = end;
        return w;
    }
    for (const double value : options.w)
        if (!(value >= 0 && value <= end * (1 + 1e-12)))
            throw InvalidArgument("spa: frequencies must be between 0 and pi/Ts = {} rad per time unit, but one is {}",
                                  end, value);
    return options.w;
}

struct Covariances {
    Vector u, y, yu;  // lags -M..M
};

/// Hann's lag window, 1 at lag 0 and 0 at M.
double lag_weight(Index lag, Index M) {
    return 0.5 * (1 + std::cos(std::numbers::pi * static_cast<double>(lag) / static_cast<double>(M)));
}

Covariances covariances_of(const IdData& data, Index M) {
    Covariances R{Vector::Zero(2 * M + 1), Vector::Zero(2 * M + 1), Vector::Zero(2 * M + 1)};
    for (const Experiment& experiment : data.experiments) {
        const Vector u = experiment.u.col(0), y = experiment.y.col(0);
        R.u += lagged_products(u, u, M);
        R.y += lagged_products(y, y, M);
        R.yu += lagged_products(y, u, M);
    }
    const auto count = static_cast<double>(data.sample_count());
    Vector window(2 * M + 1);
    for (Index lag = -M; lag <= M; ++lag) window[lag + M] = lag_weight(lag, M) / count;
    for (Vector* r : {&R.u, &R.y, &R.yu}) *r = r->cwiseProduct(window);
    return R;
}

/// sum over the lags of r(tau) exp(-i angle tau)
Complex transform_at(const Vector& r, double angle) {
    const Index M = r.size() / 2;
    Complex sum = r[M];
    for (Index lag = 1; lag <= M; ++lag) {
        const Complex turn = std::polar(1.0, -angle * static_cast<double>(lag));
        sum += r[M + lag] * turn + r[M - lag] * std::conj(turn);
    }
    return sum;
}

/// Part of the variance that the response's real part has: (1 + r)/2 with r the spectral window's overlap with itself
/// mirrored at 0, by Parseval the sum of the squared lag window times cos(2 angle tau) over the squared lag window's.
double real_share(double angle, Index M) {
    double squares = 1, turned = 1;
    for (Index lag = 1; lag < M; ++lag) {
        const double weight = lag_weight(lag, M);
        squares += 2 * weight * weight;
        turned += 2 * weight * weight * std::cos(2 * angle * static_cast<double>(lag));
    }
    return (1 + turned / squares) / 2;
}

void describe(SpectralEstimate& estimate, Index M, double averages, double Ts) {
    estimate.message = Message(
        "Spectral analysis with a lag window of {} samples: the frequency resolution is {} rad per time unit, and "
        "every value is the average of about {} independent values.",
        M, significant(std::numbers::pi / (static_cast<double>(M) * Ts), 3), significant(averages, 2));
    if (averages < 4)
        estimate.warnings.push_back(
            Message("The lag window is long for the number of samples: the errors are large, and their estimates are "
                    "unreliable. Use a shorter window or more data."));
}

}  // namespace

void SpaOptions::validate() const {
    if (window < 0)
        throw InvalidArgument("spa: the lag window must be a positive number of samples, but is {}", window);
    if (!w.allFinite()) throw InvalidArgument("spa: all frequencies must be finite numbers");
}

SpectralEstimate spa(const IdData& data, const SpaOptions& options) {
    options.validate();
    const IdData data_set = nonparametric_data("spa", data, kMinSamplesOfSpa, options.remove_mean);
    Index shortest = data_set.sample_count();
    for (const Experiment& experiment : data_set.experiments) shortest = std::min(shortest, experiment.y.rows());
    const Index M = window_of(options, shortest);
    const Covariances R = covariances_of(data_set, M);
    SpectralEstimate estimate;
    estimate.w = frequencies_of(options, M, data.Ts);
    const Index count = estimate.w.size();
    estimate.response.resize(count), estimate.std.resize(count);
    estimate.coherence.resize(count), estimate.noise_spectrum.resize(count);
    const double averages = static_cast<double>(data_set.sample_count()) / (0.75 * static_cast<double>(M));
    Vector input(count);
    for (Index i = 0; i < count; ++i) input[i] = transform_at(R.u, estimate.w[i] * data.Ts).real();
    const double max_input = input.cwiseAbs().maxCoeff(), floor = kLeastInput * max_input;
    bool poor = false;
    for (Index i = 0; i < count; ++i) {
        const double angle = estimate.w[i] * data.Ts;
        poor = poor || input[i] < kPoorInput * max_input;
        const SpectralPoint point = spectral_point(std::max(input[i], floor), transform_at(R.y, angle).real(),
                                                   transform_at(R.yu, angle), averages, real_share(angle, M));
        estimate.response[i] = point.response;
        estimate.std[i] = point.std;
        estimate.coherence[i] = point.coherence;
        estimate.noise_spectrum[i] = point.noise;
    }
    describe(estimate, M, averages, data.Ts);
    if (poor)
        estimate.warnings.push_back(Message(
            "At some frequencies the input has almost no power, so the response at these frequencies is unreliable."));
    return estimate;
}

}  // namespace dynlab::inline numerics
