#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/linear_regression.h"
#include "numerics/signals/random.h"

namespace test_linear_regression {

using namespace dynlab;

struct Problem {
    Matrix Phi;
    Vector y, truth;
};

Problem random_problem(Index N, Index d, double noise, std::uint32_t seed = 1) {
    RandomStream random(seed);
    Problem problem{Matrix(N, d), Vector(), Vector::LinSpaced(d, -1, 2)};
    for (Index j = 0; j < d; ++j) problem.Phi.col(j) = random.normal(N);
    problem.y = problem.Phi * problem.truth + noise * random.normal(N);
    return problem;
}

TEST(linear_regression, exact_data_give_the_truth) {  // oracle: analytic
    for (auto method : {RegressionMethod::kQr, RegressionMethod::kNormal}) {
        const Problem p = random_problem(30, 4, 0);
        const LinearRegression fit = lsq(p.Phi, p.y, method);
        EXPECT_LT((fit.theta - p.truth).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT(fit.rmse, 1e-13);
        EXPECT_EQ(fit.rank, 4);
    }
}

TEST(linear_regression, residuals_are_orthogonal_to_the_regressors) {  // oracle: residual of the definition
    const Problem p = random_problem(60, 3, 0.5);
    for (auto method : {RegressionMethod::kQr, RegressionMethod::kNormal}) {
        const LinearRegression fit = lsq(p.Phi, p.y, method);
        EXPECT_LT((p.Phi.transpose() * fit.residuals).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((fit.fitted + fit.residuals - p.y).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(linear_regression, both_routes_agree) {  // oracle: second route
    const Problem p = random_problem(200, 5, 0.3);
    const LinearRegression qr = lsq(p.Phi, p.y), normal = lsq(p.Phi, p.y, RegressionMethod::kNormal);
    EXPECT_LT((qr.theta - normal.theta).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((qr.covariance - normal.covariance).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((qr.std - normal.std).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(linear_regression, straight_line_has_the_textbook_errors) {  // oracle: analytic formulas of the simple regression
    const Vector x{{1.0, 2.0, 4.0, 7.0, 11.0}}, y{{2.0, 3.5, 4.0, 9.0, 12.5}};
    const PolynomialFit fit = fit_polynomial(x, y, 1, {false, RegressionMethod::kQr});
    const double xm = x.mean(), ym = y.mean(), Sxx = (x.array() - xm).square().sum();
    const double slope = ((x.array() - xm) * (y.array() - ym)).sum() / Sxx;
    const double squares = (y.array() - ym - slope * (x.array() - xm)).square().sum();
    const double sigma = std::sqrt(squares / 3);
    EXPECT_NEAR(fit.regression.theta[0], slope, 1e-13);
    EXPECT_NEAR(fit.regression.theta[1], ym - slope * xm, 1e-13);
    EXPECT_NEAR(fit.regression.sigma, sigma, 1e-13);
    EXPECT_NEAR(fit.regression.rmse, std::sqrt(squares / 5), 1e-13);
    EXPECT_NEAR(fit.regression.std[0], sigma / std::sqrt(Sxx), 1e-13);
    EXPECT_NEAR(fit.regression.std[1], sigma * std::sqrt(0.2 + xm * xm / Sxx), 1e-13);
    const Forecast next = forecast(fit, 13, 0.95);
    constexpr double kT = 3.182446305284263;  // two-sided 95 %, 3 degrees of freedom, printed tables: 3.182
    const double std = sigma * std::sqrt(1 + 0.2 + (13 - xm) * (13 - xm) / Sxx);
    EXPECT_NEAR(next.value, ym + slope * (13 - xm), 1e-12);
    EXPECT_NEAR(next.std, std, 1e-12);
    EXPECT_NEAR(next.mean_std, sigma * std::sqrt(0.2 + (13 - xm) * (13 - xm) / Sxx), 1e-12);
    EXPECT_NEAR(next.high - next.value, kT * std, 1e-9);
    EXPECT_NEAR(next.value - next.low, kT * std, 1e-9);
}

TEST(linear_regression, centring_changes_the_conditioning_only) {  // oracle: second route
    const Index N = 29;
    const Vector years = Vector::LinSpaced(N, 1896, 2020);
    const Vector times = 11.0 - 0.012 * (years.array() - 1896) + 0.1 * RandomStream(2).normal(N).array();
    const PolynomialFit centered = fit_polynomial(years, times, 1),
                        plain = fit_polynomial(years, times, 1, {false, {}});
    EXPECT_LT(centered.regression.condition_number, 50);
    EXPECT_GT(plain.regression.condition_number, 1e4);
    EXPECT_NEAR(centered.coefficients[0], plain.coefficients[0], 1e-12);
    EXPECT_NEAR(centered.coefficients[1], plain.coefficients[1], 1e-9);
    const Forecast a = forecast(centered, 2024), b = forecast(plain, 2024);
    EXPECT_NEAR(a.value, b.value, 1e-10);
    EXPECT_NEAR(a.high, b.high, 1e-9);
    EXPECT_NEAR(forecast(centered, 1950).value, forecast(plain, 1950).value, 1e-10);
}

TEST(linear_regression, polynomial_coefficients_describe_the_same_curve) {  // oracle: analytic
    const Vector x = Vector::LinSpaced(12, 3, 9);
    const Vector y = 2 * x.array().cube() - x.array() + 4;
    const PolynomialFit fit = fit_polynomial(x, y, 3);
    EXPECT_LT((fit.coefficients - Vector{{2.0, 0.0, -1.0, 4.0}}).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(forecast(fit, 20).value, 2 * 8000 - 20 + 4, 1e-8);
}

TEST(linear_regression, interval_covers_as_often_as_it_says) {  // oracle: statistics, fixed seed
    RandomStream random(11);
    const Vector x = Vector::LinSpaced(12, 0, 1);
    const int runs = 4000;
    int covered = 0;
    for (int run = 0; run < runs; ++run) {
        const Vector y = 1 + 2 * x.array() + 0.3 * random.normal(12).array();
        const Forecast next = forecast(fit_polynomial(x, y, 1), 1.5, 0.9);
        const double truth = 4 + 0.3 * random.normal();
        covered += truth > next.low && truth < next.high;
    }
    EXPECT_NEAR(covered / double(runs), 0.9, 4 * std::sqrt(0.9 * 0.1 / runs));
}

TEST(linear_regression,
     dependent_columns_are_reported) {  // oracle: analytic, solution of least norm of [1 1] theta = 2
    Matrix Phi = Matrix::Ones(5, 2);
    const LinearRegression fit = lsq(Phi, Vector::Constant(5, 2));
    EXPECT_EQ(fit.rank, 1);
    EXPECT_NEAR(fit.theta[0], 1, 1e-12);
    EXPECT_NEAR(fit.theta[1], 1, 1e-12);
    EXPECT_NE(message_text(fit.message).find("depend"), std::string::npos);
    EXPECT_THROW(lsq(Phi, Vector::Constant(5, 2), RegressionMethod::kNormal), InvalidArgument);
}

TEST(linear_regression, as_many_parameters_as_samples_have_no_noise_estimate) {  // justified: no degrees of freedom
    const Problem p = random_problem(3, 3, 0);
    const LinearRegression fit = lsq(p.Phi, p.y);
    EXPECT_LT((fit.theta - p.truth).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_TRUE(std::isnan(fit.sigma));
    EXPECT_THROW(forecast(fit, Vector::Ones(3)), InvalidArgument);
}

TEST(linear_regression, refuses_what_does_not_fit) {
    const Problem p = random_problem(10, 2, 0.1);
    EXPECT_THROW(lsq(p.Phi, Vector::Ones(9)), InvalidArgument);
    EXPECT_THROW(lsq(Matrix::Ones(1, 2), Vector::Ones(1)), InvalidArgument);
    Vector bad = p.y;
    bad[3] = std::nan("");
    EXPECT_THROW(lsq(p.Phi, bad), InvalidArgument);
    const LinearRegression fit = lsq(p.Phi, p.y);
    EXPECT_THROW(forecast(fit, Vector::Ones(3)), InvalidArgument);
    EXPECT_THROW(forecast(fit, Vector::Ones(2), 95), InvalidArgument);
    EXPECT_THROW(fit_polynomial(Vector::Ones(5), Vector::Ones(5), 1), InvalidArgument);
    EXPECT_THROW(fit_polynomial(Vector::LinSpaced(5, 0, 1), Vector::Ones(5), -1), InvalidArgument);
    EXPECT_THROW(fit_polynomial(Vector::LinSpaced(5, 0, 1), Vector::Ones(4), 1), InvalidArgument);
}

}  // namespace test_linear_regression
