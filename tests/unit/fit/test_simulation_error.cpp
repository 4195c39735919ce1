#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/criteria/denominator_group.h"
#include "numerics/fit/simulation_error.h"
#include "support/transfer_cases.h"

namespace test_simulation_error {

using namespace dynlab;
using namespace dynlab::test;

TEST(simulation_error, of_two_inputs_and_two_experiments) {  // oracle: second route, lsim channel by channel
    const TransferStructure structure =
        TransferStructure::grid(1, 2, Denominators::kPerChannel, {2, 1}, {0, 0}, {0.1, 0.237});
    const Vector theta = values({4, 3, 2, 1.5, -1});
    const auto models = structure.models(theta);
    std::vector<IdData> parts;
    double squares = 0, spread = 0;
    for (const std::uint32_t seed : {1u, 2u}) {
        const Index N = seed == 1 ? 700 : 300;
        Matrix u(N, 2);
        u << prbs(8, 5, -1, 1).head(N), RandomStream(seed).normal(N);
        const Vector noise = 0.2 * RandomStream(seed + 10).normal(N);
        const Vector y = lsim(models[0], u.col(0), 0.02) + lsim(models[1], u.col(1), 0.02) + noise;
        squares += noise.squaredNorm();
        spread += (y.array() - y.mean()).square().sum();
        parts.emplace_back(Matrix(y), u, 0.02);
    }
    const IdData data = IdData::merge(parts);
    EXPECT_NEAR(simulation_squares(data, structure, theta, 0) / squares, 1, 1e-9);
    Fit fit;
    fit.structure = structure;
    fit.theta = theta;
    measure_simulation(fit, data);
    EXPECT_NEAR(fit.loss, squares / 1000, 1e-11);
    EXPECT_NEAR(fit.noise_variance[0], squares / (1000 - 5), 1e-11);
    EXPECT_NEAR(fit.fit_percent[0], 100 * (1 - std::sqrt(squares / spread)), 1e-7);
    EXPECT_EQ(fit.offsets, Matrix::Zero(2, 1));
}

TEST(simulation_error, that_overflows_is_no_fit_and_is_reported) {  // oracle: exp(2 * 500) is no double
    const IdData data(Matrix(RandomStream(1).normal(1000)), Matrix(prbs(8, 5).head(1000)), 0.5);
    Fit fit;
    fit.structure = TransferStructure::single(1, 0);
    fit.theta = values({-2, 1});
    fit.message = Message("Found.");
    measure_simulation(fit, data);
    EXPECT_EQ(fit.fit_percent[0], -kInfinity);
    EXPECT_EQ(fit.loss, kInfinity);
    EXPECT_EQ(message_text(fit.full_message()),
              "Found. The simulation of the model diverges on these data, so no fit can be computed. Check the data "
              "and the structure.");
}

TEST(simulation_error, of_a_model_that_explodes_is_infinite) {  // oracle: exp(40 s per second) beyond all numbers
    const Index N = 600;
    const IdData data(Matrix(RandomStream(4).normal(N)), Matrix(RandomStream(3).normal(N)), 0.05);
    EXPECT_EQ(simulation_loss(data, TransferStructure::single(2, 1, 0.12), Vector{{-40, 5, 1, 3}}), kInfinity);
}

}  // namespace test_simulation_error
