#include "numerics/models/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_convert {

Vector from(std::initializer_list<double> values) {
    return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

const TransferFunction kSecondOrder(from({2}), from({1, 4, 3}));
const TransferFunction kRaoGarnier(from({-6400, 1600}), from({1, 5, 408, 416, 1600}));

TEST(convert, zoh_of_a_lag) {  // oracle: analytic, (1 - p)/(z - p)
    const TransferFunction G = c2d(TransferFunction(from({1}), from({2, 1})), 0.3);
    const double p = std::exp(-0.15);
    EXPECT_TRUE(G.den().isApprox(from({1, -p}), 1e-15));
    ASSERT_EQ(G.num().size(), 1);
    EXPECT_NEAR(G.num()(0), 1 - p, 1e-16);
    EXPECT_EQ(G.Ts(), 0.3);
}

TEST(convert, zoh_of_a_lag_with_a_fraction_of_delay) {  // oracle: analytic, modified z-transform
    const TransferFunction G = c2d(TransferFunction(from({1}), from({2, 1}), 0, 0.7), 0.3);
    const double p = std::exp(-0.15), early = std::exp(-0.1);  // 0.7 = 2 * 0.3 + 0.1; 0.2 s of the interval remain
    EXPECT_TRUE(G.den().isApprox(from({1, -p, 0}), 1e-15));
    EXPECT_TRUE(G.num().isApprox(from({1 - early, early - p}), 1e-14));
    EXPECT_NEAR(G.delay(), 0.6, 1e-15);
}

TEST(convert, foh_of_an_integrator_is_the_trapezoidal_rule) {  // oracle: analytic
    const TransferFunction G = c2d(TransferFunction(from({1}), from({1, 0})), 0.2, Discretization::kFoh);
    EXPECT_TRUE(G.num().isApprox(from({0.1, 0.1}), 1e-15));
    EXPECT_TRUE(G.den().isApprox(from({1, -1}), 1e-15));
}

TEST(convert, integrators_stay_integrators) {  // oracle: analytic, a pole at s = 0 becomes one at z = 1
    for (const Vector& integrating : {from({1, 3, 2, 0}), from({1, 3, 2, 0, 0}), from({1, 0.2, 4, 0})})
        for (const double Ts : {0.003, 0.01, 0.1, 0.3, 1.0})
            for (const auto method : {Discretization::kZoh, Discretization::kFoh, Discretization::kTustin})
                for (const double sign : {1.0, -1.0}) {
                    const TransferFunction G = c2d(TransferFunction(from({sign}), integrating), Ts, method);
                    EXPECT_EQ(G.dc_gain(), sign * std::numeric_limits<double>::infinity()) << integrating << Ts;
                    EXPECT_FALSE(G.stable()) << integrating << Ts;
                }
    const TransferFunction slow = c2d(TransferFunction(from({0.5}), from({1, 1.5, 0.5})), 1e-3);
    EXPECT_NEAR(slow.dc_gain(), 1, 1e-8) << "poles near 1 that are none at 1: rounding over Ts^2/2";
    EXPECT_TRUE(slow.stable());
}

TEST(convert, tustin_is_the_substitution) {  // oracle: definition, values at z
    const double Ts = 0.05;
    const Complex z = std::polar(0.9, 0.7), s = 2 / Ts * (z - 1.0) / (z + 1.0);
    for (const TransferFunction& G : {kSecondOrder, kRaoGarnier, TransferFunction(from({1, 2, 3}), from({1, 4, 3}))})
        EXPECT_NEAR(std::abs(c2d(G, Ts, Discretization::kTustin).at(z) / G.at(s) - 1.0), 0, 1e-12);
}

TEST(convert, discrete_model_simulates_like_the_continuous_one) {  // oracle: second route, lsim
    Vector u = RandomStream(3).normal(120);
    u(0) = 0;  // a discrete foh model sees a ramp before the first sample
    for (const Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const double delay : {0.0, 0.1, 0.13})
            for (const TransferFunction& plain :
                 {kSecondOrder, kRaoGarnier, TransferFunction(from({1, 2, 3}), from({1, 4, 3}))}) {
                const TransferFunction G = plain.with_delay(delay);
                const auto method = hold == Hold::kZoh ? Discretization::kZoh : Discretization::kFoh;
                const Vector continuous = lsim(G, u, 0.05, hold), discrete = lsim(c2d(G, 0.05, method), u, 0.05);
                EXPECT_LT((continuous - discrete).cwiseAbs().maxCoeff(), 1e-9 * continuous.cwiseAbs().maxCoeff());
            }
}

TEST(convert, d2c_undoes_c2d) {  // oracle: second route, there and back
    const TransferFunction models[] = {kSecondOrder, kRaoGarnier.with_delay(0.06),
                                       TransferFunction(from({1, 2, 3}), from({1, 4, 4})),  // double pole, feed-through
                                       TransferFunction(from({1}), from({1, 0, 0}))};       // double integrator
    for (const auto method : {Discretization::kZoh, Discretization::kFoh, Discretization::kTustin})
        for (const TransferFunction& G : models) {
            const TransferFunction back = d2c(c2d(G, 0.02, method), method);
            ASSERT_EQ(back.num().size(), G.num().size()) << back.num().transpose();
            EXPECT_TRUE(back.den().isApprox(G.den(), 1e-7)) << back.den().transpose();
            EXPECT_TRUE(back.num().isApprox(G.num(), 1e-7)) << back.num().transpose();
            EXPECT_NEAR(back.delay(), G.delay(), 1e-15);
            EXPECT_TRUE(back.continuous());
        }
}

TEST(convert, there_and_back_keeps_the_digits) {  // oracle: round trip; simple poles, fast and slow sampling
    const TransferFunction models[] = {kSecondOrder, kRaoGarnier,
                                       TransferFunction(from({3, 1}), from({1, 2, 0}), 0, 0.4)};
    for (const auto method : {Discretization::kZoh, Discretization::kFoh, Discretization::kTustin})
        for (const double Ts : {0.001, 0.01, 0.1})
            for (const TransferFunction& G : models) {
                const TransferFunction discrete = c2d(G, Ts, method), back = d2c(discrete, method);
                EXPECT_EQ(back.zero_count(), G.zero_count()) << "Ts " << Ts;  // no far zeros made of rounding
                const TransferFunction again = c2d(back, Ts, method);
                EXPECT_LT((again.den() - discrete.den()).norm(), 1e-12 * discrete.den().norm()) << "Ts " << Ts;
                EXPECT_LT((again.num() - discrete.num()).norm(), 1e-9 * discrete.num().norm()) << "Ts " << Ts;
            }
}

TEST(convert, state_space_agrees_with_transfer_function) {  // oracle: second route
    for (const auto method : {Discretization::kZoh, Discretization::kFoh, Discretization::kTustin}) {
        const TransferFunction direct = c2d(kSecondOrder, 0.1, method);
        const TransferFunction through = to_transfer_function(c2d(to_state_space(kSecondOrder), 0.1, method));
        EXPECT_TRUE(through.den().isApprox(direct.den(), 1e-13));
        EXPECT_NEAR(std::abs(through.at(Complex(0.3, 0.8)) / direct.at(Complex(0.3, 0.8)) - 1.0), 0, 1e-11);
    }
}

TEST(convert, pade_agrees_with_the_delay_at_low_frequencies) {  // oracle: the series of exp(-T s), and |exp(-jwT)| = 1
    for (const int order : {1, 2, 5, 10}) {
        const TransferFunction G = pade(kSecondOrder.with_delay(0.8), order);
        EXPECT_EQ(G.pole_count(), 2 + order);
        EXPECT_EQ(G.delay(), 0);
        EXPECT_TRUE(G.stable());
        for (const double w : {0.1, 1.0, 10.0})
            EXPECT_NEAR(std::abs(G.at(Complex(0, w)) / kSecondOrder.at(Complex(0, w))), 1, 1e-10);
        // The first term that differs is (order!)^2/((2 order)! (2 order + 1)!) (T s)^(2 order + 1).
        const double x = 0.8;
        const double first =
            std::exp(2 * std::lgamma(order + 1) - std::lgamma(2 * order + 1) - std::lgamma(2 * order + 2)) *
            std::pow(x, 2 * order + 1);
        const Complex s(0, 1);
        const double error = std::abs(G.at(s) / kSecondOrder.at(s) - std::exp(-0.8 * s));
        if (first > 1e-12) {
            EXPECT_NEAR(error / first, 1, 0.1) << order;
        }
    }
    const TransferFunction first = pade(TransferFunction().with_delay(3), 1);  // (1 - 3s/2)/(1 + 3s/2)
    EXPECT_NEAR(std::abs(first.at(2.0) - (1 - 3.0) / (1 + 3.0)), 0, 1e-15);
    EXPECT_NE(thrown_message([] { pade(kSecondOrder, 0); }).find("between 1 and 10"), std::string::npos);
}

TEST(convert, delays_become_poles_where_they_can) {  // oracle: second route, the delay itself
    const TransferFunction G(from({2, 1}), from({1, -0.5}), 0.1, 0.3);
    for (const TransferFunction& H : {with_rational_delay("test", G), pade(G, 2)}) {
        EXPECT_EQ(H.delay(), 0);
        EXPECT_EQ(H.pole_count(), 4);
        for (const Complex z : {Complex(0.3, 0.8), Complex(-1.2, 0.1)})
            EXPECT_NEAR(std::abs(H.at(z) - G.at(z)), 0, 1e-12);
    }
    EXPECT_EQ(with_rational_delay("test", kSecondOrder).den(), kSecondOrder.den());
    EXPECT_NE(thrown_message([] {
                  with_rational_delay("ss", kSecondOrder.with_delay(1));
              }).find("approximate the delay with pade(G, n)"),
              std::string::npos);
}

TEST(convert, says_what_is_wrong) {
    const TransferFunction discrete(from({1}), from({1, 0.5}), 0.1);
    EXPECT_EQ(thrown_message([&] { c2d(discrete, 0.1); }),
              "c2d: the model is already a discrete-time model, with Ts = 0.1 s");
    EXPECT_EQ(thrown_message([&] { d2c(kSecondOrder); }), "d2c: the model is already a continuous-time model");
    EXPECT_EQ(thrown_message([&] { c2d(kSecondOrder, -1); }),
              "c2d: the sampling time must be a positive number of seconds, but it is -1");
    EXPECT_NE(thrown_message([&] { d2c(discrete); }).find("the pole z = -0.5"), std::string::npos);
    EXPECT_NE(thrown_message([&] { c2d(kSecondOrder.with_delay(0.15), 0.1, Discretization::kTustin); }).find("0.15 s"),
              std::string::npos);
    const TransferFunction unstable(from({1}), from({1, -20}));  // a pole at 2/Ts
    const std::string no_image = "c2d: the Tustin method is undefined for a pole at 2/Ts = 20 rad/s; choose another Ts";
    EXPECT_EQ(thrown_message([&] { c2d(unstable, 0.1, Discretization::kTustin); }), no_image);
    EXPECT_EQ(thrown_message([&] { c2d(to_state_space(unstable), 0.1, Discretization::kTustin); }), no_image);
    const TransferFunction alternating(from({1}), from({1, 0.7, -0.3}), 0.1);  // (z + 1)(z - 0.3) but for rounding
    EXPECT_EQ(thrown_message([&] { d2c(alternating, Discretization::kTustin); }),
              "d2c: the Tustin method is undefined for a pole at z = -1");
    EXPECT_NE(thrown_message([&] { c2d(TransferFunction::variable(), 0.1); }).find("zeros"), std::string::npos);
}

}  // namespace test_convert
}  // namespace dynlab
