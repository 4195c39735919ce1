#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/closed_loop.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"

namespace test_closed_loop {

using namespace dynlab;
using testing::HasSubstr;

constexpr double kTs = 0.05;

TransferFunction discrete(const Vector& num, const Vector& den, double delay = 0) {
    return {num, den, kTs, delay};
}

Vector reference_signal() {
    return prbs(6, 5);
}

Vector noise_signal(Index count) {
    RandomStream random(4);
    return 0.3 * random.normal(count);
}

Vector late(const Vector& signal, Index samples) {
    Vector shifted = Vector::Zero(signal.size());
    shifted.tail(signal.size() - samples) = signal.head(signal.size() - samples);
    return shifted;
}

// oracle: residual of the definition: the plant driven by u alone, the controller by r - y alone
TEST(closed_loop, sampled_loops_solve_both_equations) {
    const Vector r = reference_signal(), v = noise_signal(r.size());
    const TransferFunction pi = discrete(Vector{{1.2, -1.1}}, Vector{{1, -1}});
    for (const double delay : {0.0, 0.05, 0.12})
        for (const Index computing : {0, 1, 2}) {
            const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}}, 0, delay);
            const IdData data = ClosedLoop(G, {pi, computing}, kTs).simulate(r, v);
            const Experiment& loop = data.experiments.front();
            const Vector x = lsim(G, loop.u.col(0), kTs);
            EXPECT_LT((loop.y.col(0) - v - x).cwiseAbs().maxCoeff(), 1e-12) << delay << " " << computing;
            const Vector u = lsim(pi, late(r - loop.y.col(0), computing), kTs);
            EXPECT_LT((loop.u.col(0) - u).cwiseAbs().maxCoeff(), 1e-11) << delay << " " << computing;
            EXPECT_EQ(loop.r.col(0), r);
            EXPECT_EQ(data.hold, Hold::kZoh);
        }
}

// oracle: central differences of the loop's output; unstable plants, delays and direct terms, either kind of controller
TEST(closed_loop, sensitivities_are_those_of_the_loop) {
    struct Case {
        const char* name;
        Vector num, den;
        double delay;
        LoopController controller;
        Hold hold;
    };
    const TransferFunction pi = discrete(Vector{{1.2, -1.1}}, Vector{{1, -1}});
    const TransferFunction lag(Vector{{6}}, Vector{{0.05, 1}});
    const std::vector<Case> cases = {
        {"sampled", Vector{{2}}, Vector{{1, 4, 3}}, 0, {pi, 1}, Hold::kZoh},
        {"a delay", Vector{{0.5, 2}}, Vector{{1, 4, 3}}, 0.12, {pi, 0}, Hold::kZoh},
        {"direct feedthrough", Vector{{0.1, 0.2}}, Vector{{1, 3}}, 0, {pi, 1}, Hold::kZoh},
        {"a late direct term", Vector{{0.1, 0.2}}, Vector{{1, 3}}, 0.07, {pi, 1}, Hold::kZoh},
        {"unstable", Vector{{2}}, Vector{{1, 3, -4}}, 0, {discrete(Vector{{8}}, Vector{{1}}), 0}, Hold::kZoh},
        {"continuous", Vector{{2}}, Vector{{1, 3, -4}}, 0, {lag, 0}, Hold::kFoh},
        {"direct feedthrough before a lag", Vector{{0.1, 0.2, 1}}, Vector{{1, 1, 2}}, 0, {lag, 0}, Hold::kZoh}};
    const Vector r = reference_signal();
    for (const Case& one : cases) {
        const auto output = [&](const Vector& theta) {
            Vector den(one.den.size());
            den << 1, theta.head(one.den.size() - 1);
            const TransferFunction plant(theta.tail(one.num.size()), den, 0, one.delay);
            return ClosedLoop(plant, one.controller, kTs, one.hold).to_reference(r).x;
        };
        Vector theta(one.den.size() - 1 + one.num.size());
        theta << one.den.tail(one.den.size() - 1), one.num;
        const ClosedLoop loop(TransferFunction(one.num, one.den, 0, one.delay), one.controller, kTs, one.hold);
        ASSERT_TRUE(loop.stable()) << one.name;
        const Matrix psi = loop.sensitivities(r, static_cast<int>(one.num.size()) - 1);
        ASSERT_EQ(psi.cols(), theta.size());
        for (Index i = 0; i < theta.size(); ++i) {
            const Vector step = 1e-5 * Vector::Unit(theta.size(), i);
            const Vector expected = (output(theta + step) - output(theta - step)) / 2e-5;
            EXPECT_LT((psi.col(i) - expected).norm(), 1e-7 * expected.norm()) << one.name << " " << i;
        }
    }
}

