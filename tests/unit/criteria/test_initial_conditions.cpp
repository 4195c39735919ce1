#include <gtest/gtest.h>

#include <cmath>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/error.h"

namespace test_initial_conditions {

using namespace dynlab;

const Vector kStep{{2.0, 2.0, 5.0, 5.0}}, kFlat{{3.0, 3.0, 3.0, 3.0}}, kRich{{1.0, -1.0, 1.0, 1.0}};

TEST(initial_conditions, operating_point_of_a_step_lies_before_it) {  // oracle: definition
    const Vector y{{10.0, 12.0, 11.0, 40.0}};
    EXPECT_EQ(joint_operating_point(kStep, y).inputs[0], 2);
    EXPECT_EQ(joint_operating_point(kStep, y).output, 11);
    EXPECT_EQ(joint_operating_point(kFlat, y).inputs[0], 0);
    EXPECT_EQ(joint_operating_point(kFlat, y).output, 0);
    EXPECT_EQ(joint_operating_point(kRich, y).inputs[0], 0.5);
    EXPECT_EQ(joint_operating_point(kRich, y).output, y.mean());
}

TEST(initial_conditions, automatic_choices_can_be_distinguished) {  // oracle: identifiability
    EXPECT_EQ(start_conditions(kStep, InitialState::kAuto, Offset::kAuto).size(), 6u);
    EXPECT_EQ(start_conditions(kFlat, InitialState::kAuto, Offset::kAuto).size(), 3u);
    EXPECT_EQ(start_conditions(Vector{{0.0, 1.0}}, InitialState::kAuto, Offset::kAuto).size(), 4u);
    EXPECT_EQ(start_conditions(kStep, InitialState::kAuto, Offset::kNone).size(), 3u);
    EXPECT_EQ(start_conditions(kStep, InitialState::kZero, Offset::kAuto).size(), 2u);
    const auto one = start_conditions(kStep, InitialState::kSteady, Offset::kEstimate);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].state, InitialState::kSteady);
    EXPECT_TRUE(one[0].offset);
    EXPECT_FALSE(start_conditions(kStep, InitialState::kZero, Offset::kRemove)[0].offset);
}

TEST(initial_conditions, refuses_what_a_constant_input_cannot_show) {
    EXPECT_THROW(start_conditions(kFlat, InitialState::kSteady, Offset::kNone), InvalidArgument);
    EXPECT_THROW(start_conditions(kFlat, InitialState::kEstimate, Offset::kEstimate), InvalidArgument);
    EXPECT_EQ(start_conditions(kFlat, InitialState::kEstimate, Offset::kAuto).size(), 1u);
}

TEST(initial_conditions, bic_prefers_fewer_parameters_of_perfect_fits) {  // oracle: definition
    EXPECT_LT(bic_of_loss(1e-32, 1, 100, 2), bic_of_loss(1e-33, 1, 100, 3));
    EXPECT_NEAR(bic_of_loss(0.5, 1, 100, 3), std::log(0.5) + 0.03 * std::log(100.0), 1e-15);
}

TEST(initial_conditions, several_inputs_rest_together) {  // oracle: the definition
    const Index N = 10;
    Matrix u = Matrix::Zero(N, 2);
    u.col(0).tail(4).setConstant(3);
    u.col(1).tail(6).setConstant(-1);
    u.col(1).array() += 2;
    const Vector y = Vector::LinSpaced(N, 0, 9);
    const auto steps = joint_operating_point(u, y);
    EXPECT_EQ(steps.inputs, (Vector{{0.0, 2.0}}));
    EXPECT_EQ(steps.output, 2);  // the mean of 0, 1, 2, 3, 4: the second input steps first, at sample 4
    u(2, 0) = 7;                 // no longer one step each
    const auto swinging = joint_operating_point(u, y);
    EXPECT_EQ(swinging.inputs, Vector(u.colwise().mean().transpose()));
    EXPECT_EQ(swinging.output, 4.5);
    EXPECT_EQ(start_conditions(Matrix::Ones(N, 2), InitialState::kAuto, Offset::kAuto).size(), 3u);
    EXPECT_EQ(start_conditions(u, InitialState::kAuto, Offset::kAuto).size(), 6u);
}

}  // namespace test_initial_conditions
