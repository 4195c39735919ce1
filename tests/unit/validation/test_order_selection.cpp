#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/integrated_input.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/fit_measures.h"
#include "numerics/validation/order_selection.h"
#include "support/thrown_message.h"

namespace test_order_selection {

using namespace dynlab;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const TransferFunction kSecondOrder(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}});
const TransferFunction kRaoGarnier(Vector{{-6400.0, 1600.0}}, Vector{{1.0, 5.0, 408.0, 416.0, 1600.0}});

IdData simulated_data(const TransferFunction& G, const Vector& u, double Ts, double snr, std::uint32_t seed) {
    const Vector x = lsim(G, u, Ts);
    const double sigma = std::sqrt((x.array() - x.mean()).square().mean()) * std::pow(10, -snr / 20);
    return IdData(Matrix(x + sigma * RandomStream(seed).normal(x.size())), Matrix(u), Ts);
}

OrderCandidate chosen(const OrderSelection& selection, OrderCriterion criterion = OrderCriterion::kRecommended) {
    return selection.candidates[choose_order(selection, criterion).place];
}

TEST(order_selection, grid_holds_every_strictly_proper_structure) {  // oracle: counting
    const auto grid = order_grid({1, 3}, {0, 2}, {0.0, 0.1});
    ASSERT_EQ(grid.size(), 12u);  // 1 + 2 + 3 structures, two delays
    EXPECT_EQ(grid.front().poles.front(), 1);
    EXPECT_EQ(grid.back().poles.front(), 3);
    EXPECT_EQ(grid.back().channels.front().zeros, 2);
    EXPECT_EQ(order_grid({1, 3}, {0, 3}, {0.0}, false, true).size(), 9u);  // 2 + 3 + 4 with as many zeros
    EXPECT_THROW(order_grid({0, 2}, {0, 0}, {0.0}), InvalidArgument);
    EXPECT_THROW(order_grid({2, 1}, {0, 0}, {0.0}), InvalidArgument);
    EXPECT_THROW(order_grid({1, 2}, {0, 0}, {}), InvalidArgument);
    EXPECT_THROW(order_grid({1, 1000}, {0, 1000}, {0.0}), InvalidArgument);
}

TEST(order_selection, finds_the_orders_of_rao_and_garniers_system) {  // oracle: the simulated system
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const IdData data = simulated_data(kRaoGarnier, prbs(10, 7), 0.01, 10, seed);
        const OrderSelection selection = select_order(data, order_grid({3, 5}, {0, 1}, {0.0}));
        EXPECT_EQ(chosen(selection).poles, 4) << seed;
        EXPECT_EQ(chosen(selection).zeros, 1) << seed;
    }
}

TEST(order_selection, finds_two_poles_and_no_zero) {  // oracle: the simulated system
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 10, seed);
        const OrderSelection selection = select_order(data, order_grid({1, 4}, {0, 2}, {0.0}));
        EXPECT_EQ(chosen(selection).poles, 2) << seed;
        EXPECT_EQ(chosen(selection).zeros, 0) << seed;
    }
}

TEST(order_selection, a_second_record_decides_when_it_is_given) {  // oracle: the simulated system
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 20, 1),
                 other = simulated_data(kSecondOrder, prbs(8, 5), 0.05, 20, 2);
    OrderSelectionOptions options;
    options.validation = &other;
    const OrderSelection selection = select_order(data, order_grid({1, 3}, {0, 1}, {0.0}), options);
    EXPECT_EQ(chosen(selection).poles, 2);
    EXPECT_EQ(chosen(selection).zeros, 0);
    for (const OrderCandidate& candidate : selection.candidates) EXPECT_TRUE(candidate.validation_fit.has_value());
    EXPECT_THAT(message_text(choose_order(selection).explanation), HasSubstr("validation data"));
}

