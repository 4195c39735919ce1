#include <gtest/gtest.h>

#include "platform/terminal/terminal_text.h"

namespace dynlab {
namespace test_terminal_text {

// Oracle: what ECMA-48 and Unicode's bidirectional algorithm have terminals obey, by code point.
TEST(terminal_text, shows_what_a_terminal_would_obey) {
    EXPECT_EQ(terminal_text("pi\x1B[31mpe\a\b\r\x7F"), "pi?[31mpe????");
    EXPECT_EQ(terminal_text("\u009B31m \u202Eexe.\u2066x\u200F\u061C\u200By"), "?31m ?exe.?x???y");
    EXPECT_EQ(terminal_text("bad \x9B \xC3 end \xF0\x9F"), "bad ? ? end ??");
    EXPECT_EQ(terminal_text(std::string_view("a\0b", 3)), "a?b");
}

TEST(terminal_text, keeps_all_else) {
    const std::string text = "Zoé \"œ\" 5 µm → ½\tline\nnext 日本 \U0001F408";
    EXPECT_EQ(terminal_text(text), text);
    EXPECT_EQ(terminal_text(""), "");
}

TEST(terminal_text, plain_words_of_a_command_stay_and_others_are_quoted) {
    EXPECT_EQ(shell_word("my-work/a_1.lua"), "my-work/a_1.lua");
    EXPECT_EQ(shell_word("Übung"), "Übung");
    EXPECT_EQ(shell_word("Mein Ordner Übung é"), "'Mein Ordner Übung é'");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
    EXPECT_EQ(shell_word("a;b"), "'a;b'");
    EXPECT_EQ(shell_word("~"), "'~'");
    EXPECT_EQ(shell_word(""), "''");
}

}  // namespace test_terminal_text
}  // namespace dynlab
