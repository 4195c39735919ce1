#include "numerics/simulation/time_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/thrown_message.h"

namespace dynlab {
namespace test_time_response {

const TransferFunction kLag(Vector::Ones(1), Eigen::Vector2d(2, 1));  // 1/(2s + 1)

TEST(time_response, step_and_impulse_of_a_lag) {  // oracle: analytic, at instants that are not equally spaced
    const Vector t = Eigen::Vector4d(0.5, 1, 2.5, 7);
    const Vector step = step_response(kLag, t).y, impulse = impulse_response(kLag, t).y;
    const Vector late = impulse_response(kLag.with_delay(1), t).y;
    for (Index i = 0; i < 4; ++i) {
        EXPECT_NEAR(step(i), 1 - std::exp(-t(i) / 2), 1e-15);
        EXPECT_NEAR(impulse(i), std::exp(-t(i) / 2) / 2, 1e-15);
        EXPECT_NEAR(late(i), t(i) < 1 ? 0 : std::exp(-(t(i) - 1) / 2) / 2, 1e-15);
    }
}

TEST(time_response, discrete_accumulator) {  // oracle: analytic, 1/(z - 1) with Ts 0.5; the impulse has height 2
    const TransferFunction G(Vector::Ones(1), Eigen::Vector2d(1, -1), 0.5);
    EXPECT_EQ(step_response(G, Eigen::Vector3d(0, 0.5, 2)).y, Eigen::Vector3d(0, 1, 4));
    EXPECT_EQ(impulse_response(G, Eigen::Vector3d(0, 0.5, 2)).y, Eigen::Vector3d(0, 2, 2));
}

TEST(time_response, natural_window_shows_the_settling) {  // oracle: definition, settled after 80 % of the window
    const TransferFunction models[] = {kLag, TransferFunction(Vector::Ones(1), Eigen::Vector3d(1, 0.2, 4), 0, 3)};
    for (const TransferFunction& G : models) {
        const Vector t = natural_time_grid(G), y = step_response(G, t).y;
        const double final_value = G.dc_gain();
        EXPECT_EQ(t.size(), 400);
        EXPECT_LT((y.tail(80).array() - final_value).abs().maxCoeff(), 0.02 * final_value);
        EXPECT_GT((y.head(100).array() - final_value).abs().maxCoeff(), 0.3 * final_value);
    }
}

TEST(time_response, natural_window_of_models_that_do_not_settle) {
    const double unstable_end = natural_time_grid(TransferFunction(Vector::Ones(1), Eigen::Vector2d(1, -2)))(399);
    EXPECT_GT(unstable_end, 1);
    EXPECT_LT(unstable_end, 5);
    EXPECT_EQ(natural_time_grid(TransferFunction(Vector::Ones(1), Eigen::Vector2d(1, 0)))(399), 10);
    const TransferFunction discrete(Vector::Ones(1), Eigen::Vector2d(1, -0.9), 0.1);
    const Vector t = natural_time_grid(discrete);
    EXPECT_NEAR(t(1), 0.1, 1e-15);
    EXPECT_LT(std::pow(0.9, t(t.size() - 1) / 0.1), 0.01);
}

TEST(time_response, refusals) {
    EXPECT_EQ(thrown_message([] { step_response(kLag, Eigen::Vector2d(-1, 0)); }),
              "step: the response starts at time 0, but the first instant is -1");
    EXPECT_EQ(thrown_message([] { impulse_response(kLag, Vector()); }), "impulse: the time vector is empty");
    const TransferFunction discrete(Vector::Ones(1), Eigen::Vector2d(1, -0.9), 0.1);
    EXPECT_EQ(thrown_message([&] { step_response(discrete, Eigen::Vector2d(0, 0.15)); }),
              "step: the model is a discrete-time model, so the instants must be multiples of Ts = 0.1 s, but instant "
              "2 is 0.15 s");
}

}  // namespace test_time_response
}  // namespace dynlab
