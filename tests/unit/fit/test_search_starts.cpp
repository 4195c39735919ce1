// Oracles: limits of transfer functions, fits at fixed delays, the order of nested least squares.
#include "numerics/fit/search_starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/fit/transfer_refinement.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/linalg/polynomial.h"
#include "support/transfer_cases.h"

namespace test_search_starts {

using namespace dynlab;
using namespace dynlab::test;

TEST(search_starts, structures_a_step_poorer) {
    const auto orders = [](const TransferStructure& structure) {
        std::vector<std::pair<int, int>> all;
        for (const TransferStructure& lower_order : lower_order_structures(structure))
            all.emplace_back(lower_order.poles[0], lower_order.channels[0].zeros);
        return all;
    };
    using Orders = std::vector<std::pair<int, int>>;
    EXPECT_EQ(orders(TransferStructure::single(1, 0)), Orders());
    EXPECT_EQ(orders(TransferStructure::single(2, 0)), (Orders{{1, 0}}));
    EXPECT_EQ(orders(TransferStructure::single(2, 1)), (Orders{{2, 0}, {1, 0}}));
    EXPECT_EQ(orders(TransferStructure::single(3, 1)), (Orders{{2, 1}, {3, 0}, {2, 0}}));
}

// Oracle: far below the added roots the responses are equal.
TEST(search_starts, enriched_models_have_the_poorer_one_s_response) {
    const double fast = 1e3, middle = 3;
    const auto lower_order = TransferStructure::single(2, 0);
    const Vector theta = values({1.2, 4, 8});
    const TransferFunction G = lower_order.models(theta)[0];
    for (const auto& [n, m] : {std::pair{3, 0}, {2, 1}, {3, 1}, {4, 2}, {4, 1}}) {
        const auto structure = TransferStructure::single(n, m);
        const TransferFunction H = structure.models(enriched(lower_order, theta, structure, fast, middle))[0];
        for (const double w : {0.0, 0.5, 2.0, 5.0})
            EXPECT_LT(std::abs(H.at(Complex(0, w)) - G.at(Complex(0, w))), 0.02 * std::abs(G.at(Complex(0, w))))
                << n << ", " << m << " at " << w;
    }
}

// Oracle: a made-up search whose loss for every structure is known.
TEST(search_starts, come_from_poorer_structures_that_fit_better_than_asked) {
    int calls = 0;
    const auto solve = [&](const TransferStructure& structure, const std::vector<Vector>& starts) {
        ++calls;
        const double own = structure.poles[0] == 2 ? 5 : 1;  // two poles alone end in a bad minimum
        return NestedSolution{Vector::Ones(structure.parameter_count()), starts.empty() ? own : std::min(own, 0.5),
                              structure};
    };
    const IdData data = course_system_data(0.2, 1);
    NestedSearch search(data, solve);
    // Two poles, started from one, have 0.5: two starts with a pole more.
    EXPECT_EQ(search.better_starts(TransferStructure::single(3, 0), 2).size(), 2u);
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(search.better_starts(TransferStructure::single(3, 0), 0.4).size(), 0u);
    EXPECT_EQ(calls, 3);  // all are cached
}

// Oracle: nested models. With friction, no linear model fits the crane's position, so that starts matter.
TEST(search_starts, richer_structures_never_fit_worse) {
    const Vector u = prbs(8, 6).head(800);
    Vector y = lsim(TransferFunction(values({2, 1}), values({1, 0.3, 4, 0.5})), u, 0.1);
    for (Index k = 1; k < y.size(); ++k)
        if (std::abs(y[k] - y[k - 1]) < 0.05) y[k] = y[k - 1];  // sticks
    const IdData data{Matrix(y), Matrix(u), 0.1};
    for (const InitialState state : {InitialState::kZero, InitialState::kEstimate}) {
        FitOptions options;
        options.initial_state = state;
        options.offset = Offset::kNone;
        std::map<std::pair<int, int>, double> loss;
        for (int n = 1; n <= 4; ++n)
            for (int m = 0; m < n; ++m) {
                loss[{n, m}] = search_transfer("test", data, TransferStructure::single(n, m), options).loss;
                for (const auto& before : {std::pair{n - 1, m}, {n, m - 1}, {n - 1, m - 1}})
                    if (loss.contains(before)) {
                        EXPECT_LE((loss[{n, m}]), loss[before] * (1 + 1e-3))
                            << n << ", " << m << " after " << before.first << ", " << before.second;
                    }
            }
    }
}

// Oracle: the simulated system, whose numerator, free start and constant are linear in the output.
TEST(search_starts, the_linear_part_follows_from_the_poles) {
    const Vector u = prbs(8, 5), den = values({1, 0.8, 9}), num = values({2, 5});
    const TransferFunction G(num, den, 0, 0.3);
    const IdData whole{Matrix(lsim(G, u, 0.1)), Matrix(u), 0.1};
    const auto fixed = TransferStructure::single(2, 1, 0.3);
    const NestedSolution at_rest = with_linear_part(whole, fixed, {InitialState::kZero, false}, den, 0.3);
    EXPECT_LT(relative_difference(at_rest.theta, values({0.8, 9, 2, 5})), 1e-8);
    EXPECT_LT(at_rest.loss, 1e-16);
    auto free = TransferStructure::single(2, 1);
    free.free_delays = true;
    IdData cut = whole.range(101, u.size());
    cut.experiments.front().y.array() += 7;
    const NestedSolution running = with_linear_part(cut, free, {InitialState::kEstimate, true}, den, 0.3);
    EXPECT_LT(relative_difference(running.theta, values({0.8, 9, 2, 5, 0.3})), 0.1);
}

// Oracle: the simulated systems; in the fits one pole, or two, are far from where they belong.
TEST(search_starts, exchanged_poles_lead_to_the_system) {
    const Vector u = prbs(9, 7);
    const auto least_loss_from = [&](const Vector& den, const Vector& wrong) {
        const int n = static_cast<int>(den.size()) - 1;
        const IdData data{Matrix(lsim(TransferFunction(values({1}), den), u, 0.1)), Matrix(u), 0.1};
        Fit found;
        found.structure = TransferStructure::single(n, 0);
        found.start = {InitialState::kZero, false};
        found.theta.resize(n + 1);
        found.theta << wrong.tail(n), 1;
        found.loss = with_linear_part(data, found.structure, found.start, wrong, 0).loss;
        const std::vector<Vector> starts = exchanged_poles(data, found.structure, found, FitOptions());
        EXPECT_LE(starts.size(), 8u);
        double least = kInfinity, before = 0;
        int better_than_before = 0;
        for (const Vector& start : starts) {
            const Vector A = monic(start.head(n));
            const double loss = with_linear_part(data, found.structure, found.start, A, 0).loss;
            if (loss < before) ++better_than_before;
            before = loss;
            least = std::min(least, refine_output_error(data, found.structure, found.start, start, {}).loss);
        }
        EXPECT_LE(better_than_before, 1) << "valleys, then peaks, the best of each first";
        return least;
    };
    const Vector swing = values({1, 0.1, 1.2});
    EXPECT_LT(least_loss_from(values({1, 0.5}), values({1, 40})), 1e-12);
    EXPECT_LT(least_loss_from(swing, values({1, 5, 4})), 1e-12);
    EXPECT_LT(least_loss_from(multiply(swing, values({1, 3})), multiply(values({1, 30}), values({1, 7, 12}))), 1e-12);
}

}  // namespace test_search_starts
