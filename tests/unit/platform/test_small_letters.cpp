#include <gtest/gtest.h>

#include "platform/text/small_letters.h"

namespace test_small_letters {

using namespace dynlab;

TEST(small_letters, are_those_of_ascii) {
    EXPECT_EQ(in_small_letters("Zoé SAID: ÉTÉ [A-Z]@`{"), "zoé said: ÉtÉ [a-z]@`{");
    EXPECT_EQ(in_small_letters(""), "");
}

TEST(small_letters, endings_begin_with_their_last_dot) {
    EXPECT_EQ(ending_of("a.b/Report.PDF"), ".pdf");
    EXPECT_EQ(ending_of("x.tar.GZ"), ".gz");
    EXPECT_EQ(ending_of("a.b/README"), "");
    EXPECT_EQ(ending_of(".Profile"), "");
}

}  // namespace test_small_letters
