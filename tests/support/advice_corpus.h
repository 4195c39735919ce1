#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"
#include "numerics/signals/excitation.h"
#include "numerics/signals/iddata.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

// Data sets of random systems without a fault, and with one planted fault each, for statistics of the issues found.
namespace dynlab::test {

/// The random choices of one data set: a system with bandwidth 1 rad/s, its sampling, its noise.
struct RandomExperiment {
    RandomStream random;
    TransferFunction G;
    double Ts = 0;
    Index N = 0;
    double noise = 0;  ///< standard deviation against that of the noise-free output

    double between(double low, double high) { return low + (high - low) * random.uniform(); }
    double log_between(double low, double high) { return low * std::pow(high / low, random.uniform()); }
    Index whole(Index low, Index high) {
        return std::min(high, low + static_cast<Index>(random.uniform() * static_cast<double>(high - low + 1)));
    }
    bool coin() { return random.uniform() < 0.5; }
    double sign() { return coin() ? 1 : -1; }
};

/// One to three poles, real or a pair of damping 0.15 to 0.95, sometimes a zero, bandwidth 1 rad/s, gain 0.1 to 10.
inline TransferFunction random_system(RandomExperiment& chance) {
    const Index poles = chance.whole(1, 3);
    TransferFunction G(Vector::Ones(1), Vector::Ones(1));
    const auto add = [&G](const Vector& num, const Vector& den) { G = G * TransferFunction(num, den); };
    if (poles >= 2) {
        const double zeta = chance.between(0.15, 0.95);
        add(Vector{{1.0}}, Vector{{1.0, 2 * zeta, 1.0}});
    }
    if (poles != 2) {
        const double pole = poles == 1 ? 1 : chance.log_between(0.4, 3);
        add(Vector{{pole}}, Vector{{1.0, pole}});
    }
    if (poles >= 2 && chance.random.uniform() < 0.4) {
        const double zero = chance.sign() * chance.log_between(1.5, 6);
        add(Vector{{1 / zero, 1.0}}, Vector{{1.0}});
    }
    const double w = bandwidth(G), gain = chance.sign() * chance.log_between(0.1, 10);
    Vector num = gain * G.num(), den = G.den();  // s becomes w s
    for (Index i = 0; i < num.size(); ++i) num[i] *= std::pow(w, static_cast<double>(num.size() - 1 - i));
    for (Index i = 0; i < den.size(); ++i) den[i] *= std::pow(w, static_cast<double>(den.size() - 1 - i));
    return TransferFunction(num, den);
}

/// Sampled 12 to 50 times faster than its bandwidth, 800 to 2500 samples, noise 20 to 40 dB below.
inline RandomExperiment random_experiment(std::uint32_t seed) {
    RandomExperiment chance{RandomStream(seed), {}};
    chance.G = random_system(chance);
    chance.Ts = 2 * std::numbers::pi / chance.log_between(12, 50);
    if (chance.coin()) chance.G = chance.G.with_delay(chance.between(0, 8) * chance.Ts);
    chance.N = chance.whole(800, 2500);
    chance.noise = std::pow(10, -chance.between(20, 40) / 20);
    return chance;
}

/// Samples in which the system turns once, at its bandwidth.
inline double turn(const RandomExperiment& chance) {
    return 2 * std::numbers::pi / chance.Ts;
}

inline Vector prbs_input(RandomExperiment& chance) {
    const auto hold = static_cast<int>(std::max(1.0, turn(chance) * chance.log_between(0.1, 0.4)));
    Vector u(chance.N);
    const Vector levels = prbs(10, 1);
    for (Index k = 0; k < u.size(); ++k) u[k] = levels[(k / hold) % levels.size()];
    return u * chance.log_between(0.1, 10);
}

inline Vector staircase_input(RandomExperiment& chance) {
    const Index hold = std::max<Index>(2, static_cast<Index>(turn(chance) * chance.between(0.3, 1)));
    Vector u(chance.N);
    double level = 0;
    for (Index k = 0; k < u.size(); ++k) {
        if (k >= hold && k % hold == 0) level = chance.between(-1, 1);
        u[k] = level;
    }
    return u * chance.log_between(0.1, 10);
}

/// Up and down again in equal steps.
inline Vector stairs_input(RandomExperiment& chance) {
    const Index steps = chance.whole(5, 9), hold = chance.N / (2 * steps + 1);
    Vector u(chance.N);
    for (Index k = 0; k < u.size(); ++k) {
        const Index place = std::min(k / hold, 2 * steps);
        u[k] = static_cast<double>(place <= steps ? place : 2 * steps - place);
    }
    return u;
}

inline Vector steps_input(RandomExperiment& chance) {
    Vector u = Vector::Zero(chance.N);
    const Index steps = chance.whole(1, 3), every = chance.N / (steps + 1);
    for (Index i = 1; i <= steps; ++i) u.tail(chance.N - i * every + every / 2).setConstant(chance.between(-2, 2));
    return u;
}

inline Vector multisine_input(RandomExperiment& chance) {
    Vector u = Vector::Zero(chance.N);
    const Index sines = chance.whole(6, 20);
    const double period = static_cast<double>(chance.N) / static_cast<double>(chance.whole(1, 4));
    const double highest = chance.between(1.2, 2.5);
    for (Index i = 1; i <= sines; ++i) {
        const double expected =
            highest * static_cast<double>(i) / static_cast<double>(sines) * chance.Ts;  // per sample
        const double w =
            2 * std::numbers::pi * std::max(1.0, std::round(expected * period / (2 * std::numbers::pi))) / period;
        const double phase = chance.between(0, 2 * std::numbers::pi);
        for (Index k = 0; k < u.size(); ++k) u[k] += std::sin(w * static_cast<double>(k) + phase);
    }
    return u * chance.log_between(0.1, 10);
}

/// Sines whose frequency rises, in steps of a converter.
inline Vector quantized_sine_input(RandomExperiment& chance) {
    Vector u(chance.N);
    const double steps = chance.between(20, 400), first = chance.between(0.05, 0.3), last = chance.between(1.2, 3);
    for (Index k = 0; k < u.size(); ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(chance.N);
        const double angle = (first + (last - first) * part / 2) * chance.Ts * static_cast<double>(k);
        u[k] = std::round(steps * std::sin(angle)) / steps;
    }
    return u;
}

inline double deviation(const Vector& x) {
    return std::sqrt((x.array() - x.mean()).square().mean());
}

inline Vector noise_of(RandomExperiment& chance, const Vector& x) {
    return chance.noise * deviation(x) * chance.random.normal(x.size());
}

inline IdData data_of(RandomExperiment& chance, const Vector& u, const Vector& x) {
    return IdData(Matrix(x + noise_of(chance, x)), Matrix(u), chance.Ts);
}

using InputOf = Vector (*)(RandomExperiment&);

inline IdData clean_data(InputOf input, std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = input(chance);
    return data_of(chance, u, lsim(chance.G, u, chance.Ts));
}

/// The clock of each sample is late or early by up to 8 % of a step; the system is solved exactly at those instants.
inline IdData jittered_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? prbs_input(chance) : multisine_input(chance);
    const double jitter = chance.between(0.005, 0.08);
    const bool ticks = chance.coin();  // of a coarse clock
    Vector t(chance.N);
    for (Index k = 0; k < t.size(); ++k) {
        t[k] = (static_cast<double>(k) + jitter * chance.between(-1, 1)) * chance.Ts;
        if (ticks) t[k] = std::round(10 * static_cast<double>(k) * 1.04) / 10 * chance.Ts;
    }
    const Vector x = lsim(chance.G, u, t);
    return IdData(Matrix(x + noise_of(chance, x)), Matrix(u), t);
}

