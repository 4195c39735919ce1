#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "numerics/models/convert.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/lsim.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_sriv {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const PolynomialOrders kOrders = PolynomialOrders::output_error({2}, {2}, {1});
const Vector kTruth{{-1.5, 0.7, 1, 0.5}};
const PolynomialOrders kTwoInputs = PolynomialOrders::output_error({2, 1}, {2, 1}, {1, 2});
const Vector kTwoTruth{{-1.5, 0.7, 1, 0.5, -0.8, -3}};

IdData simulated(const PolynomialOrders& orders, const Vector& theta, Index N, double noise, std::uint32_t seed) {
    Matrix u(N, static_cast<Index>(orders.inputs()));
    for (Index i = 0; i < u.cols(); ++i) u.col(i) = random_levels(N, 4 + i, seed + 20 + static_cast<std::uint32_t>(i));
    const Vector x = model_output(PolynomialModel(orders, theta, 1), u, Vector::Zero(N));
    return IdData(Matrix(x + noise * RandomStream(seed).normal(N)), u, 1);
}

FitOptions tight() {
    FitOptions options;
    options.tolerance = 1e-11;
    options.max_iterations = 200;
    return options;
}

double worst_relative(const Vector& a, const Vector& truth) {
    return (a - truth).cwiseQuotient(truth).cwiseAbs().maxCoeff();
}

TEST(sriv, recovers_noise_free_systems) {  // oracle: the simulated system
    EXPECT_LT(worst_relative(sriv(simulated(kOrders, kTruth, 500, 0, 1), kOrders, tight()).theta, kTruth), 1e-9);
    EXPECT_LT(worst_relative(sriv(simulated(kTwoInputs, kTwoTruth, 500, 0, 1), kTwoInputs, tight()).theta, kTwoTruth),
              1e-9);
}

// The instruments are the sensitivities of the simulated output, so a fixed point satisfies the normal equations of the
// output error: sriv and oe agree to rounding, covariance included.
TEST(sriv, fixed_point_is_the_output_error_optimum) {  // oracle: second route
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        for (const auto& [orders, truth] : {std::pair{kOrders, kTruth}, std::pair{kTwoInputs, kTwoTruth}}) {
            const IdData data = simulated(orders, truth, 400, 1.0, seed);
            const auto iv = sriv(data, orders, tight()), output_error = oe(data, orders, tight());
            ASSERT_EQ(iv.termination, Termination::kConverged) << message_text(iv.full_message());
            EXPECT_LT(worst_relative(iv.theta, output_error.theta), 1e-8) << seed << message_text(iv.full_message());
            EXPECT_LT(worst_relative(iv.std, output_error.std), 1e-7) << seed;
        }
    }
}

TEST(sriv, agrees_with_oe_whatever_the_start) {  // oracle: second route, cut data with an offset
    IdData data = simulated(kOrders, kTruth, 500, 0.5, 3).range(51, 500);
    data.experiments[0].y.array() += 20;
    for (InitialState state : {InitialState::kZero, InitialState::kSteady, InitialState::kEstimate}) {
        FitOptions options = tight();
        options.initial_state = state;
        options.offset = Offset::kEstimate;
        const auto iv = sriv(data, kOrders, options), output_error = oe(data, kOrders, options);
        EXPECT_EQ(iv.termination, Termination::kConverged) << message_text(iv.full_message());
        EXPECT_LT(worst_relative(iv.theta, output_error.theta), 1e-8) << message_text(iv.full_message());
        EXPECT_NEAR(iv.offsets(0, 0), output_error.offsets(0, 0), 1e-7);
    }
}

TEST(sriv, fast_sampling_needs_no_initial_value) {  // oracle: the continuous-time system, within standard errors
    const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}});
    Vector truth(4);
    truth << c2d(G, 0.01).den().tail(2), c2d(G, 0.01).num();
    const Vector u = random_levels(3000, 100, 1);
    const Vector x = model_output(PolynomialModel(kOrders, truth, 0.01), u, Vector::Zero(3000));
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const IdData data(Matrix(x + 0.1 * RandomStream(seed).normal(3000)), Matrix(u), 0.01);
        const auto result = sriv(data, kOrders);
        const double noise = std::sqrt(result.noise_variance[0]);
        EXPECT_NEAR(noise, 0.1, 0.01) << message_text(result.full_message());
        EXPECT_LT(std::sqrt(result.loss), 0.1 * 1.05);
    }
}

// Noise of half the size of the output and 155 samples: iterations meet poles that leave the unit circle again and
// again, which must not pass for convergence.
TEST(sriv, short_noisy_records_get_a_good_model) {  // oracle: the simulation error of the true system
    const Vector u = prbs(5, 5), x = lsim(TransferFunction(Vector{{2}}, Vector{{1, 4, 3}}), u, 0.2);
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        const Vector e = 0.5 * RandomStream(seed).normal(u.size());
        const auto result = sriv(IdData(Matrix(x + e), Matrix(u), 0.2), kOrders);
        EXPECT_LT(result.loss, 1.03 * e.squaredNorm() / static_cast<double>(u.size()))
            << seed << message_text(result.full_message());
    }
}

TEST(sriv, experiments_count_together_in_any_order) {  // oracle: invariance
    const IdData a = simulated(kOrders, kTruth, 300, 0.3, 1), b = simulated(kOrders, kTruth, 500, 0.3, 2);
    const auto ab = sriv(IdData::merge({a, b}), kOrders, tight()), ba = sriv(IdData::merge({b, a}), kOrders, tight());
    EXPECT_LT(worst_relative(ab.theta, ba.theta), 1e-10);
    EXPECT_LT(worst_relative(ab.std, ba.std), 1e-9);
}

TEST(sriv, always_answers) {  // oracle: definition
    FitOptions hurried;
    hurried.max_iterations = 0;
    const auto rough = sriv(simulated(kOrders, kTruth, 300, 0.5, 1), kOrders, hurried);
    EXPECT_EQ(rough.termination, Termination::kIterationLimit);
    EXPECT_THAT(message_text(rough.full_message()), HasSubstr("`max_iterations` = 0"));
    EXPECT_GT(rough.fit_percent[0], 50);
    int asked = 0;
    hurried.cancel = [&] { return ++asked > 2; };
    EXPECT_EQ(sriv(simulated(kOrders, kTruth, 300, 0.5, 1), kOrders, hurried).theta.size(), 4);
    const Matrix u = simulated(kOrders, kTruth, 300, 0.5, 1).experiments[0].u;
    const auto nothing = sriv(IdData(Matrix(RandomStream(8).normal(300)), u, 1), kOrders);
    EXPECT_TRUE(nothing.theta.allFinite());
    EXPECT_GE(nothing.fit_percent[0], -1e-9);
}

TEST(sriv, refuses_what_it_cannot_fit) {
    const IdData data = simulated(kOrders, kTruth, 100, 0.1, 1);
    const Matrix y = data.experiments[0].y;
    EXPECT_THAT(thrown_message([&] { sriv(IdData(y, Matrix::Zero(100, 1), 1), kOrders); }),
                HasSubstr("sriv: the input u1 is zero"));
    EXPECT_THAT(thrown_message([&] { sriv(data.range(1, 3), kOrders); }), HasSubstr("more samples than"));
    EXPECT_THAT(thrown_message([&] { sriv(data, PolynomialOrders::output_error({2}, {-2}, {1})); }),
                HasSubstr("nf, the number of poles"));
}

}  // namespace test_sriv
