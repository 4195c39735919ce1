#include "platform/text/shown_order.h"

#include <gtest/gtest.h>

namespace dynlab {
namespace test_shown_order {

// oracle: UAX #9, rules X1 to X8 and L2
TEST(shown_order, signs_that_turn_the_direction_turn_the_letters) {
    EXPECT_EQ(in_shown_order("\u202Ecba"), "abc");
    EXPECT_EQ(in_shown_order("by \u202Eeéoz\u202C and 2026"), "by zoée and 2026");
    EXPECT_EQ(in_shown_order("\u2067\u202Edcba\u202C\u2069"), "abcd");
    EXPECT_EQ(in_shown_order("\u202Dabc\u202C"), "abc") << "from left to right, as ever";
    EXPECT_EQ(in_shown_order("\u202E(b)a"), "a(b)") << "brackets are turned over, rule L4";
}

TEST(shown_order, other_text_stays) {
    for (const char* text : {"", "abc", "שלום abc", "Élise", "half \xC3 a character"})
        EXPECT_EQ(in_shown_order(text), text);
    EXPECT_EQ(in_shown_order("\u202E"), "");
}

}  // namespace test_shown_order
}  // namespace dynlab
