#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/signals/random.h"

namespace test_transfer_sensitivity {

using namespace dynlab;

Vector rough_input(Index N) {
    const Vector noise = RandomStream(5).normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = noise[k / 7];
    return u;
}

// Central difference of the response with respect to one entry of the coefficients or the delay.
Vector difference(const Vector& num, const Vector& den, double delay, const Vector& u, double Ts, Hold hold,
                  Vector num_step, Vector den_step, double delay_step) {
    return transfer_response(num + num_step, den + den_step, delay + delay_step, u, Ts, hold) -
           transfer_response(num - num_step, den - den_step, delay - delay_step, u, Ts, hold);
}

TEST(transfer_sensitivity, first_order_step_is_exact) {  // oracle: analytic
    const double T = 0.7, K = 3, Ts = 0.05, D = 0.163;
    const Matrix S =
        transfer_sensitivities(Vector{{K / T}}, Vector{{1.0, 1 / T}}, D, Vector::Ones(200), Ts, Hold::kZoh);
    ASSERT_EQ(S.cols(), 4);
    for (Index k = 0; k < 200; ++k) {
        const double t = static_cast<double>(k) * Ts - D;
        const double decay = t > 0 ? std::exp(-t / T) : 1, run = std::max(t, 0.0);
        EXPECT_NEAR(S(k, 0), K * (1 - decay), 1e-13);
        // y = b/a (1 - exp(-a t)): dy/da = -b/a^2 (1 - exp(-a t)) + b/a t exp(-a t)
        EXPECT_NEAR(S(k, 1), -K * T * (1 - decay) + K * run * decay, 1e-13);
        EXPECT_NEAR(S(k, 2), T * (1 - decay), 1e-13);
        EXPECT_NEAR(S(k, 3), t > 0 ? -K / T * decay : 0, 1e-12);
    }
}

TEST(transfer_sensitivity, agrees_with_differences) {  // oracle: second route, central differences
    const Vector u = rough_input(300);
    const double Ts = 0.1, delay = 0.234, h = 1e-6;
    for (Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const auto& [num, den] :
             std::vector<std::pair<Vector, Vector>>{{Vector{{2.0}}, Vector{{1.0, 1.2, 4.0}}},
                                                    {Vector{{-0.5, 3.0}}, Vector{{1.0, 1.2, 4.0}}},
                                                    {Vector{{0.7, -0.5, 3.0}}, Vector{{1.0, 1.2, 4.0}}},
                                                    {Vector{{1.0, 0.3, 2.0}}, Vector{{1.0, 2.5, 3.0, 1.5}}}}) {
            const Index n = den.size() - 1, m = num.size() - 1;
            const Matrix S = transfer_sensitivities(num, den, delay, u, Ts, hold);
            ASSERT_EQ(S.cols(), n + m + 3);
            const Vector none_num = Vector::Zero(m + 1), none_den = Vector::Zero(n + 1);
            EXPECT_LT((S.col(0) - transfer_response(num, den, delay, u, Ts, hold)).cwiseAbs().maxCoeff(), 1e-12);
            for (Index i = 1; i <= n; ++i) {
                const Vector d = difference(num, den, delay, u, Ts, hold, none_num, h * Vector::Unit(n + 1, i), 0);
                EXPECT_LT((S.col(i) - d / (2 * h)).cwiseAbs().maxCoeff(), 1e-7) << "a" << i;
            }
            for (Index j = 0; j <= m; ++j) {
                const Vector d = difference(num, den, delay, u, Ts, hold, h * Vector::Unit(m + 1, j), none_den, 0);
                EXPECT_LT((S.col(n + 1 + j) - d / (2 * h)).cwiseAbs().maxCoeff(), 1e-7) << "b" << j;
            }
            const Vector d = difference(num, den, delay, u, Ts, hold, none_num, none_den, h);
            EXPECT_LT((S.col(n + m + 2) - d / (2 * h)).cwiseAbs().maxCoeff(), 1e-6) << "delay";
        }
}

TEST(transfer_sensitivity, free_motion_is_exact) {  // oracle: analytic, undamped oscillation
    const double w = 1.3, Ts = 0.2;
    const Matrix motions = free_responses(Vector{{1.0, 0.0, w * w}}, 100, Ts);
    for (Index k = 0; k < 100; ++k) {
        const double t = static_cast<double>(k) * Ts;
        EXPECT_NEAR(motions(k, 0), std::cos(w * t), 1e-12);
        EXPECT_NEAR(motions(k, 1), std::sin(w * t) / w, 1e-12);
    }
}

TEST(transfer_sensitivity, free_sensitivities_agree_with_differences) {  // oracle: second route
    const Vector den{{1.0, 0.9, 2.0, 0.7}}, initial{{1.0, -0.5, 2.0}};
    const double h = 1e-6;
    const Matrix S = free_sensitivities(den, initial, 120, 0.1);
    for (Index i = 1; i <= 3; ++i) {
        const Vector step = h * Vector::Unit(4, i);
        const Vector d = (free_responses(den + step, 120, 0.1) - free_responses(den - step, 120, 0.1)) * initial;
        EXPECT_LT((S.col(i - 1) - d / (2 * h)).cwiseAbs().maxCoeff(), 1e-7) << i;
    }
}

TEST(transfer_sensitivity, irregular_instants_that_are_regular_give_the_same) {  // oracle: second route
    const Vector u = rough_input(150), t = Vector::LinSpaced(150, 0, 14.9), initial{{1.0, -0.5}};
    const Vector den{{1.0, 1.2, 4.0}};
    for (Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const Vector& num : {Vector{{-0.5, 3.0}}, Vector{{0.7, -0.5, 3.0}}})
            for (double delay : {0.0, 0.234}) {
                const Matrix regular = transfer_sensitivities(num, den, delay, u, 0.1, hold),
                             irregular = transfer_sensitivities(num, den, delay, u, t, hold);
                EXPECT_LT((regular - irregular).cwiseAbs().maxCoeff(), 1e-10);
                EXPECT_LT((regular.col(0) - transfer_response(num, den, delay, u, t, hold)).cwiseAbs().maxCoeff(),
                          1e-10);
            }
    EXPECT_LT((free_responses(den, t) - free_responses(den, 150, 0.1)).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((free_sensitivities(den, initial, t) - free_sensitivities(den, initial, 150, 0.1)).cwiseAbs().maxCoeff(),
              1e-11);
}

TEST(transfer_sensitivity, refuses_what_is_not_proper) {
    EXPECT_THROW(transfer_response(Vector{{1.0, 2.0, 0.0}}, Vector{{1.0, 3.0}}, 0, Vector::Ones(5), 1, Hold::kZoh),
                 InvalidArgument);
}

}  // namespace test_transfer_sensitivity
