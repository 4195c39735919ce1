#include <gtest/gtest.h>

#include "platform/text/shell_word.h"

namespace dynlab::test {
namespace test_shell_word {

TEST(shell_word, plain_words_stay_and_others_are_quoted) {
    EXPECT_EQ(shell_word("my-work/a_1.lua"), "my-work/a_1.lua");
    EXPECT_EQ(shell_word("Übung"), "Übung");
    EXPECT_EQ(shell_word("Mein Ordner Übung é"), "'Mein Ordner Übung é'");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
    EXPECT_EQ(shell_word("a;b"), "'a;b'");
    EXPECT_EQ(shell_word("~"), "'~'");
    EXPECT_EQ(shell_word(""), "''");
}

}  // namespace test_shell_word
}  // namespace dynlab::test
