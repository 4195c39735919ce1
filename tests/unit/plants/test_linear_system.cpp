#include "numerics/plants/linear_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/simulation/lsim.h"

namespace test_linear_system {

using namespace dynlab;

TEST(linear_system, has_the_stated_factors) {  // oracle: the factored form at points of the complex plane
    const LinearSystemParameters p;
    const TransferFunction G = linear_system_truth(p);
    for (const Complex s : {Complex(0, 0), Complex(0, 3), Complex(0.5, -1), Complex(0, 20)}) {
        const Complex swing = s * s / (p.frequency * p.frequency) + 2 * p.damping / p.frequency * s + 1.;
        const Complex expected = p.gain * (s / p.zero + 1.) / ((s / p.pole + 1.) * swing);
        EXPECT_LT(std::abs(G.at(s) - expected), 1e-14);
    }
    EXPECT_TRUE(G.stable());
}

TEST(linear_system, measures_its_output_in_white_noise) {  // oracle: definition, statistics
    const LinearSystemParameters p;
    const TransferFunction G = linear_system_truth(p);
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        const LinearSystemData data_sets = simulate_linear_system(p, seed);
        for (const PlantData* data_set : {&data_sets.estimation, &data_sets.validation}) {
            const Vector e = data_set->y - lsim(G, data_set->u, p.Ts);
            const auto N = static_cast<double>(e.size());
            EXPECT_NEAR(std::sqrt(e.squaredNorm() / N), p.noise_std, 4 * p.noise_std / std::sqrt(2 * N));
            EXPECT_LT(std::abs(e.head(e.size() - 1).dot(e.tail(e.size() - 1))) / e.squaredNorm(), 4 / std::sqrt(N));
            EXPECT_EQ(data_set->u.cwiseAbs(), Vector::Constant(e.size(), p.amplitude));
            EXPECT_DOUBLE_EQ(data_set->t[1] - data_set->t[0], p.Ts);
        }
    }
}

TEST(linear_system, repeats_for_equal_seeds_only) {  // oracle: definition
    const LinearSystemData one = simulate_linear_system({}, 5), again = simulate_linear_system({}, 5),
                           other = simulate_linear_system({}, 6);
    EXPECT_EQ(one.estimation.y, again.estimation.y);
    EXPECT_EQ(one.validation.y, again.validation.y);
    EXPECT_NE(one.estimation.y, other.estimation.y);
    EXPECT_NE(one.estimation.u, one.validation.u);
}

TEST(linear_system, refuses_values_out_of_range) {
    LinearSystemParameters p;
    p.damping = 0;
    EXPECT_THROW(linear_system_truth(p), InvalidArgument);
    p = {};
    p.noise_std = -1;
    EXPECT_THROW(simulate_linear_system(p, 1), InvalidArgument);
}

}  // namespace test_linear_system
