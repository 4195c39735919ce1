#include <gtest/gtest.h>

#include "numerics/estimators/armax.h"
#include "numerics/estimators/arx.h"
#include "numerics/estimators/bj.h"
#include "numerics/estimators/iv4.h"
#include "numerics/estimators/n4sid.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "support/difference_equation.h"

namespace test_discrete_properties {

using namespace dynlab;
using namespace dynlab::test;

FitOptions tight() {
    FitOptions options;
    options.tolerance = 1e-11;
    options.max_iterations = 200;
    return options;
}

PolynomialOrders with_noise(PolynomialOrders orders, int nc, int nd) {
    orders.nc = nc;
    orders.nd = nd;
    return orders;
}

struct Method {
    const char* name;
    PolynomialOrders (*orders)(int nk);
    Fit (*fit)(const IdData& data, const PolynomialOrders& orders);
};

const Method kMethods[] = {
    {"arx", [](int nk) { return PolynomialOrders::arx(2, {2}, {nk}); },
     [](const IdData& data, const PolynomialOrders& orders) { return arx(data, orders); }},
    {"oe", [](int nk) { return PolynomialOrders::output_error({2}, {2}, {nk}); },
     [](const IdData& data, const PolynomialOrders& orders) { return oe(data, orders, tight()); }},
    {"sriv", [](int nk) { return PolynomialOrders::output_error({2}, {2}, {nk}); },
     [](const IdData& data, const PolynomialOrders& orders) { return sriv(data, orders, tight()); }},
    {"iv4", [](int nk) { return PolynomialOrders::arx(2, {2}, {nk}); },
     [](const IdData& data, const PolynomialOrders& orders) { return iv4(data, orders); }},
    {"armax", [](int nk) { return with_noise(PolynomialOrders::arx(2, {2}, {nk}), 2, 0); },
     [](const IdData& data, const PolynomialOrders& orders) { return armax(data, orders, tight()); }},
    // Without D: with D, the first nd samples are left out, and a later start leaves out other samples.
    {"bj", [](int nk) { return with_noise(PolynomialOrders::output_error({2}, {2}, {nk}), 2, 0); },
     [](const IdData& data, const PolynomialOrders& orders) { return bj(data, orders, tight()); }},
};

struct Signals {
    Vector u, y;
};

Signals simulated_data(double noise) {
    const Vector u = random_levels(600, 4, 3);
    const PolynomialModel model(PolynomialOrders::output_error({2}, {2}, {1}), Vector{{-1.5, 0.7, 1, 0.5}}, 1);
    return {u, model_output(model, u, noise * RandomStream(1).normal(600))};
}

IdData data_of(const Vector& u, const Vector& y, double Ts = 1) {
    return IdData(Matrix(y), Matrix(u), Ts);
}

double worst_relative(const Vector& a, const Vector& b) {
    return (a - b).cwiseQuotient(b).cwiseAbs().maxCoeff();
}

class discrete_properties : public testing::TestWithParam<Method> {
  protected:
    static Fit fit(const IdData& data, int nk = 1) { return GetParam().fit(data, GetParam().orders(nk)); }
};

INSTANTIATE_TEST_SUITE_P(methods, discrete_properties, testing::ValuesIn(kMethods),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(discrete_properties, the_unit_of_time_has_no_say) {  // oracle: invariance
    const auto [u, y] = simulated_data(0.5);
    const auto one = fit(data_of(u, y)), micro = fit(data_of(u, y, 1e-6));
    EXPECT_EQ(one.theta, micro.theta);
    EXPECT_EQ(one.std, micro.std);
}

TEST_P(discrete_properties, a_scaled_output_scales_b) {  // oracle: invariance
    const auto [u, y] = simulated_data(0.5);
    const auto one = fit(data_of(u, y)), large = fit(data_of(u, 1e4 * y));
    Vector expected = one.theta, errors = one.std;
    expected.segment(2, 2) *= 1e4;
    errors.segment(2, 2) *= 1e4;
    EXPECT_LT(worst_relative(large.theta, expected), 1e-8);
    EXPECT_LT(worst_relative(large.std, errors), 1e-7);
    EXPECT_NEAR(large.fit_percent[0], one.fit_percent[0], 1e-7);
}

TEST_P(discrete_properties, a_scaled_input_scales_b_back) {  // oracle: invariance
    const auto [u, y] = simulated_data(0.5);
    const auto one = fit(data_of(u, y)), large = fit(data_of(-1e3 * u, y));
    Vector expected = one.theta;
    expected.segment(2, 2) /= -1e3;
    EXPECT_LT(worst_relative(large.theta, expected), 1e-8);
}

TEST_P(discrete_properties, a_later_output_is_a_longer_delay) {  // oracle: invariance, from rest
    const auto [u, y] = simulated_data(0.5);
    Vector late = Vector::Zero(600);
    late.tail(595) = y.head(595);
    const auto shifted = fit(data_of(u, late), 6);
    const auto cut = fit(data_of(u.head(595), y.head(595)));
    // arx leaves out the samples without a measured past: the shifted data contain the equations of the cut data.
    EXPECT_LT(worst_relative(shifted.theta, cut.theta), 1e-8);
}

TEST_P(discrete_properties, order_of_experiments_does_not_matter) {  // oracle: invariance
    const auto [u, y] = simulated_data(0.5);
    const IdData one = data_of(u, y), other = data_of(u.head(400), 1.1 * y.head(400));
    const auto a = fit(IdData::merge({one, other})), b = fit(IdData::merge({other, one}));
    EXPECT_LT(worst_relative(a.theta, b.theta), 1e-8);
    EXPECT_LT(worst_relative(a.std, b.std), 1e-7);
}

// Oracle: invariance. Units change the gain only, and the order of experiments nothing.
TEST(subspace_properties, units_and_order_of_experiments_have_no_say) {
    const auto [u, y] = simulated_data(0.5);
    Matrix two(600, 2);
    two << y, divided_by(Vector{{1, -0.6}}, u) + 0.2 * RandomStream(2).normal(600);
    for (const SubspaceWeighting weighting :
         {SubspaceWeighting::kMoesp, SubspaceWeighting::kN4sid, SubspaceWeighting::kCva}) {
        SubspaceOptions options;
        options.weighting = weighting;
        const Complex z = std::polar(1.0, 0.3);
        const auto one = n4sid(IdData(two, Matrix(u), 1), 3, options);
        Matrix scaled = two;
        scaled.col(1) *= 1e4;
        const auto large = n4sid(IdData(scaled, Matrix(-1e3 * u), 1e-6), 3, options);
        EXPECT_LT(std::abs(large.fit.models[0].at(z) / one.fit.models[0].at(z) + 1e-3), 1e-10);
        EXPECT_LT(std::abs(large.fit.models[1].at(z) / one.fit.models[1].at(z) + 10.0), 1e-6);
        EXPECT_LT((large.fit.fit_percent - one.fit.fit_percent).cwiseAbs().maxCoeff(), 1e-6);

        const IdData first = data_of(u, y), second = data_of(u.head(400), 1.1 * y.head(400));
        const auto a = n4sid(IdData::merge({first, second}), 2, options);
        const auto b = n4sid(IdData::merge({second, first}), 2, options);
        EXPECT_LT(std::abs(a.fit.models[0].at(z) / b.fit.models[0].at(z) - 1.0), 1e-8);
    }
}

}  // namespace test_discrete_properties
