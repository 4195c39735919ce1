#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/fit_measures.h"
#include "numerics/validation/order_selection.h"
#include "support/thrown_message.h"

using namespace dynlab;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

const TransferFunction kSecondOrder(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}});
const TransferFunction kRaoGarnier(Vector{{-6400.0, 1600.0}}, Vector{{1.0, 5.0, 408.0, 416.0, 1600.0}});

IdData record(const TransferFunction& G, const Vector& u, double Ts, double snr, std::uint32_t seed) {
    const Vector x = lsim(G, u, Ts);
    const double sigma = std::sqrt((x.array() - x.mean()).square().mean()) * std::pow(10, -snr / 20);
    return IdData(Matrix(x + sigma * RandomStream(seed).normal(x.size())), Matrix(u), Ts);
}

OrderCandidate chosen(const OrderSelection& selection, OrderCriterion criterion = OrderCriterion::kRecommended) {
    return selection.candidates[choose_order(selection, criterion).place];
}

}  // namespace

TEST(order_selection, grid_holds_every_strictly_proper_structure) {  // oracle: counting
    const auto grid = order_grid({1, 3}, {0, 2}, {0.0, 0.1});
    ASSERT_EQ(grid.size(), 12u);  // 1 + 2 + 3 structures, two delays
    EXPECT_EQ(grid.front().poles.front(), 1);
    EXPECT_EQ(grid.back().poles.front(), 3);
    EXPECT_EQ(grid.back().channels.front().zeros, 2);
    EXPECT_THROW(order_grid({0, 2}, {0, 0}, {0.0}), InvalidArgument);
    EXPECT_THROW(order_grid({2, 1}, {0, 0}, {0.0}), InvalidArgument);
    EXPECT_THROW(order_grid({1, 2}, {0, 0}, {}), InvalidArgument);
    EXPECT_THROW(order_grid({1, 1000}, {0, 1000}, {0.0}), InvalidArgument);
}

TEST(order_selection, finds_the_orders_of_rao_and_garniers_system) {  // oracle: the simulated system
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const IdData data = record(kRaoGarnier, prbs(10, 7), 0.01, 10, seed);
        const OrderSelection selection = select_order(data, order_grid({3, 5}, {0, 1}, {0.0}));
        EXPECT_EQ(chosen(selection).poles, 4) << seed;
        EXPECT_EQ(chosen(selection).zeros, 1) << seed;
    }
}

TEST(order_selection, finds_two_poles_and_no_zero) {  // oracle: the simulated system
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 10, seed);
        const OrderSelection selection = select_order(data, order_grid({1, 4}, {0, 2}, {0.0}));
        EXPECT_EQ(chosen(selection).poles, 2) << seed;
        EXPECT_EQ(chosen(selection).zeros, 0) << seed;
    }
}

TEST(order_selection, a_second_record_decides_when_it_is_given) {  // oracle: the simulated system
    const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 20, 1),
                 other = record(kSecondOrder, prbs(8, 5), 0.05, 20, 2);
    OrderSelectionOptions options;
    options.validation = &other;
    const OrderSelection selection = select_order(data, order_grid({1, 3}, {0, 1}, {0.0}), options);
    EXPECT_EQ(chosen(selection).poles, 2);
    EXPECT_EQ(chosen(selection).zeros, 0);
    for (const OrderCandidate& candidate : selection.candidates) EXPECT_TRUE(candidate.validation_fit.has_value());
    EXPECT_THAT(choose_order(selection).explanation, HasSubstr("second record"));
}

TEST(order_selection, finds_the_delay_among_several) {  // oracle: the simulated system
    const IdData data = record(kSecondOrder.with_delay(0.2), prbs(7, 8), 0.05, 20, 1);
    const OrderSelection selection = select_order(data, order_grid({2, 2}, {0, 0}, {0.0, 0.1, 0.2, 0.3}));
    EXPECT_EQ(chosen(selection).delay, 0.2);
}

