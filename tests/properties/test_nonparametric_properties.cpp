#include <gtest/gtest.h>

#include "numerics/estimators/cra.h"
#include "numerics/estimators/frequency/bla.h"
#include "numerics/estimators/frequency/etfe.h"
#include "numerics/estimators/frequency/spa.h"
#include "numerics/estimators/impulseest.h"
#include "support/difference_equation.h"

namespace test_nonparametric_properties {

using namespace dynlab;
using namespace dynlab::test;

/// The estimate and its standard errors as one vector of real numbers.
using Estimator = Vector (*)(const IdData&);

Vector parts(const SpectralEstimate& estimate) {
    Vector all(3 * estimate.w.size());
    all << estimate.response.real(), estimate.response.imag(), estimate.std;
    return all;
}

Vector parts(const ImpulseEstimate& estimate) {
    Vector all(2 * estimate.t.size());
    all << estimate.response, estimate.std;
    return all;
}

struct Method {
    const char* name;
    Estimator estimate;
};

const Method kMethods[] = {
    {"etfe",
     [](const IdData& data) {
         EtfeOptions options;
         options.smooth = 4;
         return parts(etfe(data, options));
     }},
    {"spa", [](const IdData& data) { return parts(spa(data)); }},
    {"bla",
     [](const IdData& data) {
         BlaOptions options;
         options.period = data.sample_count();
         const FrequencyData found = bla(data, options);
         Vector all(2 * found.w.size());
         all << found.response.real(), found.response.imag();
         return all;
     }},
    {"impulseest", [](const IdData& data) { return parts(impulseest(data)); }},
    {"cra", [](const IdData& data) { return parts(cra(data).impulse); }},
};

const Vector& input() {
    static const Vector u = random_levels(400, 2, 3);
    return u;
}

const Vector& output() {
    static const Vector y =
        divided_by(Vector{{1.0, -0.8}}, weighted_past(Vector{{0.0, 0.5}}, input())) + 0.2 * RandomStream(1).normal(400);
    return y;
}

IdData data_of(const Vector& u, const Vector& y, double Ts = 1) {
    return IdData(Matrix(y), Matrix(u), Ts);
}

class nonparametric_properties : public testing::TestWithParam<Method> {
  protected:
    static void expect_equal(const Vector& a, const Vector& b) {
        ASSERT_EQ(a.size(), b.size());
        EXPECT_LT((a - b).norm(), 1e-7 * b.norm());
    }
};

INSTANTIATE_TEST_SUITE_P(methods, nonparametric_properties, testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(method.param.name); });

TEST_P(nonparametric_properties, scale_with_the_output_and_against_the_input) {  // oracle: linearity
    const Vector plain = GetParam().estimate(data_of(input(), output()));
    expect_equal(GetParam().estimate(data_of(input(), 1e4 * output())), 1e4 * plain);
    expect_equal(GetParam().estimate(data_of(1e-3 * input(), output())), 1e3 * plain);
}

TEST_P(nonparametric_properties, do_not_see_offsets) {  // oracle: means are removed or estimated
    expect_equal(GetParam().estimate(data_of(input().array() + 5, output().array() - 20)),
                 GetParam().estimate(data_of(input(), output())));
}

TEST_P(nonparametric_properties, change_sign_with_a_signal) {  // oracle: linearity; standard errors keep theirs
    const Vector plain = GetParam().estimate(data_of(input(), output()));
    const Vector turned = GetParam().estimate(data_of(input(), -output()));
    expect_equal(turned.cwiseAbs(), plain.cwiseAbs());
    EXPECT_LT(turned.dot(plain), plain.dot(plain));
}

TEST_P(nonparametric_properties, do_not_depend_on_the_unit_of_time) {  // oracle: only the axis changes
    expect_equal(GetParam().estimate(data_of(input(), output(), 1e-3)),
                 GetParam().estimate(data_of(input(), output())));
}

}  // namespace test_nonparametric_properties
