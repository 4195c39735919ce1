// Oracle: the definitions in plain_words.h.
#include "platform/text/plain_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dynlab {
namespace test_plain_words {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(plain_words, accents_ligatures_and_case_do_not_count) {
    EXPECT_THAT(plain_words("Procédé À Cœur: ÇÜß"), ElementsAre("procede", "a", "coeur", "cuss"));
    EXPECT_THAT(plain_words("e\u0301tude \uFB01gure \uFB03x"), ElementsAre("etude", "figure", "ffix"));
}

TEST(plain_words, hyphens_join_and_apostrophes_part) {
    EXPECT_THAT(plain_words("Pre-processing, pre\u2011processing"), ElementsAre("preprocessing", "preprocessing"));
    EXPECT_THAT(plain_words("l'entrée d\u2019un"), ElementsAre("l", "entree", "d", "un"));
    EXPECT_THAT(plain_words("3.1 (two)"), ElementsAre("3", "1", "two"));
    EXPECT_THAT(plain_words(" \u03C9 -- \n"), IsEmpty());
}

TEST(plain_words, broken_utf8_is_no_word_and_not_printed) {
    EXPECT_THAT(plain_words("a\xFFz \xC3"), ElementsAre("a", "z"));
    EXPECT_EQ(printable("a\xFF\x1B[31m\nb\u202E\u00E9"), "a??[31m?b?\u00E9");
    EXPECT_EQ(printable("abcdef", 3), "abc…");
    EXPECT_EQ(printable("abc", 3), "abc");
    EXPECT_EQ(printable("\xE2\x82"), "??");
}

}  // namespace test_plain_words
}  // namespace dynlab
