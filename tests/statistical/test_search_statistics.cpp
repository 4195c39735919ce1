// Whether searches find the smallest error where they are known to end early: drifting noise, fewer poles than modes,
// several inputs with delays, nonlinear models far from the data. Fixed seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/estimators/bj.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/grey_box/greyest.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/rivc.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/transfer_refinement.h"
#include "support/grey_cases.h"
#include "support/search_corpus.h"
#include "support/transfer_cases.h"

namespace test_search_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr StartCondition kRest{InitialState::kZero, false};

Vector summed(Vector e) {
    for (Index k = 1; k < e.size(); ++k) e[k] += e[k - 1];
    return e;
}

Vector random_levels(SearchChance& chance, Index N, Index hold) {
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = k % hold == 0 ? 2 * chance.below(2) - 1 : u[k - 1];
    return u;
}

double deviation(const Vector& x) {
    return std::sqrt((x.array() - x.mean()).square().mean());
}

// Oracle: the innovation variance of the noise, by the steady Kalman filter of a random walk (variance q of a step)
// under white noise (variance r): P = (q + sqrt(q^2 + 4 q r))/2, P + r. Its estimate has a relative deviation of
// sqrt(2/N).
TEST(search_statistics, drifting_noise_is_modeled_down_to_its_innovations) {
    const double q = 0.05 * 0.05, r = 0.1 * 0.1;
    const double innovations = (q + std::sqrt(q * q + 4 * q * r)) / 2 + r;
    const Vector u = prbs(8, 6), x = lsim(TransferFunction(values({2}), values({1, 1.4, 2})), u, 0.1);
    TransferStructure structure = TransferStructure::single(2, 0), delayed = structure;
    delayed.free_delays = true;
    FitOptions stable;
    stable.stable = true;
    PolynomialOrders orders = PolynomialOrders::output_error({2}, {2}, {1});
    orders.nc = orders.nd = 1;
    const double max_variance = innovations * (1 + 4 * std::sqrt(2 / static_cast<double>(u.size())));
    for (std::uint32_t seed = 101; seed <= 108; ++seed) {
        RandomStream random(seed);
        const Vector walk = 0.05 * summed(random.normal(u.size())), white = 0.1 * random.normal(u.size());
        const IdData data(Matrix(x + walk + white), Matrix(u), 0.1);
        EXPECT_LT(rivc(data, structure, {1, 1}).noise_variance[0], max_variance) << seed;
        EXPECT_LT(rivc(data, structure, {1, 1}, stable).noise_variance[0], max_variance) << seed;
        EXPECT_LT(bj(data, orders).noise_variance[0], max_variance) << seed;
        if (seed % 4 == 0) {
            EXPECT_LT(rivc(data, delayed, {1, 1}).noise_variance[0], max_variance) << seed;
        }
    }
}

// Oracle: the prediction error of the true system and noise on the same data, which a minimum does not exceed beyond
// what the choice of a start costs. Their simulation error, which follows the drift, lets other starts seem better.
TEST(search_statistics, drifting_noise_does_not_choose_the_start) {
    const double q = 0.05 * 0.05, r = 0.1 * 0.1, P = (q + std::sqrt(q * q + 4 * q * r)) / 2, gain = P / (P + r);
    const Vector u = prbs(8, 6), x = lsim(TransferFunction(values({2}), values({1, 1.4, 2})), u, 0.1);
    TransferStructure structure = TransferStructure::single(2, 0), delayed = structure;
    delayed.free_delays = true;
    PolynomialOrders orders = PolynomialOrders::output_error({2}, {2}, {1});
    orders.nc = orders.nd = 1;
    const auto N = static_cast<double>(u.size());
    for (const std::uint32_t seed : {203, 208, 209, 228, 254, 260}) {
        RandomStream random(seed);
        const Vector walk = 0.05 * summed(random.normal(u.size())), white = 0.1 * random.normal(u.size());
        double level = 0, squares = 0;
        for (const double noise : Vector(walk + white)) {
            const double e = noise - level;
            squares += e * e, level += gain * e;
        }
        const double max_variance = squares / N * (1 + 12 / N);
        const IdData data(Matrix(x + walk + white), Matrix(u), 0.1);
        EXPECT_LT(rivc(data, structure, {1, 1}).noise_variance[0], max_variance) << seed;
        EXPECT_LT(rivc(data, delayed, {1, 1}).noise_variance[0], max_variance) << seed;
        EXPECT_LT(bj(data, orders).noise_variance[0], max_variance) << seed;
    }
}

