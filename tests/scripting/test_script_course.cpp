// Oracle: the course's own lines with the truth they were written from, and analytic responses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "script_run.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace test_script_course {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

TEST(script_course, runs_the_lines_of_the_course) {
    const RunRecord record = test::run(
        "local s  = tf('s')\n"
        "local Go = 2/(s^2 + 4*s + 3)\n"
        "local Ts, N = 0.01, 1500\n"
        "local u = prbs(4, 100)\n"
        "local e = 0.2*randn(N)\n"
        "local x = lsim(Go, u, Ts)\n"
        "local y = x + e\n"
        "local data0, data = iddata(x, u, Ts), iddata(y, u, Ts)\n"
        "idplot(data)\n"
        "print(#u, Go.num, Go.den, data.N, data)\n");
    ASSERT_FALSE(record.error) << record.error->text();
    const auto& pieces = record.outputs.at("cell-1");
    EXPECT_EQ(pieces.at(0).figure, "cell-1-figure-1");
    EXPECT_EQ(pieces.at(1).printed, "1500\t[2]\t[1 4 3]\t1500\tiddata: 1500 samples, 1 output, 1 input, Ts = 0.01 s\n");
}

TEST(script_course, simulates_a_first_order_step_exactly) {
    // y(t) = 1 - exp(-t/2) at the samples.
    EXPECT_EQ(printed("local s = tf('s')\nlocal y = lsim(1/(2*s + 1), ones(101), 0.1)\n"
                      "print(norm(y - (1 - exp(-0.5*range(0, 0.1, 10)))) < 1e-12)"),
              "true\n");
}

TEST(script_course, idproc_without_parameters_is_a_structure) {  // oracle: procsrivc with the text
    EXPECT_EQ(printed("local S = idproc('P1D')\nprint(S.structure, #S.names, S.Td ~= S.Td)\n"
                      "local u = prbs(7, 20)\n"
                      "local data = iddata(lsim(idproc('P1D', {Kp = 2, Tp1 = 5, Td = 0.7}), u, 0.5), u, 0.5)\n"
                      "local A, B = procsrivc(data, S), procsrivc(data, 'P1D')\n"
                      "print(A.Kp == B.Kp, A.Td == B.Td, norm(A.std - B.std) == 0)"),
              "P1D\t3\ttrue\ntrue\ttrue\ttrue\n");
    EXPECT_THAT(printed("print(idproc('P2U'))"), HasSubstr("free parameters Kp, Tw, Zeta"));
    EXPECT_THAT(error_of("print(idproc('P1').Td)"), HasSubstr("its parameters are Kp, Tp1"));
    EXPECT_THAT(error_of("step(idproc('P1'))"), HasSubstr("process structure"));
}

TEST(script_course, combines_models) {
    EXPECT_EQ(printed("local G = tf({1}, {1, 2}, {IODelay = 0.5})\nprint(G.num, G.den, G.IODelay, dcgain(G), "
                      "stable(G), pole(G)[1].re)"),
              "[1]\t[1 2]\t0.5\t0.5\ttrue\t-2\n");
    EXPECT_EQ(printed("local F = feedback(tf({1}, {1, 0}), 1)\nprint(F.num, F.den, series(F, 2).num)"),
              "[1]\t[1 1]\t[2]\n");
    EXPECT_EQ(printed("local G = idproc('P1D', {Kp = 2, Tp1 = 4, Td = 1})\nprint(G.Kp, G.param, G.den, G.names[3])"),
              "2\t[2 4 1]\t[1 0.25]\tTd\n");
    EXPECT_EQ(error_of("print(tf({1}, {1, 2}).std)"),
              "lesson.lua:1: std: this model was specified, not estimated, so it has no standard errors and no report");
    EXPECT_EQ(error_of("tf({1}, {1}, {IODelya = 1})"),
              "lesson.lua:1: tf: unknown option 'IODelya'; did you mean 'IODelay'?");
    EXPECT_EQ(error_of("lsim(1, 'x', 1)"),
              "lesson.lua:1: lsim: argument 2 (u) must be a vector, but the string \"x\" was given");
}

