// Oracle: the fit with the initial state estimated.
#include "numerics/estimators/grey_box/missed_initial_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/number_text.h"
#include "base/reader.h"
#include "support/grey_cases.h"
#include "support/transfer_cases.h"

namespace test_missed_initial_state {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

GreyModel lag_of_second_order() {
    return grey_model({{"a1", 1, 0}, {"a2", 1, 0}, {"b", 1}}, {"y", "dy"}, [](const Variables& v) -> std::vector<Term> {
        return {v.x[1], v.p[2] * v.u - v.p[0] * v.x[1] - v.p[1] * v.x[0]};
    });
}

TEST(missed_initial_state, is_reported_for_a_record_that_begins_in_a_movement) {
    const IdData cut = course_system_data(0.2, 5).range(301, 900);
    const GreyFit from_rest = greyest(cut, lag_of_second_order());
    GreyOptions options;
    options.initial_state = GreyStart::kEstimate;
    const GreyFit free = greyest(cut, lag_of_second_order(), options);
    const auto reported = missed_initial_state(cut, from_rest, Vector::Ones(1));
    ASSERT_GT(free.fit.fit_percent[0], from_rest.fit.fit_percent[0] + 1);
    ASSERT_TRUE(reported.has_value());
    EXPECT_THAT(message_text(from_rest.fit.full_message()), HasSubstr(message_text(*reported)));
    EXPECT_THAT(message_text(*reported),
                HasSubstr("about " + number_text(free.fit.fit_percent[0], 3) + " % instead of " +
                          number_text(from_rest.fit.fit_percent[0], 3) + " %"));
    EXPECT_FALSE(missed_initial_state(cut, free, Vector::Ones(1)).has_value());
}

TEST(missed_initial_state, is_not_reported_for_a_record_from_rest) {
    const IdData data = course_system_data(0.2, 5);
    EXPECT_FALSE(missed_initial_state(data, greyest(data, lag_of_second_order()), Vector::Ones(1)).has_value());
}

}  // namespace test_missed_initial_state
