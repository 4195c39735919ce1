#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "numerics/fit/discrete/polynomial_fit.h"
#include "support/message_texts.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_polynomial_fit {

using namespace dynlab;
using namespace dynlab::test;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(polynomial_fit, refuses_other_data) {  // oracle: the promises of the header
    const IdData data = course_system_data(0.1, 1);
    const PolynomialOrders orders = PolynomialOrders::arx(1, {1}, {1});
    const auto refusal = [](const IdData& given, const PolynomialOrders& asked) {
        return thrown_message([&] { check_polynomial_data("method", given, asked); });
    };
    EXPECT_EQ(refusal(data, orders), "");
    const Experiment& data_set = data.experiments[0];
    EXPECT_THAT(refusal(IdData(data_set.y, data_set.u, data.time()), orders), HasSubstr("regularly sampled"));
    EXPECT_THAT(refusal(data, PolynomialOrders::arx(1, {1, 1}, {1, 1})),
                HasSubstr("the data have 1 input, so nb, nf and nk need one value for each input"));
    EXPECT_THAT(refusal(data.range(1, 5), PolynomialOrders::arx(1, {1}, {5})), HasSubstr("delay nk = 5"));
}

TEST(polynomial_fit, has_the_model_of_its_values) {  // oracle: values written down
    const PolynomialOrders orders = PolynomialOrders::arx(1, {2}, {1});
    const Fit fit = polynomial_fit(orders, values({-0.5, 1, 2}), 0.1);
    EXPECT_THAT(fit.names, ElementsAre("a1", "b1", "b2"));
    EXPECT_EQ(fit.polynomial->A, values({1, -0.5}));
    EXPECT_EQ(fit.polynomial->B[0], values({0, 1, 2}));
    EXPECT_EQ(fit.orders->nb, orders.nb);
}

TEST(polynomial_fit, reports_models_that_are_not_stable) {  // oracle: poles written down
    Fit stable = polynomial_fit(PolynomialOrders::arx(1, {1}, {1}), values({-0.5, 1}), 1);
    warn_of_unstable_polynomials(stable);
    EXPECT_THAT(stable.warnings, IsEmpty());
    Fit unstable = polynomial_fit(PolynomialOrders::arx(1, {1}, {1}), values({-1.5, 1}), 1);
    warn_of_unstable_polynomials(unstable);
    EXPECT_THAT(texts_of(unstable.warnings),
                ElementsAre(AllOf(HasSubstr("outside or on the unit circle"), HasSubstr("sriv"))));
}

// Oracle: the remedy itself, on little data of a slow stable system whose best difference equation is unstable.
TEST(polynomial_fit, the_advice_against_unstable_models_helps) {
    const Index N = 150;
    Vector u = Vector::Zero(N);
    u.segment(10, 40).setOnes();
    const Vector x = lsim(TransferFunction(values({1}), values({1, 0.003})), u, 0.1);
    const PolynomialOrders orders = PolynomialOrders::output_error({1}, {1}, {1});
    int unstable = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const IdData data(Matrix(x + 0.6 * RandomStream(seed).normal(N)), Matrix(u), 0.1);
        const Fit fit = oe(data, orders);
        if (fit.polynomial->transfer_function(0).stable()) continue;
        ++unstable;
        EXPECT_THAT(texts_of(fit.warnings), Contains(HasSubstr("or sriv, which keeps the poles inside the circle")))
            << seed;
        EXPECT_TRUE(sriv(data, orders).polynomial->transfer_function(0).stable()) << seed;
    }
    EXPECT_GE(unstable, 3);
}

}  // namespace test_polynomial_fit
