#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/fit/diagnosis.h"
#include "support/message_texts.h"
#include "support/transfer_cases.h"

namespace test_diagnosis {

using namespace dynlab;
using namespace dynlab::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A fit of one channel, every parameter known to 1 %.
Fit fit_of(int poles, int zeros, const Vector& theta) {
    Fit fit;
    fit.structure = TransferStructure::single(poles, zeros);
    fit.theta = theta;
    fit.covariance = (0.01 * theta).cwiseAbs2().asDiagonal();
    fit.condition_number = 10;
    fit.fit_percent = values({93.214});
    return fit;
}

TEST(diagnosis, of_models) {  // oracle: poles and zeros written down
    Fit plain = fit_of(2, 0, values({4, 3, 2}));
    describe_models(plain);
    EXPECT_THAT(plain.warnings, IsEmpty());
    EXPECT_THAT(plain.names, ElementsAre("a1", "a2", "b0"));
    EXPECT_LT((plain.std - values({0.04, 0.03, 0.02})).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_NEAR(plain.models.front().dc_gain(), 2.0 / 3, 1e-15);
    Fit canceling = fit_of(2, 1, values({4, 3, 2, 2.001}));  // (s + 1)(s + 3) over 2 (s + 1.0005)
    describe_models(canceling);
    EXPECT_THAT(texts_of(canceling.warnings),
                ElementsAre(HasSubstr("A pole with a real part of -1 and a zero nearly cancel")));
    Fit unstable = fit_of(2, 0, values({-1, 3, 2}));
    describe_models(unstable);
    EXPECT_THAT(texts_of(unstable.warnings), ElementsAre("The model is unstable. Unless the system is also unstable, "
                                                         "srivc with `stable` = true finds the best stable model."));
}

TEST(diagnosis, of_parameters) {  // oracle: the definition
    Fit fit = fit_of(2, 0, values({4, 3, 2}));
    fit.names = {"a1", "a2", "b0"};
    fit.std = values({5, 1, 3});
    warn_of_doubtful_parameters(fit);
    EXPECT_THAT(texts_of(fit.warnings), ElementsAre(HasSubstr("do not reliably determine a1, b0")));
    fit.warnings.clear();
    fit.names[0] = "Td";  // zero is a delay's own bound
    warn_of_doubtful_parameters(fit);
    EXPECT_THAT(texts_of(fit.warnings), ElementsAre(HasSubstr("do not reliably determine b0")));
    fit.std[1] = std::nan("");  // unknown is not small
    EXPECT_THAT(undetermined_parameters(fit.names, fit.theta, fit.std), ElementsAre("a2", "b0"));
    fit.warnings.clear();
    fit.condition_number = 1e12;
    warn_of_doubtful_parameters(fit, SimplerModel::kFewerBins);
    EXPECT_THAT(texts_of(fit.warnings),
                ElementsAre(testing::AllOf(HasSubstr("do not determine all parameters separately"),
                                           HasSubstr("fewer bins or a richer input"))));
}

TEST(diagnosis, of_delays) {  // oracle: the definition
    const auto said = [](double delay, const DelayRange& range) {
        Fit fit;
        warn_of_delay(fit, delay, range, ChannelPlace{1, 2});
        return texts_of(fit.warnings);
    };
    EXPECT_THAT(said(0.5, {0, 1}), IsEmpty());
    EXPECT_THAT(said(1, {0, 1}), ElementsAre(HasSubstr("to output 2 is `largest_delay` = 1 s")));
    EXPECT_THAT(said(0.2, {0.2, 1}), ElementsAre(HasSubstr("decrease `least_delay`")));
    EXPECT_THAT(said(0, {0, 1}), ElementsAre(HasSubstr("No delay from input 1 to output 2 was detected")));
    EXPECT_THAT(said(0.7, {0.7, 0.7}), ElementsAre(HasSubstr("`least_delay`")));
}

// Oracle: a fit f leaves (1 - f)^2 of the variance, and a quarter has to be explained.
TEST(diagnosis, of_poor_fits) {
    EXPECT_FALSE(explains_little(13.5));
    EXPECT_TRUE(explains_little(13.3));
    EXPECT_TRUE(explains_little(-100));
    EXPECT_TRUE(explains_little(-kInfinity));
    Fit poor = fit_of(1, 0, values({1, 2}));
    poor.fit_percent = values({-4});
    warn_of_delay(poor, 0, {0, 1});
    EXPECT_THAT(poor.warnings, IsEmpty());
    warn_of_delay(poor, 1, {0, 1});
    EXPECT_THAT(texts_of(poor.warnings), ElementsAre(HasSubstr("The delay is `largest_delay`")));
}

TEST(diagnosis, of_unstable_poles) {  // oracle: poles written down
    EXPECT_TRUE(has_unstable_pole(TransferFunction(values({1}), values({1, -0.1}))));
    EXPECT_FALSE(has_unstable_pole(TransferFunction(values({1}), values({1, 3, 0}))));
    EXPECT_TRUE(has_unstable_pole(TransferFunction(values({1}), values({1, -1.1}), 1)));
    EXPECT_FALSE(has_unstable_pole(TransferFunction(values({1}), values({1, -1}), 1)));
}

TEST(diagnosis, of_the_search) {  // oracle: the sentences that scripts promise
    Fit fit = fit_of(1, 0, values({1, 2}));
    FitOptions options;
    options.max_iterations = 7;
    fit.trace.resize(7);
    EXPECT_TRUE(has_settled(fit));
    EXPECT_EQ(message_text(iteration_count(fit)), "7 iterations");
    EXPECT_EQ(message_text(simulation_text(fit)), "fit 93.21 % (simulation)");
    fit.termination = Termination::kIterationLimit;
    EXPECT_FALSE(has_settled(fit));
    describe_search(fit, course_system_data(0, 1), options, {});
    EXPECT_THAT(texts_of(fit.warnings), ElementsAre("The search did not converge within `max_iterations` = 7 "
                                                    "iterations; the result is the best point so far."));
    fit.termination = Termination::kCanceled;
    fit.warnings.clear();
    warn_of_search(fit, options);
    EXPECT_THAT(texts_of(fit.warnings), ElementsAre(HasSubstr("was interrupted")));
    fit.fit_percent = values({50, 60});
    EXPECT_EQ(message_text(simulation_text(fit)), "fit 50 % and 60 % (simulation)");
    fit.fit_percent = values({50, 60, 70});
    EXPECT_EQ(message_text(simulation_text(fit)), "fit 50 % and 60 % and 70 % (simulation)");
    const TransferStructure grid = TransferStructure::grid(2, 2, Denominators::kPerChannel, {1}, {0}, {0});
    ASSERT_TRUE(channel_place(grid, 2));
    EXPECT_EQ(channel_place(grid, 2)->input, 1u);
    EXPECT_EQ(channel_place(grid, 2)->output, 2u);
    EXPECT_FALSE(channel_place(TransferStructure::single(1, 0), 0));
}

TEST(diagnosis, a_delay_that_a_direct_term_hides) {  // oracle: the warning's own condition
    Fit fit = fit_of(1, 1, values({1, 2, 1, 0.3}));
    fit.structure.free_delays = true;
    IdData data = course_system_data(0, 1);
    describe_search(fit, data, {}, {0, 1});
    EXPECT_THAT(texts_of(fit.warnings), testing::Contains(HasSubstr("Fix the delay with `delay`")));
    fit.warnings.clear();
    data.hold = Hold::kFoh;
    describe_search(fit, data, {}, {0, 1});
    EXPECT_THAT(texts_of(fit.warnings), testing::Not(testing::Contains(HasSubstr("Fix the delay"))));
}

}  // namespace test_diagnosis
