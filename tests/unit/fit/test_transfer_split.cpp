#include <gtest/gtest.h>

#include "numerics/fit/transfer_refinement.h"
#include "support/transfer_cases.h"

namespace test_transfer_split {

using namespace dynlab;
using namespace dynlab::test;

/// Two outputs, two inputs, orders for each channel, delays free.
TransferStructure grid(Denominators sharing) {
    TransferStructure structure = TransferStructure::grid(2, 2, sharing, {2, 1, 1, 2}, {1, 0, 0, 1}, {0});
    structure.free_delays = true;
    return structure;
}

TEST(transfer_split, reports_which_outputs_are_separate) {  // oracle: the definition
    EXPECT_TRUE(outputs_are_separate(grid(Denominators::kPerChannel)));
    EXPECT_TRUE(outputs_are_separate(TransferStructure::grid(2, 2, Denominators::kPerOutput, {2}, {0}, {0})));
    EXPECT_FALSE(outputs_are_separate(TransferStructure::grid(2, 2, Denominators::kCommon, {2}, {0}, {0})));
}

TEST(transfer_split, an_output_keeps_its_channels) {  // oracle: second route, the models of the whole structure
    TransferStructure shared = TransferStructure::grid(2, 2, Denominators::kPerOutput, {2}, {1, 0, 0, 1}, {0});
    shared.free_delays = true;
    for (const TransferStructure& whole : {grid(Denominators::kPerChannel), shared}) {
        const Vector theta = Vector::LinSpaced(whole.parameter_count(), 1, 2);
        const IdData data(Matrix(Matrix::Random(100, 2)), Matrix(Matrix::Random(100, 2)), 0.1);
        const auto all = whole.models(theta);
        for (Index output = 0; output < 2; ++output) {
            const OutputProblem problem = output_problem(data, whole, output);
            EXPECT_EQ(problem.data.experiments[0].y, data.experiments[0].y.col(output));
            const auto own = problem.structure.models(theta(problem.places));
            for (std::size_t input = 0; input < 2; ++input) {
                const TransferFunction& expected = all[2 * static_cast<std::size_t>(output) + input];
                EXPECT_EQ(own[input].num(), expected.num());
                EXPECT_EQ(own[input].den(), expected.den());
                EXPECT_EQ(own[input].delay(), expected.delay());
            }
        }
    }
}

TEST(transfer_split, joined_fits) {  // oracle: values that identify their source
    const TransferStructure whole = grid(Denominators::kPerChannel);
    const IdData data(Matrix(Matrix::Random(100, 2)), Matrix(Matrix::Random(100, 2)), 0.1);
    std::vector<OutputProblem> problems;
    std::vector<Fit> fits;
    for (Index output = 0; output < 2; ++output) {
        problems.push_back(output_problem(data, whole, output));
        const Index count = problems.back().structure.parameter_count();
        Fit fit;
        fit.theta = Vector::LinSpaced(count, 1, 2).array() + 10.0 * static_cast<double>(output);
        fit.covariance = fit.theta.asDiagonal();
        fit.noise_variance = values({1.0 + static_cast<double>(output)});
        fit.fit_percent = values({90.0 + static_cast<double>(output)});
        fit.offsets = Matrix::Constant(1, 1, static_cast<double>(output));
        fit.initial_values = {values({static_cast<double>(output)})};
        fit.loss = 2 + static_cast<double>(output);
        fit.condition_number = 5 - static_cast<double>(output);
        fit.termination = output == 0 ? Termination::kIterationLimit : Termination::kNoProgress;
        fit.trace.resize(output == 0 ? 1 : 3, {fit.theta, fit.loss, 0.1});
        fits.push_back(fit);
    }
    const Fit joined = join_outputs(whole, problems, fits);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(joined.theta(problems[i].places), fits[i].theta);
        EXPECT_EQ(joined.covariance(problems[i].places, problems[i].places), fits[i].covariance);
    }
    EXPECT_NEAR(joined.covariance.sum(), joined.theta.sum(), 1e-12) << "outputs do not depend on each other";
    EXPECT_EQ(joined.fit_percent, values({90, 91}));
    EXPECT_EQ(joined.noise_variance, values({1, 2}));
    EXPECT_EQ(joined.initial_values[0], values({0, 1}));
    EXPECT_EQ(joined.offsets(0, 1), 1);
    EXPECT_DOUBLE_EQ(joined.loss, 2.5);
    EXPECT_EQ(joined.condition_number, 5);
    EXPECT_EQ(joined.termination, Termination::kIterationLimit);
    ASSERT_EQ(joined.trace.size(), 3u);
    EXPECT_EQ(joined.trace[2].theta, joined.theta);
    EXPECT_DOUBLE_EQ(joined.trace[2].loss, 2.5);
}

}  // namespace test_transfer_split
