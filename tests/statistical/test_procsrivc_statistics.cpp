#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/procsrivc.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_procsrivc_statistics {

using namespace dynlab;

constexpr Index kSamples = 400;
constexpr int kRuns = 300;
constexpr double kTs = 0.05, kNoise = 0.2;

struct Study {
    Vector mean, spread, reported;  // of the estimates, and the mean of the reported standard errors
    double noise_variance = 0;
};

Study monte_carlo(const char* structure_name, const Vector& truth) {
    const ProcessStructure structure = ProcessStructure::parse(structure_name);
    const Vector levels = RandomStream(9).normal(kSamples);
    Vector u(kSamples);
    for (Index k = 0; k < kSamples; ++k) u[k] = levels[k / 15] > 0 ? 1 : -1;
    const Vector clean = lsim(ProcessModel(structure, truth).transfer_function(), u, kTs);
    ProcsrivcOptions options;
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kEstimate;
    options.largest_delay = 1.5;
    options.delay_count = 20;
    const Index d = truth.size();
    Matrix estimates(kRuns, d);
    Study study{Vector::Zero(d), Vector::Zero(d), Vector::Zero(d), 0};
    for (int run = 0; run < kRuns; ++run) {
        const Vector y = clean + kNoise * RandomStream(static_cast<std::uint32_t>(run + 1)).normal(kSamples);
        const auto result = procsrivc(IdData(Matrix(y), Matrix(u), kTs), structure, options);
        estimates.row(run) = result.theta.transpose();
        study.reported += result.std / kRuns;
        study.noise_variance += result.noise_variance[0] / kRuns;
    }
    study.mean = estimates.colwise().mean().transpose();
    study.spread =
        ((estimates.rowwise() - study.mean.transpose()).colwise().squaredNorm() / (kRuns - 1)).cwiseSqrt().transpose();
    return study;
}

// The relative error of a standard deviation from 300 runs is 1/sqrt(600) = 4 %: 15 % is 3.7 of them.
void expect_honest(const Study& study, const Vector& truth) {
    for (Index i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(study.reported[i] / study.spread[i], 1, 0.15) << i;
        EXPECT_NEAR(study.mean[i], truth[i], 5 * study.spread[i] / std::sqrt(kRuns)) << i;
    }
    EXPECT_NEAR(study.noise_variance / (kNoise * kNoise), 1, 0.02);
}

TEST(procsrivc_statistics, standard_errors_of_p1d_are_honest) {  // oracle: statistics, fixed seeds
    const Vector truth{{1.5, 0.8, 0.373}};
    expect_honest(monte_carlo("P1D", truth), truth);
}

TEST(procsrivc_statistics, standard_errors_of_p2u_are_honest) {  // oracle: statistics, fixed seeds
    const Vector truth{{0.9, 0.5, 0.35}};
    expect_honest(monte_carlo("P2U", truth), truth);
}

}  // namespace test_procsrivc_statistics
