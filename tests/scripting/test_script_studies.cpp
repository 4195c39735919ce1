// Oracle: how the data were made, and the same estimations called separately.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_script_studies {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::AllOf;
using testing::HasSubstr;

const std::string kStudy =
    "local s = tf('s')\nlocal G0 = 2/(s^2 + 4*s + 3)\nlocal u = prbs(4, 100)\n"
    "local function study(estimators, runs)\n"
    "  return montecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = runs or 20, estimators = estimators}\n"
    "end\n";

TEST(script_studies, runs_are_what_the_functions_give_one_by_one) {
    EXPECT_EQ(
        printed(kStudy +
                "local M = study{lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3, {hold_y = 'zoh'}}, "
                "srivc = {{1, 2, 0}, {lambda = 3}}}\n"
                "rng(5)\nlocal d = iddata(lsim(G0, u, 0.01) + 0.2*randn(#u), u, 0.01)\n"
                "local function same(a, b) for i = 1, 3 do if math.abs(a.theta[{5, i}] - b[i]) > 1e-9 then return "
                "false end end return true end\n"
                "print(same(M.lssvf, lssvf(d, {2, 1, 0}, 3).param), same(M.srivc, srivc(d, {1, 2, 0}, {lambda = "
                "3}).param), same(M.ivsvf, ivsvf(d, {2, 1, 0}, 3, {hold_y = 'zoh'}).param))\n"
                "print(table.concat(M.labels, ' '), M.runs, M.sigma)"),
        "true\ttrue\ttrue\nlssvf ivsvf srivc\t20\t0.2\n");
}

TEST(script_studies, functions_of_the_script_are_estimators_too) {
    EXPECT_EQ(
        printed(kStudy + "local M = study{lssvf = {{2, 1, 0}, 3}, own = function(d) return lssvf(d, {2, 1, 0}, 3) end, "
                         "bare = function(d) local G = lssvf(d, {2, 1, 0}, 3) return G.param, G.std end}\n"
                         "print(M.own.mean[1] == M.lssvf.mean[1], M.bare.mean[3] == M.lssvf.mean[3], "
                         "M.bare.reported_std[1] == M.lssvf.reported_std[1], M.bare.truth[1])"),
        "true\ttrue\ttrue\t4\n");
}

TEST(script_studies, a_method_can_appear_twice) {
    EXPECT_EQ(
        printed(kStudy + "local M = study{{'lssvf', {2, 1, 0}, 3, label = 'slow'}, {'lssvf', {2, 1, 0}, 30, label = "
                         "'fast'}, third = {'lssvf', {2, 1, 0}, 0.3}}\n"
                         "print(table.concat(M.labels, ' '), M.slow.mean[1] ~= M.fast.mean[1])"),
        "slow fast third\ttrue\n");
    EXPECT_THAT(error_of(kStudy + "study{{'lssvf', {2, 1, 0}, 3}, {'lssvf', {2, 1, 0}, 30}}"),
                HasSubstr("two estimators are named 'lssvf'"));
}

TEST(script_studies, print_shows_truth_scatter_bias_and_failures) {
    EXPECT_THAT(
        printed(kStudy + "local n = 0\nlocal M = study({lssvf = {{2, 1, 0}, 3}, own = function(d) n = n + 1 if n == 3 "
                         "then error('no luck') end return lssvf(d, {2, 1, 0}, 3) end}, 50)\nprint(M)\n"
                         "print(M.own.failed, M.own.estimated)"),
        AllOf(HasSubstr("Monte Carlo study of 50 runs"), HasSubstr("truth"), HasSubstr("Cramer-Rao std"),
              HasSubstr("reported std"), HasSubstr("lssvf is biased in a1, a2, b0: the mean"),
              HasSubstr("own: 1 of 50 runs failed"), HasSubstr("no luck"), HasSubstr("1\t49\n")));
}

TEST(script_studies, figures_need_parameters_that_exist) {
    EXPECT_THAT(printed(kStudy + "local M = study{lssvf = {{2, 1, 0}, 3}}\nM:histograms()\nM:scatter('a1', 'b0')\n"
                                 "print(pcall(function() return M:scatter('a1', 'b7') end))"),
                HasSubstr("lssvf has no parameter 'b7'; the parameters are a1, a2, b0"));
    EXPECT_THAT(error_of(kStudy + "print(study{lssvf = {{2, 1, 0}, 3}}.ivsvf)"),
                HasSubstr("unknown estimator or field of this study: 'ivsvf'; the estimators are lssvf"));
}

