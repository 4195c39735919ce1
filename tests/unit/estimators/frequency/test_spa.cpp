#include "numerics/estimators/frequency/spa.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/reader.h"
#include "numerics/signals/random.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_spa {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const Vector kB{{0.0, 0.5, 0.2}}, kF{{1.0, -0.9, 0.3}};

Complex truth_at(double w, double Ts) {
    const Complex q = std::polar(1.0, -w * Ts);
    return (kB[0] + kB[1] * q + kB[2] * q * q) / (kF[0] + kF[1] * q + kF[2] * q * q);
}

IdData simulated_data(Index N, double noise, std::uint32_t seed, double Ts = 0.5) {
    RandomStream random(seed);
    const Vector u = random.normal(N), x = divided_by(kF, weighted_past(kB, u));
    return IdData(Matrix(x + noise * random.normal(N)), Matrix(u), Ts);
}

TEST(spa, spectra_are_transforms_of_windowed_covariances) {  // oracle: the definition, summed directly
    const IdData data = simulated_data(200, 0.3, 5);
    const Index M = 12;
    SpaOptions options;
    options.window = M;
    options.w = Vector{{0.0, 0.7, 3.0}};
    const SpectralEstimate estimate = spa(data, options);
    const Vector u = data.experiments[0].u.col(0).array() - data.experiments[0].u.mean();
    const Vector y = data.experiments[0].y.col(0).array() - data.experiments[0].y.mean();
    for (Index i = 0; i < 3; ++i) {
        Complex cross = 0, input = 0, output = 0;
        for (Index lag = -M; lag <= M; ++lag) {
            double yu = 0, uu = 0, yy = 0;
            for (Index k = 0; k < 200; ++k)
                if (k - lag >= 0 && k - lag < 200)
                    yu += y[k] * u[k - lag], uu += u[k] * u[k - lag], yy += y[k] * y[k - lag];
            const double window = 0.5 * (1 + std::cos(std::numbers::pi * static_cast<double>(lag) / M)) / 200;
            const Complex turn = std::polar(window, -options.w[i] * 0.5 * static_cast<double>(lag));
            cross += yu * turn, input += uu * turn, output += yy * turn;
        }
        EXPECT_LT(std::abs(estimate.response[i] - cross / input), 1e-12);
        EXPECT_NEAR(estimate.coherence[i], std::norm(cross) / (input.real() * output.real()), 1e-12);
    }
}

TEST(spa, bands_hold_the_truth_as_often_as_they_say) {  // oracle: statistics over 200 seeds
    SpaOptions options;
    options.window = 40;
    options.w = Vector{{0.0, 0.4, 1.2, 2.5, 4.0, 2 * std::numbers::pi}};
    Vector inside = Vector::Zero(6), ratio = Vector::Zero(6);
    const int runs = 200;
    for (int seed = 1; seed <= runs; ++seed) {
        const SpectralEstimate estimate = spa(simulated_data(3000, 0.5, static_cast<std::uint32_t>(seed)), options);
        for (Index i = 0; i < 6; ++i) {
            const double error = (estimate.response[i] - truth_at(options.w[i], 0.5)).real();
            inside[i] += std::abs(error) < 1.96 * estimate.std[i];
            ratio[i] += error * error / (estimate.std[i] * estimate.std[i]);
        }
    }
    for (Index i = 0; i < 6; ++i) {
        EXPECT_NEAR(inside[i] / runs, 0.95, 0.06) << options.w[i];  // four standard errors of a share of 200
        EXPECT_NEAR(ratio[i] / runs, 1, 0.4) << options.w[i];
    }
}

TEST(spa, bands_widen_towards_the_ends_of_the_axis) {  // oracle: spread of the real part over 400 seeds
    SpaOptions options;
    options.window = 40;
    const double end = 2 * std::numbers::pi;
    options.w = Vector{{0.02, 0.05, end - 0.05, end - 0.02}};
    Vector squares = Vector::Zero(4), stated = Vector::Zero(4);
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        const SpectralEstimate estimate = spa(simulated_data(2000, 0.5, seed), options);
        for (Index i = 0; i < 4; ++i)
            squares[i] += std::pow((estimate.response[i] - truth_at(options.w[i], 0.5)).real(), 2);
        stated += estimate.std.cwiseAbs2();
    }
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR(squares[i] / stated[i], 1, 0.3) << options.w[i];  // four standard errors
}

TEST(spa, noise_spectrum_is_that_of_the_noise) {  // oracle: white noise of known variance, statistics
    SpaOptions options;
    options.window = 100;  // long enough to leave no smoothing error
    const SpectralEstimate estimate = spa(simulated_data(20000, 0.5, 3), options);
    EXPECT_NEAR(estimate.noise_spectrum.mean(), 0.25, 0.02);
    EXPECT_LT((estimate.noise_spectrum.array() - 0.25).abs().maxCoeff(), 0.08);
}

TEST(spa, converges_to_the_true_response) {  // oracle: the true system, noise-free, long window
    SpaOptions options;
    options.window = 200;
    const SpectralEstimate estimate = spa(simulated_data(50000, 0, 4), options);
    for (Index i = 0; i < estimate.w.size(); ++i)
        EXPECT_LT(std::abs(estimate.response[i] - truth_at(estimate.w[i], 0.5)), 0.02) << estimate.w[i];
    EXPECT_GT(estimate.coherence.minCoeff(), 0.98);
}

TEST(spa, experiments_are_joined) {  // oracle: coverage shrinks as for data of the joint length
    const IdData both = IdData::merge({simulated_data(1000, 0.5, 1), simulated_data(3000, 0.5, 2)});
    SpaOptions options;
    options.window = 30;
    const SpectralEstimate joint = spa(both, options), single = spa(simulated_data(1000, 0.5, 1), options);
    EXPECT_NEAR((joint.std.array() / single.std.array()).mean(), 0.5, 0.1);
}

TEST(spa, says_what_it_needs) {
    const IdData data = simulated_data(100, 0.1, 1);
    const auto message = [&](const IdData& d, SpaOptions options = {}) {
        return thrown_message([&] { spa(d, options); });
    };
    SpaOptions wide, high;
    wide.window = 100;
    high.w = Vector{{7.0}};
    EXPECT_THAT(message(data, wide), HasSubstr("fewer samples than the shortest experiment (100), but has 100"));
    EXPECT_THAT(message(data, high), HasSubstr("between 0 and pi/Ts = 6.2832"));
    EXPECT_THAT(message(data.range(1, 7)), HasSubstr("at least 8 samples"));
    EXPECT_THAT(message(data.select({1}, {})), HasSubstr("no input"));
    EXPECT_THAT(message(IdData(Matrix(Vector::Random(50)), Matrix(Vector::Ones(50)), 1)), HasSubstr("never changes"));
    EXPECT_THAT(message(IdData(Matrix::Random(50, 2), Matrix(Vector::Random(50)), 1)),
                HasSubstr("select a pair with data:select"));
}

TEST(spa, poor_excitation_is_reported) {
    Vector u(400);
    for (Index k = 0; k < 400; ++k) u[k] = std::sin(0.3 * static_cast<double>(k));
    SpaOptions options;
    options.window = 200;
    const SpectralEstimate estimate = spa(IdData(Matrix(2 * u), Matrix(u), 1), options);
    ASSERT_EQ(estimate.warnings.size(), 2u);  // few independent values; no power beside the sine
    EXPECT_THAT(message_text(estimate.warnings[1]), HasSubstr("almost no power"));
    EXPECT_TRUE(estimate.response.allFinite());
}

}  // namespace test_spa