// Oracle: refinements that begin at each of the true modes.
TEST(search_statistics, two_poles_find_the_better_of_two_modes) {
    const TransferStructure structure = TransferStructure::single(2, 0);
    TransferStructure delayed = structure;
    delayed.free_delays = true;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        SearchChance chance(400 + seed);
        const double slow = chance.between(1, 3), fast = slow * chance.between(1.6, 4);
        const double Ts = 0.4 / fast;
        const Index N = 1000;
        const Vector u = random_levels(chance, N, 1 + chance.below(6));
        Vector x = Vector::Zero(N);
        std::vector<Vector> starts;
        for (const double w : {slow, fast}) {
            const double gain = chance.between(0.5, 2) * w * w, damping = chance.between(0.01, 0.08);
            x += lsim(TransferFunction(values({gain}), values({1, 2 * damping * w, w * w})), u, Ts);
            starts.push_back(values({2 * damping * w, w * w, gain}));
        }
        const IdData data(Matrix(x + 0.03 * deviation(x) * chance.normal(N)), Matrix(u), Ts);
        double best = kInfinity;
        for (const Vector& start : starts)
            best = std::min(best, refine_output_error(data, structure, kRest, start, {}).loss);
        EXPECT_LT(srivc(data, structure).loss, 1.005 * best) << seed;
        EXPECT_LT(coe(data, structure).loss, 1.005 * best) << seed;
        EXPECT_LT(srivc(data, delayed).loss, 1.005 * best) << seed;
        EXPECT_LT(procsrivc(data, ProcessStructure::parse("P2U")).loss, 1.005 * best) << seed;
    }
}

// Oracle: a minimum does not lie above the loss of the true system.
TEST(search_statistics, delays_of_two_inputs_end_no_higher_than_the_true_system) {
    const Index N = 2000;
    TransferStructure structure = TransferStructure::grid(1, 2, Denominators::kPerChannel, {2, 2}, {0, 1}, {0, 0});
    structure.free_delays = true;
    for (const std::uint32_t seed : {5, 10, 11, 12, 14, 15, 17, 28}) {
        SearchChance chance(300'000 + seed);
        const double shared = seed % 2 == 0 ? 0 : 0.9;
        const Vector u1 = random_levels(chance, N, 8);
        const Vector u2 = shared * u1 + std::sqrt(1 - shared * shared) * random_levels(chance, N, 3 + chance.below(8));
        const Vector x = lsim(TransferFunction(values({2}), values({1, 1.4, 2})), u1, 0.1) +
                         lsim(TransferFunction(values({1, 3}), values({1, 4.5, 2}), 0, 0.35), u2, 0.1);
        const Vector e = 0.05 * deviation(x) * chance.normal(N);
        Matrix u(N, 2);
        u << u1, u2;
        const Fit fit = srivc(IdData(Matrix(x + e), u, 0.1), structure);
        EXPECT_LT(fit.loss, e.squaredNorm() / static_cast<double>(N)) << seed;
    }
}

// Oracle: the simulated pendulum, which turns over.
TEST(search_statistics, a_pendulum_that_turns_over_is_found_from_far_away) {
    const Index N = 600;
    const double Ts = 0.05;
    SearchChance chance(7);
    const Vector u = random_levels(chance, N, 12);
    Vector t(N);
    for (Index k = 0; k < N; ++k) t[k] = Ts * static_cast<double>(k);
    const GreyModel truth = pendulum(10, 8, 0.3);
    const Matrix states = grey_response(unfitted_grey_box(truth), {Matrix(u), t, Hold::kZoh});
    ASSERT_GT(states.col(0).cwiseAbs().maxCoeff(), 4);
    const IdData data(Matrix(states.col(0) + 0.01 * chance.normal(N)), Matrix(u), Ts);
    for (const double a : {5.0, 6.0, 7.0, 9.0, 16.0}) {
        const GreyFit fit = greyest(data, pendulum(a, 8, 0.3));
        EXPECT_NEAR(fit.fit.theta[0], 10, 0.05) << a;
        EXPECT_GT(fit.fit.fit_percent[0], 95) << a;
    }
}

}  // namespace test_search_statistics
