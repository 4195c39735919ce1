#pragma once
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "numerics/models/process_model.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

// Random systems and their data, for statistics of searches: whether a search finds the smallest simulation error.
namespace dynlab::test {

/// A data set whose system is known.
struct SearchCase {
    TransferFunction G;
    int poles = 1, zeros = 0;
    bool delayed = false;
    bool process = false;  ///< real poles and at most one zero: what procsrivc's structures describe
    IdData data;
    double loss_at_truth = 0;  ///< mean square of the noise
};

/// Draws of one case.
class SearchChance {
  public:
    explicit SearchChance(std::uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * random_.uniform(); }
    double log_between(double low, double high) { return low * std::pow(high / low, random_.uniform()); }
    int below(int count) { return static_cast<int>(random_.uniform() * count); }
    Vector normal(Index count) { return random_.normal(count); }

  private:
    RandomStream random_;
};

/// Poles over a decade from 1 rad/s: damped (real), resonant (pairs of damping 0.02 to 0.3) or both.
inline TransferFunction random_poles(SearchChance& chance, int poles, bool& process) {
    TransferFunction G(Vector::Ones(1), Vector::Ones(1));
    const int kind = chance.below(3);
    process = true;
    for (int left = poles; left > 0;) {
        const double w = chance.log_between(1, 10);
        const bool pair = left >= 2 && (kind == 2 || (kind == 1 && chance.below(2) == 0));
        if (pair) {
            const double zeta = chance.log_between(0.02, 0.3);
            G = G * TransferFunction(Vector::Constant(1, w * w), Vector{{1, 2 * zeta * w, w * w}});
            process = false;
        } else {
            G = G * TransferFunction(Vector::Constant(1, w), Vector{{1, w}});
        }
        left -= pair ? 2 : 1;
    }
    return G;
}

/// `count` real zeros of either sign.
inline TransferFunction with_zeros(SearchChance& chance, TransferFunction G, int count, bool minimum_phase) {
    for (int i = 0; i < count; ++i) {
        const double zero = (minimum_phase ? 1 : -1) * chance.log_between(0.5, 20);
        G = G * TransferFunction(Vector{{1 / zero, 1}}, Vector::Ones(1));
    }
    return G;
}

inline Vector search_input(SearchChance& chance, Index N, double Ts) {
    Vector u = Vector::Zero(N);
    switch (chance.below(4)) {
        case 0: {
            const auto hold = static_cast<Index>(std::max(1.0, chance.log_between(0.1, 1) / Ts));
            const Vector levels = prbs(10, 1);
            for (Index k = 0; k < N; ++k) u[k] = levels[(k / hold) % levels.size()];
            return u;
        }
        case 1: {
            const double lowest = 2 * std::numbers::pi / (static_cast<double>(N) * Ts);
            const double highest = std::min(15.0, 0.7 * std::numbers::pi / Ts);
            for (int i = 0; i < 15; ++i) {
                const double w = lowest * std::round(chance.log_between(std::max(0.3, lowest), highest) / lowest);
                const double phase = chance.between(0, 2 * std::numbers::pi);
                for (Index k = 0; k < N; ++k) u[k] += std::sin(w * static_cast<double>(k) * Ts + phase);
            }
            return u;
        }
        case 2:
            u.tail(N - N / 20).setOnes();
            return u;
        default:
            for (Index i = 1; i <= 6; ++i) u.tail(N - i * N / 8).setConstant(chance.between(-1, 1));
            return u;
    }
}

/// One to six poles, fewer zeros, a delay in two of three, sampled slowly to fast for its poles, 200 to `max_samples`
/// samples, 0 to 40 dB of white noise; from rest, without offset. `irregular`: instants at random distances.
inline SearchCase search_case(std::uint32_t seed, Index max_samples = 20'000, bool irregular = false) {
    SearchChance chance(seed);
    SearchCase made;
    made.poles = 1 + static_cast<int>(seed % 6);
    TransferFunction G = random_poles(chance, made.poles, made.process);
    const int kind = chance.below(3);
    if (kind > 0 && made.poles > 1) made.zeros = 1 + chance.below(made.poles - 1);
    G = with_zeros(chance, G, made.zeros, kind == 1);
    made.process = made.process && made.poles <= 3 && made.zeros <= 1;
    const double fastest = G.poles().cwiseAbs().maxCoeff();
    constexpr double kSpeeds[] = {0.1, 0.5, 2};  // radians of the fastest pole in a sample
    const double Ts = kSpeeds[chance.below(3)] / fastest;
    constexpr Index kLengths[] = {200, 500, 1000, 2000, 5000, 20'000};
    const Index N = std::min(max_samples, kLengths[chance.below(6)]);
    made.delayed = chance.below(3) > 0;
    if (made.delayed) G = G.with_delay(std::min(chance.log_between(0.3, 30) * Ts, 0.15 * Ts * static_cast<double>(N)));
    made.G = G;
    const Vector u = search_input(chance, N, Ts);
    Vector t(N);
    for (Index k = 0; k < N; ++k) t[k] = static_cast<double>(k) * Ts;
    if (irregular)
        for (Index k = 1; k < N; ++k) t[k] = t[k - 1] + Ts * chance.log_between(0.3, 2);
    const Vector x = irregular ? lsim(G, u, t) : lsim(G, u, Ts);
    constexpr double kRatios[] = {0, 10, 20, 40};  // dB
    const double size = (x.array() - x.mean()).matrix().norm() / std::sqrt(static_cast<double>(N));
    const Vector noise = size * std::pow(10, -kRatios[chance.below(4)] / 20) * chance.normal(N);
    made.loss_at_truth = noise.squaredNorm() / static_cast<double>(N);
    const Vector y = x + noise;
    made.data = irregular ? IdData(Matrix(y), Matrix(u), t) : IdData(Matrix(y), Matrix(u), Ts);
    return made;
}

}  // namespace dynlab::test
