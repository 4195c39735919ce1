#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/fit/discrete/polynomial_fit.h"
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_fit {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

std::string refusal(const std::function<void(FitOptions&)>& change) {
    FitOptions options;
    change(options);
    return thrown_message([&] { options.validate(); });
}

TEST(fit, options_that_make_no_sense_are_named) {  // oracle: the promises of the header
    EXPECT_NO_THROW(FitOptions{}.validate());
    EXPECT_THAT(refusal([](FitOptions& o) { o.lambda = -1; }), HasSubstr("lambda must be a positive number"));
    EXPECT_THAT(refusal([](FitOptions& o) { o.least_delay = -1; }), HasSubstr("`least_delay` must be nonnegative"));
    EXPECT_THAT(refusal([](FitOptions& o) { o.least_delay = 2, o.largest_delay = 1; }),
                HasSubstr("`largest_delay` must be at least `least_delay` = 2, but is 1"));
    EXPECT_THAT(refusal([](FitOptions& o) { o.delay_count = 0; }), HasSubstr("`delay_count`"));
    EXPECT_THAT(refusal([](FitOptions& o) { o.max_iterations = -1; }), HasSubstr("`max_iterations`"));
    EXPECT_THAT(refusal([](FitOptions& o) { o.tolerance = 0; }), HasSubstr("`tolerance` must be positive"));
}

TEST(fit, the_percentage_is_that_of_the_norms) {  // oracle: the formula on numbers written down
    EXPECT_DOUBLE_EQ(fit_percent_of_sums(1, 4), 50);
    EXPECT_DOUBLE_EQ(fit_percent_of_sums(0, 4), 100);
    EXPECT_DOUBLE_EQ(fit_percent_of_sums(16, 4), -100);
    Matrix first(3, 2), second(2, 2);
    first << 1, 0, 2, 0, 3, 6;
    second << 10, 1, 12, 1;
    const IdData data = IdData::merge({IdData(first, Matrix::Ones(3, 1), 1), IdData(second, Matrix::Ones(2, 1), 1)});
    EXPECT_LT((output_variations(data) - values({2 + 2, 24 + 0})).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((output_powers(data) - values({258.0 / 5, 38.0 / 5})).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(fit, of_difference_equations) {  // oracle: the orders' own names
    const PolynomialOrders orders = PolynomialOrders::arx(1, {2}, {1});
    const Fit fit = polynomial_fit(orders, values({-0.5, 2, 1}), 0.1);
    EXPECT_EQ(fit.names, orders.parameter_names());
    EXPECT_EQ(fit.polynomial->A, values({1, -0.5}));
    EXPECT_EQ(fit.polynomial->B[0], values({0, 2, 1}));
}

}  // namespace test_fit
