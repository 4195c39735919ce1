#include "numerics/simulation/exact_filter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/irregular_filter.h"

namespace dynlab {
namespace test_exact_filter {

/// The definition of SampledSystem, sample by sample.
Matrix by_definition(const SampledSystem& system, const Vector& u, Vector x) {
    const Index d = system.delay;
    const auto at = [&](Index k) { return k >= 0 && k < u.size() ? u(k) : 0; };
    Matrix y(u.size(), system.C.rows());
    for (Index k = 0; k < u.size(); ++k) {
        Vector input_part = Vector::Zero(system.F.rows());
        y.row(k) = system.C * x;
        if (k == d) {
            y.row(k) += (system.first_D * at(0)).transpose();
            input_part = system.first_G * Eigen::Vector2d(at(1), at(0));
        } else if (k > d) {
            y.row(k) += (system.D * Eigen::Vector2d(at(k - d), at(k - d - 1))).transpose();
            input_part = system.G * Eigen::Vector3d(at(k - d + 1), at(k - d), at(k - d - 1));
        }
        x = system.F * x + input_part;
    }
    return y;
}

Vector stable_denominator(Index order) {
    ComplexVector poles(order);
    for (Index i = 0; i < order; ++i) poles(i) = -1.0 - 0.7 * static_cast<double>(i);
    return polynomial_from_roots(poles);
}

class exact_filter_of_order : public testing::TestWithParam<Index> {};

TEST_P(exact_filter_of_order, agrees_with_the_definition) {  // oracle: second route, sample by sample
    const Index order = GetParam();
    RandomStream random(5);
    for (const Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const double delay : {0.0, 0.1, 0.13, 0.57, 1.0})
            for (const Index N : {1, 2, 5, 9, 10, 11, 12, 50}) {
                const SampledSystem system = derivative_filter(stable_denominator(order), 0.1, hold, delay);
                const Vector u = random.normal(N), x = random.normal(order);
                Matrix y(N, order + 1);
                ExactFilter(system).run(u, x, y);
                const Matrix expected = by_definition(system, u, x);
                EXPECT_LT((y - expected).cwiseAbs().maxCoeff(), 1e-13 * std::max(1.0, expected.cwiseAbs().maxCoeff()))
                    << "delay " << delay << ", N " << N << (hold == Hold::kZoh ? ", zoh" : ", foh");
            }
}

TEST_P(exact_filter_of_order, fractional_delays_by_finer_sampling) {  // oracle: second route, eight times the rate
    constexpr Index kFiner = 8, N = 40;
    const Index order = GetParam();
    const Vector den = stable_denominator(order), u = RandomStream(6).normal(N);
    Vector held = Vector::Zero(kFiner * N), straight = held;
    for (Index k = 0; k < kFiner * (N - 1) + 1; ++k) {
        const Index i = k / kFiner;
        const double fraction = static_cast<double>(k % kFiner) / kFiner;
        held(k) = u(i);
        straight(k) = fraction == 0 ? u(i) : (1 - fraction) * u(i) + fraction * u(i + 1);
    }
    for (const Index late : {0, 3, 8, 21}) {
        const double delay = 0.4 / kFiner * static_cast<double>(late);
        for (const Hold hold : {Hold::kZoh, Hold::kFoh}) {
            const Matrix coarse = ExactFilter(derivative_filter(den, 0.4, hold, delay)).run(u);
            const Matrix fine =
                ExactFilter(derivative_filter(den, 0.4 / kFiner, hold, 0)).run(hold == Hold::kZoh ? held : straight);
            for (Index k = 0; k < N; ++k) {
                const Index source = kFiner * k - late;
                const Eigen::RowVectorXd expected =
                    source < 0 ? Eigen::RowVectorXd(Eigen::RowVectorXd::Zero(order + 1)) : fine.row(source);
                EXPECT_LT((coarse.row(k) - expected).cwiseAbs().maxCoeff(), 1e-12) << "late " << late << ", k " << k;
            }
        }
    }
}

TEST_P(exact_filter_of_order, irregular_filter_agrees_on_equal_steps) {  // oracle: second route, event by event
    const Index order = GetParam(), N = 30;
    const Vector den = stable_denominator(order), u = RandomStream(7).normal(N), x = RandomStream(8).normal(order);
    const Vector t = Vector::LinSpaced(N, 0, 0.25 * (N - 1));
    Matrix C(order + 1, order);
    C << -den.tail(order).transpose(), Matrix::Identity(order, order);
    for (const Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const double delay : {0.0, 0.1, 0.6}) {
            IrregularFilter irregular(companion(den), Vector::Unit(order, 0), C, Vector::Unit(order + 1, 0), hold,
                                      delay);
            Matrix y(N, order + 1);
            ExactFilter(derivative_filter(den, 0.25, hold, delay)).run(u, x, y);
            EXPECT_LT((irregular.run(u, t, x) - y).cwiseAbs().maxCoeff(),
                      1e-12 * std::max(1.0, y.cwiseAbs().maxCoeff()))
                << "delay " << delay;
        }
}

INSTANTIATE_TEST_SUITE_P(exact_filter, exact_filter_of_order, testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12));

TEST(exact_filter, derivatives_fulfil_their_identity) {  // oracle: definition, sum den_i s^(n-i)/den u = u
    const Vector den = Eigen::Vector4d(1, 3, 5, 2), u = RandomStream(9).normal(200);
    const Matrix y = ExactFilter(derivative_filter(den, 0.05, Hold::kFoh)).run(u);
    EXPECT_LT((y * den - u).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(exact_filter, a_discrete_gain_with_delay_only_shifts) {  // oracle: analytic
    const SampledSystem gain = discrete_system(Matrix(0, 0), Vector(0), Matrix(1, 0), Vector::Constant(1, 3.0), 2);
    const Matrix y = ExactFilter(gain).run(Vector::LinSpaced(12, 1, 12));
    for (Index k = 0; k < 12; ++k) EXPECT_EQ(y(k, 0), k < 2 ? 0.0 : 3.0 * static_cast<double>(k - 1));
}

TEST(exact_filter, delays_within_rounding_of_a_multiple_count_as_one) {  // oracle: analytic, 0.3/0.1 in doubles
    EXPECT_EQ(split_delay(0.3, 0.1).samples, 3);
    EXPECT_EQ(split_delay(0.3, 0.1).rest, 0);
    EXPECT_EQ(split_delay(0.37, 0.1).samples, 3);
    EXPECT_NEAR(split_delay(0.37, 0.1).rest, 0.07, 1e-15);
}

}  // namespace test_exact_filter
}  // namespace dynlab
