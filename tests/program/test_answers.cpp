#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/program.h"

namespace dynlab::test {
namespace test_answers {
using ::testing::HasSubstr;

constexpr const char* kHeader = "-- ---\n-- title: A\n-- answers:\n--   gain: number\n--   G: model\n-- ---\n";

// oracle: the header's promises
TEST(answers, are_told_at_once_when_missing_unknown_or_of_the_wrong_kind) {
    const Workbench bench;
    const auto run = [&](const std::string& code) {
        bench.write("a.lua", kHeader + code);
        return bench.dynlab({"run", "a.lua", "--out", "out"});
    };
    const ChildResult missing = run("answer('gain', 2)\n");
    EXPECT_EQ(missing.exit_code, 0);
    EXPECT_EQ(missing.error_output, "dynlab: answers that are not given yet: G (model)\n");
    EXPECT_EQ(run("answer('gain', 2) answer('G', tf({2}, {1, 1}))").error_output, "");
    EXPECT_THAT(run("answer('gian', 2)\n").error_output,
                HasSubstr("a.lua:7: answer: the script's header declares no answer \"gian\"; did you mean \"gain\"?"));
    EXPECT_THAT(run("answer('gain', '2')\n").error_output,
                HasSubstr("must be of the kind number, but a text was given"));
    EXPECT_THAT(run("answer('gain', 2) answer('gain', 3)").error_output, HasSubstr("was given already"));
}

// oracle: the vector that stands for the same numbers
TEST(answers, a_table_of_numbers_is_a_vector_where_one_is_wanted) {
    const Workbench bench;
    const auto given = [&](const std::string& value) {
        bench.write("a.lua", "-- ---\n-- title: A\n-- answers:\n--   v: vector\n-- ---\nanswer('v', " + value + ")\n");
        const ChildResult run = bench.dynlab({"run", "a.lua", "--out", "out"});
        return run.exit_code == 0 ? nlohmann::json::parse(bench.read("out/record.json")).at("answers").dump()
                                  : run.error_output;
    };
    EXPECT_EQ(given("{9.7, 9.5, 9.9}"), given("vector{9.7, 9.5, 9.9}"));
    EXPECT_THAT(given("{9.7, 'x'}"), HasSubstr("must be a vector of numbers, but its element 2 is the text"));
    EXPECT_THAT(given("'x'"), HasSubstr("must be of the kind vector, but a text was given"));
}

// oracle: what was handed in
TEST(answers, stand_in_the_record_bit_by_bit) {
    const Workbench bench;
    ASSERT_EQ(bench
                  .dynlab({"run", "--out", "out", "-e",
                           "answer('n', 0.1 + 0.2) answer('none', 0/0) answer('t', {1, 'a', {x = true}}) "
                           "answer('G', idproc('P1', {Kp = 2, Tp1 = 3})) answer('v', vector{1, 1/3})"})
                  .exit_code,
              0);
    const auto answers = nlohmann::json::parse(bench.read("out/record.json")).at("answers");
    EXPECT_EQ(answers.at("n").at("value").get<double>(), 0.1 + 0.2);
    EXPECT_EQ(answers.at("none").at("value"), "NaN");
    EXPECT_EQ(answers.at("t").at("items").at(2).at("fields").at("x").at("value"), true);
    EXPECT_EQ(answers.at("G").at("process").at("structure"), "P1");
    EXPECT_EQ(answers.at("v").at("values").at(1).get<double>(), 1.0 / 3);
}

TEST(answers, of_an_unknown_kind_are_refused_in_the_header) {
    const Workbench bench;
    bench.write("a.lua", "-- ---\n-- title: A\n-- answers:\n--   gain: numbre\n-- ---\n");
    EXPECT_THAT(bench.dynlab({"run", "a.lua"}).error_output,
                HasSubstr("unknown kind \"numbre\"; known are number, text"));
}

}  // namespace test_answers
}  // namespace dynlab::test
