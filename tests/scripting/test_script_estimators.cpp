// Oracle: how the data were made, and srivc on the same data.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/assessment.h"
#include "numerics/fit/diagnostics.h"
#include "numerics/fit/structure_advice.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/lsim.h"
#include "script_run.h"
#include "scripting/interpreter/catalog.h"

namespace test_script_estimators {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kColored =
    "rng(1)\nlocal u = prbs(7, 8)\nlocal e, v = randn(#u), zeros(#u)\nv[1] = e[1]\n"
    "for k = 2, #u do v[k] = 0.9*v[k - 1] + e[k] end\n"
    "local data = iddata(lsim(tf({2}, {1, 4, 3}, {IODelay = 0.3}), u, 0.05) + 0.01*v, u, 0.05)\n"
    "local function near(a, b, std) return math.abs(a - b) <= 3*std end\n";

TEST(script_estimators, rivc_shows_the_noise_model_with_its_errors) {
    EXPECT_EQ(printed(kColored + "local G = rivc(data, {1, 0, 1, 2, 6})\n"
                                 "print(#G.C, #G.D, G.D[1], near(G.D[2], -0.9, G.report.D_std[2]), G.report.D_std[1], "
                                 "math.abs(G.report.D_std[2]^2/G.report.noise_covariance[{1, 1}] - 1) < 1e-12)\n"
                                 "for i, p in ipairs{4, 3, 2} do print(near(G.param[i], p, G.std[i])) end\n"
                                 "print(near(G.report.noise_variance/1e-4, 1, math.sqrt(2/#u)))"),
              "1\t2\t1\ttrue\t0\ttrue\ntrue\ntrue\ntrue\ntrue\n");
    EXPECT_THAT(printed(kColored + "present(rivc(data, {1, 0, 1, 2, 6}))"),
                AllOf(HasSubstr("Noise model C(q^-1)/D(q^-1) e"), HasSubstr("  d1"), Not(HasSubstr("  c1"))));
    EXPECT_THAT(printed(kColored + "present(rivc(data, {1, 0, 0, 2, 6}))"), HasSubstr("Noise: assumed white"));
}

// Oracle: where errors are white both kinds of standard errors are the same on average, whatever the weights.
TEST(script_estimators, weights_of_outputs_change_both_kinds_of_standard_errors) {
    const std::string outputs =
        "local u = prbs(7, 4) local N = #u\n"
        "local function record(seed)\n"
        "    rng(seed)\n"
        "    local y1 = lsim(tf({3}, {1, 1.2, 4}), u, 0.1) + 0.05*randn(N)\n"
        "    local y2 = lsim(tf({1, 0.5}, {1, 1.2, 4}), u, 0.1) + 0.4*randn(N)\n"
        "    return iddata(matrix{y1, y2}, u, 0.1)\n"
        "end\n";
    EXPECT_EQ(
        printed(outputs + "local ratios = zeros(5)\n"
                          "for seed = 1, 20 do\n"
                          "    local G = srivc(record(seed), {{1, 2}, {2, 2}, {0, 0}}, {CommonDenominator = true, "
                          "OutputWeights = {1, 1}})\n"
                          "    for k = 1, 5 do ratios[k] = ratios[k] + G.robust_std[k]/G.std[k]/20 end\n"
                          "end\n"
                          "for k = 1, 5 do print(math.abs(ratios[k] - 1) < 0.1) end"),
        "true\ntrue\ntrue\ntrue\ntrue\n");
    for (const char* method : {"srivc", "coe"})
        EXPECT_EQ(printed(outputs + "local d = record(3) local plain, weighted = " + method +
                          "(d, {{1, 2}, {2, 2}, {0, 0}}), " + method +
                          "(d, {{1, 2}, {2, 2}, {0, 0}}, {OutputWeights = {1, 2}})\n"
                          "print(norm(weighted.param - plain.param) < 1e-5*norm(plain.param))"),
                  "true\n");
}

TEST(script_estimators, tfrivc_finds_the_delay_too) {
    EXPECT_EQ(printed(kColored +
                      "local G = tfrivc(data, 2, 0, {nd = 1, TdMax = 1})\n"
                      "print(near(G.IODelay, 0.3, G.std[4]), near(G.D[2], -0.9, G.report.D_std[2]))\n"
                      "print(tfrivc(data, 2, 0, {IODelay = 0.3}).IODelay, #tfrivc(data, 2, 0, {IODelay = 0.3}).param)"),
              "true\ttrue\n0.3\t3\n");
}

TEST(script_estimators, rivc_and_tfrivc_can_be_studied) {
    EXPECT_EQ(printed("local study = montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(7, 8), Ts = 0.05, sigma = "
                      "0.05, runs = 5, estimators = {rivc = {{1, 0, 1, 2, 0}}, tfrivc = {2, 0, {TdMax = 0}}}}\n"
                      "print(#study.rivc.mean, #study.tfrivc.mean)"),
              "3\t3\n");
}

TEST(script_estimators, models_without_a_noise_model_say_who_has_one) {
    EXPECT_THAT(error_of(kColored + "print(srivc(data, {1, 2, 6}).C)"), HasSubstr("rivc returns B, C, D and F"));
}

TEST(script_estimators, difference_equations_have_robust_errors_too) {
    for (const char* method : {"oe", "sriv"})
        EXPECT_THAT(
            printed(kColored + "local G = " + method +
                    "(data, {1, 2, 7})\nprint(#G.robust_std, G.robust_std[3] > G.std[3], G.report.white)\n"
                    "present(G)"),
            AllOf(HasSubstr("3\ttrue\tfalse"), HasSubstr("(robust ± "), HasSubstr("Use the robust standard errors")))
            << method;
}

const std::string kDelayed =
    "rng(3) local u = prbs(7, 8)\n"
    "local data = iddata(lsim(tf({2}, {1, 4, 3}, {IODelay = 0.3}), u, 0.05) + 0.01*randn(#u), u, 0.05)\n"
    "local free = tfsrivc(data, 2, 0)\n"
    "local function same(a, b) return norm(a - b) < 1e-4*norm(b) end\n";

TEST(script_estimators, a_model_or_a_delay_starts_the_search) {  // oracle: the search without a start
    EXPECT_EQ(printed(kDelayed + "print(same(tfsrivc(data, tf({1.5}, {1, 3, 2}, {IODelay = 0.2})).param, free.param), "
                                 "same(tfcoe(data, 2, 0, {Td0 = 0.25}).param, free.param))\n"
                                 "print(#tfcoe(data, tf({1.5}, {1, 3, 2})).param)"),
              "true\ttrue\n3\n");
    EXPECT_THAT(error_of(kDelayed + "tfsrivc(data, tf({1}, {1, 2}), {Td0 = 1})"),
                HasSubstr("which already includes a delay"));
    EXPECT_THAT(error_of(kDelayed + "tfsrivc(data, tf({1}, {1, 2}, {Ts = 1}))"), HasSubstr("continuous-time model"));
}

TEST(script_estimators, known_parameters_stay_as_they_are) {  // oracle: the system
    EXPECT_EQ(printed(kDelayed + "local G = srivc(data, {1, 2, 6}, {Fixed = {a2 = 3, b0 = 2}})\n"
                                 "print(G.param[2], G.param[3], G.std[2], math.abs(G.param[1] - 4) < 4*G.std[1])\n"
                                 "local T = tfcoe(data, 2, 0, {Fixed = {b0 = 2}})\n"
                                 "print(T.param[3], math.abs(T.IODelay - 0.3) < 4*T.std[4], T.std[3])"),
              "3\t2\t0\ttrue\n2\ttrue\t0\n");
    EXPECT_THAT(error_of(kDelayed + "srivc(data, {1, 2, 6}, {Fixed = {3}})"), HasSubstr("must contain named values"));
}

TEST(script_estimators, each_output_has_orders_of_its_own) {  // oracle: each output alone
    EXPECT_EQ(
        printed(
            kDelayed +
            "local two = iddata(matrix{data.y, cumsum(data.u)*0 + lsim(tf({1, 1}, {1, 2, 4, 2}), u, 0.05)}, u, 0.05)\n"
            "local G = srivc(two, {{1, 2}, {2, 3}, {6, 0}})\n"
            "print(same(G.channels[1][1].num, srivc(data, {1, 2, 6}).num), #G.channels[2][1].den, "
            "#G.channels[2][1].num)"),
        "true\t4\t2\n");
}

// Oracle: the values put into the data, and the diagnostics of the C++ function.
TEST(script_estimators, srivc_reports_the_diagnostics_of_the_cpp_function) {
    const Vector u = prbs(7, 8);
    const Vector ripple = (Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1)).array().square()).sin();
    const Vector y = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}}), u, 0.05) + u;
    const IdData data(Matrix((y + 0.05 * ripple).array() + 3), Matrix(u), 0.05);
    const Fit fit = srivc(data, TransferStructure::single(2, 0));
    const Diagnostics found = diagnose(fit, data, {});
    ASSERT_TRUE(fit.start.offset);
    ASSERT_TRUE(found.missed && found.missed->code == StructureAdviceCode::kFeedthrough);
    ASSERT_TRUE(found.assessment);
    const Vector& std = found.assessment->std;
    EXPECT_EQ(printed("local u = prbs(7, 8)\n"
                      "local y = lsim(tf({2}, {1, 4, 3}), u, 0.05) + u + 0.05*sin(range(0, 1, #u - 1)^2) + 3\n"
                      "local data = iddata(y, u, 0.05)\n"
                      "local G = srivc(data, {1, 2, 0})\n"
                      "data = nil\ncollectgarbage()\n"  // the model keeps what it needs
                      "print(G.report.warnings[#G.report.warnings])\nprint(G.report.white)\n"
                      "for i = 1, #G.param do print(string.format('%.6g %.6g', G.param[i], G.robust_std[i])) end"),
              fmt::format("{}\n{}\n{:.6g} {:.6g}\n{:.6g} {:.6g}\n{:.6g} {:.6g}\n",
                          message_text(found.warnings().back(), {nullptr, option_name}), found.assessment->white,
                          fit.theta[0], std[0], fit.theta[1], std[1], fit.theta[2], std[2]));
}

// Oracle: the constant that was added to the data.
TEST(script_estimators, message_names_the_start_that_is_chosen) {
    const std::string data_set =
        "rng(1)\nlocal u = prbs(7, 8)\n"
        "local y = lsim(tf({2}, {1, 4, 3}), u, 0.05) + 0.05*randn(#u) + 3\nlocal data = iddata(y, u, 0.05)\n";
    EXPECT_THAT(printed(data_set + "print(srivc(data, {1, 2, 0}).report.message)"),
                HasSubstr("from rest at zero input, with an estimated offset"));
    EXPECT_EQ(printed(data_set + "local none = {InitialState = \"none\", Offset = \"none\"}\n"
                                 "local zero = {InitialState = \"zero\", Offset = \"none\"}\n"
                                 "print(srivc(data, {1, 2, 0}).report.fit_percent > 75, "
                                 "srivc(data, {1, 2, 0}, none).report.fit_percent < 50, "
                                 "srivc(data, {1, 2, 0}, none).param[1] == srivc(data, {1, 2, 0}, zero).param[1])"),
              "true\ttrue\ttrue\n");
}

}  // namespace test_script_estimators
