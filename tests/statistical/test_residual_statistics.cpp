// Oracle: how often tests reject what is true, and how honest robust standard errors are, over fixed seeds.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/procsrivc.h"
#include "numerics/fit/assessment.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/residual_tests.h"

namespace test_residual_statistics {

using namespace dynlab;

Vector ar1(Index N, double pole, std::uint32_t seed) {
    constexpr Index kSettling = 200;
    Vector e = RandomStream(seed).normal(N + kSettling);
    for (Index k = 1; k < e.size(); ++k) e[k] += pole * e[k - 1];
    return std::sqrt(1 - pole * pole) * e.tail(N);
}

struct Rates {
    double not_white = 0, dependent = 0, feedback = 0, outside = 0;  // fractions
};

// Error e independent of u: how often is it called otherwise?
Rates rejection_rates(const Vector& u, double pole, const ResidualOptions& options = {}) {
    constexpr int kRuns = 1000;
    Rates rates;
    for (int run = 0; run < kRuns; ++run) {
        const Vector e = ar1(u.size(), pole, static_cast<std::uint32_t>(run + 1));
        const IdData data(Matrix(e), Matrix(u), 1);
        const auto output = residual_tests(data, {Matrix::Zero(u.size(), 1)}, options).outputs[0];
        rates.not_white += (output.whiteness.white ? 0.0 : 1.0) / kRuns;
        rates.dependent += (output.inputs[0].independent ? 0.0 : 1.0) / kRuns;
        rates.feedback += (output.inputs[0].without_feedback ? 0.0 : 1.0) / kRuns;
        rates.outside += static_cast<double>(output.inputs[0].outside) / 26 / kRuns;
    }
    return rates;
}

// 1 % of 1000 runs has a standard deviation of 0.3 %. The far tail of Ljung and Box's statistic is a little heavier
// than the tail of chi-squared for finite data (Ljung 1986), up to about twice the level here.
TEST(residual_statistics, white_errors_are_rejected_as_often_as_promised) {
    for (const Vector& u : {prbs(7, 8), prbs(4, 100), Vector(RandomStream(99).normal(800))}) {
        const Rates rates = rejection_rates(u, 0);
        EXPECT_LT(rates.not_white, 0.03);
        EXPECT_GT(rates.not_white, 0.002);
        EXPECT_NEAR(rates.dependent, 0.01, 0.01);
        EXPECT_NEAR(rates.feedback, 0.01, 0.01);
        EXPECT_NEAR(rates.outside, 0.01, 0.006);
    }
}

// 5 % of 1000 runs has a standard deviation of 0.7 %. If Ljung and Box's test wrongly rejects errors as white, the
// covariance comes from so few samples that the test rarely shows a dependence: up to 5 % of 5 %.
TEST(residual_statistics, short_records_are_rejected_as_often_as_promised) {
    for (const Index N : {50, 100, 200}) {
        const Rates rates = rejection_rates(RandomStream(99).normal(N), 0, {25, 0.95});
        EXPECT_NEAR(rates.dependent, 0.05, 0.02) << N;
        EXPECT_NEAR(rates.feedback, 0.05, 0.02) << N;
    }
}

TEST(residual_statistics, colored_errors_do_not_feign_a_dependence) {
    for (const Vector& u : {prbs(7, 8), prbs(4, 100), Vector(RandomStream(99).normal(800))})
        for (const double pole : {0.5, 0.95}) {
            const Rates rates = rejection_rates(u, pole);
            EXPECT_GT(rates.not_white, 0.99);
            EXPECT_LT(rates.dependent, 0.02);
            EXPECT_LT(rates.feedback, 0.02);
            EXPECT_NEAR(rates.outside, 0.01, 0.006);
        }
}

struct ErrorStudy {
    Vector spread, plain, robust;
};

ErrorStudy error_study(const Vector& u, double Ts, double pole, double size) {
    constexpr int kRuns = 300;
    const ProcessStructure structure = ProcessStructure::parse("P1");
    const Vector truth{{1.5, 0.8}};
    const Vector clean = lsim(ProcessModel(structure, truth).transfer_function(), u, Ts);
    ProcsrivcOptions options;
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kNone;
    Matrix estimates(kRuns, 2);
    ErrorStudy study{Vector::Zero(2), Vector::Zero(2), Vector::Zero(2)};
    for (int run = 0; run < kRuns; ++run) {
        const Vector y = clean + size * ar1(u.size(), pole, static_cast<std::uint32_t>(run + 1));
        const IdData data(Matrix(y), Matrix(u), Ts);
        const auto estimate = procsrivc(data, structure, options);
        estimates.row(run) = estimate.theta.transpose();
        study.plain += estimate.std / kRuns;
        study.robust += assess(data, estimate).std / kRuns;
    }
    const Matrix centered = estimates.rowwise() - estimates.colwise().mean();
    study.spread = (centered.colwise().squaredNorm() / (kRuns - 1)).cwiseSqrt().transpose();
    return study;
}

// The relative error of a spread from 300 runs is 1/sqrt(600) = 4 %.
TEST(residual_statistics, robust_errors_of_white_noise_are_the_plain_ones) {
    const auto study = error_study(prbs(7, 8), 0.05, 0, 0.2);
    for (Index i = 0; i < 2; ++i) {
        EXPECT_NEAR(study.plain[i] / study.spread[i], 1, 0.12);
        EXPECT_NEAR(study.robust[i] / study.plain[i], 1, 0.05);
    }
}

TEST(residual_statistics, robust_errors_of_colored_noise_are_honest_where_plain_ones_are_not) {
    for (const double pole : {0.8, 0.95}) {
        const auto study = error_study(prbs(7, 8), 0.05, pole, 0.2);
        for (Index i = 0; i < 2; ++i) {
            EXPECT_LT(study.plain[i] / study.spread[i], 0.6) << pole;
            EXPECT_NEAR(study.robust[i] / study.spread[i], 1, 0.15) << pole;
        }
    }
}

}  // namespace test_residual_statistics
