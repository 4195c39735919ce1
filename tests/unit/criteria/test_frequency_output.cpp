#include "numerics/criteria/frequency_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/simulation/sampled_response.h"
#include "support/thrown_message.h"

namespace test_frequency_output {

using namespace dynlab;
using testing::HasSubstr;

const TransferFunction kPlant(Vector{{1.0, 3.0}}, Vector{{1.0, 0.8, 4.0}}, 0, 0.13);
const Vector kFrequencies = Vector::LinSpaced(40, std::log(0.2), std::log(20)).array().exp();

FrequencyData data_of(InterSample inter_sample, double Ts) {
    const ComplexVector H = response_between_samples(kPlant, kFrequencies, Ts, inter_sample);
    return frequency_data(H, kFrequencies, Vector::LinSpaced(40, 0.1, 0.9), Ts, inter_sample);
}

struct Case {
    InterSample inter_sample;
    double Ts;
};
class frequency_output : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(holds, frequency_output,
                         testing::Values(Case{InterSample::kBandLimited, 0}, Case{InterSample::kZoh, 0.1},
                                         Case{InterSample::kFoh, 0.1}));

/// The truth in the model's time units.
Vector true_coefficients(double unit) {
    return Vector{{0.8 * unit, 4 * unit * unit, unit, 3 * unit * unit}};
}

TEST_P(frequency_output, at_the_truth_is_the_response) {
    const FrequencyData data = data_of(GetParam().inter_sample, GetParam().Ts);
    TransferStructure structure = TransferStructure::single(2, 1, 0.13);
    const double unit = frequency_time_unit(data);
    for (const bool free : {false, true}) {
        structure.free_delays = free;
        const FrequencyOutput model(data, structure, true_coefficients(unit), 0, 1);
        const Vector theta = model.parameters(true_coefficients(unit), 0.13 / unit);
        EXPECT_LT((model.output_at(theta) - model.target()).norm(), 1e-11 * model.target().norm());
        const Vector back = model.theta(theta);
        EXPECT_LT((back.head(4) - Vector{{0.8, 4.0, 1.0, 3.0}}).norm(), 1e-12);
        if (free) {
            EXPECT_NEAR(back[4], 0.13, 1e-15);
        }
    }
}

TEST_P(frequency_output, has_the_sensitivities_of_central_differences) {
    const FrequencyData data = data_of(GetParam().inter_sample, GetParam().Ts);
    TransferStructure structure = TransferStructure::single(2, 1);
    structure.free_delays = true;
    const double unit = frequency_time_unit(data);
    const FrequencyOutput model(data, structure, true_coefficients(unit), 0, 1);
    const Vector theta = 1.05 * model.parameters(true_coefficients(unit), 0.13 / unit);
    Vector output;
    Matrix J;
    model.simulate(theta, output, &J);
    for (Index i = 0; i < theta.size(); ++i) {
        const double h = 1e-6 * std::max(1.0, std::abs(theta[i]));
        Vector above = theta, below = theta;
        above[i] += h, below[i] -= h;
        const Vector slope = (model.output_at(above) - model.output_at(below)) / (2 * h);
        EXPECT_LT((J.col(i) - slope).norm(), 1e-7 * slope.norm()) << "parameter " << i;
    }
}

TEST(frequency_output_weights, make_both_parts_of_variance_one) {  // oracle: variance/2 each
    const FrequencyData data = data_of(InterSample::kBandLimited, 0);
    EXPECT_NEAR(response_weights(data)[0], 1 / std::sqrt(0.05), 1e-12);
    const FrequencyData unknown = frequency_data(data.response, data.w, Vector());
    EXPECT_EQ(response_weights(unknown), Vector::Ones(40));
}

TEST(frequency_output_stable, models_are_not_finite_where_they_are_unstable) {
    const FrequencyData data = data_of(InterSample::kBandLimited, 0);
    const Vector unstable{{-0.5, 1.0, 1.0, 1.0}};
    FrequencyOutput model(data, TransferStructure::single(2, 1), unstable);
    EXPECT_TRUE(model.output_at(model.parameters(unstable, 0)).allFinite());
    model.keep_stable();
    EXPECT_FALSE(model.output_at(model.parameters(unstable, 0)).allFinite());
}

TEST(frequency_output_channels, are_one) {
    const FrequencyData data = data_of(InterSample::kBandLimited, 0);
    const TransferStructure two = TransferStructure::grid(1, 2, Denominators::kPerOutput, {2}, {1}, {0.0});
    EXPECT_THAT(thrown_message([&] { FrequencyOutput(data, two, Vector::Ones(4)); }),
                HasSubstr("one input and one output, but the model has 2 and 1"));
}

}  // namespace test_frequency_output
