// Predictions that the user types before a run. Oracle: the sentences, written here by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_predictions {

using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

TEST(predictions, stand_beside_what_was_found) {
    EXPECT_EQ(printed("predict_first('delay', 0.3, 's')\nreveal('delay', 0.24)"),
              "delay: prediction 0.3 s, result 0.24 s (off by 25 %)\n");
    EXPECT_EQ(printed("predict_first('x', 1.097)\nreveal('x', 1)"), "x: prediction 1.097, result 1 (off by 10 %)\n");
    EXPECT_EQ(printed("predict_first('x', 1.0000001)\nreveal('x', 1)"),
              "x: prediction 1, result 1 (off by less than 0.01 %)\n");
    EXPECT_EQ(printed("predict_first('poles', 3)\nreveal('poles', 3)"), "poles: prediction 3, result 3 (off by 0 %)\n");
    EXPECT_EQ(printed("predict_first('gain', -10, '%')\nreveal('gain', -13.87)"),
              "gain: prediction -10 %, result -13.87 % (off by 3.9 percentage points)\n")
        << "28 % would read as points";
    EXPECT_EQ(printed("predict_first('gain', 4, '%')\nreveal('gain', 0)"),
              "gain: prediction 4 %, result 0 % (off by 4 percentage points)\n");
    EXPECT_EQ(printed("predict_first('gain', 2, '%')\nreveal('gain', 3)"),
              "gain: prediction 2 %, result 3 % (off by 1 percentage point)\n");
    EXPECT_EQ(printed("predict_first('mean', 1)\nreveal('mean', 0)"), "mean: prediction 1, result 0\n");
}

TEST(predictions, that_are_missing_are_reported_and_stop_nothing) {
    EXPECT_EQ(printed("predict_first('delay', nil, 's')\nreveal('delay', 0.24)"),
              "delay: no prediction yet; replace nil with your number\ndelay: result 0.24 s, no prediction\n");
}

TEST(predictions, are_made_once_and_before) {
    EXPECT_THAT(error_of("predict_first('a', 1)\npredict_first('a', 2)"),
                HasSubstr("the prediction \"a\" already exists"));
    EXPECT_THAT(error_of("reveal('a', 1)"), HasSubstr("no prediction is named \"a\""));
    EXPECT_THAT(error_of("predict_first('a', 'much')"), HasSubstr("your prediction"));
}

}  // namespace test_predictions
