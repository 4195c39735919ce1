#include "numerics/simulation/sampled_response.h"

#include <gtest/gtest.h>

#include <numbers>

#include "numerics/models/convert.h"
#include "numerics/simulation/frequency_response.h"
#include "support/thrown_message.h"

namespace test_sampled_response {

using namespace dynlab;

const TransferFunction kPlant(Vector{{1.0, 3.0}}, Vector{{1.0, 0.8, 4.0}}, 0, 0.13);
const Vector kFrequencies{{0.1, 1.0, 2.0, 10.0, 31.0}};

TEST(sampled_response, equals_that_of_the_discretized_model) {  // second route: c2d by the modified z-transform
    for (const auto& [inter_sample, method] :
         {std::pair(InterSample::kZoh, Discretization::kZoh), std::pair(InterSample::kFoh, Discretization::kFoh)}) {
        const ComplexVector direct = response_between_samples(kPlant, kFrequencies, 0.1, inter_sample);
        const ComplexVector other = frequency_response(c2d(kPlant, 0.1, method), kFrequencies);
        EXPECT_LT((direct - other).norm(), 1e-10 * other.norm());
    }
}

TEST(sampled_response, of_one_pole_is_the_textbook_formula) {  // oracle: (1 - p)/(z - p), p = exp(-Ts)
    const TransferFunction G(Vector{{1.0}}, Vector{{1.0, 1.0}});
    const double Ts = 0.5, p = std::exp(-Ts);
    const ComplexVector found = response_between_samples(G, kFrequencies.head(3), Ts, InterSample::kZoh);
    for (Index k = 0; k < 3; ++k)
        EXPECT_LT(std::abs(found[k] - (1 - p) / (std::polar(1.0, kFrequencies[k] * Ts) - p)), 1e-14);
}

TEST(sampled_response, of_sines_and_of_difference_equations_is_their_own) {
    EXPECT_EQ(response_between_samples(kPlant, kFrequencies, 0.1, InterSample::kBandLimited),
              frequency_response(kPlant, kFrequencies));
    const TransferFunction z(Vector{{1.0}}, Vector{{1.0, -0.5}}, 0.1);
    EXPECT_EQ(response_between_samples(z, kFrequencies, 0.1, InterSample::kZoh), frequency_response(z, kFrequencies));
}

TEST(sampled_response, of_a_gain_is_the_gain) {
    const TransferFunction gain(Vector{{2.5}}, Vector{{1.0}});
    const ComplexVector found = response_between_samples(gain, kFrequencies, 0.1, InterSample::kZoh);
    EXPECT_LT((found.array() - 2.5).abs().maxCoeff(), 1e-12);
}

TEST(sampled_response, of_more_zeros_than_poles_is_refused) {
    const TransferFunction improper(Vector{{1.0, 0.0, 1.0}}, Vector{{1.0, 1.0}});
    EXPECT_NE(thrown_message([&] { response_between_samples(improper, kFrequencies, 0.1, InterSample::kZoh); }), "");
}

}  // namespace test_sampled_response
