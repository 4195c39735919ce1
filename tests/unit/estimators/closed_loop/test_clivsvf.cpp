#include "numerics/estimators/closed_loop/clivsvf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/reader.h"
#include "support/loop_cases.h"
#include "support/thrown_message.h"

namespace test_clivsvf {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const TransferStructure kPlant = TransferStructure::single(2, 0);

SvfOptions cutoff(double lambda) {
    SvfOptions options;
    options.lambda = lambda;
    return options;
}

LoopKnowledge known_controller() {
    return {loop_controller()};
}

/// Columns -p x_f, -x_f, u_f.
Matrix regressors(const Vector& x, const Vector& u) {
    const Matrix filtered = state_variable_filter(x, 2, 3, kLoopTs, Hold::kFoh);
    Matrix columns(x.size(), 3);
    columns << -filtered.col(1), -filtered.col(2), lsim(TransferFunction(values({1}), values({1, 6, 9})), u, kLoopTs);
    return columns;
}

// oracle: the passes of the definition with stored columns from lsim
TEST(clivsvf, solves_the_equations_of_its_definition) {
    const IdData data = loop_data(0.05, 3);
    const Experiment& loop = data.experiments.front();
    const Vector y = loop.y.col(0), u = loop.u.col(0);
    Vector theta = lssvf(data, kPlant, cutoff(3)).theta;
    for (int pass = 0; pass < 3; ++pass) {
        const auto clean =
            ClosedLoop(kPlant.models(theta).front(), loop_controller(), kLoopTs).to_reference(loop.r.col(0));
        const Matrix Z = regressors(clean.x, clean.u), Phi = regressors(y, u);
        const Vector highest = state_variable_filter(y, 2, 3, kLoopTs, Hold::kFoh).col(0);
        theta = (Z.transpose() * Phi).partialPivLu().solve(Z.transpose() * highest);
    }
    EXPECT_LT(relative_difference(clivsvf(data, kPlant, cutoff(3), known_controller()).theta, theta), 1e-9);
}

TEST(clivsvf, finds_the_computing_delay) {  // oracle: how the data were made
    const IdData data = loop_data(0.05, 3);
    LoopKnowledge known{loop_controller()};
    known.controller->computing_delay = 0;
    known.find_computing_delay = true;
    const Fit found = clivsvf(data, kPlant, cutoff(3), known);
    EXPECT_EQ(found.theta, clivsvf(data, kPlant, cutoff(3), known_controller()).theta);
    EXPECT_THAT(message_text(found.full_message()), HasSubstr("with a controller delay of 1 sample"));
}

// oracle: definition: doubled data give the same estimate; the standard errors agree except for the window of their
// covariance, which changes with N
TEST(clivsvf, experiments_are_joined) {
    const IdData data = loop_data(0.05, 3);
    const Fit once = clivsvf(data, kPlant, cutoff(3), known_controller());
    const Fit twice = clivsvf(IdData::merge({data, data}), kPlant, cutoff(3), known_controller());
    EXPECT_LT(relative_difference(twice.theta, once.theta), 1e-9);
    EXPECT_LT(relative_difference(twice.std, once.std / std::sqrt(2.0)), 0.08);
}

TEST(clivsvf, doubts_a_wrong_controller) {  // oracle: the warning
    LoopKnowledge wrong{LoopController{TransferFunction(values({-0.5}), values({1}), kLoopTs), 1}};
    EXPECT_THAT(message_text(clivsvf(loop_data(0.05, 3), kPlant, cutoff(3), wrong).full_message()),
                HasSubstr("reference minus output explains only"));
}

TEST(clivsvf, refuses_what_it_cannot_use) {  // oracle: the sentence names method and fault
    const IdData data = loop_data(0.05, 3);
    const auto refused = [&](const IdData& data_set, const LoopKnowledge& known) {
        return thrown_message([&] { clivsvf(data_set, kPlant, cutoff(3), known); });
    };
    IdData without = data, constant = data, strange = data;
    without.experiments.front().r.resize(0, 0);
    constant.experiments.front().r.setOnes();
    strange.experiments.front().r = RandomStream(9).normal(data.sample_count());
    EXPECT_THAT(refused(without, {}), HasSubstr("clivsvf needs the reference of the loop"));
    EXPECT_THAT(refused(constant, {}), HasSubstr("the reference never changes"));
    EXPECT_THAT(refused(strange, {}),
                HasSubstr("cannot be used for estimation: check that the reference belongs to this loop"));
    EXPECT_THAT(refused(data.range(33, 40), {}), HasSubstr("at least 9 samples are needed"));
    EXPECT_THAT(refused(data, {LoopController{TransferFunction(values({1}), values({1}), 0.1)}}),
                HasSubstr("the sampling time of the controller is 0.1 s"));
    EXPECT_THAT(thrown_message([&] { clivsvf(data, kPlant, cutoff(-1)); }), HasSubstr("lambda"));
    TransferStructure free = kPlant;
    free.free_delays = true;
    EXPECT_THAT(thrown_message([&] { clivsvf(data, free, cutoff(3)); }),
                HasSubstr("this method does not estimate delays"));
}

}  // namespace test_clivsvf
