#include "numerics/models/frequency_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/thrown_message.h"

namespace test_frequency_data {

using namespace dynlab;
using testing::HasSubstr;

const ComplexVector kResponse{{Complex(1, 0), Complex(0.5, -0.5), Complex(0, -0.1)}};
const Vector kFrequencies{{1.0, 2.0, 4.0}};

std::string refusal(const ComplexVector& H, const Vector& w, const Vector& variance, double Ts = 0,
                    InterSample inter_sample = InterSample::kBandLimited) {
    return thrown_message([&] { frequency_data(H, w, variance, Ts, inter_sample); });
}

TEST(frequency_data, are_put_in_order) {  // oracle: sorted by hand
    const FrequencyData data = frequency_data(kResponse, Vector{{4.0, 1.0, 2.0}}, Vector{{0.3, 0.1, 0.2}});
    EXPECT_EQ(data.w, kFrequencies);
    EXPECT_EQ(data.response, (ComplexVector{{Complex(0.5, -0.5), Complex(0, -0.1), Complex(1, 0)}}));
    EXPECT_EQ(data.variance, (Vector{{0.1, 0.2, 0.3}}));
    EXPECT_EQ(frequency_data(kResponse, kFrequencies, Vector{{0.5}}).variance, Vector::Constant(3, 0.5));
}

TEST(frequency_data, that_cannot_be_are_refused_with_place_and_value) {
    const Vector none;
    EXPECT_THAT(refusal(kResponse, Vector{{0.0, 1.0, 2.0}}, none), HasSubstr("positive (rad/s), but frequency 1 is 0"));
    EXPECT_THAT(refusal(kResponse, Vector{{1.0, -2.0, 3.0}}, none), HasSubstr("is -2; remove it"));
    EXPECT_THAT(refusal(kResponse, Vector{{1.0, 1.0, 3.0}}, none), HasSubstr("1 rad/s occurs several times"));
    EXPECT_THAT(refusal(kResponse, Vector{{1.0, 2.0}}, none), HasSubstr("each frequency (2), but has 3"));
    EXPECT_THAT(refusal(kResponse, kFrequencies, Vector{{1.0, 2.0}}), HasSubstr("each frequency (3), but has 2"));
    EXPECT_THAT(refusal(kResponse, kFrequencies, Vector{{1.0, 0.0, 1.0}}),
                HasSubstr("variances must be positive, but the variance at frequency 2, 2 rad/s, is 0"));
    EXPECT_THAT(refusal(kResponse, kFrequencies, none, 1),
                HasSubstr("frequencies must not exceed pi/Ts = 3.1416 rad/s"));
    EXPECT_THAT(refusal(kResponse, kFrequencies, none, -1), HasSubstr("must be nonnegative"));
    EXPECT_THAT(refusal(kResponse, kFrequencies, none, 0, InterSample::kZoh), HasSubstr("needs the sampling time"));
    EXPECT_THAT(refusal(ComplexVector(), Vector(), none), HasSubstr("the response has no frequencies"));
    const ComplexVector broken{{Complex(1, 0), Complex(kNaN, 0), Complex(0, 0)}};
    EXPECT_THAT(refusal(broken, kFrequencies, none), HasSubstr("at frequency 2, 2 rad/s, is not a finite number"));
}

}  // namespace test_frequency_data
