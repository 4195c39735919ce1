#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "numerics/error.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/simulation/time_response.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/uncertainty.h"

namespace test_uncertainty {

using namespace dynlab;

// Third order with a zero and a delay: theta = [a1 a2 a3 b0 b1 delay].
const Vector kTheta{{4.0, 9.0, 6.0, -1.0, 3.0, 0.4}};

TransferFunction model_at(const Vector& theta) {
    Vector den(4);
    den << 1, theta.head(3);
    return TransferFunction(theta.segment(3, 2), den, 0, theta[5]);
}

Matrix some_covariance(const Vector& size, std::uint32_t seed = 1) {
    const Index d = size.size();
    const Vector numbers = RandomStream(seed).normal(d * d);
    const Matrix root = size.asDiagonal() * numbers.reshaped(d, d);
    return root * root.transpose();
}

const Matrix kCovariance = some_covariance(0.002 * Vector::Ones(6));

// Standard deviations by central differences of any function of theta.
Vector std_by_differences(const std::function<Vector(const Vector&)>& f, const Matrix& covariance,
                          const Vector& theta) {
    Matrix derivatives(f(theta).size(), theta.size());
    for (Index i = 0; i < theta.size(); ++i) {
        const double h = 1e-5 * std::max(1.0, std::abs(theta[i]));
        Vector above = theta, below = theta;
        above[i] += h, below[i] -= h;
        derivatives.col(i) = (f(above) - f(below)) / (2 * h);
    }
    return (derivatives * covariance * derivatives.transpose()).diagonal().cwiseSqrt();
}

void expect_close(const Vector& actual, const Vector& expected, double tolerance) {
    ASSERT_EQ(actual.size(), expected.size());
    EXPECT_LT((actual - expected).norm(), tolerance * expected.norm());
}

TEST(uncertainty, step_response_equals_finite_differences) {  // oracle: differences of the response
    Vector t(5);
    t << 0.1, 0.7, 1.0, 2.9, 7.3;
    const auto response = [&](const Vector& theta) { return step_response(model_at(theta), t).y; };
    expect_close(step_response_std({model_at(kTheta), kCovariance}, t),
                 std_by_differences(response, kCovariance, kTheta), 1e-7);
}

TEST(uncertainty, step_response_equals_sensitivities_of_a_step) {  // oracle: second route, transfer_sensitivities
    const Vector t = Vector::LinSpaced(200, 0, 9.95);
    const TransferFunction G = model_at(kTheta);
    const Matrix Psi =
        transfer_sensitivities(G.num(), G.den(), G.delay(), Vector::Ones(200), 0.05, Hold::kZoh).rightCols(6);
    const Vector expected = (Psi * kCovariance * Psi.transpose()).diagonal().cwiseSqrt();
    expect_close(step_response_std({G, kCovariance}, t), expected, 1e-9);
}

TEST(uncertainty, gain_of_a_static_step_is_exact) {  // oracle: analytic, y = b0 (1 - exp(-a1 t))/a1
    const double a = 2, b = 3;
    const Matrix P = some_covariance(Vector{{0.1, 0.2}});
    const Vector t{{0.2, 1.0, 4.0}};
    Vector expected(3);
    for (Index k = 0; k < 3; ++k) {
        const double decay = std::exp(-a * t[k]);
        const Eigen::Vector2d g(b * (t[k] * decay / a - (1 - decay) / (a * a)), (1 - decay) / a);
        expected[k] = std::sqrt(g.dot(P * g));
    }
    expect_close(step_response_std({TransferFunction(Vector{{b}}, Vector{{1.0, a}}), P}, t), expected, 1e-12);
}

TEST(uncertainty, frequency_response_equals_finite_differences) {  // oracle: differences of magnitude and phase
    const Vector w{{0.01, 0.5, 2.0, 3.1, 40.0}};
    const auto at = [&](const Vector& theta) { return frequency_response(model_at(theta), w); };
    const auto magnitude = [&](const Vector& theta) { return magnitude_db(at(theta)); };
    const auto phase = [&](const Vector& theta) { return phase_degrees_unwrapped(at(theta)); };
    const auto result = frequency_response_std({model_at(kTheta), kCovariance}, w);
    expect_close(result.magnitude_std, std_by_differences(magnitude, kCovariance, kTheta), 1e-7);
    expect_close(result.phase_std, std_by_differences(phase, kCovariance, kTheta), 1e-7);
}

TEST(uncertainty, everything_agrees_with_monte_carlo_over_theta) {  // oracle: statistics, fixed seed
    constexpr int kRuns = 4000;
    const Vector t{{0.6, 1.5, 4.0}}, w{{0.3, 3.0}};
    const Matrix root = kCovariance.llt().matrixL();
    RandomStream random(7);
    Matrix samples(kRuns, 9);
    for (int run = 0; run < kRuns; ++run) {
        const TransferFunction G = model_at(kTheta + root * random.normal(6));
        const ComplexVector response = frequency_response(G, w);
        const auto modes = damping(G);
        samples.row(run) << step_response(G, t).y.transpose(), magnitude_db(response).transpose(),
            phase_degrees_unwrapped(response).transpose(), modes[0].natural_frequency, modes[2].damping_ratio;
    }
    const Matrix centered = samples.rowwise() - samples.colwise().mean();
    const Vector spread = (centered.colwise().squaredNorm() / (kRuns - 1)).cwiseSqrt().transpose();
    const UncertainModel model(model_at(kTheta), kCovariance);
    const auto frequency = frequency_response_std(model, w);
    const auto modes = describe_uncertainty(model).modes;
    Vector expected(9);
    expected << step_response_std(model, t), frequency.magnitude_std, frequency.phase_std,
        modes[0].natural_frequency_std, modes[2].damping_ratio_std;
    for (Index i = 0; i < 9; ++i) EXPECT_NEAR(spread[i] / expected[i], 1, 0.05) << i;  // 1/sqrt(8000) = 1.1 %
}

TEST(uncertainty, poles_equal_finite_differences) {  // oracle: differences of the roots
    const UncertainModel model(model_at(kTheta), kCovariance);
    for (const RootUncertainty& pole : pole_uncertainty(model)) {
        const auto parts = [&](const Vector& theta) {
            const ComplexVector poles = model_at(theta).poles();
            Index nearest = 0;
            (poles.array() - pole.root).abs().minCoeff(&nearest);
            return Vector{
                {poles[nearest].real(), poles[nearest].imag(), poles[nearest].real() + poles[nearest].imag()}};
        };
        const Vector expected = std_by_differences(parts, kCovariance, kTheta);
        const Eigen::Vector2d both(1, 1);
        const Vector actual{{std::sqrt(pole.covariance(0, 0)), std::sqrt(pole.covariance(1, 1)),
                             std::sqrt(both.dot(pole.covariance * both))}};
        expect_close(actual, expected, 1e-6);
        EXPECT_FALSE(pole.near_multiple);
    }
    const auto zeros = zero_uncertainty(model);
    ASSERT_EQ(zeros.size(), 1u);  // z = -b1/b0
    const auto zero = [](const Vector& theta) { return Vector::Constant(1, -theta[4] / theta[3]); };
    EXPECT_NEAR(std::sqrt(zeros[0].covariance(0, 0)), std_by_differences(zero, kCovariance, kTheta)[0], 1e-8);
}

// Oracle: a pair x +- iy of a1 = -2x, a2 = x^2 + y^2 whose distance 2y has the standard deviation s/y when a2 alone has
// s, and none when x alone moves, da2 = a1/2 da1.
TEST(uncertainty, roots_are_distinguished_along_their_difference) {
    const TransferFunction G(Vector{{1.0}}, Vector{{1.0, 6.0, 10.0}});  // -3 +- i
    const auto near = [&](const Eigen::Vector2d& moves, double std) {
        Matrix covariance = Matrix::Zero(3, 3);
        covariance.topLeftCorner(2, 2) = std * std * moves * moves.transpose();
        const UncertainModel model(G, covariance);
        const bool warned = !describe_uncertainty(model).warnings.empty();
        EXPECT_EQ(warned, pole_uncertainty(model)[0].near_multiple);
        return warned;
    };
    EXPECT_FALSE(near({0, 1}, 0.6));  // 2 beside three times 0.6
    EXPECT_TRUE(near({0, 1}, 0.7));
    EXPECT_FALSE(near({1, 3}, 5));  // both move along the real axis by 2.5, together
}

TEST(uncertainty, modes_and_gain_equal_finite_differences) {  // oracle: differences
    const auto result = describe_uncertainty({model_at(kTheta), kCovariance});
    ASSERT_EQ(result.modes.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto row = [&](const Vector& theta) {
            const auto mode = damping(model_at(theta))[i];
            return Vector{{mode.natural_frequency, mode.damping_ratio, mode.time_constant}};
        };
        const Vector expected = std_by_differences(row, kCovariance, kTheta);
        const ModeUncertainty& mode = result.modes[i];
        EXPECT_NEAR(mode.natural_frequency_std, expected[0], 1e-8);
        EXPECT_NEAR(mode.damping_ratio_std, expected[1], 1e-8);
        EXPECT_NEAR(mode.time_constant_std, expected[2], 1e-8);
    }
    const auto gain = [](const Vector& theta) { return Vector::Constant(1, model_at(theta).dc_gain()); };
    EXPECT_NEAR(result.gain_std, std_by_differences(gain, kCovariance, kTheta)[0], 1e-9);
    EXPECT_TRUE(result.warnings.empty());
}

TEST(uncertainty, warns_of_poles_it_cannot_distinguish) {  // oracle: the poles made, 1 and 1.01
    const TransferFunction G(Vector{{1.0}}, Vector{{1.0, 2.01, 1.01}});
    const auto result = describe_uncertainty({G, 1e-4 * Matrix::Identity(3, 3)});
    EXPECT_EQ(result.warnings.size(), 1u);
    EXPECT_TRUE(describe_uncertainty({G, 1e-10 * Matrix::Identity(3, 3)}).warnings.empty());
    const TransferFunction twice(Vector{{1.0}}, Vector{{1.0, 2.0, 1.0}});
    EXPECT_EQ(describe_uncertainty({twice, 1e-12 * Matrix::Identity(3, 3)}).warnings.size(), 1u);
}

TEST(uncertainty, ellipses_hold_what_they_promise) {  // oracle: Mahalanobis distance of their points
    const auto poles = pole_uncertainty({model_at(kTheta), kCovariance});
    for (const RootUncertainty& pole : poles) {
        const Matrix region = confidence_region(pole, 0.95);
        if (pole.root.imag() == 0) {
            EXPECT_EQ(region.rows(), 2);
            EXPECT_NEAR(region(1, 0) - pole.root.real(), 1.959963985 * std::sqrt(pole.covariance(0, 0)), 1e-8);
            continue;
        }
        const Eigen::Vector2d center(pole.root.real(), pole.root.imag());
        for (Index k = 0; k < region.rows(); ++k) {
            const Eigen::Vector2d away = region.row(k).transpose() - center;
            EXPECT_NEAR(away.dot(pole.covariance.inverse() * away), chi_squared_quantile(0.95, 2), 1e-8);
        }
        EXPECT_LT((region.row(0) - region.row(region.rows() - 1)).norm(), 1e-12);
    }
}

TEST(uncertainty, process_models_agree_with_their_coefficients) {  // oracle: differences of the step response
    const ProcessModel process(ProcessStructure::parse("P2DU"), Vector{{2.0, 0.5, 0.3, 0.7}});
    const Matrix P = some_covariance(Vector{{0.01, 0.002, 0.003, 0.004}});
    const Vector t{{0.2, 0.9, 2.0, 5.0}};
    const auto response = [&](const Vector& parameters) {
        return step_response(ProcessModel(process.structure, parameters).transfer_function(), t).y;
    };
    expect_close(step_response_std({process, P}, t), std_by_differences(response, P, process.parameters), 1e-7);
}

TEST(uncertainty, refuses_what_it_cannot_describe) {
    const TransferFunction G(Vector{{1.0}}, Vector{{1.0, 2.0}});
    EXPECT_THROW(UncertainModel(G, Matrix::Identity(4, 4)), InvalidArgument);
    EXPECT_THROW(UncertainModel(TransferFunction(Vector{{1.0}}, Vector{{1.0, 0.5}}, 0.1), Matrix::Identity(2, 2)),
                 InvalidArgument);
    EXPECT_THROW(
        UncertainModel(ProcessModel(ProcessStructure::parse("P1"), Vector{{1.0, 2.0}}), Matrix::Identity(3, 3)),
        InvalidArgument);
    EXPECT_TRUE(std::isnan(
        describe_uncertainty({TransferFunction(Vector{{1.0}}, Vector{{1.0, 0.0}}), Matrix::Identity(2, 2)}).gain_std));
}

}  // namespace test_uncertainty
