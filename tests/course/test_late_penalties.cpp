// Penalties that need a look. Oracle: the rule in the help of grade, and calendar and clock by hand.
#include "course/grading/late_penalties.h"

#include <gmock/gmock.h>

#include "base/reader.h"
#include "course/grading/deadlines.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace dynlab::test {
namespace test_late_penalties {
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> texts(const std::vector<Message>& messages) {
    std::vector<std::string> all;
    for (const Message& message : messages) all.push_back(message_text(message));
    return all;
}

Lateness late_by(std::int64_t seconds, double percent, bool typed = false) {
    return {static_cast<double>(seconds) / 3600, percent, Message("received late"), seconds, typed};
}

TEST(late_penalties, half_the_points_or_more_wait_for_the_instructor) {
    const TemporaryFolder out;
    LatePenalties penalties(out.path(), false);
    EXPECT_EQ(penalties.counted("a", late_by(6338 * 3600L, 100)).percent, 0);
    EXPECT_EQ(penalties.counted("b", late_by(3600, 10)).percent, 10);
    EXPECT_EQ(penalties.counted("c", late_by(5 * 86400, 50, true)).percent, 50) << "the instructor wrote the time";
    EXPECT_EQ(penalties.counted("d", {}).percent, 0);
    EXPECT_THAT(message_text(penalties.counted("a", late_by(6338 * 3600L, 100)).reason),
                HasSubstr("this penalty of 100 % is not applied until your instructor confirms it"));
    EXPECT_THAT(texts(penalties.late()),
                ElementsAre("\"a\": late by 264 d 2 h, 0 % of its points", "\"b\": late by 1 h, 10 % of its points",
                            "\"c\": late by 5 d, 50 % of its points"));
    ASSERT_EQ(penalties.waiting().size(), 1u);
    EXPECT_THAT(texts(penalties.waiting())[0],
                AllOf(HasSubstr("\"a\" came 264 d 2 h after"), HasSubstr("--accept-late")));
}

TEST(late_penalties, what_was_accepted_stays_so_until_it_costs_more) {
    const TemporaryFolder out;
    {
        LatePenalties penalties(out.path(), true);
        EXPECT_EQ(penalties.counted("a", late_by(6 * 86400, 60)).percent, 60);
        ClassWork work;
        penalties.conclude(work);
        EXPECT_EQ(work.late.size(), 1u);
        EXPECT_THAT(work.unconfirmed, IsEmpty());
    }
    LatePenalties penalties(out.path(), false);
    EXPECT_EQ(penalties.counted("a", late_by(6 * 86400, 60)).percent, 60);
    EXPECT_THAT(penalties.waiting(), IsEmpty());
    EXPECT_EQ(penalties.counted("a", late_by(10 * 86400, 100)).percent, 0);
    EXPECT_EQ(penalties.counted("b", late_by(6 * 86400, 60)).percent, 0);
}

// oracle: the platform's table, which goes before the times of files
TEST(late_penalties, the_platform_s_times_go_before_those_of_files) {
    const EnvironmentVariable zone("TZ", "UTC");
    ::tzset();
    const TemporaryFolder work;
    write_file_atomically(work.path() / "deadlines.csv",
                          "submission,deadline,received\n*,2026-03-09 18:00,\ns2,2026-03-09 18:00,2026-03-09 19:00\n");
    write_file_atomically(work.path() / "times.csv", "id,time\n99345,2026-03-09 17:50\n99346,2026-03-09 17:50\n");
    write_file_atomically(work.path() / "analysis.lua", "saved again today");
    Deadlines deadlines(work.path() / "deadlines.csv");
    deadlines.set_times(ArrivalTimes(work.path() / "times.csv"));
    Submission one{"one", work.path()}, two{"two", work.path()}, three{"three", work.path()};
    one.lms_id = "99345", two.lms_id = "99346";
    EXPECT_EQ(deadlines.of(one, {}).hours, 0);
    EXPECT_EQ(deadlines.of(two, {"s2"}).hours, 1);
    EXPECT_TRUE(deadlines.of(two, {"s2"}).typed);
    EXPECT_GT(deadlines.of(three, {}).hours, 24);
    ::tzset();
}

}  // namespace test_late_penalties
}  // namespace dynlab::test
