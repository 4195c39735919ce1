#include <gtest/gtest.h>

#include "numerics/estimators/procsrivc.h"
#include "support/reference_data.h"

namespace test_procsrivc_reference {

using namespace dynlab;
using namespace dynlab::test;

IdData reference_set(const std::string& name) {
    const auto columns = reference_columns(name + ".csv");
    const auto& y = columns.at("y");
    const auto& u = columns.at("u");
    const Index N = static_cast<Index>(y.size());
    return IdData(Matrix(Vector::Map(y.data(), N)), Matrix(Vector::Map(u.data(), N)), 0.05);
}

struct Expected {
    std::vector<double> values, errors;
};

// Time constants of P2D in falling order, as found there too.
Expected expected_for(const std::string& name) {
    Expected expected;
    for (const auto& row : reference_rows("reference_8digits.csv"))
        if (row[0] == name) {
            expected.values.push_back(std::stod(row[3]));
            expected.errors.push_back(std::stod(row[5]));
        }
    return expected;
}

ProcsrivcOptions exact_options() {
    ProcsrivcOptions options;
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kNone;
    options.tolerance = 1e-10;
    return options;
}

class procsrivc_reference : public testing::TestWithParam<const char*> {};

TEST_P(procsrivc_reference, noisy_set_matches_two_programs) {  // oracle: reference data
    const std::string structure = GetParam(), name = structure + "_s0.1_seed1";
    const auto result = procsrivc(reference_set(name), ProcessStructure::parse(structure), exact_options());
    const Expected expected = expected_for(name);
    ASSERT_EQ(static_cast<std::size_t>(result.theta.size()), expected.values.size());
    EXPECT_EQ(result.termination, Termination::kConverged);
    for (Index i = 0; i < result.theta.size(); ++i) {
        const double value = expected.values[static_cast<std::size_t>(i)];
        EXPECT_NEAR(result.theta[i] / value, 1, 1e-7) << result.names[static_cast<std::size_t>(i)];
        EXPECT_NEAR(result.std[i] / expected.errors[static_cast<std::size_t>(i)], 1, 1e-6)
            << result.names[static_cast<std::size_t>(i)];
    }
}

TEST_P(procsrivc_reference, noise_free_set_gives_the_truth) {  // oracle: the simulated system
    const std::string structure = GetParam(), name = structure + "_noisefree";
    const auto result = procsrivc(reference_set(name), ProcessStructure::parse(structure), exact_options());
    const Expected expected = expected_for(name);
    for (Index i = 0; i < result.theta.size(); ++i)
        EXPECT_NEAR(result.theta[i] / expected.values[static_cast<std::size_t>(i)], 1, 1e-9);
    EXPECT_GT(result.fit_percent[0], 100 - 1e-6);
}

TEST_P(procsrivc_reference, defaults_find_the_same_optimum) {  // oracle: reference data, within its standard errors
    const std::string structure = GetParam(), name = structure + "_s0.1_seed1";
    const auto result = procsrivc(reference_set(name), ProcessStructure::parse(structure));
    const Expected expected = expected_for(name);
    for (Index i = 0; i < result.theta.size(); ++i)
        EXPECT_NEAR(result.theta[i], expected.values[static_cast<std::size_t>(i)],
                    0.5 * expected.errors[static_cast<std::size_t>(i)]);
}

INSTANTIATE_TEST_SUITE_P(structures, procsrivc_reference, testing::Values("P1D", "P2D", "P2DU"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace test_procsrivc_reference
