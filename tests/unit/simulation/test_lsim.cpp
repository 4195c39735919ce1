#include "numerics/simulation/lsim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_lsim {

Vector from(std::initializer_list<double> values) {
    return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

const TransferFunction kSecondOrder(from({2}), from({1, 4, 3}));

double second_order_step(double t) {
    return t < 0 ? 0 : 2.0 / 3 - std::exp(-t) + std::exp(-3 * t) / 3;
}
double second_order_ramp(double t) {
    return t < 0 ? 0 : 2 * t / 3 + std::exp(-t) - std::exp(-3 * t) / 9 - 8.0 / 9;
}

TEST(lsim, finds_a_sample_that_is_not_finite_wherever_it_is) {
    constexpr Index N = 60;
    const std::vector<TransferFunction> systems = {
        kSecondOrder,
        kSecondOrder.with_delay(0.73),
        kSecondOrder.with_delay(100),                                   // no sample ever comes out
        TransferFunction(from({1}), from({1, 1000})),                   // forgets at once
        TransferFunction(from({3}), from({1})),                         // no state
        TransferFunction(from({1, 2, 3}), from({1, 0, 0}), 0.1),        // no pole but zero
        TransferFunction(from({0, 0, 3}), from({1, 0, 0}), 0.1, 0.2)};  // and a delay
    for (const TransferFunction& G : systems)
        for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
            for (Index k = 0; k < N; ++k) {
                Vector u = Vector::Ones(N);
                u[k] = bad;
                EXPECT_NE(thrown_message([&] { lsim(G, u, 0.1); }).find("sample " + std::to_string(k + 1)),
                          std::string::npos)
                    << k << " of " << bad;
            }
    const TransferFunction unstable(from({1}), from({1, -200}));
    EXPECT_FALSE(lsim(unstable, Vector::Ones(N), 0.1).allFinite());  // the input is not to blame
}

TEST(lsim, step_of_a_second_order_system) {  // oracle: analytic
    for (const double delay : {0.0, 0.5, 0.33}) {
        const Vector y = lsim(kSecondOrder.with_delay(delay), Vector::Ones(100), 0.1);
        for (Index k = 0; k < 100; ++k)
            EXPECT_NEAR(y(k), second_order_step(0.1 * static_cast<double>(k) - delay), 2e-14) << delay << ", " << k;
    }
}

TEST(lsim, ramp_is_exact_with_foh) {  // oracle: analytic
    for (const double delay : {0.0, 0.5, 0.33}) {
        const Vector y = lsim(kSecondOrder.with_delay(delay), Vector::LinSpaced(100, 0, 9.9), 0.1, Hold::kFoh);
        for (Index k = 0; k < 100; ++k)
            EXPECT_NEAR(y(k), second_order_ramp(0.1 * static_cast<double>(k) - delay), 2e-14) << delay << ", " << k;
    }
}

TEST(lsim, free_motion_from_the_initial_state) {  // oracle: analytic; state 1/den = x2, y = 2 x2 = e^-t - e^-3t
    const Vector y = lsim(kSecondOrder, Vector::Zero(50), 0.1, Hold::kZoh, from({1, 0}));
    for (Index k = 0; k < 50; ++k) {
        const double t = 0.1 * static_cast<double>(k);
        EXPECT_NEAR(y(k), std::exp(-t) - std::exp(-3 * t), 1e-15);
    }
}

TEST(lsim, feedthrough_acts_at_once_and_late) {  // oracle: analytic, (s + 3)/(s + 1) = 1 + 2/(s + 1)
    const TransferFunction G(from({1, 3}), from({1, 1}), 0, 0.25);
    const Vector y = lsim(G, Vector::Ones(20), 0.1);
    for (Index k = 0; k < 20; ++k) {
        const double t = 0.1 * static_cast<double>(k) - 0.25;
        EXPECT_NEAR(y(k), t < 0 ? 0 : 3 - 2 * std::exp(-t), 1e-14) << k;
    }
}

TEST(lsim, integrator_counts) {  // oracle: analytic
    const Vector y = lsim(TransferFunction(from({1}), from({1, 0})), Vector::Ones(9), 0.5);
    for (Index k = 0; k < 9; ++k) EXPECT_NEAR(y(k), 0.5 * static_cast<double>(k), 1e-15);
}

TEST(lsim, integrator_counts_for_long_at_a_coarse_rate) {  // oracle: analytic; rounding must not add up
    const Vector y = lsim(TransferFunction(from({1}), from({1, 0})), Vector::Ones(100000), 86400);
    EXPECT_NEAR(y(99999) / (86400.0 * 99999), 1, 1e-14);
}

TEST(lsim, irregular_instants) {  // oracle: analytic, at instants without a pattern
    Vector t(60);
    RandomStream random(2);
    t(0) = 0;
    for (Index k = 1; k < t.size(); ++k) t(k) = t(k - 1) + 0.01 + 0.2 * random.uniform();
    for (const double delay : {0.0, 0.37}) {
        const Vector step = lsim(kSecondOrder.with_delay(delay), Vector::Ones(60), t);
        const Vector ramp = lsim(kSecondOrder.with_delay(delay), t, t, Hold::kFoh);
        for (Index k = 0; k < t.size(); ++k) {
            EXPECT_NEAR(step(k), second_order_step(t(k) - delay), 2e-14);
            EXPECT_NEAR(ramp(k), second_order_ramp(t(k) - delay), 2e-14);
        }
    }
}

TEST(lsim, discrete_model_follows_its_difference_equation) {  // oracle: definition's residual
    const TransferFunction G(from({0.5, 0.2}), from({1, -1.2, 0.4}), 0.1, 0.2);
    const Vector u = RandomStream(4).normal(50), y = lsim(G, u, 0.1);
    const auto at = [](const Vector& signal, Index k) { return k < 0 ? 0 : signal(k); };
    for (Index k = 0; k < 50; ++k)
        EXPECT_NEAR(y(k), 1.2 * at(y, k - 1) - 0.4 * at(y, k - 2) + 0.5 * at(u, k - 3) + 0.2 * at(u, k - 4), 1e-14);
}

TEST(lsim, several_inputs_superpose) {  // oracle: second route, separate transfer functions
    Matrix A(2, 2), B(2, 2), C(2, 2), D(2, 2);
    A << -1, 0, 0, -2;
    B << 1, 0, 0, 3;
    C << 1, 1, 2, 0;
    D << 0, 0, 0, 0.5;
    Matrix u(40, 2);
    RandomStream random(5);
    u.col(0) = random.normal(40);
    u.col(1) = random.normal(40);
    const Matrix y = lsim(StateSpace(A, B, C, D), u, 0.1);
    const TransferFunction first(from({1}), from({1, 1})), second(from({3}), from({1, 2}));
    EXPECT_LT((y.col(0) - lsim(first, u.col(0), 0.1) - lsim(second, u.col(1), 0.1)).norm(), 1e-13);
    EXPECT_LT((y.col(1) - 2 * lsim(first, u.col(0), 0.1) - 0.5 * u.col(1)).norm(), 1e-13);
}

TEST(lsim, state_variable_filter_is_lsim_of_each_derivative) {  // oracle: second route
    const Vector x = RandomStream(6).normal(80), den = power(from({1, 3}), 2);
    for (const Hold hold : {Hold::kZoh, Hold::kFoh}) {
        const Matrix outputs = state_variable_filter(x, 2, 3, 0.05, hold);
        ASSERT_EQ(outputs.cols(), 3);
        for (Index i = 0; i < 3; ++i) {
            const Vector num = Vector::Unit(3, i);
            EXPECT_LT((outputs.col(i) - lsim(TransferFunction(num, den), x, 0.05, hold)).cwiseAbs().maxCoeff(), 1e-12);
        }
    }
}

TEST(lsim, says_what_is_wrong) {
    EXPECT_EQ(thrown_message([] {
                  lsim(kSecondOrder, Vector::Ones(3), from({0, 1, 2, 3}));
              }),
              "lsim: the input has 3 samples, but the time vector has 4");
    EXPECT_EQ(thrown_message([] {
                  lsim(kSecondOrder, from({1, NAN}), 0.1);
              }),
              "lsim: sample 2 of the input is not a number (NaN); fillmissing(u, {method = \"previous\"}) repeats the "
              "previous value");
    EXPECT_EQ(thrown_message([] {
                  lsim(kSecondOrder, from({1, 2}), 0);
              }),
              "lsim: the sampling time must be a positive number of seconds, but it is 0");
    EXPECT_EQ(thrown_message([] {
                  lsim(kSecondOrder, from({1, 2, 3}), from({0, 2, 1}));
              }),
              "lsim: the time vector must be increasing, but instant 3 is 1 and the previous instant is 2");
    EXPECT_EQ(thrown_message([] {
                  lsim(TransferFunction(from({1, 0}), from({1})), from({1}), 0.1);
              }),
              "lsim: the transfer function has 1 zero but only 0 poles; a simulation needs a model with at least as "
              "many poles as zeros");
    EXPECT_EQ(thrown_message([] {
                  lsim(kSecondOrder, from({1}), 0.1, Hold::kZoh, from({1, 2, 3}));
              }),
              "lsim: the initial state x0 must have 2 values, one for each state, but it has 3");
    EXPECT_EQ(thrown_message([] {
                  lsim(TransferFunction(from({1}), from({1, 0}), 0.2), from({1}), 0.1);
              }),
              "lsim: the sampling time of the discrete-time model is 0.2 s, but the sampling time of the data is 0.1 "
              "s. The sampling times must be equal");
    EXPECT_EQ(thrown_message([] { lsim(kSecondOrder, Vector(), 0.1); }), "lsim: the input has no samples");
    EXPECT_EQ(thrown_message([] {
                  state_variable_filter(from({1, 2}), 1000000, 3, 0.1);
              }),
              "state-variable filter: the order must be between 1 and 50, but it is 1000000");
    EXPECT_EQ(thrown_message([] {
                  state_variable_filter(from({1, 2}), 2, -3, 0.1);
              }),
              "state-variable filter: the cutoff frequency lambda must be a positive number of rad/s, but it is -3");
}

}  // namespace test_lsim
}  // namespace dynlab
