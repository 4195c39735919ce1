#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/models/convert.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"

namespace test_polynomial_model {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;

PolynomialOrders all_orders() {
    PolynomialOrders orders = PolynomialOrders::output_error({2, 1}, {1, 2}, {1, 3});
    orders.na = 1;
    orders.nc = 1;
    orders.nd = 2;
    return orders;
}

TEST(polynomial_model, places_follow_the_names) {  // oracle: definition
    const PolynomialOrders orders = all_orders();
    EXPECT_THAT(orders.parameter_names(),
                ElementsAre("a1", "f1_u1", "b1_u1", "b2_u1", "f1_u2", "f2_u2", "b3_u2", "c1", "d1", "d2"));
    EXPECT_EQ(orders.parameter_count(), 10);
    EXPECT_EQ(orders.f_start(1), 4);
    EXPECT_EQ(orders.b_start(1), 6);
    EXPECT_EQ(orders.c_start(), 7);
    EXPECT_EQ(orders.d_start(), 8);
    EXPECT_EQ(orders.past(), 3);
}

TEST(polynomial_model, holds_its_polynomials) {  // oracle: definition
    const Vector theta = Vector::LinSpaced(10, 1, 10);
    const PolynomialModel model(all_orders(), theta, 0.1);
    EXPECT_EQ(model.A, (Vector{{1, 1}}));
    EXPECT_EQ(model.F[0], (Vector{{1, 2}}));
    EXPECT_EQ(model.B[0], (Vector{{0, 3, 4}}));
    EXPECT_EQ(model.F[1], (Vector{{1, 5, 6}}));
    EXPECT_EQ(model.B[1], (Vector{{0, 0, 0, 7}}));
    EXPECT_EQ(model.C, (Vector{{1, 8}}));
    EXPECT_EQ(model.D, (Vector{{1, 9, 10}}));
}

TEST(polynomial_model, transfer_functions_follow_the_difference_equation) {  // oracle: the recursion
    PolynomialOrders orders = PolynomialOrders::arx(2, {3}, {2});
    const PolynomialModel model(orders, Vector{{-1.2, 0.5, 0.4, -0.3, 0.2}}, 0.5);
    const Vector u = Vector::Unit(12, 0);
    Vector y = Vector::Zero(12);
    for (Index k = 0; k < 12; ++k) {
        const auto at = [&](const Vector& v, Index i) { return i < 0 ? 0.0 : v[i]; };
        y[k] = 1.2 * at(y, k - 1) - 0.5 * at(y, k - 2) + 0.4 * at(u, k - 2) - 0.3 * at(u, k - 3) + 0.2 * at(u, k - 4);
    }
    const TransferFunction G = model.transfer_function();
    EXPECT_DOUBLE_EQ(G.delay(), 0.5);
    EXPECT_LT((lsim(G, u, 0.5) - y).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(polynomial_model, one_sample_of_delay_is_the_hold) {  // oracle: c2d
    const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}});
    const TransferFunction discrete = c2d(G, 0.1);
    Vector theta(4);
    theta << discrete.den().tail(2), discrete.num();
    const PolynomialModel model(PolynomialOrders::arx(2, {2}, {1}), theta, 0.1);
    const TransferFunction back = d2c(model.transfer_function());
    EXPECT_EQ(back.delay(), 0);
    EXPECT_LT((back.den() - G.den()).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT(std::abs(back.num()[back.num().size() - 1] - 2), 1e-10);
}

TEST(polynomial_model, a_direct_term_and_no_poles) {  // oracle: definition
    const PolynomialModel model(PolynomialOrders::arx(0, {2}, {0}), Vector{{3, 2}}, 1);
    EXPECT_EQ(model.transfer_function().num(), (Vector{{3, 2}}));
    EXPECT_EQ(model.transfer_function().den(), (Vector{{1, 0}}));
    EXPECT_EQ(model.transfer_function().delay(), 0);
}

TEST(polynomial_model, refuses_orders_without_meaning) {
    const auto refusal = [](int na, std::vector<int> nb, std::vector<int> nk) {
        return thrown_message([&] { PolynomialOrders::arx(na, nb, nk).validate(); });
    };
    EXPECT_EQ(refusal(2, {1}, {1}), "");
    EXPECT_THAT(refusal(-1, {1}, {1}), HasSubstr("na, the number of poles"));
    EXPECT_THAT(refusal(2, {0}, {1}), HasSubstr("nb, the number of coefficients of B"));
    EXPECT_THAT(refusal(2, {1}, {-1}), HasSubstr("nk, the delay in samples"));
    EXPECT_THAT(refusal(2, {1, 1}, {1}), HasSubstr("nk needs one value for each input"));
    EXPECT_THAT(refusal(2, {}, {}), HasSubstr("at least one input"));
    EXPECT_THAT(thrown_message([] { PolynomialModel(PolynomialOrders::arx(1, {1}, {1}), Vector::Zero(3), 1); }),
                HasSubstr("2 parameters, but the number of specified values is 3"));
    EXPECT_THAT(thrown_message([] { PolynomialModel(PolynomialOrders::arx(1, {1}, {1}), Vector::Zero(2), 0); }),
                HasSubstr("sampling time must be a positive"));
}

}  // namespace test_polynomial_model
