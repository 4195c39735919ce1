#include <gtest/gtest.h>

#include <cmath>

#include "numerics/fit/output_error.h"
#include "numerics/signals/random.h"

namespace test_start_choice {

using namespace dynlab;

const std::vector<StartCondition> kThree = {
    {InitialState::kZero, false}, {InitialState::kSteady, false}, {InitialState::kEstimate, false}};

/// The place of the fit that is kept, with these values of BIC and ends, where only some have enough samples.
int kept(const std::vector<double>& bic, const std::vector<bool>& enough, const std::vector<Termination>& ends,
         int* fitted = nullptr) {
    constexpr Index kSamples = 50;
    const IdData data(Matrix(RandomStream(1).normal(kSamples)), Matrix(RandomStream(2).normal(kSamples)), 1);
    int count = 0;
    const auto place = [](const StartCondition& c) { return static_cast<std::size_t>(c.state); };
    const Fit best = fit_output_error({"method", data, kThree,
                                       [&](const StartCondition& c) { return enough[place(c)] ? 0 : kSamples; },
                                       [&](const StartCondition& c) {
                                           ++count;
                                           Fit fit;
                                           fit.start = c;
                                           fit.loss = std::exp(bic[place(c)]);  // without parameters its BIC
                                           fit.termination = ends[place(c)];
                                           return fit;
                                       }});
    if (fitted != nullptr) *fitted = count;
    return static_cast<int>(best.start.state);
}

TEST(start_choice, keeps_the_smallest_bic) {  // oracle: the definition
    const std::vector<Termination> settled(3, Termination::kConverged);
    EXPECT_EQ(kept({3, 1, 2}, {true, true, true}, settled), 1);
    EXPECT_EQ(kept({1, 1, 2}, {true, true, true}, settled), 0) << "the first of equals has fewest parameters";
    EXPECT_EQ(kept({3, 1, 2}, {true, false, true}, settled), 2) << "too few samples for the second";
    EXPECT_EQ(kept({3, 1, 2}, {false, false, false}, settled), 0) << "the first is always fitted";
}

TEST(start_choice, a_canceled_fit_ends_it) {  // oracle: the definition
    int fitted = 0;
    EXPECT_EQ(kept({3, 1, 0}, {true, true, true},
                   {Termination::kConverged, Termination::kCanceled, Termination::kConverged}, &fitted),
              1);
    EXPECT_EQ(fitted, 2);
}

}  // namespace test_start_choice