// Oracles: srivc() of the integrated data with the integrator appended, compare() of that model, the system.
TEST(order_selection, structures_with_an_integrator_are_evaluated_with_it) {
    const TransferFunction G(Vector{{3.0}}, Vector{{1.0, 2.0, 0.0}});
    const IdData data = simulated_data(G, prbs(7, 8), 0.05, 30, 1), whole = simulated_data(G, prbs(8, 5), 0.05, 30, 2);
    IdData other = whole.range(300, whole.sample_count());  // begins in motion, and somewhere
    other.experiments.front().y.array() += 20;
    OrderSelectionOptions options;
    options.validation = &other;
    options.estimation.integration = true;
    const OrderSelection selection = select_order(data, order_grid({1, 2}, {0, 1}, {0.0}), options);
    const OrderCandidate best = chosen(selection);
    EXPECT_EQ(best.poles, 1);
    EXPECT_EQ(best.zeros, 0);
    EXPECT_THAT(message_text(structure_text(best)), HasSubstr("an integrator, 1 pole and no zero"));
    Fit alone = srivc(integrated_inputs(data), TransferStructure::single(1, 0));
    EXPECT_LT((best.estimate.theta - alone.theta).norm(), 1e-9);
    append_integrator(alone);
    EXPECT_EQ(best.estimate.models.front().den(), alone.models.front().den());
    const double fit = compare(other, alone.models.front(), {InitialState::kEstimate, Offset::kNone}).fit_percent;
    EXPECT_NEAR(*best.validation_fit, fit, 1e-6);
    EXPECT_GT(fit, 90);
}

TEST(order_selection, an_unstable_model_is_recommended_only_where_all_are) {  // oracle: definition
    OrderSelection selection;
    for (const bool unstable : {false, true}) {
        OrderCandidate candidate;
        candidate.poles = unstable ? 3 : 2;
        candidate.estimate.theta = Vector::Ones(unstable ? 5 : 3);
        candidate.evidence = unstable ? -2000 : -1000;
        candidate.unstable = unstable;
        selection.candidates.push_back(candidate);
    }
    selection.samples = 500;
    const OrderChoice choice = choose_order(selection);
    EXPECT_EQ(choice.place, 0u);
    EXPECT_THAT(message_text(choice.explanation),
                HasSubstr("With 3 poles and no zeros the BIC would be better, but that model is unstable."));
    selection.candidates.front().unstable = true;
    EXPECT_EQ(choose_order(selection).place, 1u);
}

TEST(order_selection, a_zero_at_the_origin_shows_that_there_is_no_integrator) {  // oracle: the simulated system
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 30, 1);
    OrderSelectionOptions options;
    options.estimation.integration = true;
    const OrderSelection selection = select_order(data, order_grid({2, 2}, {0, 1}, {0.0}), options);
    EXPECT_TRUE(selection.candidates[1].cancellation);
    EXPECT_FALSE(select_order(data, order_grid({2, 2}, {0, 0}, {0.0})).candidates[0].cancellation);
}

TEST(order_selection, a_second_record_with_an_offset_is_evaluated_as_the_estimation_was_asked_to) {
    // Oracle: the noise, which a good model leaves over, and compare() for the recommended model alone.
    const Vector period = prbs(8, 5);
    Vector periods(2 * period.size());
    periods << period, period;
    const IdData one = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 20, 1),
                 two = simulated_data(kSecondOrder, periods, 0.05, 20, 2);
    const auto lifted = [](IdData data, double inputs, double outputs) {
        data.experiments.front().u.array() += inputs;
        data.experiments.front().y.array() += outputs;
        return data;
    };
    // The validation data is one period of a running experiment, so that its means are a level at rest.
    const IdData data = lifted(one, 3, 50), other = lifted(two.range(period.size() + 1, periods.size()), 5, -20);
    OrderSelectionOptions options;
    options.validation = &other;
    for (const Offset offset : {Offset::kEstimate, Offset::kRemove, Offset::kAuto}) {
        SCOPED_TRACE(static_cast<int>(offset));
        options.estimation.offset = offset;
        options.estimation.initial_state = InitialState::kEstimate;
        const OrderCandidate best = chosen(select_order(data, order_grid({1, 3}, {0, 1}, {0.0}), options));
        EXPECT_EQ(best.poles, 2);
        EXPECT_EQ(best.zeros, 0);
        EXPECT_NEAR(best.fit_percent, 90, 1);  // 20 dB
        EXPECT_NEAR(*best.validation_fit, 90, 1);
        const TransferFunction& G = best.estimate.models.front();
        const CompareOptions as_asked{InitialState::kEstimate, offset};
        EXPECT_NEAR(*best.validation_fit, compare(other, G, as_asked).fit_percent, 1e-9);
    }
}

