// Oracle: what a terminal is to show at which time, and that a pipe gets nothing.
#include "platform/terminal/activity_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/terminal/progress.h"
#include "support/pseudo_terminal.h"

namespace dynlab {
namespace test_activity_line {

using namespace std::chrono_literals;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

void print_to_standard_error(const std::string& text) {
    EXPECT_EQ(write(STDERR_FILENO, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

void work_in_parts() {
    ActivityLine line;
    line.begin_step("running");
    line.begin_part("cell 1 of 2");  // over before it could be called long
    line.begin_part("cell 2 of 2");
    ProgressBar bar("runs", 10);
    std::this_thread::sleep_for(1300ms);
    bar.advance(5);
}

TEST(activity_line, reports_times_in_words) {
    EXPECT_EQ(lasting_text("cell 1 of 2", 1.9), "cell 1 of 2  1 s");
    EXPECT_EQ(lasting_text("cell 1 of 2", 125), "cell 1 of 2  2 min 5 s");
}

TEST(activity_line, is_silent_in_a_pipe) {
    EXPECT_EQ(test::written_to_a_pipe(work_in_parts), "");
}

TEST(activity_line, shows_the_step_then_the_part_that_takes_long_with_its_bar) {
    const std::string shown = test::written_to_a_terminal(work_in_parts);
    EXPECT_THAT(shown, HasSubstr("running ..."));
    EXPECT_THAT(shown, Not(HasSubstr("cell 1")));
    EXPECT_THAT(shown, HasSubstr("\r\033[Kcell 2 of 2  1 s"));
    EXPECT_THAT(shown, HasSubstr("cell 2 of 2  1 s  runs  [##########----------]  5/10"));
    EXPECT_THAT(shown, EndsWith("\r\033[K"));
}

TEST(activity_line, does_not_touch_text_whose_line_is_not_over) {
    const std::string shown = test::written_to_a_terminal([] {
        ActivityLine line;
        line.begin_step("running");
        line.print("half a", print_to_standard_error);
        line.begin_step("drawing");
        line.print(" line\n", print_to_standard_error);
        line.begin_step("over");
    });
    EXPECT_THAT(shown, HasSubstr("running ...\r\033[Khalf a line"));
    EXPECT_THAT(shown, Not(HasSubstr("drawing")));
    EXPECT_THAT(shown, HasSubstr("over ..."));
}

}  // namespace test_activity_line
}  // namespace dynlab