TEST(script_studies, wrong_studies_say_what_is_wrong) {
    EXPECT_THAT(error_of(kStudy + "study{lssvf = {{2, 1}, 3}}"), HasSubstr("lssvf"));
    EXPECT_THAT(error_of(kStudy + "study{lssvf = {{2, 1, 0}}}"), HasSubstr("lambda"));
    EXPECT_THAT(error_of(kStudy + "study{lssvf = {{2, 1, 0}, 3, {hold = 'foh'}}}"), HasSubstr("option 'hold'"));
    EXPECT_THAT(error_of(kStudy + "study{nosuch = {{2, 1, 0}, 3}}"),
                HasSubstr("unknown estimator 'nosuch'; the estimators are lssvf"));
    EXPECT_THAT(error_of(kStudy + "study{own = function(d) error('always') end}"),
                AllOf(HasSubstr("every run of 'own' failed"), HasSubstr("always")));
    EXPECT_THAT(error_of(kStudy + "montecarlo{system = G0, input = u, Ts = 0.01, estimators = {}}"),
                HasSubstr("either sigma"));
    EXPECT_THAT(error_of(kStudy + "montecarlo{system = 3, input = u, Ts = 0.01, sigma = 1, estimators = {}}"),
                HasSubstr("option 'system'"));
}

TEST(script_studies, order_search_recommends_the_true_orders) {
    const std::string data_set =
        "local u = prbs(7, 8)\nlocal x = lsim(tf({2}, {1, 4, 3}), u, 0.05)\n"
        "local data, check = iddata(x + 0.1*randn(#u), u, 0.05), iddata(x + 0.1*randn(#u), u, 0.05)\n";
    EXPECT_THAT(printed(data_set + "local V = srivcstruc(data, {poles = {1, 4}, zeros = {0, 2}})\n"
                                   "print(V)\nprint(#V.rows, V.best.poles, V.best.zeros, #V.best.model.den)"),
                AllOf(HasSubstr("* "), HasSubstr("Recommended: 2 poles and no zero"), HasSubstr("9\t2\t0\t3\n")));
    EXPECT_THAT(
        printed(data_set + "local V = srivcstruc(data, {{1, 1, 0}, {1, 2, 0}, {1, 2, 1}}, {validate = check})\n"
                           "local G = selcstruc(V)\nprint(#G.den, V.rows[3].delay, V.best.validation_fit > 50)"),
        AllOf(HasSubstr("val. (%)"), HasSubstr("3\t0.05\ttrue\n")));
    EXPECT_THAT(error_of(data_set + "selcstruc(srivcstruc(data, {poles = 2, zeros = 0}), 'validation')"),
                HasSubstr("validation data"));
    EXPECT_THAT(error_of(data_set + "selcstruc(srivcstruc(data, {poles = 2, zeros = 0}), 'nonsense')"),
                HasSubstr("criterion must be"));
    EXPECT_THAT(error_of(data_set + "srivcstruc(data, {poles = {2, 1}})"), HasSubstr("option 'poles' must be a range"));
    EXPECT_THAT(error_of(data_set + "srivcstruc(data, {pole = 2})"), HasSubstr("did you mean 'poles'"));
}

TEST(script_studies, a_second_record_is_evaluated_as_fit_does) {  // oracle: fit() of the recommended model
    const std::string data_set =
        "local u = prbs(7, 8)\nlocal x = lsim(tf({2}, {1, 4, 3}), u, 0.05)\n"
        "local data = iddata(x + 50 + 0.1*randn(#u), u + 3, 0.05)\n"
        "local check = iddata(x - 20 + 0.1*randn(#u), u - 1, 0.05)\n";
    for (const std::string offset : {"estimate", "remove", "auto"}) {
        const std::string start = "InitialState = 'estimate', Offset = '" + offset + "'}";
        EXPECT_THAT(printed(data_set + "local V = srivcstruc(data, {poles = 2, zeros = 0, validate = check, " + start +
                            ")\nlocal own = fit(check, V.best.model, {" + start +
                            ")\nprint(math.abs(V.best.validation_fit - own) < 1e-9, own > 50)"),
                    HasSubstr("true\ttrue\n"))
            << offset;
    }
}