/// Tens of thousands of samples of a slow system.
inline IdData long_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    chance.N = chance.whole(20000, 40000);
    if (chance.coin()) chance.Ts /= chance.log_between(3, 20);
    const Vector u = chance.coin() ? prbs_input(chance) : staircase_input(chance);
    return data_of(chance, u, lsim(chance.G, u, chance.Ts));
}

/// Data with noise and a fault that `spoil` puts into the input or the noise-free output.
inline IdData disturbed_data(std::uint32_t seed, bool many_levels,
                             const std::function<void(RandomExperiment&, Vector& u, Vector& x)>& spoil) {
    RandomExperiment chance = random_experiment(seed);
    const bool sines = chance.coin();
    const Vector u = sines ? multisine_input(chance) : many_levels ? staircase_input(chance) : prbs_input(chance);
    Vector x = lsim(chance.G, u, chance.Ts), seen = u;
    const double noise = chance.noise * deviation(x);
    spoil(chance, seen, x);
    return IdData(Matrix(x + noise * chance.random.normal(x.size())), Matrix(seen), chance.Ts);
}

inline IdData drifting_data(std::uint32_t seed) {
    return disturbed_data(seed, false, [](RandomExperiment& chance, Vector&, Vector& x) {
        const double rise = chance.sign() * chance.between(0.7, 3) * deviation(x);
        x += Vector::LinSpaced(x.size(), 0, rise);
    });
}

