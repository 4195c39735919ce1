#include "platform/time_limits.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace dynlab {
namespace test_time_limits {

using namespace std::chrono_literals;

void spin_until(std::chrono::nanoseconds processor) {
    while (processor_time() < processor) continue;
}

TEST(time_limits, seconds_are_those_of_the_limit_that_was_reached) {
    const TimeLimits limits{60s};
    EXPECT_EQ(limits.seconds(TimeLimit::kProcessor), 60);
    EXPECT_EQ(limits.seconds(TimeLimit::kClock), 300);
    EXPECT_EQ((TimeLimits{500ms, 3}.seconds(TimeLimit::kClock)), 1.5);
}

// oracle: sleeping uses no processor time
TEST(time_limits, budget_lasts_while_others_have_the_processor) {
    TimeBudget budget({200ms, 1000});
    std::this_thread::sleep_for(400ms);
    EXPECT_EQ(budget.reached(), TimeLimit::kNone);
    spin_until(processor_time() + 250ms);
    EXPECT_EQ(budget.reached(), TimeLimit::kProcessor);
}

TEST(time_limits, budget_ends_with_the_clock_for_work_that_waits) {
    TimeBudget budget({20ms, 2});
    EXPECT_EQ(budget.reached(), TimeLimit::kNone);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(budget.reached(), TimeLimit::kClock);
}

// oracle: two threads that spin use more than one alone could
TEST(time_limits, budget_counts_all_threads) {
    const auto end = processor_time() + 200ms;
    TimeBudget budget({190ms, 1000});
    std::thread beside([&] { spin_until(end); });
    spin_until(end);
    beside.join();
    EXPECT_EQ(budget.reached(), TimeLimit::kProcessor);
}

TEST(time_limits, of_a_tree_is_what_the_process_counts_itself) {
    spin_until(processor_time() + 100ms);
    const auto own = processor_time();
    const std::chrono::milliseconds counted = processor_time_of_tree(::getpid());
    EXPECT_GE(counted, own - 50ms);
    EXPECT_EQ(processor_time_of_tree(-1), 0ms);
}

}  // namespace test_time_limits
}  // namespace dynlab
