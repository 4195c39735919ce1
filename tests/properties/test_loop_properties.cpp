// Oracle: what must not change, or change in a known way, when units of signals or time do.
#include <gtest/gtest.h>

#include "numerics/estimators/closed_loop/clivsvf.h"
#include "numerics/estimators/closed_loop/clsrivc.h"
#include "support/loop_cases.h"

namespace test_loop_properties {

using namespace dynlab;
using namespace dynlab::test;

const TransferStructure kPlant = TransferStructure::single(2, 0);

using Method = std::function<Vector(const IdData&, const LoopController&, double time_scale)>;

template <LoopRoute kRoute>
Vector refined(const IdData& data, const LoopController& controller, double time_scale) {
    FitOptions options;
    options.lambda = 4 / time_scale;
    options.tolerance = 1e-11;
    return clsrivc(data, kPlant, options, {controller}, kRoute).theta;
}

Vector filtered(const IdData& data, const LoopController& controller, double time_scale) {
    SvfOptions options;
    options.lambda = 4 / time_scale;
    return clivsvf(data, kPlant, options, {controller}).theta;
}

const std::vector<Method> kMethods = {filtered, refined<LoopRoute::kAuxiliary>, refined<LoopRoute::kIndirect>,
                                      refined<LoopRoute::kTwoStage>};

class loop_properties : public testing::TestWithParam<std::size_t> {
  protected:
    Vector estimate(const IdData& data, const LoopController& controller, double time_scale = 1) const {
        return kMethods[GetParam()](data, controller, time_scale);
    }
};

TEST_P(loop_properties, other_units_of_the_output_scale_the_numerator) {
    IdData data = loop_data(0.05, 3);
    const Vector theta = estimate(data, loop_controller());
    data.experiments.front().y *= 1000;
    data.experiments.front().r *= 1000;
    const LoopController weaker{TransferFunction(loop_controller().C.num() / 1000, loop_controller().C.den(), kLoopTs),
                                1};
    EXPECT_LT(relative_difference(estimate(data, weaker), theta.cwiseProduct(values({1, 1, 1000}))), 1e-6);
}

TEST_P(loop_properties, another_unit_of_time_scales_the_coefficients) {
    IdData data = loop_data(0.05, 3);
    const Vector theta = estimate(data, loop_controller());
    data.Ts *= 60;
    const LoopController slower{TransferFunction(loop_controller().C.num(), loop_controller().C.den(), 60 * kLoopTs),
                                1};
    EXPECT_LT(relative_difference(estimate(data, slower, 60), theta.cwiseQuotient(values({60, 3600, 3600}))), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(all, loop_properties, testing::Range<std::size_t>(0, 4));

}  // namespace test_loop_properties