TEST(order_selection, a_step_at_the_first_sample_serves_as_second_record) {  // oracle: the noise
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 20, 1);
    IdData step = simulated_data(kSecondOrder, Vector::Ones(400), 0.05, 20, 2);
    step.experiments.front().y.array() += 7;
    OrderSelectionOptions options;
    options.validation = &step;
    options.estimation.offset = Offset::kEstimate;
    EXPECT_NEAR(*chosen(select_order(data, order_grid({2, 2}, {0, 0}, {0.0}), options)).validation_fit, 90, 1);
}

TEST(order_selection,
     an_unstable_model_that_overflows_has_the_worst_of_validation_fits) {  // oracle: exp(1270) overflows
    const TransferFunction unstable(Vector{{1.0}}, Vector{{1.0, -1.0}});
    const IdData data = simulated_data(unstable, prbs(5, 4).head(100), 0.05, 40, 1);
    const IdData other = simulated_data(kSecondOrder, prbs(7, 200), 0.05, 20, 2);
    OrderSelectionOptions options;
    options.validation = &other;
    options.estimation.initial_state = InitialState::kEstimate;
    const OrderSelection selection = select_order(data, order_grid({2, 2}, {0, 0}, {0.0}), options);
    ASSERT_GT(selection.candidates.front().fit_percent, 90);
    EXPECT_EQ(*selection.candidates.front().validation_fit, -std::numeric_limits<double>::infinity());
}

TEST(order_selection, finds_the_delay_among_several) {  // oracle: the simulated system
    const IdData data = simulated_data(kSecondOrder.with_delay(0.2), prbs(7, 8), 0.05, 20, 1);
    const OrderSelection selection = select_order(data, order_grid({2, 2}, {0, 0}, {0.0, 0.1, 0.2, 0.3}));
    EXPECT_EQ(chosen(selection).delay, 0.2);
}

TEST(order_selection, measures_are_those_of_their_definitions) {  // oracle: fit_measures of the simulated model
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    const OrderSelection selection = select_order(data, order_grid({2, 2}, {0, 0}, {0.0}));
    const OrderCandidate& candidate = selection.candidates.front();
    const Vector y = data.experiments[0].y.col(0);
    const Vector simulated = lsim(candidate.estimate.models.front(), data.experiments[0].u.col(0), data.Ts);
    const auto criteria = information_criteria((y - simulated).squaredNorm() / 1016, 1016, 3);
    EXPECT_NEAR(candidate.r_squared, r_squared_simulation(y, simulated), 1e-12);
    EXPECT_NEAR(candidate.fit_percent, 100 * (1 - (y - simulated).norm() / (y.array() - y.mean()).matrix().norm()),
                1e-10);
    EXPECT_NEAR(candidate.bic, criteria.bic, 1e-12);
    EXPECT_NEAR(candidate.fpe, criteria.fpe, 1e-12);
    EXPECT_NEAR(candidate.yic, yic(y, simulated, candidate.estimate.theta, candidate.estimate.covariance).value, 1e-10);
}

TEST(order_selection, superfluous_poles_and_zeros_are_pointed_out) {  // oracle: the system has no third pole
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 20, 1);
    const OrderSelection selection = select_order(data, order_grid({4, 4}, {2, 2}, {0.0}));
    EXPECT_FALSE(selection.candidates.front().sound());
    EXPECT_THAT(message_text(choose_order(selection).explanation), HasSubstr("No structure yields a reliable model"));
}

TEST(order_selection, structures_on_which_srivc_does_not_settle_come_as_close_as_those_inside_them) {
    // Oracle: five poles hold four, so the smallest loss with five is not above the smallest with four.
    const IdData data = simulated_data(kRaoGarnier, prbs(10, 7), 0.01, 10, 1);
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
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    OrderSelectionOptions options;
    options.threads = 1;
    const OrderSelection one = select_order(data, order_grid({1, 3}, {0, 2}, {0.0}), options);
    options.threads = 4;
    const OrderSelection many = select_order(data, order_grid({1, 3}, {0, 2}, {0.0}), options);
    for (std::size_t i = 0; i < one.candidates.size(); ++i)
        EXPECT_EQ(one.candidates[i].estimate.theta, many.candidates[i].estimate.theta);
}

