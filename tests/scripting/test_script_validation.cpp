// Oracle: how the data were made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "figures/figure.h"
#include "script_run.h"

namespace test_script_validation {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;
using testing::Not;

const std::string kDataSet =
    "local u = prbs(7, 8)\n"
    "local x = lsim(idproc('P2', {Kp = 2, Tp1 = 1, Tp2 = 0.3}), u, 0.05)\n"
    "local white = iddata(x + 0.1*randn(#u), u, 0.05)\n"
    "local noise = lsim(tf({1}, {0.4, 1}), randn(#u), 0.05)\n"
    "local colored = iddata(x + noise, u, 0.05)\n";

TEST(script_validation, resid_says_what_is_left) {
    EXPECT_THAT(printed(kDataSet + "local fig, t = resid(white, procsrivc(white, 'P2'))\nprint(t.white, t.independent, "
                                   "#t.residuals[1], #t.outputs[1].inputs[1].correlation)"),
                HasSubstr("true\ttrue\t1016\t51\n"));
    EXPECT_THAT(printed(kDataSet + "local fig, t = resid(white, procsrivc(white, 'P1'))\nprint(t.independent)"),
                testing::AllOf(HasSubstr("The model does not describe all dynamics"), HasSubstr("false\n")));
    EXPECT_THAT(printed(kDataSet + "print((resid(iddata(x, u, 0.05), idproc('P2', {Kp = 2, Tp1 = 1, Tp2 = 0.3}))))"),
                testing::AllOf(HasSubstr("rounding error"), HasSubstr("nil\n")));
}

TEST(script_validation, reports_and_resid_name_the_structure_that_is_missed) {
    EXPECT_THAT(printed(kDataSet + "local raised = iddata(x + u + 0.1*randn(#u) + 5, u, 0.05)\n"
                                   "local G = srivc(raised, {1, 2, 0})\nprint(G.report.warnings[#G.report.warnings])\n"
                                   "local fig, t = resid(raised, G)\nprint(t.verdict)"),
                testing::AllOf(HasSubstr("With as many zeros as poles, the fit is"),
                               Not(HasSubstr("The model does not describe all dynamics"))));
    EXPECT_THAT(printed(kDataSet + "print(#srivc(white, {1, 2, 0}).report.warnings)"), HasSubstr("0\n"));
    EXPECT_THAT(printed(kDataSet + "local G = rivc(iddata(x + u + 0.1*randn(#u) + 5, u, 0.05), {1, 0, 1, 2, 0})\n"
                                   "print(G.report.warnings[#G.report.warnings])"),
                HasSubstr("With as many zeros as poles, the fit is"));
}

TEST(script_validation, resid_can_be_quiet_in_a_loop) {
    EXPECT_EQ(printed(kDataSet + "local fig, t = resid(white, procsrivc(white, 'P1'), {quiet = true})\n"
                                 "print(fig, t.independent)"),
              "nil\tfalse\n");
}

TEST(script_validation, resid_takes_discrete_models_and_experiments) {
    EXPECT_THAT(printed(kDataSet + "local _, t = resid(white, c2d(idproc('P2', {Kp = 2, Tp1 = 1, Tp2 = 0.3}), 0.05))\n"
                                   "print(t.white, t.independent)"),
                HasSubstr("true\ttrue\n"));
    EXPECT_THAT(printed(kDataSet + "local d = white:range(1, 500):merge(white:range(600, 1016))\n"
                                   "local G = idproc('P2', {Kp = 2, Tp1 = 1, Tp2 = 0.3})\n"
                                   "local _, t = resid(d, G)\nprint(#t.residuals[2], t.independent, fit(d, G) > 80)\n"
                                   "compare(d, G)"),
                HasSubstr("417\ttrue\ttrue\n"));
    EXPECT_EQ(printed(kDataSet + "local d = white:range(1, 500):merge(white:range(600, 1016))\n"
                                 "local G = idproc('P1', {Kp = 2, Tp1 = 1})\n"
                                 "print(fit_measures(d, G).fit_percent == fit(d, G))"),
              "true\n");
}

// Oracle: the definition, by hand: every experiment counts from its own means.
TEST(script_validation, measures_blind_to_constants_are_so_in_each_experiment) {
    EXPECT_EQ(
        printed(kDataSet + "local G = idproc('P2', {Kp = 2, Tp1 = 1, Tp2 = 0.3})\n"
                           "local a = iddata(x + 0.1*randn(#u) + 3, u, 0.05)\n"
                           "local b = iddata(x + 0.1*randn(#u) - 5, u, 0.05)\n"
                           "local how = {InitialState = 'zero', Offset = 'none'}\n"
                           "local errors, swings = 0, 0\n"
                           "for _, d in ipairs{a, b} do\n"
                           "    local e = d.y - x\n"
                           "    errors, swings = errors + norm(e - mean(e))^2, swings + norm(d.y - mean(d.y))^2\n"
                           "end\n"
                           "local m = fit_measures(merge(a, b), G, how)\n"
                           "print(math.abs(m.r_squared_simulation - (1 - errors/swings)) < 1e-9, m.fit_percent < 0)"),
        "true\ttrue\n");
}

TEST(script_validation, present_shows_robust_errors_for_colored_noise_only) {
    EXPECT_THAT(printed(kDataSet + "present(procsrivc(colored, 'P2'))"),
                testing::AllOf(HasSubstr("(robust ± "), HasSubstr("not white")));
    EXPECT_THAT(printed(kDataSet + "present(procsrivc(white, 'P2'))"), Not(HasSubstr("robust")));
    EXPECT_EQ(printed(kDataSet + "local G = procsrivc(colored, 'P2')\nprint(#G.robust_std, G.robust_std[1] > G.std[1], "
                                 "math.abs(G.robust_covariance[{1, 1}] - G.robust_std[1]^2) < 1e-12)"),
              "3\ttrue\ttrue\n");
}

TEST(script_validation, present_gives_no_error_of_a_delay_at_its_bound) {
    const std::string shown = printed(kDataSet + "present(tfsrivc(white, 2, 0, {TdMax = 0.3}))");
    EXPECT_THAT(shown, HasSubstr("  Td               0  (at its bound)\n"));
    EXPECT_THAT(shown, Not(HasSubstr("± 0\n")));
}

TEST(script_validation, present_reports_errors_of_gain_and_time_constants) {  // oracle: the gain's own standard error
    const std::string text = printed(kDataSet +
                                     "local G = procsrivc(white, 'P1')\npresent(G)\n"
                                     "print(string.format('KP %.2g T %.2g', G.robust_std[1], G.robust_std[2]))");
    const auto errors = text.substr(text.find("KP ") + 3);
    const std::string gain = errors.substr(0, errors.find(' ')), T = errors.substr(errors.find("T ") + 2);
    EXPECT_THAT(text, testing::ContainsRegex("Steady-state gain: [0-9.]+ ± " + gain + "\n"));
    EXPECT_THAT(text, HasSubstr(" ± " + T));
    EXPECT_THAT(printed("present(tf({2}, {1, 4}))"), Not(HasSubstr("±")));
}

// Oracle: the place of the last digit that is printed, against the error beside it.
TEST(script_validation, present_writes_no_digits_below_the_error) {
    const std::string text = printed(kDataSet + "present(procsrivc(white, 'P2'))\npresent(srivc(colored, {2, 2, 0}))");
    static const std::regex kPair(R"(\d+(?:\.(\d+))? +± (\d+(?:\.\d+)?(?:e-?\d+)?))");
    int pairs = 0;
    for (std::sregex_iterator pair(text.begin(), text.end(), kPair), end; pair != end; ++pair, ++pairs)
        EXPECT_GE(std::pow(10, -static_cast<double>((*pair)[1].length())), 1e-3 * std::stod((*pair)[2])) << pair->str();
    EXPECT_GT(pairs, 10);
}

// Oracle: the words and bounds of the help pages.
TEST(script_validation, options_are_held_to_their_words_and_bounds) {
    const std::string model = kDataSet + "local G = idproc('P1', {Kp = 2, Tp1 = 1})\n";
    for (const auto& [call, said] : std::vector<std::pair<std::string, std::string>>{
             {"compare(white, G, {InitialState = 'model'})",
              "option 'InitialState' must be one of \"none\", \"steady\", \"estimate\", \"auto\", but \"model\" was "
              "given"},
             {"predict(white, G, {Offset = 'big'})",
              "option 'Offset' must be one of \"none\", \"remove\", \"estimate\", \"auto\", but \"big\" was given"},
             {"bootstrap(G, white, {kind = 'blocks'})",
              "option 'kind' must be one of \"residual\", \"parametric\", but \"blocks\" was given"},
             {"bootstrap(G, white, {runs = 19})", "option 'runs' must be at least 20, but 19 was given"},
             {"lsq({{1}, {2}}, {1, 2}, {method = 'svd'})",
              "option 'method' must be one of \"qr\", \"normal\", but \"svd\" was given"},
             {"lsq({{1, 1}, {2, 2}, {3, 3}}, {1, 2, 3}, {method = 'normal'})", "lsq"},
             {"idfilt(white, {0, 1}, {order = 21})", "option 'order' must be between 1 and 20, but 21 was given"}})
        EXPECT_THAT(error_of(model + call), HasSubstr(said)) << call;
    EXPECT_EQ(printed("print(lsq({{1, 1}, {2, 2}, {3, 3}}, {1, 2, 3}, {method = 'qr'}).rank == 1)\n"
                      "print(iddata({1, 2}, {1, 2}, 1).InterSample)\n"
                      "print(iddata({1, 2}, {1, 2}, 1, {InterSample = 'foh'}).InterSample)"),
              "true\nzoh\nfoh\n");
}

TEST(script_validation, figures_carry_bands_unless_refused) {
    const auto bands = [](const std::string& drawing) {
        const RunRecord record = test::run(kDataSet + "local G = procsrivc(white, 'P2')\n" + drawing);
        EXPECT_FALSE(record.error) << record.error->text();
        std::size_t count = 0;
        for (const auto& [name, figure] : record.figures)
            for (const Panel& panel : figure.figure->panels)
                for (const Curve& curve : panel.curves)
                    count += curve.style == CurveStyle::kBand || message_text(curve.label) == "90 % confidence";
        return count;
    };
    EXPECT_EQ(bands("step(G)"), 1u);
    EXPECT_EQ(bands("step(G, {confidence = false})"), 0u);
    EXPECT_EQ(bands("bode(G, {confidence = 0.9})"), 2u);
    EXPECT_EQ(bands("pzmap(G, {confidence = 0.9})"), 1u);
    EXPECT_EQ(bands("step(tf({1}, {1, 1}))"), 0u);
    EXPECT_THAT(error_of("step(tf({1}, {1, 1}), {confidence = 2})"),
                HasSubstr("must be a confidence level between 0 and 1"));
    EXPECT_THAT(error_of("nyquist(tf({1}, {1, 1}), {confidence = 0.9})"), HasSubstr("unknown option 'confidence'"));
}

const std::string kNoisyData =
    "local z = tf('z', 1)\n"
    "local u = prbs(7, 4)\n"
    "local y = lsim((z + 0.5)/(z^2 - 1.5*z + 0.7), u, 1) + lsim(z^2/(z^2 - 1.5*z + 0.7), 0.3*randn(#u), 1)\n"
    "local d = iddata(y, u, 1)\n";

TEST(script_validation, predict_and_pe_know_the_noise) {
    EXPECT_EQ(printed(kNoisyData +
                      "local G = armax(d, {2, 2, 1, 1})\n"
                      "local e, about = pe(d, G)\n"
                      "local yp = predict(d, G)\n"
                      "print(#e, about.first, math.abs(about.loss/G.report.loss - 1) < 1e-9, norm(d.y - yp - e))\n"
                      "print(norm(predict(d, G, 5) - predict(d, G, {k = 5})))\n"
                      "print(fit(d, G, {k = 1}) > fit(d, G, {k = 3}), fit(d, G, {k = 3}) > fit(d, G))"),
              "508\t3\ttrue\t0\n0\ntrue\ttrue\n");
    EXPECT_EQ(printed(kDataSet + "local G = rivc(colored, {1, 0, 1, 2, 0})\n"
                                 "print(G.report.Ts, fit(colored, G, {k = 1}) > fit(colored, G) + 5)"),
              "0.05\ttrue\n");
    EXPECT_EQ(printed(kDataSet + "local G = procsrivc(white, 'P2')\n"
                                 "print(norm(predict(white, G) - fit_measures(white, G).output))\n"
                                 "local two = white:range(1, 500):merge(white:range(600, 1016))\n"
                                 "local y, about = predict(two, G)\nprint(#y, #y[2], about.message:match('^%a+'))"),
              "0\n2\t417\tSimulated\n");
    EXPECT_EQ(printed(kNoisyData + "local G = arx(d, {2, 2, 1})\nprint(fit(d, G, 4) == fit(d, G, {k = 4}), "
                                   "compare(d, G, 4).curves[2].label == compare(d, G, {K = 4}).curves[2].label, "
                                   "G.noise_variance == G.report.noise_variance)"),
              "true\ttrue\ttrue\n");
    EXPECT_THAT(error_of(kNoisyData + "predict(d, arx(d, {2, 2, 1}), {k = 0.5})"),
                HasSubstr("option 'k' must be a whole number of steps"));
    EXPECT_THAT(error_of(kNoisyData + "predict(d, arx(d, {2, 2, 1}), -2)"), HasSubstr("but -2 was given"));
    EXPECT_THAT(error_of(kNoisyData + "pe(iddata(y, u, 0.5), arx(d, {2, 2, 1}))"),
                HasSubstr("The sampling times must be equal"));
}

TEST(script_validation, resid_tests_predictions_too) {
    EXPECT_EQ(printed(kNoisyData + "local G = arx(d, {2, 2, 1})\n"
                                   "local _, e = resid(d, G, {prediction = true, quiet = true})\n"
                                   "local _, v = resid(d, G, {quiet = true})\n"
                                   "print(e.white, v.white, norm(e.residuals[1] - pe(d, G)) < 1e-12)"),
              "true\tfalse\ttrue\n");
}

TEST(script_validation, compare_gives_what_it_draws) {
    EXPECT_EQ(printed(kNoisyData +
                      "local G = arx(d, {2, 2, 1})\n"
                      "local drawn = compare(d, G, {k = 2}).curves\n"
                      "print(#drawn, drawn[1].label, norm(drawn[1].y - d.y), norm(drawn[2].y - predict(d, G, 2)))\n"
                      "print(drawn[2].label == string.format('arx, 2 steps ahead: %.1f %%', fit(d, G, {k = 2})))\n"
                      "local simulated = compare(d, G).curves[2]\n"
                      "print(norm(simulated.y - fit_measures(d, G).output), simulated.panel)"),
              "2\tmeasured\t0\t0\ntrue\n0\t1\n");
}

// Oracle: an output raised by 5, whose fit without the offset is that of the errors 5 on every sample.
TEST(script_validation, fit_compare_and_present_state_the_offset_that_they_remove) {
    const std::string raised = kDataSet +
                               "local raised = iddata(x + 5, u, 0.05, {OutputUnit = 'V'})\n"
                               "local G = idproc('P2', {Kp = 2, Tp1 = 1, Tp2 = 0.3})\n";
    const std::string noted = printed(raised +
                                      "for k = 1, 3 do local f = fit(raised, G) end\n"
                                      "print('plain', 100*(1 - 5*math.sqrt(#u)/norm(x - mean(x))))");
    std::smatch found;
    const std::regex note(
        "^fit: an estimated offset of 5 V was removed; if the offset is not removed, the fit is (-[0-9.]+) %\\. To "
        "choose, set "
        "Offset to \"estimate\" or \"none\"\\.\nplain\t(-[0-9.]+)\n$");
    ASSERT_TRUE(std::regex_match(noted, found, note)) << noted << "once a line";
    EXPECT_NEAR(std::stod(found[1]), std::stod(found[2]), 0.1);
    EXPECT_EQ(printed(raised + "local f, g = fit(raised, G, {Offset = 'estimate'}), fit(white, G)"), "")
        << "asked for, and none";
    EXPECT_EQ(printed(raised +
                      "print(compare(raised, G).curves[2].label, compare(white, G).curves[2].label:match('offset'))"),
              "model 1: 100.0 %, offset 5 V\tnil\n");
    EXPECT_THAT(printed(raised + "present(srivc(raised, {1, 2, 0}))"),
                HasSubstr("The fit refers to the simulation from rest at zero input, with an estimated offset (5"));
    EXPECT_THAT(printed(raised + "present(srivc(white, {1, 2, 0}, {InitialState = 'none', Offset = 'none'}))"),
                HasSubstr("The fit refers to the simulation from rest at zero input, without an offset.\n"));
}

TEST(script_validation, crossvalidate_ranks_structures) {
    EXPECT_THAT(
        printed(kDataSet + "local function fold(kind) return function(d) return procsrivc(d:experiment(1), kind) "
                           "end end\n"
                           "local _, one = crossvalidate(white, fold('P1'), {folds = 4})\n"
                           "local _, two = crossvalidate(white, fold('P2'), {folds = 4})\n"
                           "print(#two.fit_percent, two.mean[1] > one.mean[1], two.folds[2].first)"),
        testing::AllOf(HasSubstr("Simulated on 4 parts"), HasSubstr("4\ttrue\t255\n")));
}

TEST(script_validation, crossvalidate_passes_errors_on) {
    EXPECT_EQ(error_of(kDataSet + "crossvalidate(white, function(d) error('no') end)"), "lesson.lua:6: no");
    EXPECT_THAT(error_of(kDataSet + "crossvalidate(white, function(d) return 3 end)"),
                HasSubstr("the estimation function must return a model"));
    EXPECT_THAT(error_of(kDataSet + "crossvalidate(white, 3)"),
                HasSubstr("argument 2 (fit) must be a function of a data object"));
}

}  // namespace test_script_validation
