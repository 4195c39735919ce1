#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/fit/spectral_estimate.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace test_spectral_estimate {

using namespace dynlab;
using testing::HasSubstr;

TEST(spectral_estimate, one_point_is_a_regression) {  // oracle: complex least squares on drawn numbers
    const Index m = 400;
    const Complex G(0.8, -0.6);
    const Vector parts = RandomStream(3).normal(4 * m);
    ComplexVector U(m), Y(m);
    for (Index i = 0; i < m; ++i) {
        U[i] = Complex(parts[4 * i], parts[4 * i + 1]);
        Y[i] = G * U[i] + 0.3 * Complex(parts[4 * i + 2], parts[4 * i + 3]);
    }
    const double n = static_cast<double>(m), input = U.squaredNorm() / n, output = Y.squaredNorm() / n;
    const Complex cross = U.dot(Y) / n;
    const SpectralPoint point = spectral_point(input, output, cross, n, 0.5);
    const Complex regression = U.dot(Y) / U.squaredNorm();
    const double rest = (Y - regression * U).squaredNorm();
    EXPECT_LT(std::abs(point.response - regression), 1e-14);
    EXPECT_NEAR(point.noise, rest / (n - 1), 1e-12);
    EXPECT_NEAR(point.coherence, 1 - rest / Y.squaredNorm(), 1e-12);
    EXPECT_NEAR(point.std, std::sqrt(rest / (n - 1) / U.squaredNorm() / 2), 1e-12);
    EXPECT_LT(std::abs(point.response - G), 5 * point.std);
    EXPECT_NEAR(spectral_point(input, output, cross, n, 1).std, std::sqrt(2.0) * point.std, 1e-14);
}

TEST(spectral_estimate, data_it_can_work_on) {  // oracle: the promises of the header
    const Matrix y = RandomStream(1).normal(50).array() + 3, u = RandomStream(2).normal(50);
    const auto refusal = [](const IdData& data) {
        return thrown_message([&] { nonparametric_data("spa", data, 20, false); });
    };
    EXPECT_EQ(refusal(IdData(y, u, 0.1)), "");
    EXPECT_NEAR(nonparametric_data("spa", IdData(y, u, 0.1), 20, true).experiments[0].y.mean(), 0, 1e-13);
    EXPECT_EQ(nonparametric_data("spa", IdData(y, u, 0.1), 20, false).experiments[0].y, y);
    EXPECT_THAT(refusal(IdData(y, Matrix(50, 0), 0.1)), HasSubstr("spa: the data have no input"));
    EXPECT_THAT(refusal(IdData(y, u, Vector(Vector::LinSpaced(50, 0, 7)))), HasSubstr("sampled irregularly"));
    EXPECT_THAT(refusal(IdData(y, Matrix::Ones(50, 1), 0.1)), HasSubstr("input never changes"));
    EXPECT_THAT(refusal(IdData(Matrix::Ones(50, 1), u, 0.1)), HasSubstr("output never changes"));
    EXPECT_THAT(refusal(IdData(Matrix(y.topRows(10)), Matrix(u.topRows(10)), 0.1)), HasSubstr("at least 20 samples"));
}

TEST(spectral_estimate, variance_of_zero_becomes_the_largest) {  // oracle: by hand
    const Vector y = RandomStream(1).normal(50), u = RandomStream(2).normal(50);
    SpectralEstimate estimate;
    estimate.w = Vector{{1, 2, 3}};
    estimate.response = ComplexVector::Ones(3);
    estimate.std = Vector{{0.1, 0, 0.2}};
    const IdData data(Matrix(y), Matrix(u), 0.1);
    const FrequencyData response = frequency_data_of(estimate, data, "spa", true);
    EXPECT_LT((response.variance - Vector{{0.02, 0.08, 0.08}}).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(thrown_message([&] { check_frequency_data("srivc", response); }), "");
    estimate.std.setZero();
    EXPECT_EQ(frequency_data_of(estimate, data, "spa", true).variance.size(), 0);
}

}  // namespace test_spectral_estimate