TEST(script_course, fits_a_process_model_to_noise_free_data) {
    EXPECT_EQ(printed("local G = idproc('P1', {Kp = 2, Tp1 = 3})\nlocal u = prbs(6, 20)\nlocal data = iddata(lsim(G, "
                      "u, 0.1), u, 0.1)\n"
                      "local M = procsrivc(data, 'P1', {InitialState = 'zero', Offset = 'none'})\n"
                      "print(norm(M.param - {2, 3}) < 1e-6, M.report.fit_percent > 99.99, fit(data, M) > 99.99, "
                      "M.report.converged)"),
              "true\ttrue\ttrue\ttrue\n");
    EXPECT_EQ(
        error_of("procsrivc(iddata({1, 2}, {1, 2}, 1), 'P4')"),
        "lesson.lua:1: procsrivc: process model: \"P4\" is not a process model structure. Write P1, P2 or P3, followed "
        "by any of D (delay), I (integrator), Z (zero) and U (underdamped, P2 and P3 only), such as P2DU");
    EXPECT_EQ(printed("local u = prbs(6, 8)\nlocal G = idproc('P3DIZU', {Kp = 0.5, Tp3 = 0.3, Tw = 0.4, Zeta = 0.2, "
                      "Tz = -0.2, Td = 0.23})\n"
                      "local a = iddata(lsim(G, u, 0.05), u, 0.05)\n"
                      "local M = procsrivc(a:merge(a), 'P3DIZU', {InitialState = 'zero', Offset = 'none'})\n"
                      "print(norm(M.param - {0.5, 0.3, 0.4, 0.2, -0.2, 0.23}) < 1e-6, #M.report.offsets, "
                      "#M.report.output == 2*#u)"),
              "true\t2\ttrue\n");
    EXPECT_EQ(error_of("procsrivc(iddata({1, 2}, {1, 2}, 1), 'P1', {TdMx = 0})"),
              "lesson.lua:1: procsrivc: unknown option 'TdMx'; did you mean 'TdMax'?");
}

TEST(script_course, fits_lines) {
    EXPECT_EQ(printed("local t = range(0, 3)\nlocal fit = lsq(matrix{t, ones(4)}, {1, 3, 5, 7})\nprint(norm(fit.theta "
                      "- {2, 1}) < 1e-12, fit.rmse < 1e-12)\n"
                      "print(norm(polyfit({0, 1, 2}, {1, 2, 5}, 2) - {1, 0, 1}) < 1e-12)\n"
                      "local r = polyfit_report({0, 1, 2, 3}, {1, 3, 5, 7.1}, 1)\nlocal f = forecast(r, "
                      "4)\nprint(f.low < f.value, f.value < f.high)"),
              "true\ttrue\ntrue\ntrue\ttrue\n");
}

// Oracle: with one degree of freedom Student's distribution is Cauchy's; tables say 2.0518 for 97.5 % and 27 degrees.
TEST(script_course, gives_student_s_quantile_which_forecast_has_in_its_interval) {
    EXPECT_EQ(printed("print(abs(tinv(0.8, 1) - math.tan(math.pi*0.3)) < 1e-12, round(1e4*tinv(0.975, 27)))\n"
                      "local f = forecast(polyfit_report({0, 1, 2, 3}, {1, 3, 5, 7.1}, 1), 4)\n"
                      "print(abs(f.high - f.value - tinv(0.975, 2)*f.std) < 1e-12)"),
              "true\t20518\ntrue\n");
    EXPECT_THAT(error_of("tinv(1, 3)"), testing::HasSubstr("tinv: "));
}

TEST(script_course, has_every_function_in_help) {
    std::string text = printed("help()");
    for (const FunctionEntry& entry : catalog_of_functions()) {
        EXPECT_NE(text.find(std::string("  ") + entry.name + " "), std::string::npos) << entry.name;
        EXPECT_GT(std::string(entry.signature).size(), 3u);
        EXPECT_EQ(printed(std::string("print(type(") + entry.name + "))"), "function\n") << entry.name;
    }
    EXPECT_NE(printed("help('matlab')").find("gt(x, 2)"), std::string::npos);
    EXPECT_EQ(printed("help(rng)"), printed("help('rng')"));
    EXPECT_EQ(error_of("help('lsimm')"), "lesson.lua:1: help: no help for 'lsimm'; did you mean 'lsim'?");
}

TEST(script_course, takes_short_curve_names_but_no_line_specifications) {
    EXPECT_EQ(printed("plot({1, 2}, {3, 4}, 'rms', {1, 2}, {4, 3}, 'box') print('drawn')"), "drawn\n");
    for (const char* look : {"r--", "ro", ".-"}) {
        EXPECT_NE(
            error_of("plot({1, 2}, {3, 4}, '" + std::string(look) + "')").find("a string is the name of the curve"),
            std::string::npos)
            << look;
    }
    EXPECT_EQ(
        error_of("plot({1, 2}, {3, 4}, {color = 1.7})"),
        "lesson.lua:1: plot: option 'color' must be an integer from 0 to 1000, or a name such as \"red\", but 1.7 "
        "was given");
}

TEST(script_course, counts_samples_and_channels_in_whole_numbers) {
    const std::string data = "local d = iddata(zeros(5), ones(5), 1) ";
    EXPECT_EQ(error_of(data + "print(d[{1.5, 3}])"),
              "lesson.lua:1: sample and channel numbers must be whole numbers, but 1.5 was given");
    EXPECT_NE(error_of(data + "d:select({1.7})").find("but 1.7 was given"), std::string::npos);
}

}  // namespace test_script_course
