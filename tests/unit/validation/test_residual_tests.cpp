#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/residual_tests.h"

namespace test_residual_tests {

using namespace dynlab;
using testing::HasSubstr;

const TransferFunction kG(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}});
constexpr double kTs = 0.05;

Vector ar1(Index N, double pole, std::uint32_t seed) {
    Vector e = RandomStream(seed).normal(N);
    for (Index k = 1; k < N; ++k) e[k] += pole * e[k - 1];
    return e;
}

IdData simulated_data(const Vector& y, const Vector& u) {
    return IdData(Matrix(y), Matrix(u), kTs);
}

ResidualTests plain_tests(const IdData& data, const TransferFunction& G, const ResidualOptions& options = {}) {
    return residual_tests(data, {G}, {InitialState::kZero, Offset::kNone}, options);
}

TEST(residual_tests, correlations_equal_their_definition) {  // oracle: the definition
    const Vector u = prbs(6, 3), N_e = ar1(u.size(), 0.6, 2);
    const Vector y = lsim(kG, u, kTs) + N_e;
    const auto output = plain_tests(simulated_data(y, u), kG).outputs[0];
    const Vector e = N_e.array() - N_e.mean(), v = u.array() - u.mean();
    const Index N = u.size();
    for (Index lag = 0; lag <= 25; ++lag) {
        EXPECT_NEAR(output.whiteness.correlation[lag], e.tail(N - lag).dot(e.head(N - lag)) / e.squaredNorm(), 1e-10);
        const double scale = e.norm() * v.norm();
        EXPECT_NEAR(output.inputs[0].correlation[25 + lag], e.tail(N - lag).dot(v.head(N - lag)) / scale, 1e-10);
        EXPECT_NEAR(output.inputs[0].correlation[25 - lag], e.head(N - lag).dot(v.tail(N - lag)) / scale, 1e-10);
    }
    EXPECT_NEAR(output.mean, N_e.mean(), 1e-10);
    EXPECT_NEAR(output.variance, e.squaredNorm() / static_cast<double>(N), 1e-10);
}

TEST(residual_tests, white_noise_on_the_true_model_passes) {  // oracle: how the data were made
    const Vector u = prbs(7, 8), y = lsim(kG, u, kTs) + 0.1 * RandomStream(1).normal(u.size());
    const auto tests = plain_tests(simulated_data(y, u), kG);
    EXPECT_TRUE(tests.outputs[0].whiteness.white);
    EXPECT_TRUE(tests.outputs[0].inputs[0].independent);
    EXPECT_TRUE(tests.outputs[0].inputs[0].without_feedback);
    EXPECT_THAT(message_text(tests.verdict), HasSubstr("y1: The output error is white"));
    EXPECT_THAT(message_text(tests.verdict), HasSubstr("u1 is not correlated with the residuals"));
    EXPECT_THAT(message_text(tests.verdict), HasSubstr("The tests show no missing dynamics"));
}

TEST(residual_tests, colored_noise_on_the_true_model_is_distinguished_from_missing_dynamics) {
    const Vector u = prbs(7, 8), y = lsim(kG, u, kTs) + 0.05 * ar1(u.size(), 0.9, 3);
    const auto colored = plain_tests(simulated_data(y, u), kG);
    EXPECT_FALSE(colored.outputs[0].whiteness.white);
    EXPECT_TRUE(colored.outputs[0].inputs[0].independent);
    EXPECT_THAT(message_text(colored.verdict), HasSubstr("the dynamics. The disturbance is colored:"));
    const TransferFunction poor(Vector{{2.0 / 3}}, Vector{{1.0, 1.0}});
    const auto missing = plain_tests(simulated_data(y, u), poor);
    EXPECT_FALSE(missing.outputs[0].inputs[0].independent);
    EXPECT_THAT(message_text(missing.verdict), HasSubstr("u1 is correlated with the residuals"));
    EXPECT_THAT(message_text(missing.verdict), HasSubstr("The model does not describe all dynamics"));
}