inline IdData random_walk_data(std::uint32_t seed) {
    return disturbed_data(seed, false, [](RandomExperiment& chance, Vector&, Vector& x) {
        const double end = chance.between(0.7, 3) * deviation(x);  // standard deviation of the last sample
        Vector walk = end / std::sqrt(static_cast<double>(x.size())) * chance.random.normal(x.size());
        for (Index k = 1; k < walk.size(); ++k) walk[k] += walk[k - 1];
        x += walk;
    });
}

inline IdData square_law_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? multisine_input(chance) : staircase_input(chance);
    const double share = chance.sign() * chance.between(0.15, 0.5);
    const bool at_input = chance.coin();
    const auto bent = [share](const Vector& v) -> Vector {
        return v.array() + share * v.array().square() / deviation(v);
    };
    const Vector x = at_input ? lsim(chance.G, bent(u), chance.Ts) : bent(lsim(chance.G, u, chance.Ts));
    return data_of(chance, u, x);
}

inline IdData dead_band_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? multisine_input(chance) : staircase_input(chance);
    const double width = chance.between(0.15, 0.4) * u.cwiseAbs().maxCoeff();
    Vector acting(u.size());
    for (Index k = 0; k < u.size(); ++k) acting[k] = std::copysign(std::max(0.0, std::abs(u[k]) - width), u[k]);
    return data_of(chance, u, lsim(chance.G, acting, chance.Ts));
}

/// The play operator.
inline Vector with_backlash(const Vector& x, double half_width) {
    Vector y = x;
    y[0] = 0;
    for (Index k = 1; k < x.size(); ++k) y[k] = std::clamp(y[k - 1], x[k] - half_width, x[k] + half_width);
    return y;
}

inline IdData backlash_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? multisine_input(chance) : staircase_input(chance);
    const double width = chance.between(0.1, 0.3);
    const bool at_input = chance.coin();
    const auto loose = [width](const Vector& v) { return with_backlash(v, width * v.cwiseAbs().maxCoeff()); };
    const Vector x = at_input ? lsim(chance.G, loose(u), chance.Ts) : loose(lsim(chance.G, u, chance.Ts));
    return data_of(chance, u, x);
}

inline IdData clipped_data(std::uint32_t seed, bool noise_before) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? multisine_input(chance) : staircase_input(chance);
    Vector x = lsim(chance.G, u, chance.Ts);
    const double level = chance.between(0.45, 0.75);
    const Vector noise = noise_of(chance, x);
    if (noise_before) x += noise;
    x = x.cwiseMin(level * x.maxCoeff());
    if (chance.coin()) x = x.cwiseMax(level * x.minCoeff());
    if (!noise_before) x += noise;
    return IdData(Matrix(x), Matrix(u), chance.Ts);
}
inline IdData saturated_data(std::uint32_t seed) {
    return clipped_data(seed, true);
}
inline IdData saturated_under_noise_data(std::uint32_t seed) {
    return clipped_data(seed, false);
}