// Oracle: nested least squares. No linear model fits data with a threshold, where starts matter.
TEST(order_selection, richer_structures_of_the_grid_never_fit_worse) {
    Vector y = lsim(kSecondOrder, prbs(8, 6).head(700), 0.05) + 0.02 * RandomStream(3).normal(700);
    y = y.unaryExpr([](double v) { return std::abs(v) < 0.2 ? 0.0 : v; }).eval();
    const IdData data(Matrix(y), Matrix(prbs(8, 6).head(700)), 0.05);
    for (const bool free_delay : {false, true}) {
        OrderSelectionOptions options;
        if (free_delay) options.estimation.largest_delay = 0.5;
        const auto grid = order_grid({1, 4}, {0, 2}, {0.0}, free_delay);
        const OrderSelection selection = select_order(data, grid, options);
        for (const OrderCandidate& rich : selection.candidates)
            for (const OrderCandidate& poor : selection.candidates)
                if (poor.poles <= rich.poles && poor.zeros <= rich.zeros) {
                    EXPECT_LE(rich.estimate.loss, poor.estimate.loss * (1 + 1e-3))
                        << rich.poles << " " << rich.zeros << " after " << poor.poles << " " << poor.zeros;
                }
    }
}

TEST(order_selection, other_criteria_take_the_best_value) {  // oracle: the definition
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    const OrderSelection selection = select_order(data, order_grid({1, 4}, {0, 2}, {0.0}));
    const OrderCandidate best = chosen(selection, OrderCriterion::kYic);
    for (const OrderCandidate& candidate : selection.candidates) EXPECT_LE(best.yic, candidate.yic);
    const OrderCandidate closest = chosen(selection, OrderCriterion::kRSquared);
    for (const OrderCandidate& candidate : selection.candidates) EXPECT_GE(closest.r_squared, candidate.r_squared);
    EXPECT_THROW(choose_order(selection, OrderCriterion::kValidationFit), InvalidArgument);
}

TEST(order_selection, constant_in_the_record_leads_to_the_same_structure) {  // oracle: the constant put in
    const Vector u = prbs(8, 4);
    const Vector x = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 3.0, 2.0}}), u, 0.1);
    const Vector y = x + 0.02 * RandomStream(31).normal(u.size());
    const auto recommended = [&](double constant, const FitOptions& estimation) {
        const IdData data(Matrix(y.array() + constant), Matrix(u), 0.1);
        OrderSelectionOptions options;
        options.estimation = estimation;
        const OrderSelection selection = select_order(data, order_grid({1, 2}, {0, 1}, {0.0}), options);
        return selection.candidates[choose_order(selection).place];
    };
    const OrderCandidate plain = recommended(0, {}), found = recommended(3, {});
    EXPECT_EQ(plain.poles, 2);
    EXPECT_FALSE(plain.estimate.start.offset);
    EXPECT_EQ(found.poles, 2);
    EXPECT_EQ(found.zeros, plain.zeros);
    ASSERT_TRUE(found.estimate.start.offset);
    EXPECT_NEAR(found.estimate.offsets(0, 0), 3, 0.02);
    // The same errors with one value more: BIC is larger by ln N / N, in whichever scale it is reported.
    FitOptions asked;
    asked.initial_state = InitialState::kZero;
    asked.offset = Offset::kEstimate;
    const OrderCandidate reported = recommended(3, asked);
    EXPECT_NEAR(found.fit_percent, reported.fit_percent, 1e-6);
    EXPECT_GT(found.bic, reported.bic) << "an offset that was chosen counts as a parameter";
}

TEST(order_selection, failures_are_kept_and_reported) {
    const IdData data = simulated_data(kSecondOrder, prbs(7, 8), 0.05, 10, 1);
    OrderSelectionOptions options;
    options.estimation.lambda = -1;
    EXPECT_THAT(thrown_message([&] {
                    select_order(data, order_grid({1, 2}, {0, 0}, {0.0}), options);
                }),
                AllOf(HasSubstr("the first error:"), HasSubstr("lambda")));
    options.estimation = {};
    options.cancel = [] { return true; };
    const OrderSelection stopped = select_order(data, order_grid({1, 2}, {0, 0}, {0.0}), options);
    EXPECT_TRUE(stopped.canceled);
    EXPECT_THAT(message_text(stopped.candidates.front().failure), HasSubstr("interrupted"));
    EXPECT_THROW(choose_order(stopped), InvalidArgument);
    EXPECT_THROW(select_order(data, {}), InvalidArgument);
}

}  // namespace test_order_selection
