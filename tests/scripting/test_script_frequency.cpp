// Frequencies as scripts see them. Oracles: the systems that made the responses; the definitions of the fields.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_script_frequency {

using namespace dynlab;
using dynlab::test::printed;
using dynlab::test::run;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kResponse =
    "local w = logspace(-1, 1, 50)\n"
    "local G0 = tf({1.2}, {1.1, 0.0009, 1.2})\n"
    "local F = idfrd(freqresp(G0, w), w)\n"
    "local function near(a, b, limit) if math.abs(a - b) > (limit or 1e-9) then error(a .. ' is not ' .. b, 2) end "
    "end\n";

/// What the script says after the response; nothing when all its assertions hold.
std::string said(const std::string& code) {
    return printed(kResponse + code);
}

TEST(script_frequency, options_of_nonparametric_methods_are_checked_before_their_messages) {
    for (const char* method : {"etfe", "spa", "cra", "impulseest"})
        for (const char* option : {"confidence = 1", "labels = 'a'"})
            EXPECT_THAT(said("rng(1)\nlocal u = prbs(6, 4)\nlocal d = iddata(u + 0.1*randn(#u), u, 0.1)\n" +
                             std::string(method) + "(d, {" + option + "})"),
                        AllOf(StartsWith("ERROR"), HasSubstr("option '")))
                << method << ", " << option;
    EXPECT_THAT(said("local u = prbs(6, 4)\netfe(iddata(u, u, 0.1), {quiet = true, confidence = 1})"),
                AllOf(StartsWith("ERROR"), HasSubstr("option 'confidence'")));
}

TEST(script_frequency, responses_have_their_fields) {
    EXPECT_EQ(said("print(F)"), "idfrd: 50 frequencies from 0.1 to 10 rad/s, variances unknown\n");
    EXPECT_EQ(said("assert(#F == 50 and #F.w == 50 and F.variance == nil and F.std == nil and F.Ts == 0)\n"
                   "near(F.H[3].re, freqresp(G0, w)[3].re)\n"
                   "near(F.magnitude[7], F.H[7].abs)\n"
                   "local V = idfrd({F.H.re, F.H.im}, w, {variance = 0.08, Ts = 0.1, InterSample = 'zoh', InputName = "
                   "'force'})\n"
                   "near(V.std[1], 0.2) assert(V.InterSample == 'zoh' and V.InputName == 'force')\n"
                   "local P = idfrd({{1, 2}, {3, 4}, {5, 6}}, {3, 1, 2})\n"
                   "near(P.H[1].re, 3) near(P.H[3].im, 2) near(P.w[3], 3)\n"
                   "near(idfrd(G0, w).H[9].im, F.H[9].im)\n"),
              "");
}

TEST(script_frequency, models_of_responses_are_the_system) {
    EXPECT_EQ(
        said("for _, G in ipairs{coe(F, {1, 2, 0}), srivc(F, {1, 2, 0}), tfsrivc(F, 2, 0, {TdMax = 0}),\n"
             "                   tfcoe(F, 2, 0, {IODelay = 0}), lssvf(F, {2, 1, 0}, 2)} do\n"
             "  near(G.param[1], 0.0009/1.1, 1e-12) near(G.param[2], 1.2/1.1, 1e-10) near(G.param[3], 1.2/1.1, 1e-10)\n"
             "end\n"
             "local late = idfrd(tf({2}, {1, 0.8, 4}, {IODelay = 0.7}), w)\n"
             "near(tfsrivc(late, 2, 0).IODelay, 0.7)\n"
             "local held = idfrd(tf({2}, {1, 0.8, 4}, {IODelay = 0.2}), w, {Ts = 0.1, InterSample = 'zoh'})\n"
             "near(coe(held, {1, 2, 2}).param[1], 0.8)\n"),
        "");
}

TEST(script_frequency, of_a_discrete_model_are_those_of_held_samples) {
    EXPECT_EQ(said("local D = idfrd(c2d(G0, 0.1), w) assert(D.Ts == 0.1 and D.InterSample == 'zoh')\n"
                   "near(coe(D, {1, 2, 0}).param[2], 1.2/1.1, 1e-8)\n"),
              "");
}

