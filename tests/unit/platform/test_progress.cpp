#include "platform/progress.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <thread>

namespace dynlab {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// Oracle: half of the work in 3 s leaves 3 s; a quarter in 60 s leaves 180 s.
TEST(progress, line_shows_bar_count_and_time_left) {
    EXPECT_EQ(progress_line("runs", 50, 100, 3.0, 80), "runs  [##########----------]  50/100  3 s left");
    EXPECT_EQ(progress_line("runs", 25, 100, 60.0, 80), "runs  [#####---------------]  25/100  3 min left");
    EXPECT_EQ(progress_line("runs", 0, 10, 1.0, 80), "runs  [--------------------]  0/10");
    EXPECT_EQ(progress_line("runs", 12, 10, 1.0, 80), "runs  [####################]  10/10  0 s left");
    EXPECT_EQ(progress_line("LaTeX", 0, 0, 1.0, 80), "LaTeX");
    EXPECT_EQ(progress_line("a long description", 5, 10, 1.0, 6), "a long");
}

/// What a bar prints on standard error while that is the far end of `fd`.
template <class Action>
void with_standard_error(int fd, Action action) {
    const int before = dup(STDERR_FILENO);
    dup2(fd, STDERR_FILENO);
    action();
    dup2(before, STDERR_FILENO);
    close(before);
}

std::string waiting_in(int fd) {
    pollfd ready{fd, POLLIN, 0};
    char text[4096];
    std::string all;
    while (poll(&ready, 1, 50) == 1 && (ready.revents & POLLIN)) {
        const ssize_t count = read(fd, text, sizeof text);
        if (count <= 0) break;
        all.append(text, static_cast<std::size_t>(count));
    }
    return all;
}

void work_for_a_while() {
    ProgressBar bar("runs", 10);
    bar.advance(1);  // too early to be shown
    std::this_thread::sleep_for(350ms);
    bar.advance(7);
}

TEST(progress, is_silent_in_a_pipe) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    with_standard_error(ends[1], work_for_a_while);
    EXPECT_EQ(waiting_in(ends[0]), "");
    close(ends[0]), close(ends[1]);
}

TEST(progress, appears_on_a_terminal_and_clears_its_line) {
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_TRUE(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
    const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
    ASSERT_GE(terminal, 0);
    with_standard_error(terminal, work_for_a_while);
    const std::string shown = waiting_in(master);
    EXPECT_THAT(shown, testing::Not(HasSubstr(" 1/10")));
    EXPECT_THAT(shown, HasSubstr("runs  [##############------]  7/10"));
    EXPECT_TRUE(shown.size() > 4 && shown.substr(shown.size() - 4) == "\r\033[K");
    close(terminal), close(master);
}

}  // namespace
}  // namespace dynlab
