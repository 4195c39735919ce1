#include "platform/spelling.h"

#include <gtest/gtest.h>

namespace dynlab {
namespace test_spelling {

const std::vector<std::string> kNames = {"heat_exchanger", "suspension", "winning_times", "step", "bode"};

// Oracle: distances counted by hand.
TEST(spelling, finds_the_slip) {
    EXPECT_EQ(nearest_word("heatexchanger", kNames), "heat_exchanger");  // one inserted
    EXPECT_EQ(nearest_word("suspenssion", kNames), "suspension");        // one deleted
    EXPECT_EQ(nearest_word("winning_tines", kNames), "winning_times");   // one replaced
    EXPECT_EQ(nearest_word("setp", kNames), "step");                     // neighbors swapped: one of four letters
    EXPECT_EQ(nearest_word("Bode", kNames), "bode");                     // case ignored
}

TEST(spelling, does_not_suggest_unlikely_words) {
    EXPECT_FALSE(nearest_word("crane", kNames));
    EXPECT_FALSE(nearest_word("spet", {"step"}));  // e and p apart: two of four letters
    EXPECT_FALSE(nearest_word("", kNames));
    EXPECT_FALSE(nearest_word("u", {"y"}));
    EXPECT_FALSE(nearest_word("anything", {}));
}

TEST(spelling, takes_the_nearest_of_several) {
    EXPECT_EQ(nearest_word("n4sidd", {"n4sid2x", "n4sid", "nsid"}), "n4sid");
}

}  // namespace test_spelling
}  // namespace dynlab
