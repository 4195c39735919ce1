// Oracle: what must not change, or change in a known way, when units of signals or time do.
#include <gtest/gtest.h>

#include "numerics/estimators/recursive/rivsvf.h"
#include "numerics/estimators/recursive/rlssvf.h"
#include "numerics/estimators/recursive/rsrivc.h"
#include "support/recursive_cases.h"

namespace test_recursive_properties {

using namespace dynlab;
using namespace dynlab::test;

const TransferStructure kStructure = TransferStructure::single(2, 0);
using Method = Fit (*)(const IdData&, const TransferStructure&, const RecursiveOptions&);
const std::vector<Method> kMethods = {rlssvf, rivsvf, rsrivc};

class recursive_properties : public testing::TestWithParam<std::size_t> {
  protected:
    Vector estimate(const IdData& data, RecursiveOptions options) const {
        options.forgetting = 0.998;
        return kMethods[GetParam()](data, kStructure, options).theta;
    }
};

TEST_P(recursive_properties, other_units_of_the_output_scale_the_numerator) {
    IdData data = course_system_data(0.05, 3);
    const Vector theta = estimate(data, recursive(3));
    data.experiments.front().y *= 1000;
    EXPECT_LT(relative_difference(estimate(data, recursive(3)), theta.cwiseProduct(values({1, 1, 1000}))), 1e-6);
}

TEST_P(recursive_properties, another_unit_of_time_scales_the_coefficients) {
    IdData data = course_system_data(0.05, 3);
    const Vector theta = estimate(data, recursive(3));
    data.Ts *= 60;
    EXPECT_LT(relative_difference(estimate(data, recursive(3.0 / 60)), theta.cwiseQuotient(values({60, 3600, 3600}))),
              1e-6);
}

// 5/(cut-off x Ts), the number of samples in a block for the color of the errors, is whole except for rounding.
TEST_P(recursive_properties, another_unit_of_time_scales_the_standard_errors) {
    for (const double unit : {1e6, 1e-6, 7.0, 1.0 / 3}) {
        IdData data = course_system_data(0.05, 3);
        data.Ts = 0.05;
        const Vector std = kMethods[GetParam()](data, kStructure, recursive(4)).std;
        data.Ts *= unit;
        const Vector scaled = kMethods[GetParam()](data, kStructure, recursive(4 / unit)).std;
        EXPECT_LT(relative_difference(scaled, std.cwiseQuotient(values({unit, unit * unit, unit * unit}))), 1e-6)
            << unit;
    }
}

TEST_P(recursive_properties, what_comes_later_changes_no_history) {
    const IdData data = course_system_data(0.05, 3);
    RecursiveOptions options = recursive(3);
    options.history_points = 10'000;
    const auto whole = kMethods[GetParam()](data, kStructure, options).history;
    const auto part = kMethods[GetParam()](data.range(1, 1200), kStructure, options).history;
    for (Index k = 800; k < 1200; ++k)
        EXPECT_LT(relative_difference(part->theta.row(k).transpose(), whole->theta.row(k).transpose()), 1e-12) << k;
}

INSTANTIATE_TEST_SUITE_P(all, recursive_properties, testing::Range<std::size_t>(0, 3));

}  // namespace test_recursive_properties
