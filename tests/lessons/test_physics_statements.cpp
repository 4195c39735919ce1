// What lesson 6 says in words, held to a second route: the rigs' parameters and their sensors' noise.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "numerics/rigs/crane.h"
#include "numerics/rigs/two_tanks.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_physics_statements {

double number(const nlohmann::json& record, const std::string& name) {
    return record.at("values").at(name).at("number");
}

double cell(const nlohmann::json& record, const char* table, int row, int column) {
    return std::stod(record.at("tables").at(table).at("rows").at(row).at(column).get<std::string>());
}

TEST(lesson_06_physics, finds_what_the_linear_models_leave) {
    const Workbench bench(Workbench::Memory::kShared);
    const ChildResult run = bench.dynlab({"run", DYNLAB_SOURCE_DIR "/lessons/06_physics/lesson.lua", "--out", "made"});
    ASSERT_EQ(run.exit_code, 0) << run.error_output;
    const auto record = nlohmann::json::parse(bench.read("made/record.json"));
    const CraneTruth crane = crane_truth({});
    const double length = 9.81 / std::pow(crane.natural_frequency, 2);

    EXPECT_NEAR(number(record, "true_length"), 1e3 * length, 1e-6);
    EXPECT_NEAR(number(record, "length"), 1e3 * length, 0.5) << "mm";
    EXPECT_NEAR(number(record, "dry_voltage"), crane.dry_voltage, 0.01);
    EXPECT_LT(number(record, "linear_fit"), 97);
    EXPECT_GE(number(record, "crane_fit_4"), 98);
    EXPECT_LT(number(record, "crane_fit_2"), number(record, "crane_fit_3") - 1) << "friction explains no angle";
    const double potentiometer = 1e3 * std::hypot(2e-3, 1.5e-3 / std::sqrt(12.));
    EXPECT_NEAR(number(record, "left_physics"), potentiometer, 0.2);

    const TwoTanksParameters tanks;
    const double truths[] = {tanks.k1, tanks.k2, tanks.k3, tanks.k4, tanks.overflow_part, tanks.sensor_offset};
    for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(cell(record, "six", k, 1), truths[k], 4 * cell(record, "six", k, 2) + 1e-4) << k;
    const double sensor = std::hypot(tanks.noise_std, tanks.resolution / std::sqrt(12.));
    EXPECT_NEAR(number(record, "physics_error"), sensor, 0.1 * sensor) << "nothing is left";
    EXPECT_GT(number(record, "simple_error"), number(record, "linear_error")) << "half of the physics";
    EXPECT_LT(number(record, "linear_error"), number(record, "narx_error"));
    EXPECT_GT(number(record, "linear_error"), 6 * number(record, "physics_error"));
    EXPECT_LT(number(record, "narx_ahead"), number(record, "narx_error") / 3);
}

}  // namespace test_physics_statements
}  // namespace dynlab::test