/// A digital proportional or proportional and integral controller, which acts at the next sample.
inline IdData feedback_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector reference = chance.coin() ? prbs_input(chance) : staircase_input(chance);
    const double size = std::abs(chance.G.dc_gain());
    const double sign = chance.G.dc_gain() > 0 ? 1 : -1, gain = sign * chance.between(0.15, 0.4) / size;
    const double integral = chance.coin() ? gain * chance.Ts * chance.between(0.05, 0.3) : 0;
    constexpr Index kLength = 600;  // the pulse response
    const Vector pulse = lsim(chance.G, Vector(Vector::Unit(kLength, 0)), chance.Ts);
    chance.noise = std::pow(10, -chance.between(15, 30) / 20);
    const double noise = chance.noise * size * deviation(reference) * std::abs(gain) * size;
    Vector u(chance.N), y(chance.N);
    double sum = 0, command = 0;
    for (Index k = 0; k < chance.N; ++k) {
        u[k] = command;
        y[k] = noise * chance.random.normal();
        const Index reach = std::min(k + 1, kLength);
        for (Index i = 0; i < reach; ++i) y[k] += pulse[i] * u[k - i];
        const double error = reference[k] - y[k];
        sum += error;
        command = gain * error + integral * sum;
    }
    return IdData(Matrix(y), Matrix(u), chance.Ts);
}

inline IdData integrator_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? multisine_input(chance) : prbs_input(chance);
    const TransferFunction integrator(Vector{{1.0}}, Vector{{1.0, 0.0}});
    const TransferFunction lag(Vector{{1.0}}, Vector{{chance.between(0.2, 1), 1.0}});
    const TransferFunction G = integrator * (chance.coin() ? lag : TransferFunction(Vector{{1.0}}, Vector{{1.0}}));
    return data_of(chance, u, lsim(TransferFunction(G.num() * chance.log_between(0.1, 10), G.den()), u, chance.Ts));
}

inline IdData slowly_sampled_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const double delay = chance.G.delay() / chance.Ts;
    chance.Ts = 2 * std::numbers::pi / chance.between(2, 4.5);
    chance.G = chance.G.with_delay(std::round(delay / 4) * chance.Ts);
    const Vector u = chance.coin() ? prbs_input(chance) : staircase_input(chance);
    return data_of(chance, u, lsim(chance.G, u, chance.Ts));
}

inline IdData offset_data(std::uint32_t seed) {
    return disturbed_data(seed, false, [](RandomExperiment& chance, Vector&, Vector& x) {
        x.array() += chance.sign() * chance.log_between(0.3, 20) * deviation(x);
    });
}

/// Cut out where the output is far from where it would rest, and from zero.
inline IdData running_start_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    chance.N += 400;
    const Vector u = chance.coin() ? multisine_input(chance) : prbs_input(chance);
    const Vector x = lsim(chance.G, u, chance.Ts);
    const Vector distance = (x - chance.G.dc_gain() * u).cwiseAbs();
    Index first = 200;
    while (first < 399 && (distance[first] < 1.2 * deviation(x) || std::abs(x[first]) < 0.8 * deviation(x))) ++first;
    return data_of(chance, u, x).range(first + 1, chance.N);
}

inline IdData outlier_data(std::uint32_t seed) {
    return disturbed_data(seed, false, [](RandomExperiment& chance, Vector&, Vector& x) {
        const double size = deviation(x);
        for (Index i = chance.whole(2, 8); i > 0; --i)
            x[chance.whole(0, x.size() - 1)] += chance.sign() * chance.between(2, 6) * size;
    });
}

inline IdData exchanged_data(std::uint32_t seed) {
    IdData data = clean_data(seed % 2 == 0 ? multisine_input : prbs_input, seed);
    std::swap(data.experiments[0].u, data.experiments[0].y);
    return data;
}

inline IdData changing_gain_data(std::uint32_t seed) {
    return disturbed_data(seed, false, [](RandomExperiment& chance, Vector&, Vector& x) {
        x.array() *= Vector::LinSpaced(x.size(), 1, chance.between(1.6, 3)).array();
    });
}

/// Noise that forgets within 20 samples.
inline IdData slow_noise_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? prbs_input(chance) : staircase_input(chance);
    const Vector x = lsim(chance.G, u, chance.Ts);
    Vector e = noise_of(chance, x) * std::sqrt(1 - 0.81);
    for (Index k = 1; k < e.size(); ++k) e[k] += 0.9 * e[k - 1];
    return IdData(Matrix(x + e), Matrix(u), chance.Ts);
}

