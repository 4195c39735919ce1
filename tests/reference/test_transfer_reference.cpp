#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/srivc.h"
#include "support/transfer_cases.h"

namespace test_transfer_reference {

using namespace dynlab;
using namespace dynlab::test;

struct GoldRow {
    std::string set, method;
    Vector theta, std;
};

Vector numbers(const nlohmann::json& list) {
    Vector result(static_cast<Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) result[static_cast<Index>(i)] = std::stod(list[i].get<std::string>());
    return result;
}

std::vector<GoldRow> gold_rows() {
    std::ifstream file(std::string(DYNLAB_SOURCE_DIR) + "/tests/reference/data/gold_longdouble.json");
    std::vector<GoldRow> rows;
    for (const auto& row : nlohmann::json::parse(file)) {
        GoldRow gold{row[0], row[1], numbers(row[2]), {}};
        if (row.size() > 3 && row[3].is_array()) gold.std = numbers(row[3]);
        rows.push_back(std::move(gold));
    }
    return rows;
}

bool is_rao_garnier(const std::string& set) {
    return set.rfind("rg", 0) == 0;
}

TransferStructure structure_of(const std::string& set) {
    return is_rao_garnier(set) ? TransferStructure::single(4, 1) : TransferStructure::single(2, 0);
}

Fit estimate(const std::string& set, const std::string& method, double lambda) {
    const IdData data = reference_data(set, 0.01);
    SvfOptions options;
    options.lambda = lambda;
    if (method.find("yzoh") != std::string::npos) options.hold_y = Hold::kZoh;
    if (method.rfind("lssvf", 0) == 0) return lssvf(data, structure_of(set), options);
    if (method.rfind("ivsvf", 0) == 0) return ivsvf(data, structure_of(set), options);
    FitOptions refined;
    refined.lambda = lambda;
    refined.tolerance = 1e-10;
    return srivc(data, structure_of(set), refined);
}

// oracle: an independent program in 80-bit arithmetic
TEST(transfer_reference, svf_and_srivc_match_the_long_double_program) {
    int compared = 0;
    for (const GoldRow& gold : gold_rows()) {
        SCOPED_TRACE(gold.set + " " + gold.method);
        const bool noise_free = gold.set.find("noisefree") != std::string::npos;
        const Fit found = estimate(gold.set, gold.method, is_rao_garnier(gold.set) ? 25 : 2);
        EXPECT_LT(relative_difference(found.theta, gold.theta), noise_free ? 1e-9 : 1e-7);
        if (gold.std.size() > 0 && !noise_free) {
            EXPECT_LT(relative_difference(found.std, gold.std), 1e-7);
        }
        ++compared;
    }
    EXPECT_GE(compared, 20);
}

// oracle: two independent programs, printed to 10 digits
TEST(transfer_reference, cutoffs_of_the_course_match) {
    std::map<std::string, std::vector<double>> expected;
    const auto rows = reference_rows("reference_lambda.csv");
    for (std::size_t i = 1; i < rows.size(); ++i)
        expected[rows[i][0] + "," + rows[i][1] + "," + rows[i][2]].push_back(std::stod(rows[i][4]));
    for (const auto& [key, theta] : expected) {
        SCOPED_TRACE(key);
        std::istringstream cells(key);
        std::string set, method, lambda;
        std::getline(cells, set, ',');
        std::getline(cells, method, ',');
        std::getline(cells, lambda, ',');
        const Fit found = estimate(set, method, std::stod(lambda));
        EXPECT_LT(relative_difference(found.theta, Vector::Map(theta.data(), 3)), 1e-7);
    }
    EXPECT_EQ(expected.size(), 3u * 4u * 3u);
}

// oracle: two independent programs, printed to 8 digits
TEST(transfer_reference, srivc_rows_with_exact_instruments_match) {
    std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> expected;
    for (const auto& row : reference_rows("reference_8digits.csv"))
        if (row[1].find("ivexact") != std::string::npos && row[0].find("noisefree") == std::string::npos) {
            auto& [theta, errors] = expected[row[0]];
            if (row[1].find("yfoh") == std::string::npos) continue;
            theta.push_back(std::stod(row[3]));
            errors.push_back(std::stod(row[5]));
        }
    EXPECT_GE(expected.size(), 3u);
    for (const auto& [set, values] : expected) {
        SCOPED_TRACE(set);
        const Fit found = estimate(set, "srivc", is_rao_garnier(set) ? 25 : 2);
        const Index d = found.theta.size();
        ASSERT_EQ(values.first.size(), static_cast<std::size_t>(d));
        EXPECT_LT(relative_difference(found.theta, Vector::Map(values.first.data(), d)), 1e-7);
        EXPECT_LT(relative_difference(found.std, Vector::Map(values.second.data(), d)), 1e-7);
    }
}

}  // namespace test_transfer_reference
