#include "numerics/estimators/closed_loop/clsrivc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/srivc.h"
#include "support/loop_cases.h"
#include "support/thrown_message.h"

namespace test_clsrivc {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const TransferStructure kPlant = TransferStructure::single(2, 0);
const Vector kTruth = values({4, 3, 2});

FitOptions exact() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

LoopKnowledge known_controller() {
    return {loop_controller()};
}

TEST(clsrivc, noise_free_records_give_the_plant) {  // oracle: the truth
    const IdData data = loop_data(0, 1);
    EXPECT_LT(relative_difference(clsrivc(data, kPlant, exact(), known_controller()).theta, kTruth), 1e-7);
    EXPECT_LT(relative_difference(clsrivc(data, kPlant, exact()).theta, kTruth), 1e-7);
    EXPECT_LT(
        relative_difference(clsrivc(data, kPlant, exact(), known_controller(), LoopRoute::kIndirect).theta, kTruth),
        1e-7);
    EXPECT_LT(relative_difference(clsrivc(data, kPlant, exact(), {}, LoopRoute::kDirect).theta, kTruth), 1e-7);
}

TEST(clsrivc, the_direct_route_is_srivc) {  // oracle: srivc
    const IdData data = loop_data(0.05, 2);
    const Fit direct = clsrivc(data, kPlant, {}, {}, LoopRoute::kDirect);
    EXPECT_EQ(direct.theta, srivc(data, kPlant).theta);
    EXPECT_THAT(message_text(direct.full_message()), HasSubstr("The direct route ignores the controller"));
}

TEST(clsrivc, errors_do_not_go_with_the_instruments) {  // oracle: residual of the definition, by lsim
    const IdData data = loop_data(0.05, 2);
    const Experiment& one = data.experiments.front();
    const Fit fit = clsrivc(data, kPlant, exact(), known_controller());
    const TransferFunction G = fit.models.front();
    const auto clean = ClosedLoop(G, loop_controller(), kLoopTs).to_reference(one.r.col(0));
    const Vector e = one.y.col(0) - lsim(G, one.u.col(0), kLoopTs);  // filtered by A/A
    const auto filtered = [&](double b1, double b0, const Vector& signal, Hold hold) {
        return lsim(TransferFunction(values({b1, b0}), G.den()), signal, kLoopTs, hold);
    };
    for (const Vector& z : {filtered(1, 0, clean.x, Hold::kFoh), filtered(0, 1, clean.x, Hold::kFoh),
                            filtered(0, 1, clean.u, Hold::kZoh)})
        EXPECT_LT(std::abs(z.dot(e)), 1e-8 * z.norm() * e.norm());
}

TEST(clsrivc, the_indirect_route_lies_at_the_least_squares_of_the_loop) {  // oracle: neighbors are no better
    const IdData data = loop_data(0.05, 2);
    const Experiment& one = data.experiments.front();
    const auto loss = [&](const Vector& theta) {
        const ClosedLoop loop(kPlant.models(theta).front(), loop_controller(), kLoopTs);
        return (one.y.col(0) - loop.to_reference(one.r.col(0)).x).squaredNorm();
    };
    const Vector theta = clsrivc(data, kPlant, exact(), known_controller(), LoopRoute::kIndirect).theta;
    for (Index i = 0; i < 3; ++i)
        for (const double change : {-1e-3, 1e-3}) {
            Vector other = theta;
            other[i] *= 1 + change;
            EXPECT_GT(loss(other), loss(theta)) << i << " " << change;
        }
}

TEST(clsrivc, an_unstable_plant_is_found_in_its_loop) {  // oracle: the truth 2/((s - 1)(s + 4))
    const IdData data = held_input_data(0.02, 3);
    FitOptions options = exact();
    options.lambda = 4;
    for (const LoopRoute route : {LoopRoute::kAuxiliary, LoopRoute::kIndirect}) {
        const Fit fit = clsrivc(data, kPlant, options, {holding_controller()}, route);
        EXPECT_LT(relative_difference(fit.theta, values({3, -4, 2})), 0.1) << fit.theta.transpose();
        EXPECT_GT(fit.std.minCoeff(), 0) << fit.std.transpose();
        for (Index i = 0; i < 3; ++i) EXPECT_LT(std::abs(fit.theta[i] - values({3, -4, 2})[i]), 4 * fit.std[i]);
        EXPECT_EQ(fit.termination, Termination::kConverged);
    }
    EXPECT_LT(relative_difference(
                  clsrivc(held_input_data(0, 3), kPlant, options, {holding_controller()}, LoopRoute::kIndirect).theta,
                  values({3, -4, 2})),
              1e-7);
}

TEST(clsrivc, a_controller_in_continuous_time) {  // oracle: the truth, except for interpolation of u
    const Vector r = prbs(7, 10);
    const TransferFunction C(values({4, 4}), values({1, 0}));
    const IdData data = ClosedLoop(loop_plant(), {C}, 0.02).simulate(r, 0.01 * RandomStream(3).normal(r.size()));
    const Fit auxiliary = clsrivc(data, kPlant, {}, {LoopController{C}});
    const Fit indirect = clsrivc(data, kPlant, {}, {LoopController{C}}, LoopRoute::kIndirect);
    EXPECT_LT(relative_difference(auxiliary.theta, kTruth), 0.06) << auxiliary.theta.transpose();
    EXPECT_LT(relative_difference(indirect.theta, kTruth), 0.03) << indirect.theta.transpose();
}

TEST(clsrivc, refuses_what_it_cannot_use) {  // oracle: the sentence names method and fault
    const IdData data = loop_data(0.05, 3);
    EXPECT_THAT(thrown_message([&] { clsrivc(data, kPlant, {}, {}, LoopRoute::kIndirect); }),
                HasSubstr("needs a known controller"));
    IdData without = data;
    without.experiments.front().r.resize(0, 0);
    EXPECT_THAT(thrown_message([&] { clsrivc(without, kPlant); }),
                HasSubstr("clsrivc needs the reference of the loop"));
    const LoopController unstable{TransferFunction(values({-400}), values({1}), kLoopTs), 1};
    EXPECT_THAT(thrown_message([&] { clsrivc(data, kPlant, {}, {unstable}, LoopRoute::kIndirect); }),
                HasSubstr("is unstable, so the indirect route cannot start"));
    EXPECT_THAT(message_text(clsrivc(data, kPlant, {}, {unstable}).full_message()),
                HasSubstr("the model or the controller is wrong"));
}

}  // namespace test_clsrivc