// Oracle: arx() itself, over the same samples.
TEST(script_studies, arx_orders_are_chosen_and_go_on_to_arx) {
    const std::string data_set =
        "local function made(seed)\nrng(seed)\nlocal u, y = randn(500), zeros(500)\n"
        "for k = 3, 500 do y[k] = 1.5*y[k-1] - 0.7*y[k-2] + u[k-1] + 0.5*u[k-2] + 0.2*randn() end\n"
        "return iddata(y, u, 1)\nend\nlocal data, second = made(1), made(2)\n";
    EXPECT_THAT(printed(data_set + "local V = arxstruc(data, {na = {1, 4}, nb = {1, 4}, nk = {1, 2}})\n"
                                   "local o, fig = selstruc(V, 'MDL')\nprint(o[1], o[2], o[3], #V.rows, V.best.na)\n"
                                   "print(arx(data, o).param[1] < -1.4)"),
                AllOf(HasSubstr("*    2    2    1          4"), HasSubstr("has the smallest BIC."),
                      HasSubstr("2\t2\t1\t32\t2\ntrue\n")));
    EXPECT_THAT(printed(data_set + "local V = arxstruc(data, {na = 2, nb = 2, nk = 1, validate = second})\n"
                                   "local G = arx(data, {2, 2, 1})\n"
                                   "print(math.abs(V.best.loss/G.report.loss - 1) < 1e-9, V.best.validation_loss > "
                                   "V.best.loss/2, V.best.determined)\nprint(V)"),
                AllOf(HasSubstr("true\ttrue\ttrue"), HasSubstr("val. loss")));
    EXPECT_THAT(error_of(data_set + "selstruc(arxstruc(data), 'FPE')"),
                HasSubstr("\"loss\", \"AIC\", \"BIC\" or \"MDL\""));
    EXPECT_THAT(error_of(data_set + "arxstruc(data, second, {{1, 1, 1}})"), HasSubstr("accepts at most 2 arguments"));
    EXPECT_THAT(error_of(data_set + "arxstruc(data, {n = 2})"), HasSubstr("unknown option 'n'"));
    EXPECT_THAT(error_of(data_set + "selstruc(3)"), HasSubstr("the result of arxstruc"));
}

// Oracle: a separate call of srivc() with Integration.
TEST(script_studies, structures_may_have_an_integrator) {
    EXPECT_THAT(printed("local u = prbs(7, 8)\nlocal x = lsim(tf({3}, {1, 2, 0}), u, 0.05)\n"
                        "local data = iddata(x + 0.05*randn(#u), u, 0.05)\n"
                        "local V = srivcstruc(data, {poles = {1, 2}, zeros = {0, 1}, Integration = true})\n"
                        "local G = srivc(data, {1, 1, 0}, {Integration = true})\nprint(V.recommendation)\n"
                        "print(V.best.poles, norm(V.best.model.den - G.den) < 1e-9, V.best.model.den)"),
                AllOf(HasSubstr("Recommended: an integrator, 1 pole and no zero"), HasSubstr("1\ttrue\t[1 ")));
}

TEST(script_studies, delays_are_real_numbers) {  // oracle: the simulated system
    const std::string data_set =
        "local u = prbs(8, 5)\nlocal x = lsim(tf({-4, 0.5}, {1, 1, 4}, {IODelay = 8}), u, 0.1)\n"
        "local data = iddata(x + 10^(-15/20)*std(x)*randn(#u), u, 0.1)\n";
    EXPECT_THAT(
        printed(data_set + "local Td, fig, D = delayest(data, {poles = 2, zeros = 1})\n"
                           "print(math.abs(Td - 8) < 4*D.std, D.delay == Td, math.abs(D.samples - 10*Td) < 1e-9, "
                           "D.poles, D.zeros, D.model.IODelay == Td, #D.delays == #D.losses, D.rival)"),
        AllOf(HasSubstr("The delay is "), HasSubstr("true\ttrue\ttrue\t2\t1\ttrue\ttrue\tnil\n")));
    EXPECT_THAT(error_of(data_set + "delayest(data, {TdMin = 3, TdMax = 3})"),
                HasSubstr("TdMax must be greater than TdMin"));
    EXPECT_THAT(error_of(data_set + "delayest(data, {TdMax = 1000})"), HasSubstr("TdMax"));
    EXPECT_THAT(error_of(data_set + "delayest(data, {pole = 2})"), HasSubstr("did you mean 'poles'"));
    EXPECT_THAT(error_of(data_set + "delayest(x)"), HasSubstr("data"));
}

}  // namespace test_script_studies
