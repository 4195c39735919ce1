#include "platform/terminal/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "platform/temporary_folder.h"
#include "support/pseudo_terminal.h"

namespace dynlab {
namespace test_progress {

using namespace std::chrono_literals;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A command that another process waits for. Oracle: the share of its steps.
TEST(progress, a_command_says_how_far_it_is_in_the_file_of_its_environment) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "progress";
    write_progress(1, 4);  // not requested
    EXPECT_EQ(progress_in(file), std::nullopt);
    ::setenv(kFileOfProgress, file.c_str(), 1);
    write_progress(1, 4);
    ::unsetenv(kFileOfProgress);
    EXPECT_EQ(progress_in(file), 0.25);
}

// Oracle: half of the work in 3 s leaves 3 s; a quarter in 60 s leaves 180 s.
TEST(progress, line_shows_bar_count_and_time_left) {
    EXPECT_EQ(progress_line("runs", 50, 100, 3.0), "runs  [##########----------]  50/100  3 s left");
    EXPECT_EQ(progress_line("runs", 25, 100, 60.0), "runs  [#####---------------]  25/100  3 min left");
    EXPECT_EQ(progress_line("runs", 0, 10, 1.0), "runs  [--------------------]  0/10");
    EXPECT_EQ(progress_line("runs", 12, 10, 1.0), "runs  [####################]  10/10  0 s left");
    EXPECT_EQ(progress_line("LaTeX", 0, 0, 1.0), "LaTeX");
}

void work_for_a_while() {
    ProgressBar bar("runs", 10);
    bar.advance(1);  // too early to be shown
    std::this_thread::sleep_for(350ms);
    bar.advance(7);
}

TEST(progress, is_silent_in_a_pipe) {
    EXPECT_EQ(test::written_to_a_pipe(work_for_a_while), "");
}

TEST(progress, appears_on_a_terminal_and_clears_its_line) {
    const std::string shown = test::written_to_a_terminal(work_for_a_while);
    EXPECT_THAT(shown, Not(HasSubstr(" 1/10")));
    EXPECT_THAT(shown, HasSubstr("runs  [##############------]  7/10"));
    EXPECT_THAT(shown, EndsWith("\r\033[K"));
}

/// Where another process shows the work, it hears the same numbers, and that the bar is over.
TEST(progress, can_be_sent_to_a_listener) {
    std::vector<std::pair<std::size_t, std::size_t>> reported;
    ProgressBar::set_listener([&](std::size_t done, std::size_t total) { reported.emplace_back(done, total); });
    EXPECT_EQ(test::written_to_a_terminal(work_for_a_while), "");
    ProgressBar::set_listener({});
    EXPECT_THAT(reported, testing::ElementsAre(std::pair(7u, 10u), std::pair(0u, 0u)));
}

}  // namespace test_progress
}  // namespace dynlab
