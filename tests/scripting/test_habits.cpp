// What habits of MATLAB, Octave, Python and of other desks lead to: each script stops with a remedy. Oracle: the
// remedies, written here by hand, and the functions they name, which can be called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "platform/temporary_folder.h"
#include "script_run.h"

namespace test_habits {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

struct Habit {
    const char *code, *remedy;
};

TEST(habits, are_answered_with_the_remedy) {
    const Habit habits[] = {
        // elements
        {"local A = zeros(3, 3)\nA[1][1] = 2", "A[{i, j}]"},
        {"local A = eye(2)\nprint(A[1][1])", "A[{i, j}]"},
        {"local A = eye(2)\nprint(A(1, 1))", "write the element i, j as A[{i, j}]"},
        {"print(zeros(1, 5)[3])", "A[{i, j}]"},
        {"print(1/eye(2))", "write inv(A) for the inverse of A"},
        {"print(eye(2)/eye(2))", "write solve(A, b) for A"},
        {"print(A[1,2])", "A[{1, 2}]"},
        {"x(3) = 5", "write an element as x[3]"},
        {"local x = vector{1, 2}\nx(3) = 5", "write an element as x[3]"},
        {"A(1, 2) = 5", "write an element of a matrix as A[{1, 2}]"},
        {"x = {}\nx(end+1) = 3", "the last element is x[#x]"},
        {"x = vector{}\nx[1] = 2",
         "v has 0 elements, and its length is fixed. Use zeros(n) to create a vector of length n"},
        {"x = vector{1}\nx[2] = 2", "v has 1 element, and its length"},
        {"local mag, ph, w = bode(tf({1}, {1, 1}))\nprint(mag[1])", "bode_values(G, w)"},
        // calls
        {"?lsim", "to get help, write help(\"lsim\")"},
        {"step G", "write a call as step(G)"},
        {"print x", "write a call as print(x)"},
        {"format long", "string.format(\"%.10g\", x)"},
        {"srivc(iddata(randn(50), randn(50), 1), 1, 2, 0)", "write the orders as one table {1, 2, 0}"},
        {"x = zeros(3); x(1) = 5", "write an element as x[1]"},
        {"load mydata.csv", "write a call as load(\"mydata.csv\")"},
        {"A = [1 2; 3 4]; A'", "write a vector as vector{1, 2, 3} and a matrix as matrix{{1, 2}, {3, 4}}"},
        {"A = eye(2)\nB = A @ A", "write the product of two matrices as A*B"},
        {"montecarlo{system = tf({1}, {1, 1}), input = prbs(5, 4), Ts = 0.1, sigma = 0.1, runs = 3, estimators = "
         "{srivc = {1, 1, 0}}}",
         "contains the table of orders: srivc = {{1, 1, 0}}"},
        {"vector(1, 2, 3)", "vector{1, 2, 3}"},
        {"local d = iddata(randn(9), randn(9), 1)\nd.split(0.6)", "object:split(...)"},
        {"plot({1, 2}, {1, 2}, 'r--')", "{dash = 1}"},
        // blocks, names and numbers
        {"try\n  x = 1\ncatch\nend", "write local ok, message = pcall(f) instead of try"},
        {"switch x\ncase 1\nend", "if ... elseif ... else ... end"},
        {"b = a > 1 ? 2 : 3", "if ... then ... else ... end"},
        {"f = @(x) x^2", "function(x) return x^2 end"},
        {"for k = 1:10 print(k) end", "for k = 1, N do ... end"},
        {"x = 1\nx += 1", "x = x + 1"},
        {"local 2x = 1", "a name must start with a letter"},
        {"x = 3,5", "x = 3,5 assigns x the value 3: use a decimal point, 3.5"},
        {"print(1)\nlocal Ts = 0,01\nprint(Ts)", "lesson.lua:2: Ts = 0,01 assigns Ts the value 0"},
        {"math.randomseed(3)", "rng(seed)"},
        {"local ok = randn(9) > 0", "gt(x, y)"},
    };
    for (const Habit& habit : habits) EXPECT_THAT(error_of(habit.code), HasSubstr(habit.remedy)) << habit.code;
}

TEST(habits, of_commas_that_are_no_decimals_stay) {
    EXPECT_EQ(printed("local a, b = 3,5\nlocal t = {x = 3,5}\nfor k = 1,2 do a = a + k end\nlocal c = 3, 5\n"
                      "print(a, b, t[1], c)"),
              "6\t5\t5\t3\n");
}

// What a hint wants to be called instead is there.
TEST(habits, of_other_programs_functions_lead_to_those_here) {
    static const std::regex kCall("(^|[^:A-Za-z_0-9.])([a-z][a-z_0-9.]*)\\(");
    for (const char* name :
         {"aic",        "all",      "angle",    "any",     "cond",     "cpsd",     "ctrb",     "cumprod",
          "d2d",        "db",       "deconv",   "double",  "expm",     "fix",      "fliplr",   "format",
          "freqz",      "getTrend", "hist",     "initial", "int32",    "iscell",   "lower",    "nan",
          "keyboard",   "null",     "optimset", "pinv",    "pwelch",   "qr",       "randi",    "rank",
          "regexp",     "repmat",   "reshape",  "rlocus",  "setpar",   "sisotool", "ssdata",   "strsplit",
          "upper",      "trapz",    "zpkdata",  "unique",  "randperm", "exit",     "datetime", "input",
          "fminsearch", "mag2db",   "real",     "imag",    "conj",     "getpar",   "chol",     "tfestimate"}) {
        const std::string said = error_of("print(" + std::string(name) + ")");
        const std::string::size_type hint = said.find("unknown function or variable '" + std::string(name) + "'; ");
        ASSERT_NE(hint, std::string::npos) << name << ": " << said;
        const std::string words =
            said.substr(hint + std::string("unknown function or variable ''; ").size() + std::string(name).size());
        for (std::sregex_iterator i(words.begin(), words.end(), kCall), end; i != end; ++i)
            EXPECT_EQ(printed("print(type(" + (*i)[2].str() + "))"), "function\n") << name << ": " << said;
    }
}

// The rest of what the hints write runs.
TEST(habits, remedies_run) {
    EXPECT_EQ(printed("local v = vector{1, 2, 3}\nprint(v:select(range(#v, -1, 1)), exp(cumsum(log(v)))[3] > 5.9)\n"
                      "local mask = gt(v, 0)\nprint(#find(mask) == #v, #find(mask) > 0)"),
              "[3 2 1]\ttrue\ntrue\ttrue\n");
    EXPECT_EQ(printed("local _, order = sort(rand(4))\nprint(sum(order))"), "10\n");
    EXPECT_EQ(printed("local G = tf({1}, {1, 1})\nlocal k = 3\nprint(pole(feedback(k*G, 1)))"), "[-4]\n");
    EXPECT_EQ(printed("local G = ss({{-1}}, {{1}}, {{2}}, {{0}})\nprint(G.A, G.C)"), "-1\t2\n");
    EXPECT_EQ(printed("local G = tf({1}, {1, 1})\nprint(freqresp(G, 1)[1].arg < 0, freqresp(G, 1)[1].re)"),
              "true\t0.5\n");
    EXPECT_EQ(printed("local y = lsim(ss({{-1}}, {{1}}, {{2}}, {{0}}), zeros(5), 0.1, {x0 = {1}})\nprint(y[1])"),
              "2\n");
}

TEST(habits, tables_of_numbers_are_vectors) {
    const TemporaryFolder folder;
    RunOptions options;
    options.out_folder = options.script_folder = folder.path();
    EXPECT_EQ(printed("save_csv('r.csv', {fit = {1, 2.5}})\nprint(load('r.csv').fit)", options), "[1 2.5]\n");
    EXPECT_THAT(error_of("save_csv('r.csv', {fit = {1, 'a'}})", options),
                HasSubstr("'fit': entry 2 of a list of numbers must be a number, but it is the string \"a\""));
    EXPECT_EQ(printed("print(freqresp(tf({1}, {1, 1}), 1))"), "[0.5 - 0.5i]\n");
}

}  // namespace test_habits