TEST(closed_loop, a_sampled_gain_on_a_lag_is_known_by_hand) {  // oracle: analytic
    const double a = std::exp(-kTs), gain = 3;
    const Vector r = Vector::Ones(40);
    const auto loop =
        ClosedLoop(TransferFunction(Vector{{1}}, Vector{{1, 1}}), {discrete(Vector{{gain}}, Vector{{1}})}, kTs)
            .to_reference(r);
    const double pole = a - gain * (1 - a);  // x(k+1) = a x + (1 - a) gain (1 - x)
    for (Index k = 0; k < r.size(); ++k)
        EXPECT_NEAR(loop.x[k], gain / (1 + gain) * (1 - std::pow(pole, static_cast<double>(k))), 1e-13) << k;
}

// oracle: the loop's transfer functions from the algebra of polynomials
TEST(closed_loop, continuous_loops_are_those_of_feedback) {
    const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}}), C(Vector{{2, 3}}, Vector{{1, 0}});
    const Vector r = reference_signal(), v = noise_signal(r.size());
    const ClosedLoop loop(G, {C}, kTs);
    const TransferFunction one(Vector{{1}}, Vector{{1}});
    const auto expected_value = loop.to_reference(r), disturbed = loop.to_disturbance(v);
    EXPECT_LT((expected_value.x - lsim(feedback(C * G, one), r, kTs)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((expected_value.u - lsim(feedback(C, G), r, kTs)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((disturbed.x + lsim(feedback(C * G, one), v, kTs, Hold::kFoh)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((disturbed.u + lsim(feedback(C, G), v, kTs, Hold::kFoh)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(loop.simulate(r, v).hold, Hold::kFoh);
}

TEST(closed_loop, an_unstable_plant_may_be_held) {  // oracle: poles by hand, 1/(s - 1) with gain 3 in s = -2
    const TransferFunction G(Vector{{1}}, Vector{{1, -1}}), gain(Vector{{3}}, Vector{{1}}),
        weak(Vector{{0.5}}, Vector{{1}});
    EXPECT_TRUE(ClosedLoop(G, {gain}, kTs).stable());
    EXPECT_FALSE(ClosedLoop(G, {weak}, kTs).stable());
    EXPECT_NEAR(ClosedLoop(G, {gain}, kTs).to_reference(Vector::Ones(400)).x[399], 1.5, 1e-9);
}

TEST(closed_loop, refuses_what_is_no_loop) {  // oracle: the sentence names the fault
    const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}}), direct(Vector{{1, 2}}, Vector{{1, 1}});
    const TransferFunction gain(Vector{{3}}, Vector{{1}}), sampled_gain = discrete(Vector{{3}}, Vector{{1}});
    const auto refused = [&](const TransferFunction& plant, const LoopController& controller) {
        return thrown_message([&] { ClosedLoop(plant, controller, kTs); });
    };
    EXPECT_THAT(refused(G, {TransferFunction(Vector{{3}}, Vector{{1}}, 0.1)}),
                HasSubstr("sampling time of the controller is 0.1 s"));
    EXPECT_THAT(refused(G, {TransferFunction(Vector{{1, 0}}, Vector{{1}})}),
                HasSubstr("controller has 1 zero but only 0"));
    EXPECT_THAT(refused(G, {gain, 1}), HasSubstr("needs a sampled controller"));
    EXPECT_THAT(refused(G.with_delay(0.1), {gain}), HasSubstr("pade(G, n)"));
    EXPECT_THAT(refused(direct, {sampled_gain}), HasSubstr("algebraic loop. Add a computing delay"));
    EXPECT_THAT(refused(direct, {TransferFunction(Vector{{-1}}, Vector{{1}})}),
                HasSubstr("algebraic loop without a solution. Change the gain"));
    EXPECT_THAT(refused(discrete(Vector{{1}}, Vector{{1, -0.5}}), {sampled_gain}), HasSubstr("continuous-time model"));
    EXPECT_EQ(refused(direct, {sampled_gain, 1}), "");
    const Vector r = Vector::Ones(10);
    EXPECT_THAT(
        thrown_message([&] {
            ClosedLoop(TransferFunction(Vector{{1}}, Vector{{1, -1}}), {gain}, kTs).simulate(r, Vector::Zero(9));
        }),
        HasSubstr("10 samples, but the noise has 9"));
    EXPECT_THAT(thrown_message([&] {
                    ClosedLoop(TransferFunction(Vector{{9}}, Vector{{1, -1}}),
                               {TransferFunction(Vector{{0.1}}, Vector{{1}})}, kTs)
                        .simulate(r, r);
                }),
                HasSubstr("the loop is unstable"));
}

}  // namespace test_closed_loop
