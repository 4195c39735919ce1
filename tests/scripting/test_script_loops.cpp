// Closed-loop data and recursive estimation from scripts. Oracles: how the data were made, and the same estimation by
// another function.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "script_run.h"

namespace test_script_loops {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

const std::string kLoop =
    "rng(3)\nlocal Ts, G0, r = 0.05, tf({2}, {1, 4, 3}), prbs(7, 5)\nlocal C = tf({4, -3.9}, {1, -1}, Ts)\n"
    "local data, x = simloop(G0, C, r, Ts, {noise = 0.02*randn(#r), ComputingDelay = 1})\n"
    "local function near(G) for k, v in ipairs{4, 3, 2} do if math.abs(G.param[k] - v) > 4*G.std[k] then return false "
    "end end return true end\n";

TEST(script_loops, the_reference_goes_with_the_data) {
    EXPECT_EQ(printed(kLoop + "print(data.r[1] == r[1], #data.r, data)\n"
                              "local a, b = data:split(0.4)\nprint(a.r[254] == r[254], b.r[1] == r[255])\n"
                              "print(data:range(10, 20).r[1] == r[10], data:select(1, 1).r[7] == r[7])\n"
                              "print(math.abs(mean(data:remove_mean().r)) < 1e-12, #data:resample(1, 5).r)\n"
                              "print(data:merge(data).experiments, data:shift(2).r[1] == r[3])\n"
                              "print(data:keep{{1, 50}, {90, 120}}:experiment(2).r[1] == r[90])"),
              "true\t635\tiddata: 635 samples, 1 output, 1 input, Ts = 0.05 s, 1 reference\ntrue\ttrue\ntrue\ttrue\n"
              "true\t127\n2\ttrue\ntrue\n");
    EXPECT_THAT(error_of(kLoop + "iddata(data.y, data.u, Ts, {Reference = r:range(1, 9)})"),
                HasSubstr("635 samples, but the reference has 9"));
    EXPECT_THAT(error_of(kLoop + "data:merge(iddata(data.y, data.u, Ts))"),
                HasSubstr("0 references, but the number of references in the first part is 1"));
    EXPECT_THAT(error_of(kLoop + "print(iddata(data.y, data.u, Ts).r)"), HasSubstr("have no reference"));
}

TEST(script_loops, four_routes) {
    EXPECT_EQ(
        printed(kLoop +
                "print(near(clivsvf(data, {2, 1, 0}, 4)), near(clivsvf(data, {2, 1, 0}, 4, {controller = C})))\n"
                "for _, route in ipairs{'auxiliary', 'indirect', 'two-stage'} do\n"
                "  print(near(clsrivc(data, {1, 2, 0}, {controller = C, route = route})))\nend\n"
                "print(clsrivc(data, {1, 2, 0}, {route = 'direct'}).param[1] == srivc(data, {1, 2, 0}).param[1])"),
        "true\ttrue\ntrue\ntrue\ntrue\ntrue\n");
    EXPECT_THAT(printed(kLoop + "print(clsrivc(data, {1, 2, 0}, {controller = C}).report.message)"),
                HasSubstr("with a controller delay of 1 sample"));
    EXPECT_THAT(error_of(kLoop + "clsrivc(data, {1, 2, 0}, {route = 'indirect'})"),
                HasSubstr("needs a known controller"));
    EXPECT_THAT(error_of(kLoop + "clsrivc(data, {1, 2, 0}, {controller = 'C'})"),
                HasSubstr("the controller must be a model"));
    EXPECT_THAT(error_of(kLoop + "clivsvf(data, {2, 1, 0}, 4, {ComputingDelay = 1})"),
                HasSubstr("requires option 'controller'"));
    EXPECT_THAT(error_of(kLoop + "simloop(G0, 100, r, Ts) simloop(tf({1}, {1, -1}), 0.5, r, Ts)"),
                HasSubstr("the loop is unstable"));
}

// oracle: the plant 2/((s - 1)(s + 4)) in its loop, whose noise is a hundredth of the output
TEST(script_loops, an_unstable_plant_is_measured_in_its_loop) {
    const std::string held =
        "rng(3)\nlocal r, C = prbs(7, 5), tf({8}, {1}, 0.05)\n"
        "local data = simloop(tf({2}, {1, 3, -4}), C, r, 0.05, {noise = 0.01*randn(#r)})\n";
    for (const char* call :
         {"clivsvf(data, {2, 1, 0}, 4, {controller = C})", "clsrivc(data, {1, 2, 0}, {controller = C, lambda = 4})",
          "clsrivc(data, {1, 2, 0}, {controller = C, lambda = 4, route = 'indirect'})"}) {
        const std::string reported =
            printed(held + "local G = " + call +
                    "\nprint(G.report.fit_percent > 90, math.abs(G.noise_variance/1e-4 - 1) < 0.5)\n" +
                    "print(table.concat(G.report.warnings, ' '))");
        EXPECT_THAT(reported, HasSubstr("true\ttrue\n")) << call;
        EXPECT_THAT(reported, HasSubstr("check the controller, the orders and the cutoff frequency")) << call;
        EXPECT_THAT(reported, HasSubstr("to the closed loop with the model")) << call;
        EXPECT_THAT(reported, testing::Not(HasSubstr("Stable"))) << call;
    }
}

TEST(script_loops, records_of_loops_say_what_they_cannot) {
    const std::string moving =
        "local r = prbs(5, 5)\nlocal a = simloop(tf({2}, {1, 4}), tf({1}, {0.1, 1}), r, 0.05)\n"
        "local b = simloop(tf({2}, {1, 4}), tf({1}, {1}, 0.05), r, 0.05)\n";
    const std::string english = printed(moving), french = printed(moving, {}, "fr");
    EXPECT_THAT(english, testing::StartsWith("simloop: with a continuous-time controller, u changes"));
    EXPECT_EQ(std::count(english.begin(), english.end(), '\n'), 1) << "a sampled controller holds u";
    EXPECT_THAT(french, testing::StartsWith("simloop : avec un régulateur à temps continu"));
    EXPECT_THAT(printed("print(pcall(simloop, tf({2}, {1, 4}, {IODelay = 1}), 3, prbs(5, 5), 0.05))"),
                testing::StartsWith("false"))
        << "the note is only for data that were simulated";
    EXPECT_THAT(error_of("simloop(tf({2}, {1, 4}), 3, 1, 0.05)"),
                HasSubstr("r must contain the reference at every sample"));
}

TEST(script_loops, studies_of_loops) {
    const std::string study =
        kLoop +
        "local M = montecarlo{system = G0, controller = C, ComputingDelay = 1, reference = r, Ts = Ts, sigma "
        "= 0.1, runs = 40, estimators = {lssvf = {{2, 1, 0}, 4}, clivsvf = {{2, 1, 0}, 4, {controller = C}}, "
        "own = function(d) return clsrivc(d, {1, 2, 0}, {controller = C}) end}}\n";
    EXPECT_EQ(
        printed(study + "local function off(m, k) return math.abs(m.bias[k])/(m.std[k]/math.sqrt(40)) end\n"
                        "print(off(M.lssvf, 1) > 10, off(M.clivsvf, 1) < 4, off(M.own, 1) < 4, M.own.cramer_rao)"),
        "true\ttrue\ttrue\tnil\n");
    EXPECT_THAT(
        error_of(kLoop + "montecarlo{system = G0, controller = C, input = r, Ts = Ts, sigma = 1, estimators = {}}"),
        HasSubstr("omit option 'input'"));
}

TEST(script_loops, recursive_methods_report_their_history) {
    EXPECT_EQ(printed("rng(1)\nlocal u = prbs(5, 20)\nlocal y = lsim(tf({2}, {1, 4, 3}), u, 0.05) + 0.02*randn(#u)\n"
                      "local d = iddata(y, u, 0.05)\nlocal G, B = rlssvf(d, {2, 1, 0}, 4), lssvf(d, {2, 1, 0}, 4)\n"
                      "print(math.abs(G.param[1] - B.param[1]) < 1e-8, #G.history.t, G.history.theta.columns)\n"
                      "print(G.history.theta[{620, 1}] == G.param[1], table.concat(G.history.names, ' '))\n"
                      "local R = rsrivc(d, {1, 2, 0}, 4, {drift = 1e-6, HistoryPoints = 10})\n"
                      "print(#R.history.t, plot_history(R, {truth = {a1 = 4, b0 = u}}))"),
              "true\t620\t3\ntrue\ta1 a2 b0\n10\tfigure: 3 panels, 8 curves\n");
    const std::string data_set =
        "local u = prbs(5, 20)\nlocal d = iddata(lsim(tf({2}, {1, 4, 3}), u, 0.05), u, 0.05)\n";
    EXPECT_THAT(error_of(data_set + "rlssvf(d, {2, 1, 0}, 4, {forgetting = 1.1})"),
                HasSubstr("the forgetting factor must be greater than 0"));
    EXPECT_THAT(error_of(data_set + "print(lssvf(d, {2, 1, 0}, 4).history)"),
                HasSubstr("processes all samples at once"));
    // A fixed model for filters and instruments: the end is the batch estimate with the same.
    EXPECT_EQ(
        printed("rng(2)\nlocal u = prbs(5, 20)\nlocal y = lsim(tf({2}, {1, 4, 3}), u, 0.05) + 0.02*randn(#u)\n"
                "local d = iddata(y, u, 0.05)\nlocal I, S = ivsvf(d, {2, 1, 0}, 4), srivc(d, {1, 2, 0})\n"
                "local R = rivsvf(d, {2, 1, 0}, 4, {model = lssvf(d, {2, 1, 0}, 4)})\n"
                "local Q = rsrivc(d, {1, 2, 0}, 4, {model = S})\n"
                "print(norm(R.param - I.param) < 1e-7*norm(I.param), norm(Q.param - S.param) < 1e-6*norm(S.param))"),
        "true\ttrue\n");
    EXPECT_THAT(error_of(data_set + "plot_history(tf({1}, {1, 1}))"), HasSubstr("has no history"));
    EXPECT_THAT(error_of(data_set + "plot_history(rlssvf(d, {2, 1, 0}, 4), {truth = {K = 1}})"),
                HasSubstr("the parameters are a1, a2, b0"));
}

}  // namespace test_script_loops
