#include "numerics/fit/discrete/arma_noise.h"

#include <gtest/gtest.h>

#include "support/colored_noise.h"
#include "support/thrown_message.h"

namespace test_arma_noise {

using namespace dynlab;
using namespace dynlab::test;

TEST(arma_noise, whitening_undoes_the_noise_filter) {  // oracle: the definition, once the start has died away
    ArmaNoise noise = ArmaNoise::white(1, 2);
    noise.C = values({1, 0.5});
    noise.D = values({1, -1, 0.2});
    const Vector v = arma_signal(noise.C, noise.D, 300, 3);
    const Vector e = RandomStream(3).normal(500).tail(300);
    const Vector found = whitened(noise, v);
    EXPECT_LT((found - e).tail(200).norm(), 1e-12);
    EXPECT_EQ(found[1], 0);
}

TEST(arma_noise, finds_the_model_within_its_errors) {  // oracle: the simulated noise; two data sets, fixed seeds
    const Vector C = values({1, 0.9}), D = values({1, -1, 0.2});
    const std::vector<Vector> data_sets{arma_signal(C, D, 2000, 1), arma_signal(C, D, 1000, 2)};
    const ArmaNoise found = estimate_arma(data_sets, 1, 2, 1e-8);
    const Vector std = found.covariance.diagonal().cwiseSqrt();
    EXPECT_EQ(found.termination, Termination::kConverged);
    EXPECT_NEAR(found.C[1], 0.9, 3 * std[0]);
    EXPECT_NEAR(found.D[1], -1, 3 * std[1]);
    EXPECT_NEAR(found.D[2], 0.2, 3 * std[2]);
    EXPECT_NEAR(found.variance, 1, 3 * std::sqrt(2.0 / 3000));
    EXPECT_LT(std.maxCoeff(), 0.05);
}

TEST(arma_noise, autoregressions_are_least_squares) {  // oracle: the normal equations' gradient vanishes
    const Vector v = arma_signal(values({1}), values({1, -1.2, 0.5}), 800, 5);
    const ArmaNoise found = estimate_arma({v}, 0, 2, 1e-10);
    const Vector e = whitened(found, v);
    for (Index i = 1; i <= 2; ++i) EXPECT_NEAR(e.tail(798).dot(v.segment(2 - i, 798)), 0, 1e-6) << i;
}

TEST(arma_noise, models_stay_stable_and_invertible) {  // oracle: the definition; noise with a zero outside the circle
    const Vector v = arma_signal(values({1, 2}), values({1}), 2000, 7);
    const ArmaNoise found = estimate_arma({v}, 1, 0, 1e-8);
    EXPECT_NEAR(found.C[1], 0.5, 3 * std::sqrt(found.covariance(0, 0)));  // the same spectrum, mirrored
    EXPECT_NEAR(found.variance, 4, 4 * 3 * std::sqrt(2.0 / 2000));
}

TEST(arma_noise, refuses_what_cannot_be) {
    EXPECT_NE(thrown_message([] { estimate_arma({Vector::Ones(5)}, 2, 2, 1e-6); }).find("longer experiments"),
              std::string::npos);
    EXPECT_NE(thrown_message([] { estimate_arma({Vector::Ones(50)}, -1, 2, 1e-6); }).find("negative"),
              std::string::npos);
}

}  // namespace test_arma_noise