// Oracle: how the data were made. Each data set has one cause, which the message names instead of missing poles.
TEST(residual_tests, known_causes_are_named) {
    const Vector u = prbs(7, 8), e = 0.02 * RandomStream(1).normal(u.size());
    const auto message_on = [](const Vector& input, const Vector& y, const TransferFunction& G,
                               const ModelDoubts& doubts) {
        const std::string text = message_text(
            residual_tests(simulated_data(y, input), {G}, {InitialState::kZero, Offset::kNone}, {}, doubts).verdict);
        EXPECT_EQ(text.find("The model does not describe all dynamics"), std::string::npos) << text;
        return text;
    };
    const auto message_for = [&](const Vector& y, const TransferFunction& G, const ModelDoubts& doubts = {}) {
        return message_on(u, y, G, doubts);
    };
    const Vector answer = lsim(kG, u, kTs);
    EXPECT_THAT(message_for(answer + 0.2 * u + e, kG), HasSubstr("as many zeros as poles"));
    const Vector fast = RandomStream(3).normal(u.size());
    const TransferFunction quick(Vector{{9.0}}, Vector{{1.0, 9.0}}), late(quick.num(), quick.den(), 0, 0.3);
    EXPECT_THAT(message_on(fast, lsim(quick, fast, kTs) + e, late, {}), HasSubstr("try a shorter delay"));
    const Vector long_u = (Vector(2 * u.size()) << Vector::Constant(u.size(), 3), u).finished();
    const Vector running = lsim(kG, long_u, kTs).tail(u.size());
    EXPECT_THAT(message_for(running + e, kG), HasSubstr("The assumed initial conditions are wrong: for a simulation"));
    EXPECT_THAT(message_for(answer + 0.2 * u + e, kG, {{}, Message("With this the fit is 9 %.")}),
                HasSubstr("With this the fit"));
    EXPECT_THAT(message_for(answer + e, kG, {{"b0"}, {}}), HasSubstr("the data do not reliably determine b0"));
}

TEST(residual_tests, tests_do_not_make_poor_models_good) {  // oracle: how the data were made
    const Vector u = prbs(7, 8), e = RandomStream(1).normal(u.size());
    const auto poor =
        plain_tests(simulated_data(0.1 * lsim(kG, u, kTs) + e, u), TransferFunction(0.1 * kG.num(), kG.den()));
    EXPECT_TRUE(poor.outputs[0].whiteness.white && poor.outputs[0].inputs[0].independent);
    EXPECT_THAT(message_text(poor.verdict), HasSubstr("The model explains little of the output (fit "));
    const TransferFunction unstable(Vector{{2.0}}, Vector{{1.0, 4.0, -0.004}});  // a pole at 0.001
    const auto explodes = plain_tests(simulated_data(lsim(unstable, u, kTs) + 0.01 * e, u), unstable);
    EXPECT_TRUE(explodes.outputs[0].whiteness.white && explodes.outputs[0].inputs[0].independent);
    EXPECT_THAT(message_text(explodes.verdict), HasSubstr("The model is unstable. Do not use it"));
    for (const ResidualTests* tests : {&poor, &explodes})
        EXPECT_EQ(message_text(tests->verdict).find("standard errors of the model are valid"), std::string::npos);
}

TEST(residual_tests, feedback_shows_at_negative_lags) {  // oracle: how the data were made
    const Index N = 1000;
    const Vector noise = 0.3 * RandomStream(2).normal(N), r = RandomStream(5).normal(N);
    Vector u(N), y(N);
    for (Index k = 0; k < N; ++k) {
        y[k] = noise[k];  // no response at all, so that the model G = 0 is right
        u[k] = r[k] + (k > 0 ? 0.8 * y[k - 1] : 0);
    }
    const TransferFunction none(Vector{{0.0}}, Vector{{1.0, 1.0}});
    const auto tests = plain_tests(simulated_data(y, u), none);
    EXPECT_TRUE(tests.outputs[0].inputs[0].independent);
    EXPECT_FALSE(tests.outputs[0].inputs[0].without_feedback);
    EXPECT_THAT(message_text(tests.verdict), HasSubstr("affect the input through feedback"));
    Index peak = 0;
    tests.outputs[0].inputs[0].correlation.cwiseAbs().maxCoeff(&peak);
    EXPECT_EQ(peak - 25, -1);
}

