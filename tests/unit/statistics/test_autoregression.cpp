// Oracles: autoregressions that are known, the definition of whiteness, and the identity z'e = x'w.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "numerics/statistics/autoregression.h"

namespace test_autoregression {

using namespace dynlab;

/// e(k) + a_1 e(k-1) + ... = w(k), settled before its first sample.
Vector autoregressive(const Vector& a, Index N, std::uint32_t seed) {
    constexpr Index kSettling = 3000;
    Vector e = RandomStream(seed).normal(N + kSettling);
    for (Index k = a.size(); k < e.size(); ++k) e[k] -= a.dot(e.segment(k - a.size(), a.size()).reverse());
    return e.tail(N);
}

TEST(autoregression, finds_the_coefficients_of_a_known_process) {
    const Vector a{{-1.97, 0.98}};
    const Vector e = autoregressive(a, 100'000, 1);
    const Autoregression model = fit_autoregression(e, {e.size()}, 2);
    ASSERT_EQ(model.order(), 2);
    EXPECT_NEAR(model.predictors.back()[0], a[0], 3e-3);  // four standard errors, sqrt((1 - a_2^2)/N) each
    EXPECT_NEAR(model.predictors.back()[1], a[1], 3e-3);
    EXPECT_NEAR(model.variance, 1, 0.02);
}

TEST(autoregression, chooses_no_order_for_white_noise_and_enough_for_colored) {
    int orders = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Vector e = RandomStream(seed).normal(1000);
        orders += fit_autoregression(e, {1000}, 40).order() > 3 ? 1 : 0;
        const Vector colored = autoregressive(Vector{{-0.9, 0, 0, 0.5}}, 1000, seed);
        EXPECT_GE(fit_autoregression(colored, {1000}, 40).order(), 4) << seed;
    }
    EXPECT_LE(orders, 3);
}

TEST(autoregression, chooses_the_order_of_the_process_by_bic) {
    int right = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Vector e = autoregressive(Vector{{-1.2, 0.5}}, 3000, seed);
        const Vector a = fit_autoregression(e, {3000}, 10, AutoregressiveOrder::kBic).filter();
        if (a.size() != 3) continue;
        ++right;
        EXPECT_EQ(a[0], 1);
        EXPECT_NEAR(a[1], -1.2, 0.08);
        EXPECT_NEAR(a[2], 0.5, 0.08);
    }
    EXPECT_GE(right, 17);
    EXPECT_LE(fit_autoregression(RandomStream(1).normal(2000), {2000}, 10, AutoregressiveOrder::kBic).order(), 1);
}

TEST(autoregression, of_the_highest_order_is_asked_for) {
    const Vector e = RandomStream(2).normal(30);
    EXPECT_EQ(fit_autoregression(e, {20, 10}, 12, AutoregressiveOrder::kMaxInteger).order(), 12);
}

TEST(autoregression, a_sine_is_described_by_two_coefficients) {  // x(k) = 2 cos(w) x(k - 1) - x(k - 2)
    Vector x(5000);
    for (Index k = 0; k < x.size(); ++k) x[k] = std::cos(0.7 * static_cast<double>(k));
    const Autoregression model = fit_autoregression(x, {x.size()}, 2, AutoregressiveOrder::kMaxInteger);
    EXPECT_NEAR(model.predictors.back()[0], -2 * std::cos(0.7), 1e-3);
    EXPECT_NEAR(model.predictors.back()[1], 1, 1e-3);
}

TEST(autoregression, filters_where_the_past_is_known) {  // oracle: the definition
    const Autoregression model{{Vector(), Vector{{0.3}}, Vector{{-0.5, 0.25}}}, 1};
    const Vector x = RandomStream(3).normal(30), y = filtered_past(model, x);
    ASSERT_EQ(y.size(), 28);
    for (Index k = 0; k < 28; ++k) EXPECT_NEAR(y[k], x[k + 2] - 0.5 * x[k + 1] + 0.25 * x[k], 1e-14);
    const Vector w = whitened(model, x, {29, 1});
    EXPECT_TRUE(w.segment(2, 27).isApprox(y.head(27), 1e-14));
    EXPECT_EQ(w[0], x[0]);
    EXPECT_EQ(w[1], x[1] + 0.3 * x[0]);
    EXPECT_EQ(w[29], x[29]);
}

TEST(autoregression, whitens_its_process) {
    const Vector e = autoregressive(Vector{{-1.5, 0.8}}, 20'000, 3);
    const std::vector<Index> lengths{12'000, 8'000};
    const Vector w = whitened(fit_autoregression(e, lengths, 20), e, lengths);
    for (const Index lag : {1, 2, 3, 10}) {
        const double correlation = w.head(w.size() - lag).dot(w.tail(w.size() - lag)) / w.squaredNorm();
        EXPECT_LT(std::abs(correlation), 4 / std::sqrt(20'000.0)) << lag;
    }
}

TEST(autoregression, coloring_backwards_is_the_transposed_operation) {
    const std::vector<Index> lengths{40, 3, 57};
    const Vector e = autoregressive(Vector{{-1.2, 0.5}}, 100, 4);
    Autoregression model = fit_autoregression(e, lengths, 8);
    ASSERT_GT(model.order(), 1);
    Matrix Z(100, 2);
    Z << RandomStream(5).normal(100), RandomStream(6).normal(100);
    const Vector by_e = Z.transpose() * e;
    const Vector by_w = colored_backwards(model, Z, lengths).transpose() * whitened(model, e, lengths);
    EXPECT_LT((by_e - by_w).norm(), 1e-12 * by_e.norm());
}

TEST(autoregression, of_nothing_is_of_order_zero) {
    EXPECT_EQ(fit_autoregression(Vector::Zero(50), {50}, 10).order(), 0);
    EXPECT_EQ(fit_autoregression(Vector::Ones(3), {1, 1, 1}, 10).order(), 0);
    EXPECT_EQ(highest_autoregressive_order(1), 0);
}

TEST(autoregression, refuses_lengths_and_values_that_do_not_fit) {
    EXPECT_THROW(fit_autoregression(Vector::Ones(10), {4, 5}, 2), InvalidArgument);
    EXPECT_THROW(fit_autoregression(Vector::Constant(10, 1.0 / 0.0), {10}, 2), InvalidArgument);
    EXPECT_THROW(whitened({{Vector()}, 1}, Vector::Ones(10), {11}), InvalidArgument);
}

}  // namespace test_autoregression
