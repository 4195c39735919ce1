// Penalties that need a look. Oracle: the rule in the help of grade, and calendar and clock by hand.
#include "course/grading/late_penalties.h"

#include <gmock/gmock.h>

#include "base/reader.h"

namespace dynlab::test {
namespace test_late_penalties {
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> texts(const std::vector<Message>& messages) {
    std::vector<std::string> all;
    for (const Message& message : messages) all.push_back(message_text(message));
    return all;
}

WorkItem item_late_by(const std::string& name, std::int64_t seconds, bool confirmed) {
    WorkItem item;
    item.submission.name = name;
    item.lateness = lateness_of({1'000'000, 900, 10, 100}, 1'000'000 + seconds);
    if (needs_confirmation(item.lateness) && !confirmed) item.lateness = unconfirmed(item.lateness);
    return item;
}

// oracle: 10 percent for each day or part of a day beyond 15 minutes of grace
TEST(late_penalties, half_the_points_or_more_wait_for_the_instructor) {
    ClassWork work;
    work.items = {item_late_by("a", 6338 * 3600L, false), item_late_by("b", 3600, false),
                  item_late_by("c", 5 * 86400, true), item_late_by("d", 900, false)};
    EXPECT_EQ(work.items[0].lateness.percent, 0);
    EXPECT_EQ(work.items[1].lateness.percent, 10);
    EXPECT_EQ(work.items[2].lateness.percent, 50) << "the time of receipt is confirmed";
    EXPECT_EQ(work.items[3].lateness.percent, 0);
    EXPECT_THAT(message_text(work.items[0].lateness.reason),
                HasSubstr("this penalty of 100 % is not applied until your instructor confirms it"));
    conclude_lateness(work);
    EXPECT_THAT(
        texts(work.late),
        ElementsAre("\"a\" is late by 264 d 2 h; a penalty of 100 % of the points is not applied until you confirm it",
                    "\"b\" is late by 1 h; the penalty is 10 % of the points",
                    "\"c\" is late by 5 d; the penalty is 50 % of the points"));
    EXPECT_EQ(work.unconfirmed, 1);
    ASSERT_EQ(work.attention.size(), 1u);
    EXPECT_THAT(texts(work.attention)[0],
                AllOf(HasSubstr("\"a\" arrived 264 d 2 h after"), HasSubstr("--accept-late")));
}

}  // namespace test_late_penalties
}  // namespace dynlab::test
