#include "numerics/simulation/sampled_recursion.h"

#include <gtest/gtest.h>

#include "numerics/signals/random.h"

namespace test_sampled_recursion {

using namespace dynlab;

Matrix outputs_of(const SampledSystem& system, const Vector& u) {
    const Eigen::Map<const Vector> view(u.data(), u.size());
    SampledRecursion recursion(system, view);
    Matrix y(u.size(), recursion.output_count());
    Vector row(recursion.output_count());
    for (Index k = 0; k < u.size(); ++k) {
        recursion.output(k, row);
        y.row(k) = row.transpose();
        recursion.step(k);
    }
    return y;
}

/// 1/(s + 1)^2 with both states, and a feed-through at the first output.
SampledSystem two_lags(double Ts, Hold hold, double delay) {
    const Matrix A{{-1, 0}, {1, -1}};
    return discretize(A, Vector{{1.0, 0.0}}, Matrix::Identity(2, 2), Vector{{0.5, 0.0}}, Ts, hold, delay);
}

// oracle: finer sampling, where the delay is a multiple of the interval and the input is what the hold makes of it
TEST(sampled_recursion, agrees_with_finer_sampling_without_a_fraction_of_a_delay) {
    constexpr Index kFiner = 10;
    const Index N = 40;
    const double Ts = 0.5;
    const Vector u = RandomStream(1).normal(N);
    for (const Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const Index tenths : {0, 3, 10, 27}) {
            Vector finer = Vector::Zero(N * kFiner);
            for (Index i = 0; i < finer.size(); ++i) {
                const Index k = i / kFiner;
                const double part = static_cast<double>(i % kFiner) / kFiner;
                const double next = k + 1 < N ? u[k + 1] : u[k];
                finer[i] = hold == Hold::kZoh ? u[k] : (1 - part) * u[k] + part * next;
            }
            const Matrix y = outputs_of(two_lags(Ts, hold, 0.1 * Ts * static_cast<double>(tenths)), u);
            const Matrix expected =
                outputs_of(two_lags(Ts / kFiner, hold, 0.1 * Ts * static_cast<double>(tenths)), finer);
            for (Index k = 0; k < N; ++k)
                EXPECT_LT((y.row(k) - expected.row(k * kFiner)).norm(), 1e-13)
                    << "sample " << k << ", delay of " << tenths << " tenths";
        }
}

// oracle: definition, the formulas of SampledSystem written out
TEST(sampled_recursion, is_what_the_system_says) {
    SampledSystem system = two_lags(0.5, Hold::kFoh, 0.2);
    system.first_D = Vector{{0.3, -2.0}};
    for (const Index d : {0, 1, 4}) {
        system.delay = d;
        const Vector u = RandomStream(2).normal(9);
        const Matrix y = outputs_of(system, u);
        Vector x = Vector::Zero(2);
        for (Index k = 0; k < u.size(); ++k) {
            const Index now = k - d;
            Vector expected = system.C * x;
            if (now == 0) expected += system.first_D * u[0];
            if (now > 0) expected += system.D * Vector{{u[now], u[now - 1]}};
            EXPECT_LT((y.row(k).transpose() - expected).norm(), 1e-14) << "sample " << k << ", delay " << d;
            if (now + 1 >= u.size()) break;
            x = (system.F * x).eval();
            if (now == 0) x += system.first_G * Vector{{u[1], u[0]}};
            if (now > 0) x += system.G * Vector{{u[now + 1], u[now], u[now - 1]}};
        }
    }
}

// oracle: definition, the state is what the recursion was set to
TEST(sampled_recursion, goes_on_from_a_state_that_is_set) {
    const Vector u = Vector::Zero(5);
    const Eigen::Map<const Vector> view(u.data(), u.size());
    const SampledSystem system = two_lags(0.5, Hold::kZoh, 0);
    SampledRecursion recursion(system, view);
    recursion.set_state(Vector{{1.0, 2.0}});
    recursion.step(1);
    EXPECT_LT((recursion.state() - system.F * Vector{{1.0, 2.0}}).norm(), 1e-16);
    recursion.step(4);  // past the last sample nothing is defined, nor done
    EXPECT_LT((recursion.state() - system.F * Vector{{1.0, 2.0}}).norm(), 1e-16);
}

}  // namespace test_sampled_recursion
