#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/signals/box_muller.h"
#include "numerics/signals/random.h"

namespace test_box_muller {

using namespace dynlab;

/// Largest difference, relative to R, from the definition in long double.
double largest_difference(const NormalPairs& u1, const NormalPairs& u2) {
    NormalPairs cosines, sines;
    box_muller(u1, u2, cosines, sines);
    double largest = 0;
    for (int i = 0; i < kNormalPairs; ++i) {
        const long double radius = std::sqrt(-2 * std::log(1 - static_cast<long double>(u1[i])));
        const long double angle = 2 * std::numbers::pi_v<long double> * u2[i];
        const double across = static_cast<double>(std::abs(cosines[i] - radius * std::cos(angle)));
        const double up = static_cast<double>(std::abs(sines[i] - radius * std::sin(angle)));
        const double size = radius > 0 ? static_cast<double>(radius) : 1e-300;  // what is not 0 at R = 0 shows
        largest = std::max(largest, std::max(across, up) / size);
    }
    return largest;
}

TEST(box_muller, agrees_with_the_definition) {  // oracle: long double of the mathematical library
    RandomStream random(11);
    NormalPairs u1, u2;
    for (int repeat = 0; repeat < 20000; ++repeat) {
        for (int i = 0; i < kNormalPairs; ++i) {
            u1[i] = random.uniform();
            u2[i] = random.uniform();
        }
        ASSERT_LT(largest_difference(u1, u2), 5e-16);
    }
}

TEST(box_muller, extreme_uniforms_give_numbers) {  // oracle: long double of the mathematical library
    constexpr double kMinValue = 0x1p-53, kMaxValue = 1 - 0x1p-53;
    const NormalPairs u1{0, kMinValue, 2 * kMinValue, 0.25, 0.5, 1 - std::numbers::sqrt2 / 2, 0.75, kMaxValue};
    for (const double u2 : {0., kMinValue, 0.125, 0.25, 0.5, 0.75, kMaxValue}) {
        NormalPairs same;
        same.fill(u2);
        EXPECT_LT(largest_difference(u1, same), 5e-16) << u2;
    }
}

}  // namespace test_box_muller
