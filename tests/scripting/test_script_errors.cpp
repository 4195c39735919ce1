// Oracle: the sentences that the language promises, written here by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "script_run.h"

namespace test_script_errors {

using dynlab::test::error_of;
using dynlab::test::printed;
using dynlab::test::run;

struct Expected {
    std::string code;
    const char* sentence;
};

void check(std::initializer_list<Expected> cases) {
    for (const Expected& expected : cases) EXPECT_EQ(error_of(expected.code), expected.sentence) << expected.code;
}

TEST(script_errors, say_which_name_is_unknown_and_which_is_near) {
    check({
        {"\n\nlocal x = zeors(3)", "lesson.lua:3: unknown function or variable 'zeors'; did you mean 'zeros'?"},
        {"local gain = 2\nprint(gian)", "lesson.lua:2: unknown function or variable 'gian'; did you mean 'gain'?"},
        {"print(qqqqqqq)", "lesson.lua:1: unknown function or variable 'qqqqqqq'"},
        {"string.fromat('%d', 1)", "lesson.lua:1: 'string' has no member 'fromat'; did you mean 'format'?"},
        {"local v = vector{1}\nv:rnge(1, 1)",
         "lesson.lua:2: a vector has no field or method 'rnge'; did you mean 'range'?"},
    });
}

TEST(script_errors, name_the_lua_form_of_a_matlab_function) {
    check({
        {"disp(3)", "lesson.lua:1: unknown function or variable 'disp'; write print(x)"},
        {"local n = length({1})", "lesson.lua:1: unknown function or variable 'length'; write #v"},
        {"numel({1})", "lesson.lua:1: unknown function or variable 'numel'; write #v"},
        {"size({1})",
         "lesson.lua:1: unknown function or variable 'size'; write #v for a vector, A.rows and A.columns for a matrix"},
        {"fprintf('%d', 1)",
         "lesson.lua:1: unknown function or variable 'fprintf'; write print(string.format(\"%.3f\", x))"},
        {"local w = 2*pi", "lesson.lua:1: unknown function or variable 'pi'; write math.pi"},
    });
}

/// What a hint wants to be called instead: its words before a bracket.
std::vector<std::string> functions_of(const std::string& hint) {
    static const std::regex kCall("([a-z][a-z_0-9.]*)\\(");
    std::vector<std::string> names;
    for (std::sregex_iterator i(hint.begin(), hint.end(), kCall), end; i != end; ++i) names.push_back((*i)[1]);
    return names;
}

// Oracle: the names of the toolboxes' documentation; what a hint calls can be called here.
TEST(script_errors, lead_from_the_toolboxes_functions_to_those_here) {
    for (const char* name :
         {"tfest",    "procest", "ssest",   "polyest",   "pem",        "idtf",     "idpoly", "idss",    "spafdr",
          "frd",      "idinput", "misdata", "simc",      "conv",       "comparec", "residc", "getpvec", "getcov",
          "isstable", "zpplot",  "zpk",     "tfdata",    "nlhw",       "nlarx",    "rarx",   "rpem",    "roots",
          "xcorr",    "filter",  "etime",   "allmargin", "shadedplot", "sidgpmf",  "hsrivc", "poly",    "os"}) {
        const std::string said = error_of(std::string(name) + "()");
        const std::string::size_type hint = said.find("'; ");
        ASSERT_NE(hint, std::string::npos) << name << ": " << said;
        for (const std::string& function : functions_of(said.substr(hint)))
            EXPECT_EQ(printed("print(type(" + function + "))"), "function\n") << name << ": " << said;
    }
}

TEST(script_errors, name_the_called_method_once) {
    const std::string data_set = "local u = ones(50)\nlocal d = iddata(0.5*u, u, 0.1)\n";
    for (const auto& [method, call] : {std::pair{"lsgpmf", "lsgpmf(d, {2, 1, 0}, 3)"},
                                       {"ivsvf", "ivsvf(d, {2, 1, 0}, 3)"},
                                       {"tfsrivc", "tfsrivc(d, 2, 1, {Offset = 'none', InitialState = 'none'})"},
                                       {"tfcoe", "tfcoe(d, 2, 1, {Offset = 'none', InitialState = 'none'})"}})
        EXPECT_EQ(error_of(data_set + call).find("lesson.lua:3: " + std::string(method) + ": the input never changes"),
                  0u)
            << error_of(data_set + call);
    EXPECT_EQ(error_of("local u = prbs(3, 1)\narx(iddata(u, u, 1), {3, 3, 1})")
                  .find("lesson.lua:2: arx estimates 6 parameters and needs more equations"),
              0u)
        << error_of("local u = prbs(3, 1)\narx(iddata(u, u, 1), {3, 3, 1})");
}

TEST(script_errors, put_what_lua_says_into_plain_words) {
    check({
        {"local m\nprint(m.gain)",
         "lesson.lua:2: the variable 'm' is nil (it has no value), so it has no fields or elements"},
        {"local m = {}\nprint(m.model.gain)",
         "lesson.lua:2: the field 'model' is nil (it has no value), so it has no fields or elements"},
        {"local m = {}\nm.fit()",
         "lesson.lua:2: the field 'fit' is nil (it has no value), so it cannot be called like a function"},
        {"local v = vector{1, 2}\nprint(v(1))",
         "lesson.lua:2: the variable 'v' is a vector, so it cannot be called like a function; write the element i as "
         "v[i]"},
        {"local a\nlocal b = a + 1",
         "lesson.lua:2: the variable 'a' is nil (it has no value), so arithmetic with it is not possible"},
        {"local a = {1, 2}\nlocal b = 2*a",
         "lesson.lua:2: the variable 'a' is a table, so arithmetic with it is not possible; convert the table to a "
         "vector: "
         "vector(t)"},
        {"local a\nlocal b = 'x' .. a",
         "lesson.lua:2: the variable 'a' is nil (it has no value), so the operator .. cannot join it to a string; use "
         "tostring(x)"},
        {"local a\nlocal n = #a",
         "lesson.lua:2: the variable 'a' is nil (it has no value), so the operator # cannot count its elements"},
        {"local ok = 1 < 'x'", "lesson.lua:1: a number cannot be compared with a string by < or >"},
        {"local ok = {} < {}", "lesson.lua:1: a table cannot be compared with a table by < or >"},
        {"string.rep()", "lesson.lua:1: rep: argument 1 must be a string, but no value was given"},
        {"for i = 1, 'x' do end", "lesson.lua:1: the limit of a for loop must be a number, but a string was given"},
        {"for i = 1, 2, 0 do end", "lesson.lua:1: the step of a for loop must not be zero"},
        {"local y = 1//0", "lesson.lua:1: a whole number cannot be divided by zero with //"},
        {"local y = 1%0", "lesson.lua:1: the remainder of a division by zero is undefined"},
        {"local t = {}\nt[nil] = 1",
         "lesson.lua:2: a key of a table must not be nil (no value); check the expression in the brackets"},
        {"local function f() return 1 + f() end\nf()",
         "lesson.lua:1: infinite recursion (stack overflow): a function calls itself, directly or through other "
         "functions, and never stops"},
        {"error()", "lesson.lua:1: error() was called without a message; write error(\"message\")"},
        {"error('my own words')", "lesson.lua:1: my own words"},
        {"error({code = 2})", "lesson.lua:1: {code = 2}"},
    });
}

TEST(script_errors, hint_at_lua_where_a_line_is_matlab) {
    check({
        {"local y = x'",
         "lesson.lua:1: the string is not closed by a quotation mark; the transpose is A:t(); a vector is already a "
         "column"},
        {"local z = x.*y",
         "lesson.lua:1: expected a name before '*'; write x*y for vectors and A:times(B) for matrices, instead of x.*y "
         "and A.*B"},
        {"local z = x./y", "lesson.lua:1: expected a name before '/'; for vectors, write x/y instead of x./y"},
        {"local z = x.^2", "lesson.lua:1: expected a name before '^'; for vectors, write x^2 instead of x.^2"},
        {"local k = 0:N-1",
         "lesson.lua:1: unexpected ':'; write a range as range(first, last) or range(first, step, last), and a part of "
         "a vector v as v:range(i, j)"},
        {"local v = [1 2 3]",
         "lesson.lua:1: unexpected '['; write a vector as vector{1, 2, 3} and a matrix as matrix{{1, 2}, {3, 4}}"},
        {"% a comment", "lesson.lua:1: a comment starts with -- in Lua"},
        {"local a = 1\n% my comment\nprint(a)", "lesson.lua:2: a comment starts with -- in Lua"},
        {"local a = 1\n\n  % my comment\n\nprint(a)", "lesson.lua:3: a comment starts with -- in Lua"},
        {"# comment\nprint(1)", "lesson.lua:1: a comment starts with -- in Lua"},
        {"local a = 1 % gain", "lesson.lua:1: unknown variable 'gain'; a comment starts with -- in Lua"},
        {"y = 3 % comment", "lesson.lua:1: unknown variable 'comment'; a comment starts with -- in Lua"},
        {"local y = 3 # comment", "lesson.lua:1: unexpected '#'; a comment starts with -- in Lua"},
        {"local x = vector{1}\nprint(x[end])",
         "lesson.lua:2: unexpected 'end'; the last element is x[#x]; vector{x, y} appends y to x"},
        {"local x = {}\nx(end+1) = 3",
         "lesson.lua:2: unexpected 'end'; the last element is x[#x]; vector{x, y} appends y to x"},
        {"print(A[1,2])", "lesson.lua:1: expected ']' before ','; the element in row 1 and column 2 is A[{1, 2}]"},
        {"local b = a > 1 ? 2 : 3",
         "lesson.lua:1: unexpected '?'; Lua has no '?' operator; write if ... then ... else ... end"},
        {"print(1) end", "lesson.lua:1: unexpected 'end': no block is open"},
        {"print(2 + 1i)",
         "lesson.lua:1: unexpected '1i'; dynlab has no complex arithmetic; complex numbers returned by functions have "
         "the fields re, im, abs and arg"},
        {"if a != b then end", "lesson.lua:1: expected 'then' before '!'; write 'not equal' as ~= in Lua"},
        {"if a = b then end", "lesson.lua:1: expected 'then' before '='; to compare, write == instead of ="},
        {"local s = 1 + ...\n 2", "lesson.lua:2: unexpected '2'"},
        {"for k = 1:10\nend",
         "lesson.lua:1: expected ',' before ':'; write a loop in the form: for k = 1, N do ... end"},
        {"local x = A\\b", "lesson.lua:1: unexpected '\\'; write A\\b as solve(A, b)"},
        {"elseif x then", "lesson.lua:1: unexpected 'elseif': no block is open"},
        {"else", "lesson.lua:1: unexpected 'else': no block is open"},
        {"if 1 then x = 2 end end", "lesson.lua:1: unexpected 'end': no block is open"},
        {"if true then\nprint(1)\n", "lesson.lua:1: the 'if' in line 1 has no 'end'"},
        {"for i = 1, 2 do print(1)", "lesson.lua:1: the 'for' in line 1 has no 'end'"},
        {"for i = 1, 2 do\nprint(1)", "lesson.lua:1: the 'for' in line 1 has no 'end'"},
    });
}

// Lua finds the error at the end of the script. The line to fix is further up.
TEST(script_errors, name_the_line_where_something_is_missing) {
    const std::string below = "\n-- %% [markdown]\n-- Words, else if not.\n\n-- %%\nlocal z = 1\nprint(z)\n";
    check({
        {"local x = 1\nfor i = 1, 3 do\n  x = x + i\n" + below, "lesson.lua:2: the 'for' in line 2 has no 'end'"},
        {"local function f(x)\n  if x > 1 then\n    return 1\nend\n" + below,
         "lesson.lua:2: the 'if' in line 2 has no 'end'"},
        {"local function f(x)\n  while x > 1 do\n    x = x/2\n  return x\nend\nlocal y = f(3)\n" + below,
         "lesson.lua:2: the 'while' in line 2 has no 'end'"},
        {"if 1 > 2 then\n  print(1)\nelse if 2 > 1 then\n  print(2)\nend\n" + below,
         "lesson.lua:3: an 'end' is missing, because 'else if' opens a second block; write elseif"},
        {"for i = 1, 2 do if i > 1 then print(i) end\n" + below, "lesson.lua:1: the 'for' in line 1 has no 'end'"},
        {"local x = 1 +\n" + below, "lesson.lua:1: the statement is incomplete at the end of the cell"},
        {"local v = {1, 2,\n" + below, "lesson.lua:1: the statement is incomplete at the end of the cell"},
        {"print(1)\nprint(1, {2,\n3\n", "lesson.lua:2: the '{' in line 2 is not closed: '}' is missing"},
        {"print(1 +\n2,\n3 3)\n" + below, "lesson.lua:3: the '(' in line 1 is not closed: ')' is missing"},
    });
}

// Characters of word processors and printed pages.
TEST(script_errors, name_characters_that_no_program_can_hold) {
    check({
        {"print(\u201ca\u201d)", "lesson.lua:1: unexpected character \u201c (U+201C); replace it with \""},
        {"local x = 3 \u2013 2", "lesson.lua:1: unexpected character \u2013 (U+2013); replace it with -"},
        {"local x = s\u02c62", "lesson.lua:1: unexpected character \u02c6 (U+02C6); replace it with ^"},
        {"local x = 2\u00b7pi", "lesson.lua:1: unexpected character \u00b7 (U+00B7); replace it with *"},
        {"local x =\u00a03", "lesson.lua:1: unexpected character \u00a0 (U+00A0); replace it with a space"},
        {"local l\u00e9ger = 1",
         "lesson.lua:1: unexpected character \u00e9 (U+00E9); a name may contain only the letters a to z and A to Z, "
         "digits and "
         "_"},
        {"local x = '\u00e9' -- \u2013\nprint(y)", "lesson.lua:2: unknown function or variable 'y'"},
        {"local x = 1 \xe9", "lesson.lua:1: unexpected byte that is not UTF-8; save the script as UTF-8"},
    });
}

TEST(script_errors, say_what_habits_of_other_languages_lead_to) {
    check({
        {"print(string.format('%d', 3.5))",
         "lesson.lua:1: format: argument 2 is not a whole number, which %d requires; write %g or %.0f"},
        {"print('a = ' + {})",
         "lesson.lua:1: arithmetic with a string is not possible; use two dots to join strings and numbers: \"a = \" "
         ".. x"},
        {"local d = iddata(randn(9), randn(9), 1)\nprint(#d)",
         "lesson.lua:2: the variable 'd' is an iddata object, so the operator # cannot count its elements; data.N is "
         "the "
         "number of "
         "samples"},
        {"local d = iddata(randn(9), randn(9), 1)\nd.split(0.6)",
         "lesson.lua:2: split: argument 1 (data) must be an iddata object, but 0.6 was given; a method is called with "
         "a "
         "colon: "
         "object:split(...)"},
        {"randn(20):range(10)", "lesson.lua:1: range: argument 2 (last) is missing; it must be a whole number"},
        {"vector(1, 2, 3)", "lesson.lua:1: vector: write a vector with braces: vector{1, 2, 3}"},
        {"matrix({1, 2}, {3, 4})",
         "lesson.lua:1: matrix: write a matrix with braces: matrix{{1, 2}, {3, 4}} (rows) or matrix{v1, v2} (columns)"},
        {"plot({1, 2}, {1, 2}, 'LineWidth', 2)",
         "lesson.lua:1: plot: \"LineWidth\" is an option of MATLAB's plot; write the options as one table, plot(x, y, "
         "{line_width = 2, color = \"red\", style = \"points\"})"},
        {"plot({1, 2}, {color = 'pinkish'})",
         "lesson.lua:1: plot: option 'color' must be an integer from 0 to 1000, or one of \"blue\", \"orange\", "
         "\"black\", "
         "\"green\", \"purple\", \"cyan\", \"red\", \"magenta\", \"gray\", \"grey\", but \"pinkish\" was given"},
        {"io.open('x')",
         "lesson.lua:1: unknown function or variable 'io'; read data with load(name), write data with save_csv(path, "
         "data), and "
         "print values with print(x)"},
        {"strcmp('a', 'b')", "lesson.lua:1: unknown function or variable 'strcmp'; write a == b"},
    });
}

TEST(script_errors, carry_the_line_of_the_script_record) {
    const auto record = run("local x = 1\n\nvector(3)\n");
    ASSERT_TRUE(record.error);
    EXPECT_EQ(record.error->line, 3);
    EXPECT_EQ(record.error->text(), "lesson.lua:3: vector: write a vector with braces: vector{1, 2, 3}");
}

TEST(script_errors, name_argument_wanted_and_given) {
    check({
        {"zeros('x')", "lesson.lua:1: zeros: argument 1 (n) must be a number, but the string \"x\" was given"},
        {"zeros(2.5)", "lesson.lua:1: zeros: argument 1 (n) must be a whole number, but 2.5 was given"},
        {"zeros(-1)", "lesson.lua:1: zeros: argument 1 (n) must be nonnegative, but -1 was given"},
        {"zeros()", "lesson.lua:1: zeros: argument 1 (n) is missing; it must be a whole number"},
        {"sum('x')", "lesson.lua:1: sum: argument 1 (v) must be a vector, but the string \"x\" was given"},
        {"sum({1, 'a'})",
         "lesson.lua:1: sum: argument 1 (v) must be a vector of numbers, but its element 2 is the string \"a\""},
        {"mean({})", "lesson.lua:1: mean: argument 1 (v) must have at least one element, but it is empty"},
        {"dot({1}, {1, 2})",
         "lesson.lua:1: dot: a and b must have the same number of elements, but a has 1 value and b has 2"},
        {"rng(-1)", "lesson.lua:1: rng: the seed must be a whole number from 0 to 4294967295, but -1 was given"},
        {"sqrt(-2)", "lesson.lua:1: sqrt: the function is undefined for the negative number -2"},
        {"norm({1}, {2})", "lesson.lua:1: norm: accepts at most 1 argument, but 2 were given"},
        {"toc(1)", "lesson.lua:1: toc: accepts no arguments, but 1 was given"},
        {"regression_plot({}, {}, polyfit_report({1, 2, 3}, {1, 2, 4}, 1))",
         "lesson.lua:1: regression_plot: argument 1 (x) must have at least one element, but it is empty"},
        {"lqr(matrix{{0, 0/0}, {0, 0}}, matrix{{0}, {1}}, eye(2), eye(1))",
         "lesson.lua:1: lqr: A contains a value that is not finite"},
        {"lqr(matrix{{0, 1}}, matrix{{0}, {1}}, eye(2), eye(1))",
         "lesson.lua:1: lqr: A must be a 1 x 1 matrix, but is 1 x 2"},
        {"place(matrix{{0, 1}, {0, 0}}, matrix{{0}, {1}}, {-1, -math.huge})",
         "lesson.lua:1: place: all poles must be finite"},
        {"fillmissing({1, 0/0, 0/0, 4}, {method = 'previous', longest = 1})",
         "lesson.lua:1: fillmissing: samples 2 to 3 are missing, a gap of more than 1 sample. To fill the gap, specify "
         "{longest "
         "= 2}"},
        {"histogram({1, 2}, 'bins', 3)",
         "lesson.lua:1: histogram: accepts at most 2 arguments, but 3 were given; write the options as one table {bins "
         "= "
         "value}"},
    });
}

TEST(script_errors, of_too_many_arguments_suggest_a_table_only_where_the_function_takes_one) {
    const std::string models = "local d, G = iddata({1, 2, 4}, {1, 0, 1}, 1), tf({1}, {1, 1})\n";
    check({
        {models + "arx(d, 1, 1, 0)",
         "lesson.lua:2: arx: accepts at most 3 arguments, but 4 were given; write the orders as one table {1, 1, 0}"},
        {models + "idplot(d, 1, 3, {labels = 'a'})",
         "lesson.lua:2: idplot: accepts at most 3 arguments, but 4 were given"},
        {models + "series(G, 2, 3)", "lesson.lua:2: series: accepts at most 2 arguments, but 3 were given"},
        {models + "save(idplot(d), 'a.svg', 3)", "lesson.lua:2: save: accepts at most 2 arguments, but 3 were given"},
    });
}

TEST(script_errors, count_one_in_the_singular) {
    const std::string data_set = "local d = iddata({1, 2, 4}, {1, 0, 1}, 1)\n";
    check({
        {"lsim(tf({1, 0}, {2}), {1, 2}, 1)",
         "lesson.lua:1: lsim: the transfer function has 1 zero but only 0 poles; a simulation needs a "
         "model with at least as many poles as zeros"},
        {"lsq(matrix{{1}, {2}}, {1})",
         "lesson.lua:1: lsq: least squares: the matrix has 2 rows, but the right-hand side has 1 value"},
        {"local y = vector{1} + vector{1, 2}",
         "lesson.lua:1: x + y needs equal sizes, but x is a vector of 1 value and y is a vector of 2 values"},
        {"report.table('t', {{'a', 'b'}, {1}})",
         "lesson.lua:1: report.table: row 2 has 1 cell, but the header has 2; all rows must have the same number of "
         "cells"},
        {"local v = vector{5}\nprint(v[2])", "lesson.lua:2: v[2] does not exist: v has only the element 1"},
        {"zeros(1, 2):row(2)", "lesson.lua:1: row 2 does not exist: the only valid number is 1"},
        {data_set + "d:experiment(2)", "lesson.lua:2: experiment 2 does not exist: the only valid number is 1"},
        {data_set + "srivc(d, {2})",
         "lesson.lua:2: srivc: argument 2 (orders) must be {nb, nf, nk} (nb: coefficients of B; nf: poles; nk: samples "
         "of delay), but the list has 1 entry"},
        {data_set + "merge(d, iddata({1, 2}, matrix{{1, 2}, {2, 1}}, 1))",
         "lesson.lua:2: merge: part 2 has 1 output and 2 inputs, but the first part has 1 and 1. Select the same "
         "channels in both parts with data:select"},
    });
}

TEST(script_errors, stay_with_their_line_in_coroutines_and_protected_calls) {
    EXPECT_EQ(error_of("local f = coroutine.wrap(function()\n  zeors(1)\nend)\nf()"),
              "lesson.lua:2: unknown function or variable 'zeors'; did you mean 'zeros'?");
    EXPECT_EQ(printed("print(pcall(function() local a; return a.b end))"),
              "false\tlesson.lua:1: the variable 'a' is nil (it has no value), so it has no fields or elements\n");
    EXPECT_EQ(printed("print(xpcall(error, function(m) return 'seen ' .. m end, 'x', 0))"),
              "false\tseen lesson.lua:1: x\n");
    EXPECT_EQ(printed("local t = {}\nlocal ok, e = pcall(error, t)\nprint(e == t)"), "true\n");
    EXPECT_EQ(printed("local co = coroutine.create(function() local x = nil + 1 end)\nprint(coroutine.resume(co))"),
              "false\tlesson.lua:1: this value is nil (it has no value), so arithmetic with it is not possible\n");
    EXPECT_EQ(printed("local g = coroutine.wrap(function() print(pcall(function() coroutine.yield(1) error('late', 0) "
                      "end)) end)\n"
                      "print(g())\ng()"),
              "1\nfalse\tlesson.lua:1: late\n");
}

TEST(script_errors, refuse_to_replace_functions_of_dynlab) {
    EXPECT_EQ(error_of("mean = 3"),
              "lesson.lua:1: 'mean' is a function or table of dynlab and cannot be replaced; choose another name, or "
              "write 'local mean = ...' to define a variable with this name");
    EXPECT_EQ(error_of("string.trim = 1"),
              "lesson.lua:1: 'string' is a built-in table and cannot be changed; store values and functions in your "
              "own table");
    EXPECT_EQ(error_of("dynlab.mean = 1"),
              "lesson.lua:1: 'dynlab' is a built-in table and cannot be changed; store values and functions in your "
              "own table");
    EXPECT_EQ(printed("answer_to_all = 42\nanswer_to_all = 43\nprint(answer_to_all, dynlab.sum{1, 2})\nlocal mean = "
                      "5\nprint(mean)"),
              "43\t3\n5\n");
}

TEST(script_errors, wrong_lines_of_any_length_are_reported) {
    for (const std::string& filling : {std::string(600'000, 'a'), std::string(600'000, ' '), std::string(600'000, '1')})
        for (const std::string& wrong :
             {"f(" + filling + ") = 3", filling + " y", "x[" + filling + ", 2", "? " + filling})
            EXPECT_THAT(error_of(wrong), testing::HasSubstr("lesson.lua:1:"));
}

/// A max or min function that the script defines is not a mistake.
TEST(script_errors, a_maximum_of_one_s_own_is_compared) {
    EXPECT_EQ(printed("local function max(t) return 7 end print(math.max(0, max{1}))"), "7\n");
    EXPECT_EQ(printed("local max = math.max print(math.max(0, max(3, 4)), math.max(1, max(2)))"), "4\t2\n");
}

}  // namespace test_script_errors
