#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/models/impulse_estimate.h"
#include "support/thrown_message.h"

namespace test_impulse_estimate {

using namespace dynlab;
using testing::HasSubstr;

ImpulseEstimate estimate_of(const Vector& response) {
    ImpulseEstimate estimate;
    estimate.response = response;
    estimate.null_std = Vector::Ones(response.size());
    return estimate;
}

TEST(impulse_estimate, the_first_response_is_followed_by_another_of_its_sign) {   // oracle: the definition
    ImpulseEstimate late = estimate_of(Vector{{0.1, 9.0, -0.2, 5.0, 6.0, 2.0}});  // a lone peak at lag 1
    read_dead_time(late, 0.1, "s", Hold::kZoh, 3);
    EXPECT_EQ(late.first, 3);
    EXPECT_THAT(message_text(late.message), HasSubstr("the dead time is about 0.2 s (2 samples)"));
    EXPECT_NEAR(late.dead_time.value_or(-1), 0.2, 1e-12);
    ImpulseEstimate on_lines = estimate_of(late.response);  // half of a triangle has passed at its lag
    read_dead_time(on_lines, 0.1, "min", Hold::kFoh, 3);
    EXPECT_THAT(message_text(on_lines.message), HasSubstr("the dead time is about 0.3 min (3 samples)"));
    EXPECT_NEAR(on_lines.dead_time.value_or(-1), 0.3, 1e-12);
    ImpulseEstimate changing = estimate_of(Vector{{5.0, -5.0, -6.0, 0.0}});
    read_dead_time(changing, 0.1, "s", Hold::kZoh, 3);
    EXPECT_EQ(changing.first, 1);
    EXPECT_THAT(message_text(changing.message), HasSubstr("no dead time was detected"));
    ImpulseEstimate none = estimate_of(Vector{{1.0, -2.0, 2.0, 1.0}});
    read_dead_time(none, 0.1, "s", Hold::kZoh, 3);
    EXPECT_FALSE(none.first);
    EXPECT_FALSE(none.dead_time);
    EXPECT_THAT(message_text(none.message), HasSubstr("The response never exceeds"));
}

TEST(impulse_estimate, as_many_lags_as_the_record_bears) {  // oracle: the rule of the header
    EXPECT_EQ(lags_or_default("cra", 0, 10'000), 70);
    EXPECT_EQ(lags_or_default("cra", 0, 100), 20);
    EXPECT_EQ(lags_or_default("cra", 30, 90), 30);
    EXPECT_THAT(thrown_message([] { lags_or_default("cra", 31, 90); }), HasSubstr("cra: 31 lags need at least 93"));
    EXPECT_THAT(thrown_message([] { lags_or_default("cra", -1, 90); }), HasSubstr("must be positive"));
}

}  // namespace test_impulse_estimate
