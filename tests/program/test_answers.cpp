// Answers on the command line. Oracle: the header's promises. The rules: tests/unit/workflow/test_script_answers.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.h"

namespace dynlab::test {
namespace test_answers {

TEST(answers, are_in_the_record_and_missing_ones_are_reported_at_once) {
    const Workbench bench;
    bench.write("a.lua",
                "-- ---\n-- title: A\n-- answers:\n--   gain: number\n--   G: model\n-- ---\nanswer('gain', 2)\n");
    const ChildResult run = bench.dynlab({"run", "a.lua", "--out", "out"});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.error_output, "dynlab: answers not given yet: G (model)\n");
    EXPECT_EQ(nlohmann::json::parse(bench.read("out/record.json")).at("answers").at("gain").at("value"), 2);
}

}  // namespace test_answers
}  // namespace dynlab::test
