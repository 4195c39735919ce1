// Oracle: what Pandoc 2.17 was seen to take minutes for, and texts that it reads at once or in a few seconds.
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

TEST(costly_text, quotes_that_are_never_closed_are_refused) {
    for (const char* part : {"[a](b \"c ", "[a](b \"c) ", "[a](b 'c) ", "![a](b \"c) ", "[a]: b \"c\n", "\"a 'b "})
        EXPECT_TRUE(is_costly(times(20, part))) << part;
    EXPECT_TRUE(is_costly("[a](b" + times(20, " \"c")));
    EXPECT_TRUE(is_costly("[a]: b\n" + times(20, " \"c")));
    EXPECT_TRUE(is_costly("> - [a](b" + times(20, " 'c")));
}

TEST(costly_text, thousands_of_signs_are_refused) {
    for (const char* part : {"<a <b ", "'a ", "&a", "[a", "[a][b ", "![a](", "[@a; ", "-@a[b ", "^[b"})
        EXPECT_TRUE(is_costly(times(4000, part))) << part;
    EXPECT_TRUE(is_costly(std::string(20000, '`')));
}

TEST(costly_text, blocks_that_are_never_closed_are_refused) {
    EXPECT_EQ(CostlyText().line_of(times(300, "::: a\n")), 201);
    EXPECT_EQ(CostlyText().line_of(times(300, "::: {.a}\n\n")), 401);
    EXPECT_EQ(CostlyText().line_of(times(300, "> ::: a\n")), 201);
    EXPECT_FALSE(is_costly(times(3000, "::: {.note}\ntext\n:::\n\n")));
}

TEST(costly_text, many_paragraphs_are_counted_together) {
    EXPECT_FALSE(is_costly(times(800, "[a") + "\n"));
    EXPECT_EQ(CostlyText().line_of(times(10, times(800, "[a") + "\n\n")), 7);
}

// Pandoc and this count differ on what is code, a formula or a comment: nothing hides there.
TEST(costly_text, code_formulas_lists_and_comments_hide_nothing) {
    const std::string attack = times(20, "[a](b \"c) ");
    EXPECT_EQ(CostlyText().line_of("$a $ " + attack + "x$"), 1);
    EXPECT_EQ(CostlyText().line_of("- `\n- " + attack + "\n- `\n"), 1);
    EXPECT_EQ(CostlyText().line_of("~~~\n```\n~~~\n\n" + attack + "\n\n~~~\n```\n~~~\n"), 5);
    EXPECT_EQ(CostlyText().line_of("<!--\n```\n-->\n\n" + attack + "\n\n<!--\n```\n-->\n"), 5);
    EXPECT_EQ(CostlyText().line_of("```\n\n" + attack + "\n\n```\n"), 3);
}

TEST(costly_text, ordinary_texts_are_read) {
    EXPECT_FALSE(is_costly(times(200, "[a](b \"c\") and ^[a note [@ref]] in `code[[[[` for $[0, T)$ or [0, 1].\n")));
    EXPECT_FALSE(
        is_costly(times(50, "La voie va dans [0, 1[ volts, l'entr\u00e9e aussi [1, 2[ : \u00ab d'accord \u00bb. ")));
    EXPECT_FALSE(is_costly("[l'article](a.pdf 'titre') " + times(100, "l'entr\u00e9e de l'appareil ")));
    EXPECT_FALSE(is_costly(times(100, "\"one 'two' three\" and 'one \"two\" three', \"the student's\" 5\" screen\n")));
    EXPECT_FALSE(is_costly(times(40, "\\[")));
    EXPECT_FALSE(is_costly("```{.lua .numbered}\n" + times(50, "a[[b(\n\n") + "```\n"));
    EXPECT_FALSE(is_costly("```lua\n" + times(5000, "if a < b then x[1] = '' print(\"a\", 'b') end\n") + "```\n"));
    EXPECT_FALSE(is_costly(std::string(200000, 'a')));
    EXPECT_FALSE(is_costly(times(300'000, "$a ")));
}

}  // namespace test_costly_text
