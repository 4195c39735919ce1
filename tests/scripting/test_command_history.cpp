// The kept history. Oracles: the lines that were added, RFC 3629 for what is UTF-8, the stated bounds.
#include "scripting/prompt/command_history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_command_history {
using testing::ElementsAre;
using testing::IsEmpty;

TEST(command_history, keeps_lines_from_session_to_session) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "state/dynlab/history";
    {
        CommandHistory history(file);
        EXPECT_TRUE(history.add("x = 1"));
        EXPECT_FALSE(history.add("x = 1")) << "not twice in a row";
        EXPECT_FALSE(history.add("   "));
        CommandHistory other(file);
        other.add("y = 2");
        EXPECT_TRUE(history.add("z = 3"));
    }
    EXPECT_THAT(CommandHistory(file).lines(), ElementsAre("x = 1", "y = 2", "z = 3"));
    EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0600));
}

TEST(command_history, cleans_what_it_is_given) {
    EXPECT_EQ(clean_line("a\tb\x1b[31mc\r\n\x7f"), "a b[31mc");
    EXPECT_EQ(clean_line("\xc3\xa9\xff\xc3(\xe2\x82\xac\xed\xa0\x80\xc0\x80\xf0\x9f\x90\x88"),
              "\xc3\xa9(\xe2\x82\xac\xf0\x9f\x90\x88");
    EXPECT_EQ(clean_line(std::string("a\0b", 3)), "ab");
    EXPECT_EQ(clean_line("a\xc2\x9b"
                         "31mb"),
              "a31mb")
        << "U+009B starts a terminal sequence";
    CommandHistory history("");
    EXPECT_FALSE(history.add(std::string(CommandHistory::kMaxLineLength + 1, 'x')));
    EXPECT_THAT(history.lines(), IsEmpty());
}

TEST(command_history, is_bounded_and_takes_any_file) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "history";
    std::string text;
    for (std::size_t i = 1; i <= CommandHistory::kMaxLineCount + 500; ++i) text += "line " + std::to_string(i) + '\n';
    write_file_atomically(file, text);
    EXPECT_EQ(CommandHistory(file).lines().size(), CommandHistory::kMaxLineCount);
    EXPECT_EQ(CommandHistory(file).lines().front(), "line 501");
    EXPECT_LT(std::filesystem::file_size(file), text.size());

    std::string bytes;
    for (int i = 0; i < 100'000; ++i) bytes += static_cast<char>((i * 7919) % 256);
    write_file_atomically(file, bytes + std::string(1 << 20, 'x') + "\nlast\n");
    const CommandHistory history(file);
    EXPECT_EQ(history.lines().back(), "last");
    for (const std::string& line : history.lines()) EXPECT_EQ(line, clean_line(line));
}

TEST(command_history, a_place_that_cannot_be_written_stops_no_session) {
    for (const char* place : {"/proc/no/history", "/dev/null/history", "/", "/dev/null"}) {
        CommandHistory history(place);
        EXPECT_TRUE(history.add("x = 1")) << place;
        EXPECT_THAT(history.lines(), ElementsAre("x = 1")) << place;
    }
}

}  // namespace test_command_history
}  // namespace dynlab::test
