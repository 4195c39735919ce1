#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/fit/equation_error.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_equation_error {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const PolynomialOrders kOrders = PolynomialOrders::arx(1, {1}, {1});

IdData simulated_data(Index N, std::uint32_t seed) {
    const Vector u = random_levels(N, 3, seed + 100), e = 0.2 * RandomStream(seed).normal(N);
    return IdData(Matrix(model_output(PolynomialModel(kOrders, Vector{{-0.7, 0.5}}, 1), u, e)), Matrix(u), 1);
}

TEST(equation_error, measures_of_a_fit) {  // oracle: both errors sample by sample
    const IdData data = IdData::merge({simulated_data(300, 1), simulated_data(200, 2)});
    const double a = -0.6, b = 0.4;
    double predicted = 0, simulated = 0, spread = 0;
    for (const Experiment& x : data.experiments) {
        const Vector y = x.y.col(0), later = y.tail(y.size() - 1);
        double state = y[0];
        for (Index k = 1; k < y.size(); ++k) {
            predicted += std::pow(y[k] + a * y[k - 1] - b * x.u(k - 1, 0), 2);
            state = -a * state + b * x.u(k - 1, 0);
            simulated += std::pow(y[k] - state, 2);
        }
        spread += (later.array() - later.mean()).square().sum();
    }
    Fit fit = polynomial_fit(kOrders, Vector{{a, b}}, 1);
    report_equation_error(fit, data);
    EXPECT_NEAR(fit.loss, predicted / 498, 1e-12);
    EXPECT_NEAR(fit.noise_variance[0], predicted / 496, 1e-12);
    EXPECT_NEAR(fit.prediction_fit_percent, 100 * (1 - std::sqrt(predicted / spread)), 1e-9);
    EXPECT_NEAR(fit.fit_percent[0], 100 * (1 - std::sqrt(simulated / spread)), 1e-9);
    fit.covariance = Matrix::Identity(2, 2) * 1e-4;
    fit.condition_number = 1;
    describe_equation_error(fit);
    EXPECT_TRUE(fit.warnings.empty());
    EXPECT_NEAR(fit.std[0], 0.01, 1e-15);
}

TEST(equation_error, what_is_refused) {  // oracle: the promises of the header
    const IdData data = simulated_data(50, 1);
    PolynomialOrders noisy = kOrders;
    noisy.nc = 1;
    EXPECT_THAT(thrown_message([&] { check_equation_error("arx", data, noisy); }), HasSubstr("nc, nd and nf"));
    EXPECT_THAT(thrown_message([&] { check_equation_error("arx", data.range(1, 3), kOrders); }),
                HasSubstr("more equations than parameters, but the data provide only 2"));
    IdData poor = simulated_data(200, 1);
    poor.experiments[0].u.setOnes();  // shows only the sum of two coefficients of B
    EXPECT_THAT(thrown_message([&] { solve_rich_arx("arx", poor, PolynomialOrders::arx(1, {2}, {0})); }),
                HasSubstr("arx"));
}

}  // namespace test_equation_error
