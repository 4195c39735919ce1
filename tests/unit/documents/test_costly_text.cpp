// Oracle: what Pandoc 2.17 was seen to take minutes for, and texts that it reads at once.
#include "documents/words/costly_text.h"

#include <gtest/gtest.h>

#include <string>

namespace test_costly_text {

using namespace dynlab;

std::string times(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

bool is_costly(const std::string& text) {
    return CostlyText().line_of(text).has_value();
}

TEST(costly_text, what_is_never_closed_is_refused) {
    for (const char* part : {"a^[b", "![a^[", "[a^[b ", "[@a ^[", "[a][b ", "[a", "^[", "![a", "[@a; ", "[[a"})
        EXPECT_TRUE(is_costly(times(18, part))) << part;
    for (const char* part : {"[a](b \"c ", "[a](b \"c) ", "[a](b 'c) ", "![a](b \"c) ", "[a]: b \"c\n"})
        EXPECT_TRUE(is_costly(times(20, part))) << part;
    for (const char* part : {"<a <b ", "'a ", "&a"}) EXPECT_TRUE(is_costly(times(4000, part))) << part;
    EXPECT_TRUE(is_costly(std::string(20000, '`')));
    EXPECT_TRUE(is_costly(times(14, "[") + "a" + times(14, "]")));
}

TEST(costly_text, many_paragraphs_are_counted_together) {
    EXPECT_FALSE(is_costly(times(8, "[a") + "\n"));
    EXPECT_EQ(CostlyText().line_of(times(100, times(8, "[a") + "\n\n")), 11);
}

TEST(costly_text, ordinary_texts_are_read) {
    EXPECT_FALSE(is_costly(times(200, "[a](b \"c\") and ^[a note [@ref]] in `code[[[[` for $[0, T)$ or [0, 1].\n")));
    EXPECT_FALSE(is_costly("for t in [0, 1[, ]1, 2[ and [2, 3[, where a < b, it's the student's 'own' & theirs"));
    EXPECT_FALSE(is_costly(times(40, "\\[")));
    EXPECT_FALSE(is_costly("```{.lua .numbered}\n" + times(50, "a[[b(\n\n") + "```\n"));
    EXPECT_FALSE(is_costly("```lua\n" + times(5000, "if a < b then x[1] = '' end\n") + "```\n"));
    EXPECT_FALSE(is_costly(std::string(200000, 'a')));
    EXPECT_FALSE(is_costly(times(300'000, "$a ")));
}

// Pandoc takes for text what follows a fence that nothing ends, or that has words behind it.
TEST(costly_text, fences_that_are_none_hide_nothing) {
    const std::string attack = times(18, "a^[b");
    EXPECT_EQ(CostlyText().line_of("```\n\n" + attack), 3);
    EXPECT_EQ(CostlyText().line_of("``` two words\n\n" + attack + "\n\n```\n"), 3);
    EXPECT_EQ(CostlyText().line_of("``` {a}\n\n" + attack + "\n\n```\n"), 3);
    EXPECT_EQ(CostlyText().line_of("```\ncode\n```\ntext\n\n" + attack), 6);
}

}  // namespace test_costly_text