/// An angle within one turn, in degrees or radians; its noise is wrapped with it.
inline IdData wrapped_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    const Vector u = chance.coin() ? multisine_input(chance) : prbs_input(chance);
    Vector x = lsim(chance.G, u, chance.Ts);
    const double turn = chance.coin() ? 360 : 2 * std::numbers::pi, low = chance.coin() ? 0 : -turn / 2;
    x *= chance.between(0.6, 1.2) * turn / x.cwiseAbs().maxCoeff();
    x += noise_of(chance, x);
    for (double& v : x) v -= turn * std::floor((v - low) / turn);
    return IdData(Matrix(x), Matrix(u), chance.Ts);
}

/// The input is logged one sample late.
/// Sampled so that one sample is more than what a zero more or less makes up for.
inline IdData late_input_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    chance.Ts = 2 * std::numbers::pi / chance.between(8, 12);
    chance.G = chance.G.with_delay(0);
    chance.noise = 0.02;
    const Vector u = chance.coin() ? prbs_input(chance) : staircase_input(chance);
    const Vector x = lsim(chance.G, u, chance.Ts);
    const Index N = u.size() - 1;
    return data_of(chance, u.head(N), x.tail(N));
}

inline IdData loaded_integrator_data(std::uint32_t seed) {
    RandomExperiment chance = random_experiment(seed);
    Vector u = chance.coin() ? multisine_input(chance) : prbs_input(chance);
    u.array() -= u.mean();
    const TransferFunction G(Vector{{1.0}}, Vector{{chance.between(0.2, 1), 1.0, 0.0}});
    const Vector x = lsim(G, u, chance.Ts);
    const double load = chance.sign() * chance.between(0.3, 1) * deviation(u);
    const Vector ramp = lsim(G, Vector::Constant(u.size(), load), chance.Ts);
    return IdData(Matrix(x + ramp + noise_of(chance, x)), Matrix(u), chance.Ts);
}

struct CorpusKind {
    std::string name;
    std::function<IdData(std::uint32_t seed)> simulated_data;
    std::vector<std::string> codes;  ///< one of them must be found; none for clean data
};

inline std::vector<CorpusKind> clean_kinds() {
    const auto with = [](InputOf input) { return [input](std::uint32_t seed) { return clean_data(input, seed); }; };
    return {{"prbs", with(prbs_input), {}},           {"multisine", with(multisine_input), {}},
            {"steps", with(steps_input), {}},         {"stairs", with(stairs_input), {}},
            {"staircase", with(staircase_input), {}}, {"quantized sine", with(quantized_sine_input), {}},
            {"jittered clock", jittered_data, {}},    {"long", long_data, {}},
            {"slow noise", slow_noise_data, {}}};
}

inline std::vector<CorpusKind> faulty_kinds() {
    return {{"drift", drifting_data, {"drift"}},
            {"random walk", random_walk_data, {"random_walk", "drift"}},
            {"square law", square_law_data, {"nonlinear"}},
            {"dead band", dead_band_data, {"nonlinear"}},
            {"backlash", backlash_data, {"nonlinear"}},
            {"saturated", saturated_data, {"saturation"}},
            {"saturated, noise", saturated_under_noise_data, {"saturation", "nonlinear"}},
            {"feedback", feedback_data, {"feedback"}},
            {"integrator", integrator_data, {"integrator"}},
            {"slow sampling", slowly_sampled_data, {"slow_sampling"}},
            {"offset", offset_data, {"offset"}},
            {"running start", running_start_data, {"running_start"}},
            {"outliers", outlier_data, {"outliers"}},
            {"exchanged", exchanged_data, {"causality"}},
            {"changing gain", changing_gain_data, {"changing_gain"}},
            {"wrapped", wrapped_data, {"wrapped"}},
            {"late input", late_input_data, {"late_input"}},
            {"loaded integrator", loaded_integrator_data, {"load"}}};
}

}  // namespace dynlab::test