TEST(order_selection, measures_are_those_of_their_definitions) {  // oracle: fit_measures of the simulated model
    const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    const OrderSelection selection = select_order(data, order_grid({2, 2}, {0, 0}, {0.0}));
    const OrderCandidate& candidate = selection.candidates.front();
    const Vector y = data.experiments[0].y.col(0);
    const Vector simulated = lsim(candidate.estimate.models.front(), data.experiments[0].u.col(0), data.Ts);
    const auto criteria = information_criteria((y - simulated).squaredNorm() / 1016, 1016, 3);
    EXPECT_NEAR(candidate.r_squared, r_squared_simulation(y, simulated), 1e-12);
    EXPECT_NEAR(candidate.fit_percent, fit_percent(y, simulated), 1e-10);
    EXPECT_NEAR(candidate.bic, criteria.bic, 1e-12);
    EXPECT_NEAR(candidate.fpe, criteria.fpe, 1e-12);
    EXPECT_NEAR(candidate.yic, yic(y, simulated, candidate.estimate.theta, candidate.estimate.covariance).value, 1e-10);
}

TEST(order_selection, superfluous_poles_and_zeros_are_pointed_out) {  // oracle: the system has no third pole
    const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 20, 1);
    const OrderSelection selection = select_order(data, order_grid({4, 4}, {2, 2}, {0.0}));
    EXPECT_FALSE(selection.candidates.front().sound());
    EXPECT_THAT(choose_order(selection).explanation, HasSubstr("No structure gives a sound model"));
}

TEST(order_selection, structures_on_which_srivc_does_not_settle_come_as_close_as_those_inside_them) {
    // Oracle: five poles hold four, so the smallest loss with five is not above the smallest with four.
    const IdData data = record(kRaoGarnier, prbs(10, 7), 0.01, 10, 1);
    const OrderSelection selection = select_order(data, order_grid({4, 5}, {1, 1}, {0.0}));
    EXPECT_LT(selection.candidates[1].estimate.loss, 1.001 * selection.candidates[0].estimate.loss);
}

TEST(order_selection, exact_records_need_no_more_than_the_system_has) {  // oracle: the simulated system
    const Vector u = prbs(7, 8);
    const IdData data(Matrix(lsim(kSecondOrder, u, 0.05)), Matrix(u), 0.05);
    const OrderCandidate candidate = chosen(select_order(data, order_grid({1, 3}, {0, 1}, {0.0})));
    EXPECT_EQ(candidate.poles, 2);
    EXPECT_EQ(candidate.zeros, 0);
}

TEST(order_selection, same_numbers_for_any_number_of_threads) {  // oracle: one thread, bit for bit
    const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    OrderSelectionOptions options;
    options.threads = 1;
    const OrderSelection one = select_order(data, order_grid({1, 3}, {0, 2}, {0.0}), options);
    options.threads = 4;
    const OrderSelection many = select_order(data, order_grid({1, 3}, {0, 2}, {0.0}), options);
    for (std::size_t i = 0; i < one.candidates.size(); ++i)
        EXPECT_EQ(one.candidates[i].estimate.theta, many.candidates[i].estimate.theta);
}

TEST(order_selection, other_criteria_take_the_best_value) {  // oracle: the definition
    const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    const OrderSelection selection = select_order(data, order_grid({1, 4}, {0, 2}, {0.0}));
    const OrderCandidate best = chosen(selection, OrderCriterion::kYic);
    for (const OrderCandidate& candidate : selection.candidates) EXPECT_LE(best.yic, candidate.yic);
    const OrderCandidate closest = chosen(selection, OrderCriterion::kRSquared);
    for (const OrderCandidate& candidate : selection.candidates) EXPECT_GE(closest.r_squared, candidate.r_squared);
    EXPECT_THROW(choose_order(selection, OrderCriterion::kValidationFit), InvalidArgument);
}

TEST(order_selection, failures_are_kept_and_told) {
    const IdData data = record(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    OrderSelectionOptions options;
    options.estimation.lambda = -1;
    EXPECT_THAT(thrown_message([&] {
                    select_order(data, order_grid({1, 2}, {0, 0}, {0.0}), options);
                }),
                AllOf(HasSubstr("the first one says: "), HasSubstr("lambda")));
    options.estimation = {};
    options.cancel = [] { return true; };
    const OrderSelection stopped = select_order(data, order_grid({1, 2}, {0, 0}, {0.0}), options);
    EXPECT_TRUE(stopped.cancelled);
    EXPECT_THAT(stopped.candidates.front().failure, HasSubstr("stopped"));
    EXPECT_THROW(choose_order(stopped), InvalidArgument);
    EXPECT_THROW(select_order(data, {}), InvalidArgument);
}
