#include <gtest/gtest.h>

#include <random>

#include "numerics/signals/random.h"

namespace test_random {

using namespace dynlab;

TEST(random, uniforms_come_from_the_standard_twister) {  // oracle: std::mt19937 of the C++ library
    for (const std::uint32_t seed : {0u, 1u, 5489u, 4294967295u}) {
        std::mt19937 twister(seed);
        RandomStream stream(seed);
        for (int i = 0; i < 2000; ++i) {
            const double high = twister() >> 5, low = twister() >> 6;
            ASSERT_EQ(stream.uniform(), (high * 67108864.0 + low) / 9007199254740992.0) << "draw " << i;
        }
    }
}

TEST(random, first_normals_of_seed_1) {  // oracle: reference data, 10 published digits
    RandomStream stream(1);
    for (const double expected : {-0.1925803402, -1.0208449868, -0.0048841639, 0.0143145961})
        EXPECT_NEAR(stream.normal(), expected, 5e-11);
}

TEST(random, vectors_continue_the_same_stream) {  // oracle: second route, single values
    RandomStream one(7), many(7);
    const Vector first = many.normal(5), second = many.normal(4), third = many.uniform(3);
    for (Index i = 0; i < 5; ++i) EXPECT_EQ(first(i), one.normal());
    for (Index i = 0; i < 4; ++i) EXPECT_EQ(second(i), one.normal());
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(third(i), one.uniform());
}

TEST(random, normals_are_normal) {  // oracle: statistics; bounds are five standard errors of each moment
    constexpr Index kCount = 200000;
    const Eigen::ArrayXd e = RandomStream(3).normal(kCount);
    const double root = std::sqrt(static_cast<double>(kCount));
    EXPECT_NEAR(e.mean(), 0, 5 / root);
    EXPECT_NEAR(e.square().mean(), 1, 5 * std::sqrt(2.0) / root);
    EXPECT_NEAR(e.cube().mean(), 0, 5 * std::sqrt(15.0) / root);
    EXPECT_NEAR(e.pow(4).mean(), 3, 5 * std::sqrt(96.0) / root);
    EXPECT_NEAR((e.head(kCount - 1) * e.tail(kCount - 1)).mean(), 0, 5 / root);
}

}  // namespace test_random
