#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/fit.h"
#include "numerics/validation/fit_measures.h"

namespace test_fit_measures {

using namespace dynlab;

const Vector kY{{1.0, 2.0, 3.0, 6.0}}, kSim{{1.5, 2.0, 2.5, 5.0}};

TEST(fit_measures, fit_percent_by_hand) {  // oracle: analytic; |e|^2 = 1.5, |y - mean|^2 = 14
    EXPECT_NEAR(variation_about_mean(kY), 14, 1e-14);
    EXPECT_NEAR(fit_percent_of_sums((kY - kSim).squaredNorm(), 14), 100 * (1 - std::sqrt(1.5 / 14)), 1e-12);
    EXPECT_EQ(fit_percent_of_sums(0, 14), 100);
    EXPECT_EQ(fit_percent_of_sums(14, 14), 0);
}

TEST(fit_measures, r_squared_ignores_a_constant_error) {  // oracle: definition
    EXPECT_NEAR(r_squared_simulation(kY, kY.array() + 5), 1, 1e-15);
    const Vector e = kY - kSim;  // -0.5 0 0.5 1: mean 0.25, squares about it 1.25
    EXPECT_NEAR(r_squared_simulation(kY, kSim), 1 - 1.25 / 14, 1e-14);
    EXPECT_NEAR(e.mean(), 0.25, 1e-15);
}

TEST(fit_measures, yic_by_hand) {  // oracle: definition
    const Matrix P = Vector{{0.04, 0.5}}.asDiagonal();
    const auto both = yic(kY, kSim, Vector{{2.0, 5.0}}, P);
    EXPECT_NEAR(both.value, std::log(1.25 / 14) + std::log((0.01 + 0.02) / 2), 1e-13);
    EXPECT_TRUE(both.skipped.empty());
    const auto one = yic(kY, kSim, Vector{{0.0, 5.0}}, P);
    EXPECT_NEAR(one.value, std::log(1.25 / 14) + std::log(0.02), 1e-13);
    ASSERT_EQ(one.skipped.size(), 1u);
    EXPECT_EQ(one.skipped[0], 0);
    EXPECT_EQ(yic(kY, kY, Vector{{2.0, 5.0}}, P).value, -std::numeric_limits<double>::infinity());
}

TEST(fit_measures, information_criteria_by_hand) {  // oracle: definition (Ljung 1999, section 16.4)
    const auto c = information_criteria(0.5, 100, 4);
    EXPECT_NEAR(c.fpe, 0.5 * 1.04 / 0.96, 1e-15);
    EXPECT_NEAR(c.aic, std::log(0.5) + 0.08, 1e-15);
    EXPECT_NEAR(c.aicc, c.aic + 40.0 / (100 * 95), 1e-15);
    EXPECT_NEAR(c.bic, std::log(0.5) + 0.04 * std::log(100.0), 1e-15);
    EXPECT_NEAR(std::exp(c.aic), c.fpe, 1e-4);  // they agree to second order in d/N
}

TEST(fit_measures, refuses_what_has_no_meaning) {
    EXPECT_THROW(variation_about_mean(Vector::Ones(4)), InvalidArgument);
    EXPECT_THROW(variation_about_mean(Vector::Ones(1)), InvalidArgument);
    EXPECT_THROW(r_squared_simulation(kY, Vector::Ones(3)), InvalidArgument);
    EXPECT_THROW(r_squared_simulation(Vector::Ones(4), kSim), InvalidArgument);
    EXPECT_THROW(yic(kY, kSim, Vector::Ones(2), Matrix::Identity(3, 3)), InvalidArgument);
    EXPECT_THROW(yic(kY, kSim, Vector::Zero(2), Matrix::Identity(2, 2)), InvalidArgument);
    EXPECT_THROW(information_criteria(1, 5, 4), InvalidArgument);
    EXPECT_THROW(information_criteria(-1, 50, 4), InvalidArgument);
}

}  // namespace test_fit_measures