TEST(script_frequency, spectral_estimates_are_responses) {
    EXPECT_THAT(said("rng(1)\nlocal G1 = tf({2}, {1, 1.2, 4})\nlocal u = prbs(9, 4)\nu = vector{u, u}\n"
                     "local y = lsim(G1, u, 0.1)\nlocal N = #u // 2\n"
                     "local _, E = etfe(iddata(y:range(N + 1, 2*N), u:range(N + 1, 2*N), 0.1))\n"
                     "local G = coe(E, {1, 2, 0})\n"
                     "near(G.param[1], 1.2, 1e-4) near(G.param[2], 4, 1e-4) near(G.param[3], 2, 1e-4)\n"
                     "local _, S = spa(iddata(y + 0.05*randn(#y), u, 0.1), {window = 100})\n"
                     "local g = srivc(S, {1, 2, 0})\n"
                     "near(g.param[2], 4, 0.2) assert(S.method == 'spa' and S.variance and S.coherence)\n"
                     "print(g.report.warnings[#g.report.warnings])"),
                HasSubstr("\nThe errors of neighboring values of a smoothed response are correlated"));
}

TEST(script_frequency, spectral_estimates_are_quiet_when_asked) {  // oracle: the same call that is not
    const std::string data_set = "local u = prbs(7, 4)\nlocal d = iddata(lsim(tf({2}, {1, 4, 3}), u, 0.05), u, 0.05)\n";
    for (const char* method : {"spa", "etfe"}) {
        const std::string quiet = data_set + "local fig, F = " + method + "(d, {quiet = true})\n";
        EXPECT_TRUE(run(quiet).figures.empty()) << method;
        EXPECT_FALSE(run(data_set + method + "(d)").figures.empty()) << method;
        EXPECT_EQ(printed(quiet + "local _, G = " + method + "(d)\nprint(fig, F.response[9].re == G.response[9].re)"),
                  printed(data_set + method + "(d)") + "nil\ttrue\n");
    }
}

TEST(script_frequency, few_noisy_samples_give_a_figure_and_a_sentence) {
    const std::string few =
        "for N = 8, 29 do\n"
        "  rng(N)\n"
        "  local u = randn(N)\n"
        "  local y = lsim(tf({1}, {1, 1}), u, 0.5) + 0.3*randn(N)\n"
        "  local fig, F = spa(iddata(y, u, 0.5))\n"
        "  bode(F)\n"
        "  if N == 10 then print('10: ' .. (F.warnings[1] or '')) end\n"
        "end\n";
    const std::string text = printed(few);
    EXPECT_THAT(text, Not(HasSubstr("ERROR")));
    EXPECT_THAT(
        text, HasSubstr("\n10: The response does not differ significantly from zero at any frequency, so its phase is "
                        "unknown. Use more samples or a stronger input.\n"));
    EXPECT_EQ(run(few).figures.size(), 2u * 22u);
}

TEST(script_frequency, drawings_take_responses_and_models_in_any_order) {
    EXPECT_EQ(
        said("local V = idfrd(F.H, w, {variance = 0.01})\n"
             "bode(V, G0) bode(G0, V, {labels = {'model', 'measured'}}) bode(F) bode(F, V, w, {confidence = false})\n"),
        "");
    EXPECT_THAT(said("bode(F, G0, {labels = 'one'})"), HasSubstr("option 'labels' has 1 string for 2 models"));
}

