// Answers that a script gives. Oracles: the promises of its header, and the bits of the values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "workflow_run.h"

namespace dynlab::test {
namespace test_script_answers {
using ::testing::HasSubstr;

std::string header(const std::string& answers) {
    return "-- ---\n-- title: A\n-- answers:\n" + answers + "-- ---\n";
}

TEST(script_answers, that_are_missing_unknown_repeated_or_of_the_wrong_kind_are_reported) {
    const WorkFolder work;
    const std::string promised = header("--   gain: number\n--   G: model\n");
    const auto missing = [&](const std::string& code) {
        const PercentScript script = parse_percent_script(promised + code, work.path("a.lua"));
        return missing_answers(script, work.run(script).record);
    };
    EXPECT_EQ(missing("answer('gain', 2)\n"), "G (model)");
    EXPECT_EQ(missing("answer('gain', 2) answer('G', tf({2}, {1, 1}))"), "");
    const auto refusal = [&](const std::string& code) {
        const auto error = work.run(promised + code, "a.lua").record.error;
        return error ? error->text() : "";
    };
    EXPECT_THAT(refusal("answer('gian', 2)\n"),
                HasSubstr("a.lua:7: answer: the script's header declares no answer \"gian\"; did you mean \"gain\"?"));
    EXPECT_THAT(refusal("answer('gain', '2')\n"),
                HasSubstr("must be of the kind number, but a value of the kind text was given"));
    EXPECT_THAT(refusal("answer('gain', 2) answer('gain', 3)"), HasSubstr("already has another value"));
    EXPECT_THAT(error_of([&] { parse_percent_script(header("--   gain: numbre\n"), "a.lua"); }),
                HasSubstr("unknown kind \"numbre\"; the kinds are number, text"));
}

// oracle: the vector of the same numbers
TEST(script_answers, a_table_of_numbers_is_a_vector_where_one_is_wanted) {
    const WorkFolder work;
    const auto given = [&](const std::string& value) {
        const RunRecord record = work.run(header("--   v: vector\n") + "answer('v', " + value + ")\n").record;
        return record.error ? record.error->text() : record.answers.at("v").json;
    };
    EXPECT_EQ(given("{9.7, 9.5, 9.9}"), given("vector{9.7, 9.5, 9.9}"));
    EXPECT_THAT(given("{9.7, 'x'}"), HasSubstr("must be a vector of numbers, but its element 2 is the string"));
    EXPECT_THAT(given("'x'"), HasSubstr("must be of the kind vector, but a value of the kind text was given"));
}

TEST(script_answers, are_in_the_record_bit_by_bit) {
    const RunRecord record = WorkFolder()
                                 .run(
                                     "answer('n', 0.1 + 0.2) answer('none', 0/0) answer('t', {1, 'a', {x = true}}) "
                                     "answer('G', idproc('P1', {Kp = 2, Tp1 = 3})) answer('v', vector{1, 1/3})")
                                 .record;
    ASSERT_FALSE(record.error) << record.error->text();
    const auto answers = nlohmann::json::parse(to_json(record)).at("answers");
    EXPECT_EQ(answers.at("n").at("value").get<double>(), 0.1 + 0.2);
    EXPECT_EQ(answers.at("none").at("value"), "NaN");
    EXPECT_EQ(answers.at("t").at("items").at(2).at("fields").at("x").at("value"), true);
    EXPECT_EQ(answers.at("G").at("process").at("structure"), "P1");
    EXPECT_EQ(answers.at("v").at("values").at(1).get<double>(), 1.0 / 3);
}

}  // namespace test_script_answers
}  // namespace dynlab::test
