// Oracle: the rules, written down case by case.
#include "numerics/validation/model_assessment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"

namespace test_model_assessment {

using namespace dynlab;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string quality_text(const ModelEvidence& model) {
    return message_text(model_quality_message(model));
}

TEST(model_assessment, good_models_only_are_called_good) {
    EXPECT_EQ(quality_text({}), "The tests show no missing dynamics, and the standard errors of the model are valid.");
    const auto not_good = Not(HasSubstr("The tests show no missing dynamics"));
    EXPECT_THAT(quality_text({.unstable = true}), not_good);
    EXPECT_THAT(quality_text({.fit_percent = 5}), not_good);
    EXPECT_THAT(quality_text({.fit_percent = -30}), not_good);
    EXPECT_THAT(quality_text({.white = false}), not_good);
    EXPECT_THAT(quality_text({.independent = false}), not_good);
    EXPECT_THAT(quality_text({.doubts = {.undetermined = {"a2", "b2"}}}), not_good);
}

TEST(model_assessment, the_gravest_comes_first) {
    EXPECT_THAT(quality_text({.fit_percent = 5, .unstable = true}), StartsWith("The model is unstable"));
    EXPECT_THAT(quality_text({.fit_percent = 5, .white = false}), StartsWith("The model explains little"));
    EXPECT_THAT(
        quality_text({.fit_percent = 5, .independent = false}),
        testing::AllOf(StartsWith("The model explains little"), HasSubstr("The model does not describe all dynamics")));
    EXPECT_THAT(quality_text({.white = false, .doubts = {.undetermined = {"b0"}}}),
                HasSubstr("do not reliably determine b0"));
    EXPECT_THAT(quality_text({.white = false}), HasSubstr("the dynamics. The disturbance is colored:"));
    EXPECT_THAT(quality_text({.white = false, .tested = false}), HasSubstr("cannot distinguish them"));
    EXPECT_THAT(quality_text({.fit_percent = 38, .white = false}),
                testing::AllOf(Not(HasSubstr("model describes the dynamics")), HasSubstr("(fit 38 %)"),
                               HasSubstr("nonlinearity")));
}

TEST(model_assessment, known_causes_come_before_missing_dynamics) {
    const ModelEvidence remedy{
        .independent = false, .acts_at_once = true, .start = Message("B."), .doubts = {.remedy = Message("A.")}};
    EXPECT_EQ(quality_text(remedy), "A.");
    const ModelEvidence start{.independent = false, .acts_at_once = true, .start = Message("B.")};
    EXPECT_EQ(quality_text(start), "B.");
    EXPECT_THAT(quality_text({.independent = false, .acts_at_once = true}), HasSubstr("direct feedthrough"));
    EXPECT_THAT(quality_text({.independent = false, .acts_earlier = true}), HasSubstr("shorter delay"));
    EXPECT_THAT(quality_text({.independent = false}), StartsWith("The model does not describe all dynamics"));
}

// A remedy for one output, and its parameters, do not appear under another.
TEST(model_assessment, doubts_about_one_output_keep_to_it) {
    const ModelDoubts both{{"a1", "b0_y1", "b0_y2", "b1_y2u1", "b0_y12"}, Message("Take a pole."), "position"};
    const ModelDoubts angle = both.about(0, "angle"), position = both.about(1, "position");
    EXPECT_THAT(angle.undetermined, testing::ElementsAre("a1", "b0_y1"));
    EXPECT_TRUE(angle.remedy.empty());
    EXPECT_THAT(position.undetermined, testing::ElementsAre("a1", "b0_y2", "b1_y2u1"));
    EXPECT_EQ(message_text(position.remedy), "Take a pole.");
    EXPECT_EQ(message_text(ModelDoubts{{}, Message("Take a pole."), ""}.about(0, "y1").remedy), "Take a pole.");
}

}  // namespace test_model_assessment