TEST(script_frequency, approximations_come_with_their_levels) {
    EXPECT_THAT(
        said("rng(2)\nlocal parts = {}\n"
             "for m = 1, 6 do\n"
             "  local u = multisine(256, {lines = range(1, 60), odd = true, periods = 5})\n"
             "  local x = lsim(tf({2}, {1, 1.2, 4}), u, 0.1)\n"
             "  parts[m] = iddata(x + 0.05*x^2 + 0.001*randn(#u), u, 0.1)\n"
             "end\n"
             "local B, figure = bla(merge(table.unpack(parts)), {period = 256, transient = 2})\n"
             "assert(#B.w == 30 and B.noise_variance and B.distortion and B.noise_power < 0.01*B.output_power)\n"
             "assert(sum(B.even.distortion) > 0.9*B.distortion_power and figure)\n"
             "near(coe(B, {1, 2, 0}).param[2], 4, 0.02)\n"),
        StartsWith("Best linear approximation at 30 frequencies from 6 realizations of 3 periods. The noise level is"));
}

TEST(script_frequency, multisines_follow_the_stream_or_a_seed) {
    EXPECT_EQ(
        said("rng(3)\nlocal a, grid = multisine(64, {lines = {1, 3, 5}, amplitude = 2, periods = 2})\n"
             "local b = multisine(64, {lines = {1, 3, 5}})\n"
             "assert(#a == 128 and #grid.lines == 3 and #grid.detection == 0 and norm(a:range(1, 64)/2 - b) > 1)\n"
             "local c, d = multisine(64, {seed = 9}), multisine(64, {seed = 9})\n"
             "near(norm(c - d), 0) near(norm(a)/math.sqrt(128), 2)\n"),
        "");
}

TEST(script_frequency, mistakes_are_reported_in_sentences) {
    const std::pair<const char*, const char*> kCases[] = {
        {"idfrd(F.H, w - 0.1)", "frequencies must be positive (rad/s), but frequency 1 is 0; remove it"},
        {"idfrd(F.H, -1*w)", "frequencies must be positive"},
        {"idfrd(F.H, w, {variance = 0})", "variances must be positive"},
        {"idfrd(F.H, w, {Ts = 1})", "frequencies must not exceed pi/Ts"},
        {"idfrd(F.H, w:range(1, 9))", "each frequency (9), but has 50"},
        {"idfrd(w, w)", "must be a complex vector"},
        {"coe(F, {1, 2, 3})", "nk is a delay in samples, which is undefined for a response without Ts"},
        {"coe(F, {1, 40, 0})", "poles"},
        {"coe(idfrd({{1, 2}}, {3}), {1, 2, 0})",
         "the response must have at least as many frequencies as parameters (3), but has 1"},
        {"coe(F, {1, 2, 0}, {Offset = 'estimate'})", "unknown option 'Offset'"},
        {"ivsvf(F, {2, 1, 0}, 2)", "must be an iddata object, but"},
        {"lssvf(F, {2, 1, 0}, -1)", "cutoff frequency"},
        {"idfrd(c2d(G0, 0.1), w*20)", "frequencies must not exceed pi/Ts = 31.416 rad/s"},
        {"idfrd(c2d(G0, 0.1), w, {Ts = 0.2})", "but the model has 0.1 s"},
        {"coe(idfrd(0*F.H.re + 0, w), {1, 2, 0})", "must be a complex vector"},
        {"coe(idfrd({0*w, 0*w}, w), {1, 2, 0})", "the response is zero at all frequencies"},
        {"multisine(64, {lines = {40}})", "from 1 to 31, but one is 40"},
    };
    for (const auto& [code, sentence] : kCases)
        EXPECT_THAT(said("print(" + std::string(code) + ")"), AllOf(StartsWith("ERROR"), HasSubstr(sentence))) << code;
}

TEST(script_frequency, responses_can_be_answers_and_are_reported_in_french) {
    const std::string code =
        "rng(2)\nlocal u = multisine(256, {lines = range(1, 60), periods = 3})\n"
        "local B = bla(iddata(lsim(tf({2}, {1, 1.2, 4}), u, 0.1), u, 0.1), {period = 256})\n"
        "print(B.message)\nprint(coe(B, {1, 2, 0}).report.message)";
    EXPECT_THAT(printed(code, {}, "fr"), AllOf(HasSubstr("Meilleure approximation linéaire"),
                                               HasSubstr("L'ajustement à la réponse fréquentielle a convergé")));
}

}  // namespace test_script_frequency
