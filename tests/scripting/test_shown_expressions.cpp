// Oracle: what the same text prints at the prompt, and the texts of mistakes that stay mistakes, written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <span>

#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/conversions/numeric.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/objects/data_object.h"
#include "scripting/runtime/shown_calls.h"
#include "scripting/runtime/shown_expressions.h"

namespace test_shown_expressions {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using dynlab::test::run;
using testing::HasSubstr;

TEST(shown_expressions, stand_alone_in_a_line) {
    EXPECT_EQ(printed("local x = vector{1, 2, 3}\nx\nx + 1\n2*x[2]\n#x\n-x\n'text'\n{1, 2}\n(x)"),
              "[1 2 3]\n[2 3 4]\n4\n3\n[-1 -2 -3]\ntext\n{1, 2}\n[1 2 3]\n");
}

TEST(shown_expressions, are_shown_in_blocks_and_over_several_lines) {
    EXPECT_EQ(printed("for k = 1, 2 do\n  k*10\nend"), "10\n20\n");
    EXPECT_EQ(printed("local a, b = 2, 3\nsum{\n  a, -- the first\n  b\n} + 1\na, b"), "6\n2\t3\n");
    EXPECT_EQ(printed("local f = function(x)\n  x\n  return x + 1\nend\nf(1) == 2"), "1\ntrue\n");
}

TEST(shown_expressions, are_hidden_by_a_semicolon) {
    EXPECT_EQ(printed("local x = 3\nx;\nx + 1;\nx"), "3\n");
    EXPECT_EQ(error_of("local x\nx + 1;"),
              "lesson.lua:2: the variable 'x' is nil (it has no value), so arithmetic with it is not possible");
}

TEST(shown_expressions, keep_lines_in_messages_and_change_nothing_that_is_lua) {
    EXPECT_EQ(error_of("local x = 1\nx\nprint(y)"), "lesson.lua:3: unknown function or variable 'y'");
    for (const char* code : {"local x = 1\nprint(x)\n", "f(x)\n(g or h)(y)\n", "-- only a comment", ""})
        EXPECT_EQ(with_shown_expressions(code, shown_calls()), code);
}

TEST(shown_expressions, leave_mistakes_as_they_are) {
    for (const char* code : {"local x = = 1", "hold on", "x y z", "for k = 1:10\nend", "print(1) end", "if x\nend",
                             "local v = [1 2 3]", "x = {1, 2", "x +", "a = b c", "if true then 1 + 1 end"})
        EXPECT_EQ(with_shown_expressions(code, shown_calls()), code);
}

TEST(shown_expressions, calls_that_only_compute_are_shown_with_the_names_of_their_results) {
    EXPECT_EQ(printed("local G = tf({1}, {1, 2})\ndamp(G)\npole(G)\ndcgain(G);\n"),
              "{T = [0.5], wn = [2], zeta = [1]}\n[-2]\n");
    EXPECT_EQ(printed("for k = 1, 2 do\n  mean({k, k + 2})\nend\nlocal m =\n  mean({5})\nprint(\n  m)"), "2\n3\n5\n");
    const char* unchanged[] = {
        "local x =\n  mean({1})", "f{\n  mean({1}),\n  2}", "return\n  mean({1})", "mean({1}).x = 2", "fit = {1}",
        "local p = pole(G)",      "x = y +\n  mean({1})"};
    for (const char* code : unchanged) EXPECT_EQ(with_shown_calls(code, shown_calls()), code);
}

TEST(shown_expressions, methods_that_give_a_value_are_shown) {
    EXPECT_EQ(
        printed("local A = matrix{{1, 2}, {3, 4}}\nA:col(2)\nA:row(1);\nlocal v = vector{5, 6, 7}\nv:range(2, 3)"),
        "[2 4]\n[6 7]\n");
    EXPECT_THAT(printed("local d = iddata(linspace(0, 1, 20), linspace(1, 2, 20), 0.1)\nd:split(0.5)"),
                testing::ContainsRegex("10 samples(.|\n)*10 samples"));
    const std::set<const ObjectType*> kinds = {&kVectorType, &kMatrixType, &Userdata<IdData>::type};
    for (const TypeEntry& entry : catalog_of_types())
        for (const Member& method : kinds.contains(entry.type) ? entry.methods : std::span<const Member>()) {
            const std::string call = std::string("x:") + method.name + "(1)";
            EXPECT_EQ(with_shown_calls(call, shown_calls()) == call, std::string_view(method.name) == "set") << call;
        }
}

TEST(shown_expressions, every_call_that_gives_a_value_is_shown_as_at_the_prompt) {
    const std::string before = "local s = tf('s')\nlocal G = 2/(s^2 + 4*s + 3)\nlocal t = range(0, 3)\n";
    const char* calls[] = {"lsq(matrix{t, ones(4)}, {1, 3, 5, 7})",
                           "d2c(c2d(G, 0.1))",
                           "max({3, 1, 2})",
                           "step(G, {0, 1, 2})",
                           "iddata({1, 2}, {3, 4}, 0.1)",
                           "vector{1, 2}",
                           "tf('s')",
                           "tf's'",
                           "math.max(2, 3)",
                           "string.format('%d', 3)",
                           "polyval({1, 2}, 3)"};
    for (const char* call : calls) {
        const std::string shown = printed(before + call);
        EXPECT_EQ(shown, printed(before + "show(" + call + ")")) << call;
        EXPECT_FALSE(shown.empty()) << call;
        EXPECT_EQ(printed(before + call + ";"), "") << call;
    }
    EXPECT_EQ(printed("sort({3, 1, 2})"), "{places = [2 3 1], sorted = [1 2 3]}\n");
    EXPECT_THAT(printed("lqr({{0, 1}, {0, 0}}, {0, 1}, eye(2), 1)"), testing::StartsWith("{K = 1  1.7321, poles = ["));
}

TEST(shown_expressions, calls_that_draw_or_print_what_they_give_show_it_once) {
    const std::string data = "local u = prbs(4, 10)\nlocal d = iddata(lsim(tf({1}, {1, 1}), u, 0.1), u, 0.1)\n";
    for (const char* call :
         {"idplot(d)", "delayest(d)", "plot({1, 2})", "resid(d, tf({1}, {1, 2}))", "step(tf({1}, {1, 1}))"})
        EXPECT_EQ(run(data + call).figures.size(), 1u) << call;
    for (const char* code : {"advice(d)", "slider('a', 1, 0, 2)", "require('x')", "present(G)", "plot({1})", "print(1)",
                             "math.randomseed(1)", "selcstruc(V)"})
        EXPECT_EQ(with_shown_calls(code, shown_calls()), code);
}

TEST(shown_expressions, functions_of_the_script_s_own_are_not_taken_for_those_that_only_compute) {
    for (const char* code :
         {"local function damp(x)\n  return x\nend\ndamp(2)", "fit = function(x) return x end\nfit(2)",
          "local a, sum = 1, print\nsum(2)", "function mean(x) return x end\nmean(2)"})
        EXPECT_EQ(with_shown_calls(code, shown_calls()), code);
    EXPECT_EQ(printed("local r = {fit = 1, sum = 2}\nsum({1, 2})"), "3\n");
    // Names of blocks that are closed, or not there yet, hide nothing.
    EXPECT_EQ(printed("mean({1, 2, 3})\nfor _, mean in ipairs{1} do local a = mean end\nmean({3})"), "2\n3\n");
    EXPECT_EQ(
        printed("local function f(sum)\n  if sum then local std = 1 else return 2 end\n  return sum\nend\nsum({1, 2})"),
        "3\n");
    for (const char* code :
         {"for _, fit in ipairs{print} do\n  fit(1)\nend", "local function g(fit)\n  fit(1)\nend",
          "if true then\n  local sum = print\n  sum(1)\nend", "repeat\n  local mean = print\n  mean(1)\nuntil true"})
        EXPECT_EQ(with_shown_calls(code, shown_calls()), code);
}

TEST(shown_expressions, show_figures_too) {
    const RunRecord record = run("local fig = plot({1, 2, 3})\nfig");
    ASSERT_FALSE(record.error) << record.error->text();
    EXPECT_EQ(record.figures.size(), 1u);
}

TEST(shown_expressions, rows_of_a_matrix_are_not_set_apart_by_semicolons) {
    EXPECT_THAT(error_of("local x = 1\nlocal A = matrix{{1, 2;\n3, 4}}"),
                HasSubstr("lesson.lua:2: each row of a matrix is a table: matrix{{1, 2}, {3, 4}}"));
    EXPECT_FALSE(misread_line_of("local t = {1; 2}\nlocal A = matrix{{1, 2}, {3, 4}};"));
}

TEST(shown_expressions, files_of_the_folder_can_be_required) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "tools.lua")
        << "count = 1 + (rawget(_G, 'count') or 0)\nreturn {double = function(x) return 2*x end}\n";
    std::ofstream(folder.path() / "wrong.lua") << "local x = 1\nlocal y = = 2\n";
    std::ofstream(folder.path() / "fails.lua") << "\n\nerror('no luck')\n";
    std::filesystem::create_directories(folder.path() / "lib");
    std::ofstream(folder.path() / "lib" / "more.lua") << "local t = 1\n";
    RunOptions options;
    options.script_folder = folder.path();
    EXPECT_EQ(printed("local t = require('tools')\nprint(t.double(4), require('tools') == t, count)", options),
              "8\ttrue\t1\n");
    EXPECT_EQ(printed("print(require('lib.more'))", options), "true\n");
    EXPECT_THAT(error_of("require('wrong')", options), HasSubstr("wrong.lua:2: "));
    EXPECT_THAT(error_of("require('fails')", options), HasSubstr("fails.lua:3: no luck"));
    EXPECT_THAT(error_of("require('absent')", options), HasSubstr("file not found: absent.lua in the script's folder"));
    for (const char* outside : {"../tools", "/etc/passwd", "lib..more", ""})
        EXPECT_THAT(error_of(std::string("require('") + outside + "')", options),
                    HasSubstr("folder without extension"));
    std::filesystem::create_symlink("/etc/hostname", folder.path() / "link.lua");
    EXPECT_THAT(error_of("require('link')", options), HasSubstr("is outside the script's folder"));
}

TEST(shown_expressions, scripts_can_be_timed) {
    EXPECT_EQ(printed("tic()\nlocal a = toc()\nlocal b = toc()\nprint(a >= 0, b >= a, clock() >= 0)"),
              "true\ttrue\ttrue\n");
    EXPECT_EQ(error_of("toc()"), "lesson.lua:1: toc: call tic() before toc()");
}

}  // namespace test_shown_expressions
