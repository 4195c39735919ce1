// What lesson 7 says in words, held to a second route: the rigs' parameters, and what must hold for any noise.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "documents/text_lines.h"
#include "numerics/rigs/drifting_process.h"
#include "numerics/rigs/drive.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_feedback_statements {

double number(const nlohmann::json& record, const std::string& name) {
    return record.at("values").at(name).at("number");
}

/// A cell of a table of numbers, "−1.5 ± 0.2" being -1.5.
double cell(const nlohmann::json& record, const char* table, int row, int column) {
    return std::stod(replaced(record.at("tables").at(table).at("rows").at(row).at(column), "−", "-"));
}

TEST(lesson_07_feedback, finds_the_bias_of_the_loop_its_cures_and_the_drift) {
    const Workbench bench(Workbench::Memory::kShared);
    const ChildResult run = bench.dynlab({"run", DYNLAB_SOURCE_DIR "/lessons/07_feedback/lesson.lua", "--out", "made"});
    ASSERT_EQ(run.exit_code, 0) << run.error_output;
    const auto record = nlohmann::json::parse(bench.read("made/record.json"));
    const TransferFunction G = drive_plant({});

    EXPECT_NEAR(number(record, "true_gain"), G.dc_gain(), 1e-9);
    EXPECT_NEAR(cell(record, "direct", 0, 1), G.den()[1], 5e-3);
    EXPECT_NEAR(cell(record, "direct", 0, 2), G.den()[2], 5e-3);
    EXPECT_GT(number(record, "srivc_errors"), 4) << "the standard errors know nothing of the bias";
    EXPECT_GT(number(record, "direct_fit"), number(record, "true_fit")) << "the wrong model wins";
    EXPECT_GE(number(record, "deepest_lag"), 0) << "the voltage comes no earlier";
    EXPECT_GT(number(record, "deepest"), number(record, "open_most"));

    EXPECT_EQ(number(record, "repetitions"), 40);
    for (const char* direct : {"bias_ls", "bias_srivc"}) EXPECT_LT(number(record, direct), -10) << direct;
    for (const char* cure : {"bias_own", "bias_clivsvf", "bias_clsrivc", "bias_two_stage"})
        EXPECT_LT(std::abs(number(record, cure)), 3) << cure;
    EXPECT_GT(number(record, "own_scatter"), number(record, "wrong_scatter")) << "the price of being right";
    EXPECT_GT(number(record, "cl_scatter"), number(record, "wrong_scatter"));

    const DriftingProcessParameters heater;
    const int fourth = 4, fifth = 5, first = 1;  // rows of the pieces, behind the whole record
    EXPECT_LT(cell(record, "pieces", fourth, 1), cell(record, "pieces", first, 1)) << "the gain falls";
    EXPECT_GT(cell(record, "pieces", fifth, 1), cell(record, "pieces", fourth, 1) + 0.03) << "and returns";
    EXPECT_GT(heater.cleaning_time, 2550);
    EXPECT_LT(heater.cleaning_time, 3400) << "in the fourth piece";
    EXPECT_GT(number(record, "ls_time_bias"), 3);
    EXPECT_LT(number(record, "iv_time_bias"), 1);
}

}  // namespace test_feedback_statements
}  // namespace dynlab::test