TEST(residual_tests, experiments_count_together) {  // oracle: second route, sums over the parts
    const Vector u = prbs(6, 5), y = lsim(kG, u, kTs) + 0.1 * RandomStream(9).normal(u.size());
    const IdData whole = simulated_data(y, u);
    const IdData parts = IdData::merge({whole.range(1, 150), whole.range(151, 315)});
    const std::vector<Matrix> simulated = {Matrix(lsim(kG, u, kTs).head(150)), Matrix(lsim(kG, u, kTs).tail(165))};
    const auto output = residual_tests(parts, simulated).outputs[0];
    const Vector e = y - lsim(kG, u, kTs);
    const Vector first = e.head(150).array() - e.head(150).mean(), second = e.tail(165).array() - e.tail(165).mean();
    const double products = first.tail(147).dot(first.head(147)) + second.tail(162).dot(second.head(162));
    EXPECT_NEAR(output.whiteness.correlation[3], products / (first.squaredNorm() + second.squaredNorm()), 1e-10);
}

TEST(residual_tests, channels_are_tested_pair_by_pair) {  // oracle: how the data were made
    const Index N = 900;
    Matrix u(N, 2), y(N, 2);
    u.col(0) = RandomStream(1).normal(N);
    u.col(1) = RandomStream(2).normal(N);
    const TransferFunction H(Vector{{1.0}}, Vector{{1.0, 1.0}});
    y.col(0) = lsim(kG, u.col(0), kTs) + lsim(H, u.col(1), kTs) + 0.01 * RandomStream(3).normal(N);
    y.col(1) = lsim(H, u.col(1), kTs) + 0.01 * RandomStream(4).normal(N);
    const TransferFunction none(Vector{{0.0}}, Vector{{1.0, 1.0}});
    const auto tests = residual_tests(IdData(y, u, kTs), {kG, none, none, H}, {InitialState::kZero, Offset::kNone});
    ASSERT_EQ(tests.outputs.size(), 2u);
    EXPECT_TRUE(tests.outputs[0].inputs[0].independent);
    EXPECT_FALSE(tests.outputs[0].inputs[1].independent);
    EXPECT_TRUE(tests.outputs[1].whiteness.white);
    EXPECT_TRUE(tests.outputs[1].inputs[0].independent);
    EXPECT_TRUE(tests.outputs[1].inputs[1].independent);
}

TEST(residual_tests, says_when_there_is_nothing_to_test) {
    const Vector u = prbs(6, 3);
    const auto exact = plain_tests(simulated_data(lsim(kG, u, kTs), u), kG);
    EXPECT_TRUE(exact.outputs[0].exact);
    EXPECT_THAT(message_text(exact.verdict), HasSubstr("rounding error"));
    const Vector flat = Vector::Ones(100), y = lsim(kG, flat, kTs) + 0.1 * RandomStream(1).normal(100);
    EXPECT_THAT(message_text(plain_tests(simulated_data(y, flat), kG).verdict), HasSubstr("u1 never changes"));
    const Vector drift = lsim(kG, flat, kTs) + 0.1 * ar1(100, 0.9, 1);
    EXPECT_THAT(message_text(plain_tests(simulated_data(drift, flat), kG).verdict),
                HasSubstr(", cannot distinguish them"));
}

TEST(residual_tests, refuses_short_records_and_wrong_sizes) {
    const IdData data = simulated_data(RandomStream(1).normal(40), RandomStream(2).normal(40));
    EXPECT_THROW(plain_tests(data, kG), InvalidArgument);
    EXPECT_NO_THROW(plain_tests(data, kG, {10, 0.99}));
    EXPECT_THROW(plain_tests(data, kG, {0, 0.99}), InvalidArgument);
    EXPECT_THROW(plain_tests(data, kG, {10, 1}), InvalidArgument);
    EXPECT_THROW(residual_tests(data, {Matrix::Zero(39, 1)}, {10, 0.99}), InvalidArgument);
    EXPECT_THROW(residual_tests(data, std::vector<Matrix>{}, {10, 0.99}), InvalidArgument);
}

}  // namespace test_residual_tests
