#include "numerics/signals/random_phase_multisine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/signals/fourier.h"
#include "support/thrown_message.h"

namespace test_random_phase_multisine {

using namespace dynlab;
using testing::HasSubstr;

std::string refusal(Index period, const RandomPhaseOptions& options) {
    RandomStream random(1);
    return thrown_message([&] { random_phase_multisine(period, options, random); });
}

TEST(random_phase_multisine, has_equal_lines_where_they_are_wanted_and_none_elsewhere) {  // oracle: its transform
    RandomPhaseOptions options;
    options.lines = Vector{{1.0, 3.0, 4.0, 10.0}};
    options.amplitude = 2.5;
    RandomStream random(3);
    const RandomPhaseMultisine signal = random_phase_multisine(90, options, random);
    EXPECT_NEAR(std::sqrt(signal.u.squaredNorm() / 90), 2.5, 1e-12);
    const Vector sizes = fourier_transform(signal.u).cwiseAbs() / 90;
    for (Index k = 0; k <= 45; ++k) {
        const bool excited = (options.lines.array() == static_cast<double>(k)).any();
        EXPECT_NEAR(sizes[k], excited ? 2.5 / std::sqrt(8.0) : 0, 1e-12) << k;
    }
}

TEST(random_phase_multisine, is_the_sum_of_its_cosines) {  // oracle: the sum, with the phases of the stream
    RandomPhaseOptions options;
    options.lines = Vector{{2.0, 5.0}};
    RandomStream random(7), again(7);
    const RandomPhaseMultisine signal = random_phase_multisine(32, options, random);
    const Vector phases = 2 * std::numbers::pi * again.uniform(2);
    for (Index n = 0; n < 32; ++n) {
        const double turn = 2 * std::numbers::pi * static_cast<double>(n) / 32;
        EXPECT_NEAR(signal.u[n], std::cos(2 * turn + phases[0]) + std::cos(5 * turn + phases[1]), 1e-13);
    }
}

TEST(random_phase_multisine, leaves_one_of_each_group_of_odd_lines_out) {  // oracle: counting
    RandomPhaseOptions options;
    options.odd = true;
    options.detection = 4;
    RandomStream random(3);
    const RandomPhaseMultisine one = random_phase_multisine(1000, options, random);
    const RandomPhaseMultisine next = random_phase_multisine(1000, options, random);
    // 250 odd lines below 500: 62 groups of four and two lines more
    ASSERT_EQ(one.detection.size(), 62);
    ASSERT_EQ(one.lines.size(), 188);
    for (Index g = 0; g < 62; ++g) {
        EXPECT_GE(one.detection[g], static_cast<double>(8 * g + 1));
        EXPECT_LE(one.detection[g], static_cast<double>(8 * g + 7));
        EXPECT_EQ(std::fmod(one.detection[g], 2), 1);
    }
    EXPECT_EQ(one.lines, next.lines);
    EXPECT_GT((one.u - next.u).norm(), 1);
}

TEST(random_phase_multisine, has_lower_peaks_where_they_are_wanted) {  // oracle: published crest factors, about 1.5
    RandomPhaseOptions options;
    options.lines = Vector::LinSpaced(30, 1, 30);
    RandomStream random(1);
    const double usual = random_phase_multisine(512, options, random).crest;
    options.low_crest = true;
    const RandomPhaseMultisine low = random_phase_multisine(512, options, random);
    EXPECT_GT(usual, 2);
    EXPECT_LT(low.crest, 1.7);
    EXPECT_NEAR(low.crest, low.u.cwiseAbs().maxCoeff() / std::sqrt(low.u.squaredNorm() / 512), 1e-12);
}

TEST(random_phase_multisine, refuses_what_cannot_be) {
    RandomPhaseOptions options;
    EXPECT_THAT(refusal(4, options), HasSubstr("at least 8 samples, but has 4"));
    options.lines = Vector{{1.0, 16.0}};
    EXPECT_THAT(refusal(32, options), HasSubstr("from 1 to 15, but one is 16"));
    options.lines = Vector{{1.5}};
    EXPECT_THAT(refusal(32, options), HasSubstr("but one is 1.5"));
    options.lines = Vector{{2.0, 2.0}};
    EXPECT_THAT(refusal(32, options), HasSubstr("2 occurs several times"));
    options.lines = Vector{{2.0, 4.0}};
    options.odd = true;
    EXPECT_THAT(refusal(32, options), HasSubstr("no line remains to be excited"));
    options = {};
    options.detection = 1;
    EXPECT_THAT(refusal(32, options), HasSubstr("a group needs at least 2 lines"));
    options = {};
    options.amplitude = 0;
    EXPECT_THAT(refusal(32, options), HasSubstr("amplitude must be positive"));
}

}  // namespace test_random_phase_multisine
