#include <gtest/gtest.h>

#include "numerics/fit/discrete/sriv_iteration.h"
#include "support/difference_equation.h"

namespace test_sriv_iteration {

using namespace dynlab;
using namespace dynlab::test;

const PolynomialOrders kOrders = PolynomialOrders::output_error({2}, {2}, {1});
const Vector kTruth{{-1.5, 0.7, 0.8, -0.3}};

/// Data of the system, from rest, with white noise of this size.
std::vector<SampledExperiment> simulated_data(Index N, double noise) {
    const Vector u = random_levels(N, 3, 7), none = Vector::Zero(N);
    const Vector y = model_output(PolynomialModel(kOrders, kTruth, 1), u, none) + noise * RandomStream(11).normal(N);
    return {{Matrix(u), y}};
}

TEST(sriv_iteration, an_exact_record_gives_its_system) {  // oracle: the system that made the data
    const auto experiments = simulated_data(400, 0);
    const DiscreteOutput model(kOrders, {InitialState::kZero, false}, experiments);
    const Vector y = model.target();
    for (const Vector& start : {Vector{{-1.2, 0.5, 0.5, 0}}, instrument_start(model, y)}) {
        const InstrumentSolution found = iterate_instruments(model, y, start, 50, 1e-12);
        EXPECT_EQ(found.termination, Termination::kConverged);
        EXPECT_LT((found.theta - kTruth).cwiseAbs().maxCoeff(), 1e-8);
        EXPECT_LT(found.loss, 1e-16);
    }
}

// Oracle: the equations that hold at the end, Psi' (y - output) = 0, with Psi from central differences.
TEST(sriv_iteration, errors_are_orthogonal_to_the_instruments_at_its_end) {
    const auto experiments = simulated_data(600, 0.3);
    const DiscreteOutput model(kOrders, {InitialState::kZero, false}, experiments);
    const Vector y = model.target();
    const InstrumentSolution found = iterate_instruments(model, y, instrument_start(model, y), 100, 1e-12);
    ASSERT_EQ(found.termination, Termination::kConverged);
    Vector output;
    model.simulate(found.theta, output, nullptr);
    const Vector e = y - output;
    EXPECT_NEAR(found.loss, e.squaredNorm() / 600, 1e-12);
    for (Index i = 0; i < 4; ++i) {
        constexpr double kStep = 1e-6;
        Vector ahead, behind;
        model.simulate(found.theta + kStep * Vector::Unit(4, i), ahead, nullptr);
        model.simulate(found.theta - kStep * Vector::Unit(4, i), behind, nullptr);
        const Vector psi = (ahead - behind) / (2 * kStep);
        EXPECT_LT(std::abs(psi.dot(e)), 1e-6 * psi.norm() * e.norm()) << i;
    }
}

TEST(sriv_iteration, ends_on_request) {  // oracle: the call itself
    const auto experiments = simulated_data(200, 0.1);
    const DiscreteOutput model(kOrders, {InitialState::kZero, false}, experiments);
    const InstrumentSolution found =
        iterate_instruments(model, model.target(), Vector{{-1.2, 0.5, 0.5, 0}}, 50, 1e-12, [] { return true; });
    EXPECT_EQ(found.termination, Termination::kCanceled);
}

}  // namespace test_sriv_iteration
