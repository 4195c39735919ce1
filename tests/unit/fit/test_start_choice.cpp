#include <gtest/gtest.h>

#include "numerics/fit/start_choice.h"

namespace test_start_choice {

using namespace dynlab;

struct Named {
    int name = 0;
    Termination termination = Termination::kConverged;
};

const std::vector<StartCondition> kThree = {
    {InitialState::kZero, false}, {InitialState::kSteady, false}, {InitialState::kEstimate, false}};

/// The name of the fit that is kept, with these values of BIC and ends, where only some have enough samples.
int kept(const std::vector<double>& bic, const std::vector<bool>& enough, const std::vector<Termination>& ends,
         int* fitted = nullptr) {
    int count = 0;
    const Named best = smallest_bic(
        kThree, [&](const StartCondition& c) { return enough[static_cast<std::size_t>(c.state)]; },
        [&](const StartCondition& c) {
            ++count;
            const auto i = static_cast<std::size_t>(c.state);
            return Candidate<Named>{{static_cast<int>(i), ends[i]}, bic[i]};
        });
    if (fitted != nullptr) *fitted = count;
    return best.name;
}

TEST(start_choice, keeps_the_smallest_bic) {  // oracle: the definition
    const std::vector<Termination> settled(3, Termination::kConverged);
    EXPECT_EQ(kept({3, 1, 2}, {true, true, true}, settled), 1);
    EXPECT_EQ(kept({1, 1, 2}, {true, true, true}, settled), 0) << "the first of equals has fewest parameters";
    EXPECT_EQ(kept({3, 1, 2}, {true, false, true}, settled), 2) << "too few samples for the second";
    EXPECT_EQ(kept({3, 1, 2}, {false, false, false}, settled), 0) << "the first is always fitted";
}

TEST(start_choice, a_cancelled_fit_ends_it) {  // oracle: the definition
    int fitted = 0;
    EXPECT_EQ(kept({3, 1, 0}, {true, true, true},
                   {Termination::kConverged, Termination::kCancelled, Termination::kConverged}, &fitted),
              1);
    EXPECT_EQ(fitted, 2);
}

}  // namespace test_start_choice
