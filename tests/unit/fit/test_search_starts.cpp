// Oracles: limits of transfer functions, fits at fixed delays, the order of nested least squares.
#include "numerics/fit/search_starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/fit/transfer_search.h"
#include "support/transfer_cases.h"

namespace test_search_starts {

using namespace dynlab;
using namespace dynlab::test;

TEST(search_starts, structures_a_step_poorer) {
    const auto orders = [](const TransferStructure& structure) {
        std::vector<std::pair<int, int>> all;
        for (const TransferStructure& poorer : poorer_structures(structure))
            all.emplace_back(poorer.poles[0], poorer.channels[0].zeros);
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
    const auto poorer = TransferStructure::single(2, 0);
    const Vector theta = values({1.2, 4, 8});
    const TransferFunction G = poorer.models(theta)[0];
    for (const auto& [n, m] : {std::pair{3, 0}, {2, 1}, {3, 1}, {4, 2}, {4, 1}}) {
        const auto structure = TransferStructure::single(n, m);
        const TransferFunction H = structure.models(enriched(poorer, theta, structure, fast, middle))[0];
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
    const IdData data = course_record(0.2, 1);
    NestedSearch search(data, solve);
    // Two poles, started from one, have 0.5: two starts with a pole more.
    EXPECT_EQ(search.better_starts(TransferStructure::single(3, 0), 2).size(), 2u);
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(search.better_starts(TransferStructure::single(3, 0), 0.4).size(), 0u);
    EXPECT_EQ(calls, 3);  // all are remembered
}

// Oracle: nested models. Friction makes the crane's position a record that no linear model fits, where starts matter.
TEST(search_starts, richer_structures_never_fit_worse) {
    const Vector u = prbs(8, 6).head(800);
    Vector y = lsim(TransferFunction(values({2, 1}), values({1, 0.3, 4, 0.5})), u, 0.1);
    for (Index k = 1; k < y.size(); ++k)
        if (std::abs(y[k] - y[k - 1]) < 0.05) y[k] = y[k - 1];  // sticks
    const IdData data{Matrix(y), Matrix(u), 0.1};
    for (const InitialState state : {InitialState::kZero, InitialState::kEstimate}) {
        FitOptions options;
        options.initial_state = state;
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

// Oracle: the joint search at every fixed delay. Far from the true delay several minima lie close together.
TEST(search_starts, loss_over_the_delay_is_that_of_fixed_delays) {
    const Vector u = prbs(7, 5);
    const Vector y = lsim(TransferFunction(values({3}), values({1, 1.5, 3}), 0, 0.62), u, 0.1) +
                     0.1 * RandomStream(4).normal(u.size());
    const IdData data{Matrix(y), Matrix(u), 0.1};
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    FitOptions options;
    options.largest_delay = 3;
    const DelayScan scan = scan_delays(data, structure, options);
    ASSERT_GT(scan.delays.size(), 25);
    for (Index i = 0; i < scan.delays.size(); i += 4) {
        const double fixed = search_transfer("test", data, TransferStructure::single(2, 0, scan.delays[i]), {}).loss;
        EXPECT_LT(scan.losses[i], 1.03 * fixed) << scan.delays[i];
        EXPECT_GT(scan.losses[i], 0.999 * fixed) << scan.delays[i];
    }
}

// Oracle: the delay of the record.
TEST(search_starts, the_range_of_delays_grows_until_the_delay_is_in_it) {
    const Index N = 600;
    Vector u = Vector::Zero(N);
    u.tail(N - 10).setOnes();
    const Vector y =
        lsim(TransferFunction(values({1}), values({1, 0.5}), 0, 7.3), u, 0.1) + 0.02 * RandomStream(5).normal(N);
    const IdData data{Matrix(y), Matrix(u), 0.1};
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    const Fit fit = search_transfer("test", data, structure, {});
    EXPECT_NEAR(fit.theta[2], 7.3, 0.05);
}

// Oracle: the beginning that is scanned has 50,000 samples, of which no delay may be longer than a quarter.
TEST(search_starts, delays_stay_within_the_part_of_a_long_record_that_is_scanned) {
    const Index N = 400'000;
    Vector u = Vector::Ones(N);
    u.head(100).setZero();
    const Vector y =
        lsim(TransferFunction(values({1}), values({1, 0.5}), 0, 2.3), u, 0.1) + 0.02 * RandomStream(6).normal(N);
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    const DelayScan scan = scan_delays(IdData{Matrix(y), Matrix(u), 0.1}, structure, {});
    EXPECT_LE(scan.largest, 50'000 * 0.1 / 4);
    EXPECT_NEAR(scan.starts.front()[2], 2.3, 0.3);
}

}  // namespace test_search_starts
