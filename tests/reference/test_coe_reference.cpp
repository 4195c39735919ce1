#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/srivc.h"
#include "support/transfer_cases.h"

namespace test_coe_reference {

using namespace dynlab;
using namespace dynlab::test;

Vector numbers(const nlohmann::json& list) {
    Vector result(static_cast<Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) result[static_cast<Index>(i)] = std::stod(list[i].get<std::string>());
    return result;
}

TransferStructure structure_of(const std::string& set) {
    return set.starts_with("rg") ? TransferStructure::single(4, 1) : TransferStructure::single(2, 0);
}

FitOptions exact() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

TEST(coe_reference, output_error_rows_match_the_long_double_program) {  // oracle: reference data in 80-bit arithmetic
    std::ifstream file(std::string(DYNLAB_SOURCE_DIR) + "/tests/reference/data/gold_longdouble.json");
    int compared = 0;
    for (const auto& row : nlohmann::json::parse(file)) {
        const std::string set = row[0], method = row[1];
        if (method.find("oe") == std::string::npos) continue;
        SCOPED_TRACE(set);
        const bool noise_free = set.find("noisefree") != std::string::npos;
        const auto found = coe(reference_data(set, 0.01), structure_of(set), exact());
        EXPECT_LT(relative_difference(found.theta, numbers(row[2])), noise_free ? 1e-9 : 1e-7);
        ++compared;
        if (noise_free) continue;
        EXPECT_EQ(found.termination, Termination::kConverged);
        EXPECT_LT(relative_difference(found.std, numbers(row[3])), 1e-7);
        const double N = static_cast<double>(reference_data(set, 0.01).sample_count());
        EXPECT_NEAR(found.loss * N / std::stod(row[4].get<std::string>()), 1, 1e-10);
    }
    EXPECT_EQ(compared, 5);
}

TEST(coe_reference, output_error_rows_match_two_programs) {  // oracle: reference data, two programs, 8 digits
    std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> expected;
    for (const auto& row : reference_rows("reference_8digits.csv"))
        if (row[1] == "oe" && row[0].find("noisefree") == std::string::npos && !row[0].starts_with("P")) {
            expected[row[0]].first.push_back(std::stod(row[3]));
            expected[row[0]].second.push_back(std::stod(row[5]));
        }
    EXPECT_EQ(expected.size(), 3u);
    for (const auto& [set, values] : expected) {
        SCOPED_TRACE(set);
        const auto found = coe(reference_data(set, 0.01), structure_of(set), exact());
        ASSERT_EQ(static_cast<Index>(values.first.size()), found.theta.size());
        EXPECT_LT(relative_difference(found.theta, Vector::Map(values.first.data(), found.theta.size())), 1e-7);
        EXPECT_LT(relative_difference(found.std, Vector::Map(values.second.data(), found.std.size())), 1e-7);
    }
}

TEST(coe_reference, equals_srivc) {  // oracle: second route, the fixed point of the refined instruments
    for (const std::string set : {"sys2_s0.2_seed1", "sys2_s0.4_seed1", "rg_snr10_seed1"}) {
        const IdData data = reference_data(set, 0.01);
        EXPECT_LT(relative_difference(coe(data, structure_of(set), exact()).theta,
                                      srivc(data, structure_of(set), exact()).theta),
                  1e-8)
            << set;
    }
}

}  // namespace test_coe_reference
