// The steps that the workbench finds in a script, and edits of its lines. Oracle: the lines, read by the author.
#include "app/workbench/session_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_io/values/value_limits.h"

namespace test_session_script {
using namespace dynlab;
using testing::ElementsAre;

SessionStep only_step(const std::string& source) {
    const std::vector<SessionStep> steps = session_steps(source);
    EXPECT_EQ(steps.size(), 1u) << source;
    return steps.empty() ? SessionStep() : steps.front();
}

TEST(session_script, reads_a_call_with_its_options) {
    const SessionStep step = only_step("G = srivc(data, {1, 2, 0}, {lambda = 3, Fixed = {a2 = 4}})\n");
    EXPECT_THAT(step.names, ElementsAre("G"));
    EXPECT_EQ(step.function, "srivc");
    EXPECT_THAT(step.arguments, ElementsAre("data", "{1, 2, 0}"));
    ASSERT_EQ(step.options.size(), 2u);
    EXPECT_EQ(step.options[0].key + step.options[0].text, "lambda3");
    EXPECT_EQ(step.options[1].text, "{a2 = 4}");
    EXPECT_FALSE(step.local || step.braces);
}

TEST(session_script, reads_methods_values_braces_and_texts) {
    EXPECT_EQ(only_step("ze = z:range(1, 200)").receiver, "z");
    EXPECT_EQ(only_step("ze = z:range(1, 200)").function, "range");
    EXPECT_THAT(only_step("local G0 = 2/(s^2 + 4*s + 3)").arguments, ElementsAre("2/(s^2 + 4*s + 3)"));
    EXPECT_TRUE(only_step("local G0 = 2/(s^2 + 4*s + 3)").local);
    EXPECT_THAT(only_step("a, b = z:split(0.6)").names, ElementsAre("a", "b"));
    const SessionStep study = only_step("M = montecarlo{system = G0, runs = 100}");
    EXPECT_TRUE(study.braces);
    EXPECT_EQ(study.options.at(1).text, "100");
    EXPECT_THAT(only_step("h = load \"crane\"").arguments, ElementsAre("\"crane\""));
    EXPECT_EQ(only_step("report.value(\"fit\", 3)").function, "report.value");
    EXPECT_THAT(only_step("G = tf({1, 2}, {1, 2, 3})").arguments, ElementsAre("{1, 2}", "{1, 2, 3}"));
    EXPECT_EQ(only_step("y = f(x) + 1").function, "");
}

TEST(session_script, leaves_alone_what_controls_cannot_show) {
    EXPECT_TRUE(session_steps("for i = 1, 3 do G = srivc(data, {1, 2, 0}) end\n").empty());
    EXPECT_TRUE(session_steps("local function f()\n  G = srivc(d, {1, 2, 0})\nend\n").empty());
    EXPECT_TRUE(session_steps("if a then\n  G = f(1)\nend\nrepeat\n  x = g(2)\nuntil x\n").empty());
    EXPECT_TRUE(session_steps("-- G = srivc(data, {1, 2, 0})\n").empty());
    EXPECT_TRUE(session_steps("local x\nx.y = f(3)\n").empty());
    EXPECT_TRUE(session_steps("").empty());
    EXPECT_TRUE(session_steps(")}]end end x").empty());
}

TEST(session_script, knows_the_lines_of_steps_over_several) {
    const std::vector<SessionStep> steps = session_steps(
        "-- %% id=one\na = f(1)\n\nb = g(a,\n  {x = 1,\n   y = 2})\nfor i = 1, 2 do\n  c = h(i)\nend\nd = k(b)\n");
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_EQ(steps[0].first_line, 2);
    EXPECT_EQ(steps[1].first_line, 4);
    EXPECT_EQ(steps[1].last_line, 6);
    EXPECT_EQ(steps[2].first_line, 10);
}

std::string seen_in(const std::string& source) {
    std::string text;
    for (const SessionStep& step : session_steps(source)) {
        text += std::to_string(step.first_line) + "-" + std::to_string(step.last_line) + (step.broken ? " broken" : "");
        for (const std::string& name : step.names) text += " " + name;
        text += " = " + step.function;
        for (const std::string& argument : step.arguments) text += "|" + argument;
        text += "\n";
    }
    return text;
}

TEST(session_script, a_statement_that_is_half_typed_takes_nothing_with_it) {
    const std::string before = "a = f(1)\n", behind = "\n-- %% id=later\nb, c = g(a)\n", rest = "4-4 b c = g|a\n";
    EXPECT_EQ(seen_in(before + "G = srivc(data, {1, 2" + behind),
              "1-1 a = f|1\n2-2 broken G = |srivc(data, {1, 2\n" + rest);
    EXPECT_EQ(seen_in(before + "G = 2/(s^2 +" + behind), "1-1 a = f|1\n2-2 broken G = |2/(s^2 +\n" + rest);
    EXPECT_EQ(seen_in(before + "G = 2/" + behind), "1-1 a = f|1\n2-2 broken G = |2/\n" + rest);
    EXPECT_EQ(seen_in(before + "G =" + behind), "1-1 a = f|1\n2-2 broken G = |\n" + rest);
    EXPECT_EQ(seen_in(before + "G = \"never closed" + behind), "1-1 a = f|1\n2-2 broken G = |\"never closed\n" + rest);
    EXPECT_EQ(seen_in(before + "G = 2/\nK = 3" + behind),
              "1-1 a = f|1\n2-2 broken G = |2/\n3-3 K = |3\n5-5 b c = g|a\n");
    EXPECT_EQ(seen_in("M = montecarlo{runs = 3,\n  estimators = {srivc = {{1, 2}}\nK = 3\n"),
              "1-2 broken M = |montecarlo{runs = 3, estimators = {srivc = {{1, 2}}\n3-3 K = |3\n");
    EXPECT_EQ(seen_in("G = srivc(data))\nend\nK = 3\n"), "1-1 G = |srivc(data))\n3-3 K = |3\n");
    EXPECT_EQ(seen_in("a = 1; b = 2\nK = 3\n"), "2-2 K = |3\n") << "nothing unfinished";
}

TEST(session_script, remarks_behind_a_step_stay_and_those_inside_make_it_none) {
    EXPECT_EQ(only_step("G = f(1) -- a remark\n").rest, " -- a remark");
    EXPECT_EQ(only_step("G = f(1);\n").rest, "");
    EXPECT_TRUE(session_steps("G = f(1, -- why\n  2)\n").empty());
    EXPECT_EQ(session_steps("G = f(\"--\", 2)\n").size(), 1u);
}

TEST(session_script, reads_steps_that_were_switched_off) {
    const std::vector<SessionStep> steps =
        session_steps("z = data\n-- off: z = detrend(z, \"mean\")\nG = srivc(z, {1, 2, 0})\n");
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_FALSE(steps[1].on);
    EXPECT_EQ(steps[1].function, "detrend");
    EXPECT_TRUE(steps[2].on);
}

// A statement whose lines hold other text as well is none that may be written again.
TEST(session_script, what_shares_its_lines_with_other_text_is_no_step) {
    EXPECT_TRUE(session_steps("--[[ a\nb ]] G = f(x)\n").empty());
    EXPECT_TRUE(session_steps("G = f(x) --[[ a\nb ]]\n").empty());
    EXPECT_EQ(session_steps("G = f(x) --[ a\n").size(), 1u);
    EXPECT_EQ(session_steps("x = 1\n::top::\ny = 2\n").size(), 2u);
    for (const char* text : {"t = [[\n-- off: z = f(1)\n]]\n", "--[==[\n]]\n-- off: z = f(1)\n]==]\nt = 1\n"})
        EXPECT_EQ(session_steps(text).size(), 1u) << text;
    EXPECT_EQ(session_steps("-- [[\n-- off: z = f(1)\n").size(), 1u) << "a remark of one line";
    EXPECT_EQ(only_step("-- off: z = f(1)  -- why\n").rest, "  -- why");
}

/// People do not write such lines, but programs do. The session that shows them must not exit.
TEST(session_script, lines_may_be_long) {
    const std::string letters(3'000'000, 'x'), blanks(3'000'000, ' ');
    const std::string remark = "--" + letters, step = "a = 1";
    EXPECT_EQ(only_step(remark + "\n" + step + "\n").first_line, 2);
    EXPECT_EQ(only_step(step + " " + remark).rest, " " + remark);
    EXPECT_EQ(only_step(step + blanks).names, std::vector<std::string>{"a"});
    EXPECT_EQ(only_step("-- off: " + step + " " + remark).rest, " " + remark);
    EXPECT_EQ(only_step(letters + " = 1\n").names, std::vector<std::string>{letters});
    EXPECT_EQ(only_step("--[==[" + letters + "]]\n-- off: b = 2\n]==]\n" + step).first_line, 4);
    EXPECT_TRUE(only_step("a = f(" + letters).broken);
    EXPECT_TRUE(only_step(letters + " = f(" + blanks).broken);
}

TEST(session_script, edits_keep_the_line_ends_of_the_script) {
    const std::string source = "G = f(a,\r\n  b)\r\nz = 1\r\n";
    EXPECT_EQ(with_edits(source, {{3, 3, "z = 2\ny = 3"}}), "G = f(a,\r\n  b)\r\nz = 2\r\ny = 3\r\n");
    EXPECT_EQ(session_steps(source).at(0).arguments.at(1), "b");
    EXPECT_EQ(session_steps("G = f({1,\r\n 2})\r\n").at(0).arguments.at(0), "{1,\n 2}");
    EXPECT_EQ(session_steps(source).at(1).rest, "");
}

TEST(session_script, edits_replace_remove_and_insert_lines) {
    const std::string source = "one\ntwo\nthree\n";
    EXPECT_EQ(with_edits(source, {{2, 2, "TWO\nand"}}), "one\nTWO\nand\nthree\n");
    EXPECT_EQ(with_edits(source, {{2, 2, ""}}), "one\nthree\n");
    EXPECT_EQ(with_edits(source, {{4, 3, "four"}}), "one\ntwo\nthree\nfour\n");
    EXPECT_EQ(with_edits(source, {{3, 3, "3"}, {1, 1, "1"}}), "1\ntwo\n3\n");
    EXPECT_EQ(with_edits("no end", {{2, 1, "x"}}), "no end\nx\n");
    EXPECT_THROW(with_edits(source, {{5, 5, "x"}}), ValueError);
    EXPECT_THROW(with_edits(source, {{1, 2, "x"}, {2, 2, "y"}}), ValueError);
    EXPECT_THROW(with_edits(source, {{0, 0, "x"}}), ValueError);
}

}  // namespace test_session_script
