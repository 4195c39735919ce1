#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/criteria/grey_output.h"
#include "numerics/signals/prbs.h"
#include "support/grey_cases.h"
#include "support/thrown_message.h"

namespace test_grey_output {

using namespace dynlab;
using namespace dynlab::test;

IdData two_experiments() {
    const Vector u = prbs(4, 3);
    const IdData one(Matrix::Constant(u.size(), 2, 0.1), Matrix(u), 0.1);
    return IdData::merge({one, one.range(3, 30)});
}

TEST(grey_output, sensitivities_of_all_values_agree_with_differences) {  // oracle: central differences of fourth order
    const IdData data = two_experiments();
    GreyModel model = pendulum(5, 1.5, 0.3);
    model.parameters[1].fixed = true;
    model.estimated_initial = {false, true};
    const GreyOutput criterion(data, model, model.start(), std::nullopt, Vector{{1, 3}}, 1e-12);
    ASSERT_EQ(criterion.parameter_count(), 4);  // a, c, and w(0) of two experiments
    const Vector theta{{5.2, 0.3, 0.4, -0.7}};
    Vector output;
    Matrix J;
    criterion.simulate(theta, output, &J);
    EXPECT_EQ(output.size(), 2 * data.sample_count());
    for (Index q = 0; q < theta.size(); ++q) {
        const double h = 1e-3;
        const auto at = [&](double steps) { return criterion.output_at(theta + steps * h * Vector::Unit(4, q)); };
        const Vector expected = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
        EXPECT_LT((J.col(q) - expected).cwiseAbs().maxCoeff(), 1e-7 * std::max(1., expected.cwiseAbs().maxCoeff()))
            << q;
    }
}

TEST(grey_output, rows_are_experiments_outputs_samples_with_weights) {  // oracle: definition
    const IdData data = two_experiments();
    const GreyModel model = pendulum(5, 1.5, 0.3);
    const GreyOutput criterion(data, model, model.start(), std::nullopt, Vector{{1, 3}}, 1e-9);
    const Vector y = criterion.measured(), output = criterion.output_at(criterion.start());
    const Index N = data.sample_count(0);
    EXPECT_DOUBLE_EQ(y[0], 0.1);
    EXPECT_DOUBLE_EQ(y[N], 0.3);
    const std::vector<GreyTrajectory> runs = criterion.trajectories(criterion.start(), false);
    EXPECT_DOUBLE_EQ(output[N + 7], 3 * runs[0].y(7, 1));
    EXPECT_DOUBLE_EQ(output[2 * N + 5], runs[1].y(5, 0));
}

TEST(grey_output, of_a_simulation_that_breaks_down_is_no_number) {  // oracle: definition
    const Vector u = prbs(4, 3);
    const IdData data(Matrix::Constant(u.size(), 1, 0.1), Matrix(u), 0.1);
    const GreyModel growing = grey_model({{"k", 1}}, {"x"}, [](const Variables& v) -> std::vector<Term> {
        return {v.p[0] * v.x[0] * v.x[0] * v.x[0] + v.u};
    });
    const GreyOutput criterion(data, growing, growing.start(), std::nullopt, Vector::Ones(1), 1e-7);
    EXPECT_TRUE(criterion.output_at(Vector::Constant(1, 50)).array().isNaN().all());
}

TEST(grey_output, refuses_other_channels) {  // oracle: definition
    const Vector u = prbs(4, 3);
    const IdData three(Matrix::Constant(u.size(), 3, 0.1), Matrix(u), 0.1);
    const GreyModel model = pendulum(5, 1.5, 0.3);
    EXPECT_THAT(thrown_message([&] { GreyOutput(three, model, model.start(), std::nullopt, Vector::Ones(3), 1e-7); }),
                testing::HasSubstr("The model returns 2 outputs, but the data have 3"));
    const IdData none(Matrix::Constant(u.size(), 1, 0.1), Matrix(u.size(), 0), 0.1);
    EXPECT_THAT(thrown_message([&] { GreyOutput(none, model, model.start(), std::nullopt, Vector::Ones(1), 1e-7); }),
                testing::HasSubstr("The model has 1 input, but the data have 0"));
}

}  // namespace test_grey_output
