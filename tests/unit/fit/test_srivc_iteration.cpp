#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/fit/first_estimate.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/signals/random.h"
#include "support/transfer_cases.h"

namespace test_srivc_iteration {

using namespace dynlab;
using namespace dynlab::test;

constexpr double kTs = 0.05;

/// Samples of y = (s + 3)/(s^2 + 2 s + 5) u(t - 0.12) for held random steps, with white noise of this size.
IdData simulated_data(Index N, double noise) {
    const Vector numbers = RandomStream(3).normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = numbers[k / 8] > 0 ? 1 : -1;
    const TransferFunction G = TransferFunction(values({1, 3}), values({1, 2, 5})).with_delay(0.12);
    const Vector t = kTs * Vector::LinSpaced(N, 0, static_cast<double>(N - 1));
    return IdData(Matrix(lsim(G, u, t) + noise * RandomStream(4).normal(N)), Matrix(u), kTs);
}

const TransferStructure kStructure = TransferStructure::single(2, 1, 0.12);
const Vector kTruth{{2, 5, 1, 3}};

TEST(srivc_iteration, an_exact_record_gives_its_system) {  // oracle: the system that made the data
    const IdData data = simulated_data(600, 0);
    FitOptions options;
    options.hold_y = Hold::kFoh;
    const Vector start = best_cutoff_start(data, kStructure, options);
    const SrivcSolution found = iterate_srivc(data, kStructure, start, options);
    EXPECT_EQ(found.termination, Termination::kConverged);
    EXPECT_LT((found.theta - kTruth).cwiseQuotient(kTruth).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT(simulation_loss(data, kStructure, found.theta), 1e-12);
}

// Oracle: with instruments that are the sensitivities of the simulated output, the end is a stationary point of the
// simulation error; its gradient is taken by central differences of the loss of an independent simulation.
TEST(srivc_iteration, ends_where_the_simulation_error_is_stationary) {
    const IdData data = simulated_data(2000, 0.05);
    FitOptions options;
    options.tolerance = 1e-10;
    options.max_iterations = 200;
    const Vector start = best_cutoff_start(data, kStructure, options);
    const SrivcSolution found = iterate_srivc(data, kStructure, start, options);
    ASSERT_EQ(found.termination, Termination::kConverged);
    const Vector t = kTs * Vector::LinSpaced(2000, 0, 1999);
    const auto loss = [&](const Vector& theta) {
        const TransferFunction G =
            TransferFunction(Vector(theta.tail(2)), values({1, theta[0], theta[1]})).with_delay(0.12);
        return (data.experiments[0].y.col(0) - lsim(G, data.experiments[0].u.col(0), t)).squaredNorm() / 2000;
    };
    EXPECT_NEAR(simulation_loss(data, kStructure, found.theta), loss(found.theta), 1e-12);
    for (Index i = 0; i < 4; ++i) {
        const double step = 1e-3 * std::abs(found.theta[i]);
        const double ahead = loss(found.theta + step * Vector::Unit(4, i));
        const double behind = loss(found.theta - step * Vector::Unit(4, i)), here = loss(found.theta);
        const double curvature = ahead - 2 * here + behind;
        ASSERT_GT(curvature, 0) << i;
        // The minimum along this axis lies within a thousandth of the step.
        EXPECT_LT(std::abs(ahead - behind) / 2, 1e-3 * curvature) << i;
    }
}

}  // namespace test_srivc_iteration
