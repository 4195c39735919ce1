#include "numerics/signals/segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/error.h"
#include "support/thrown_message.h"

namespace test_segments {

using namespace dynlab;
using testing::HasSubstr;

IdData counted(Index count) {
    const Vector y = Vector::LinSpaced(count, 1, static_cast<double>(count));
    return IdData(Matrix(y), Matrix(-y), 0.5);
}

TEST(segments, kept_stretches_become_experiments_with_their_times) {  // oracle: definition
    const IdData kept = keep_segments(counted(10), {{7, 8}, {1, 3}});
    ASSERT_EQ(kept.experiments.size(), 2u);
    EXPECT_EQ(kept.experiments[0].y, (Vector{{7, 8}}));
    EXPECT_EQ(kept.experiments[0].u, (Vector{{-7, -8}}));
    EXPECT_EQ(kept.time(0), (Vector{{3.0, 3.5}}));
    EXPECT_EQ(kept.experiments[1].y, (Vector{{1, 2, 3}}));
    EXPECT_EQ(kept.experiments[1].name, "samples 1 to 3");
}

TEST(segments, discarding_keeps_the_rest) {  // oracle: by hand; overlaps joined, short leftovers dropped
    const IdData rest = discard_segments(counted(20), {{9, 12}, {4, 5}, {11, 14}, {16, 17}});
    ASSERT_EQ(rest.experiments.size(), 3u);
    EXPECT_EQ(rest.experiments[0].y, (Vector{{1, 2, 3}}));
    EXPECT_EQ(rest.experiments[1].y, (Vector{{6, 7, 8}}));
    EXPECT_EQ(rest.experiments[2].y, (Vector{{18, 19, 20}}));
    EXPECT_EQ(discard_segments(counted(20), {{9, 12}, {14, 20}}, 1).experiments.size(), 2u);
}

TEST(segments, refuses_stretches_outside_the_record) {
    for (const Segment& wrong : {Segment{0, 3}, Segment{3, 11}, Segment{5, 4}}) {
        EXPECT_THAT(thrown_message([&] { keep_segments(counted(10), {wrong}); }),
                    HasSubstr("the data have samples 1 to 10"));
        EXPECT_THROW(discard_segments(counted(10), {wrong}), InvalidArgument);
    }
    EXPECT_THROW(keep_segments(counted(10), {}), InvalidArgument);
    EXPECT_THAT(thrown_message([] {
                    discard_segments(counted(10), {{1, 9}});
                }),
                HasSubstr("no range of at least 2 samples would remain"));
    const IdData two = IdData::merge({counted(3), counted(3)});
    EXPECT_THAT(thrown_message([&] { keep_segments(two, {{1, 2}}); }), HasSubstr("select one with data:experiment(k)"));
}

}  // namespace test_segments
