#include "numerics/fit/recursive/recursive_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "support/recursive_cases.h"
#include "support/thrown_message.h"

namespace test_recursive_pass {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

TEST(recursive_pass, the_history_ends_with_the_estimate) {  // oracle: definition
    const IdData data = course_system_data(0.1, 3);
    for (const RecursiveMethod kind :
         {RecursiveMethod::kLeastSquares, RecursiveMethod::kInstruments, RecursiveMethod::kRefined})
        for (const Index points : {1, 7, 1500, 100'000}) {
            RecursiveOptions options = recursive(3);
            options.history_points = points;
            const Fit fit =
                recursive_pass({"a test", Message("A pass")}, kind, data, TransferStructure::single(2, 0), options);
            const Index count = fit.history->t.size();
            EXPECT_EQ(count, std::min<Index>(points, 1500)) << points;
            EXPECT_EQ(fit.history->theta.row(count - 1).transpose(), fit.theta);
            EXPECT_LT(relative_difference(fit.history->std.row(count - 1).transpose(), fit.std), 1e-12);
            EXPECT_NEAR(fit.history->t[count - 1], 14.99, 1e-9);
            EXPECT_THAT(message_text(fit.full_message()), HasSubstr("A pass, recursive"));
        }
}

TEST(recursive_pass, messages_begin_with_the_method) {  // oracle: the sentence
    RecursiveOptions options = recursive(3);
    options.history_points = 0;
    EXPECT_THAT(thrown_message([&] {
                    recursive_pass({"a test", Message("A pass")}, RecursiveMethod::kRefined, course_system_data(0.1, 3),
                                   TransferStructure::single(2, 0), options);
                }),
                testing::StartsWith("a test: `history_points` must be at least 1"));
}

}  // namespace test_recursive_pass
