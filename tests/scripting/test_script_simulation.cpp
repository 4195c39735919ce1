// Oracle: what the numbers must be by their definition, worked out in the script another way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_script_simulation {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

const std::string kEstimate =
    "local u = prbs(7, 8)\n"
    "local d = iddata(lsim(tf({2}, {1, 4, 3}), u, 0.05) + 0.1*randn(#u), u, 0.05)\n"
    "local G = srivc(d, {1, 2, 0})\n";

TEST(script_simulation, sim_adds_the_noise_of_the_model) {
    EXPECT_EQ(printed(kEstimate +
                      "local inputs = iddata(nil, u, 0.05)\n"
                      "print(inputs.ny, inputs.nu, inputs.N, norm(sim(G, inputs) - lsim(G, u, 0.05)))\n"
                      "local y, v = sim(G, inputs, {noise = true, seed = 3})\n"
                      "rng(3)\nlocal e = randn(#u)\n"
                      "print(norm(v - G.report.noise_variance^0.5*e) < 1e-12, norm(y - sim(G, u, 0.05) - v) < 1e-12)\n"
                      "rng(3)\nprint(norm(sim(G, u, 0.05, {noise = true}) - y))\n"
                      "local q = G.B[1] - G.num[1] + #G.F - #G.den\nprint(q)"),
              "0\t1\t1016\t0\ntrue\ttrue\n0\n0\n");
    EXPECT_EQ(printed("local z = tf('z', 1)\nlocal u = prbs(8, 20)\n"
                      "local d = iddata(lsim(1/(z - 0.8), u, 1) + lsim((z + 0.5)/(z - 0.8), 0.3*randn(#u), 1), u, 1)\n"
                      "local G = armax(d, {1, 1, 1, 1})\n"
                      "local y, v = sim(G, u, 1, {noise = true, seed = 1})\n"
                      "local e = pe(iddata(y, u, 1), G)\n"
                      "print(math.abs(std(e)^2/G.report.noise_variance - 1) < 0.05, std(v) > 1.5*std(e))"),
              "true\ttrue\n");
}

TEST(script_simulation, a_static_characteristic_belongs_to_its_model) {  // oracle: f(u) by hand, then lsim
    const std::string model =
        "rng(2)\nlocal u = 2*rand(600) - 1\n"
        "for k = 1, 600 do u[k] = u[1 + 6*((k - 1)//6)] end\n"
        "local bent = interp1({-1, -0.2, 0.2, 1}, {-0.8, 0, 0, 1.6}, u)\n"
        "local y = lsim(tf({9}, {1, 2, 9}), bent, 0.05) + 0.01*randn(600)\n"
        "local d = iddata(y, u, 0.05)\n"
        "local options = {Breakpoints = {-1, -0.2, 0.2, 1}, IODelay = 0, InitialState = 'zero'}\n"
        "local G = hammerstein(d, 2, 0, options)\n"
        "local f = interp1(G.report.breakpoints, G.report.levels, u, {outside = 'hold'})\n"
        "local x = lsim(G, f, 0.05)\n"
        "local start = {InitialState = 'zero', Offset = 'none'}\n";
    EXPECT_EQ(printed(model + "print(norm(sim(G, u, 0.05) - x), norm(sim(G, d) - x), norm(lsim(G, u, 0.05) - x) > 1)\n"
                              "print(norm(compare(d, G, start).curves[2].y - x) < 1e-12)\n"
                              "print(norm(predict(d, G, start) - x) < 1e-12, norm(pe(d, G, start) - (y - x)) < 1e-12)\n"
                              "print(math.abs(fit(d, G, start) - G.report.fit_percent) < 1e-6)\n"
                              "start.quiet = true\nlocal _, tests = resid(d, G, start)\n"
                              "print(norm(tests.residuals[1] - (y - x)) < 1e-12)"),
              "0\t0\ttrue\ntrue\ntrue\ttrue\ntrue\ntrue\n");
    // Of several experiments each input is put through it.
    EXPECT_EQ(printed(model + "local both = merge(d, iddata(-2*y, u, 0.05))\n"
                              "print(math.abs(fit(both:experiment(2), G, start) - 100*(1 - norm(-2*y - x)/norm(2*(y - "
                              "mean(y))))) < 1e-6)\n"
                              "print(#predict(both, G, start))"),
              "true\n2\n");
}

TEST(script_simulation, sim_takes_a_signal_to_noise_ratio) {
    EXPECT_EQ(printed("local u = prbs(7, 8)\nlocal S = tf({2}, {1, 4, 3})\n"
                      "local x = lsim(S, u, 0.05)\nlocal y, v = sim(S, u, 0.05, {snr = 15, seed = 2})\n"
                      "rng(2)\nlocal e = randn(#u)\n"
                      "local sigma = (sum((x - mean(x))^2)/#x)^0.5*10^(-15/20)\n"
                      "print(norm(v - sigma*e) < 1e-12, norm(y - x - v) < 1e-12)\n"
                      "print(math.abs(20*math.log(std(x)/std(v), 10) - 15) < 0.5)"),
              "true\ttrue\ntrue\n");
    EXPECT_THAT(error_of("sim(tf({1}, {1, 1}), ones(9), 1, {noise = true})"),
                HasSubstr("specify the option snr in dB"));
    EXPECT_THAT(error_of(kEstimate + "sim(lssvf(d, {2, 1, 0}, 3), d, {noise = true})"),
                HasSubstr("estimates an equation error"));
    EXPECT_THAT(error_of(kEstimate + "sim(rivc(d, {1, 0, 1, 2, 0}), u, 0.1, {noise = true})"),
                HasSubstr("the sampling time of the noise model is 0.05 s"));
}

TEST(script_simulation, bands_as_numbers) {
    EXPECT_EQ(printed(kEstimate +
                      "local mag, ph, w, sdmag, sdph = bode_values(G, {0.1, 1, 10})\n"
                      "local H = freqresp(G, w)\n"
                      "print(#mag, norm(mag - H.abs) < 1e-14, #sdmag, #sdph)\n"
                      // the steady-state gain b/a2 and its standard error by hand
                      "local mag0, _, _, sd0 = bode_values(G, {1e-9})\n"
                      "local P, p = G.robust_covariance, G.param\n"
                      "if G.report.white then P = G.covariance end\n"
                      "local by = matrix{{0}, {-p[3]/p[2]^2}, {1/p[2]}}\n"
                      "local variance = (by:t()*P*by)[{1, 1}]\n"
                      "print(math.abs(sd0[1]/variance^0.5 - 1) < 1e-6)\n"
                      "local y, t, sd = step(G, linspace(0, 40, 5))\n"
                      "print(math.abs(sd[5]/variance^0.5 - 1) < 1e-6, sd[1])\n"
                      "print(select('#', bode_values(tf({1}, {1, 1}))), select('#', step(tf({1}, {1, 1}), {1})))"),
              "3\ttrue\t3\t3\ntrue\ntrue\t0\n3\t2\n");
}

// Oracle: MATLAB's final time, which has no counterpart.
TEST(script_simulation, a_last_instant_is_refused_with_the_instants_to_give) {
    for (const char* drawn : {"step(tf({1}, {1, 1}), 5)", "impulse(tf({1}, {1, 1}), 5)"})
        EXPECT_THAT(error_of(drawn), HasSubstr("x = linspace(0, 5, 300)")) << drawn;
    EXPECT_THAT(error_of("step(tf({1}, {1, 1}), 5)"), HasSubstr("plot(x, step(G, x))"));
    EXPECT_THAT(error_of("impulse(tf({1}, {1, 1}), 5)"), HasSubstr("plot(x, impulse(G, x))"));
    EXPECT_THAT(error_of("nyquist(tf({1}, {1, 1}), 5)"),
                HasSubstr("w = logspace(-2, 2, 300). nyquist(G, w) returns a figure, and freqresp(G, w)"));
}

TEST(script_simulation, simsd_agrees_with_the_band_of_the_step) {
    EXPECT_EQ(printed(kEstimate + "local fig, s = simsd(G, ones(100), 0.05, {runs = 1000, seed = 1})\n"
                                  "local _, _, sd = step(G, 0.05*range(0, 99))\n"
                                  "print(norm(s.std - sd)/norm(sd) < 0.1, s.unstable, #s.output, s.drawn.columns)\n"
                                  "print(norm(fig.curves[1].y - s.output), #fig.curves)"),
              "true\t0\t100\t1000\n0\t2\n");
    EXPECT_EQ(
        printed("local u = prbs(7, 4)\nlocal d = iddata(lsim(tf({1}, {1, -0.8}, 1), u, 1) + 0.1*randn(#u), u, 1)\n"
                "local _, s = simsd(oe(d, {1, 1, 1}), d, {runs = 20})\nprint(#s.std, s.std[400] > 0)"),
        "508\ttrue\n");
    EXPECT_THAT(error_of("simsd(tf({1}, {1, 1}), ones(9), 1)"), HasSubstr("an estimated model"));
    // Two inputs: what the estimate simulates is what lsim makes of its channels.
    EXPECT_EQ(printed("rng(1)\nlocal u, v = prbs(7, 4):range(1, 381), prbs(7, 3)\n"
                      "local y = lsim(tf({2}, {1, 3}), u, 0.1) + lsim(tf({1}, {1, 1}), v, 0.1) + 0.05*randn(381)\n"
                      "local d = iddata(y, {u, v}, 0.1)\n"
                      "for _, G in ipairs{srivc(d, {{1, 1}, {1, 1}, {0, 0}}), tfsrivc(d, 1, 0, {IODelay = 0}),\n"
                      "                   arx(d, {1, {1, 1}, {1, 1}})} do\n"
                      "  local _, s = simsd(G, d, {runs = 30, seed = 1})\n"
                      "  print(norm(s.output - sim(G, d)) < 1e-9, s.std[381] > 0, s.drawn.columns)\nend"),
              "true\ttrue\t30\ntrue\ttrue\t30\ntrue\ttrue\t30\n");
    EXPECT_THAT(error_of("rng(1)\nlocal u = prbs(7, 4)\nlocal d = iddata(lsim(tf({2}, {1, 3}), u, 0.1) + "
                         "0.05*randn(#u), u, 0.1)\nsimsd(srivc(d, {1, 1, 0}), matrix{{1, 2}, {3, 4}}, 0.1)"),
                HasSubstr("the model has 1 input, but the number of input signals is 2"));
}

TEST(script_simulation, inputs_and_sampling_time_that_differ_from_the_model_are_refused) {
    const std::string models =
        "rng(1)\nlocal u, v = prbs(7, 4), prbs(7, 4, {0, 1})^2 + randn(508)\n"
        "local y = lsim(tf({2}, {1, 3}), u, 0.1) + lsim(tf({1}, {1, 1}), v, 0.1) + 0.05*randn(508)\n"
        "local A, G = arx(iddata(y, u, 0.1), {1, 1, 1}), srivc(iddata(y, {u, v}, 0.1), {{1, 1}, {1, 1}, {0, 0}})\n";
    EXPECT_THAT(error_of(models + "simsd(A, u, 0.2)"),
                HasSubstr("the sampling time of the model is 0.1 s, but the sampling time of the input is 0.2 s"));
    EXPECT_THAT(error_of(models + "sim(A, u, 0.2)"), HasSubstr("The sampling times must be equal"));
    EXPECT_THAT(error_of(models + "sim(G, u, 0.1)"),
                HasSubstr("the model has 2 inputs, but the number of input signals is 1"));
    EXPECT_EQ(printed(models + "print(#sim(G, matrix{u, v}, 0.1))"), "508\n");
    for (const char* call : {"compare(d, G)", "predict(d, G)", "resid(d, G)"})
        EXPECT_THAT(error_of(models + "local d = iddata({y, y}, u, 0.1)\n" + call),
                    HasSubstr("the model has 2 inputs and 1 output, but the data have 1 input and 2 outputs"))
            << call;
}

TEST(script_simulation, data_of_inputs_are_refused_where_an_output_is_needed) {
    for (const char* call :
         {"arx(d, {1, 1, 1})", "srivc(d, {1, 2, 0})", "compare(d, tf({1}, {1, 1}))", "resid(d, tf({1}, {1, 1}))",
          "n4sid(d, 2)", "etfe(d)", "spa(d)", "impulseest(d)", "cra(d)", "delayest(d)", "advice(d)",
          "procsrivc(d, 'P1')", "step_first_order(d)", "hammerstein(d, 1, 0)", "rivc(d, {1, 0, 1, 2, 0})",
          "predict(d, tf({1}, {1, 1}))", "crossvalidate(d, function(x) return tf({1}, {1, 1}) end)",
          "srivcstruc(d, {poles = {1, 2}, zeros = {0, 1}})", "test_your_model(tf({1}, {1, 1}), d)"})
        EXPECT_THAT(error_of(std::string("local d = iddata(nil, prbs(5, 4), 0.1)\n") + call),
                    HasSubstr("(data) must have an output, but these data contain only inputs"))
            << call;
    EXPECT_EQ(
        printed("local d = iddata(nil, prbs(5, 4), 0.1)\n"
                "print(d:range(1, 50).N, d:merge(d).experiments, d:split(0.5).N, d:remove_mean().nu, "
                "d:detrend('linear').N, idfilt(d, {0, 5}).N, resample(d, 1, 2).N, d:shift(2).N, d:keep{{1, 9}}.N)\n"
                "idplot(d)\nidplot(d, 1, 20)\nprint(d)"),
        printed("local d = iddata(nil, prbs(5, 4), 0.1)\nprint(50, 2, 62, 1, 124, 124, 62, 122, 9)\nprint(d)"));
}

TEST(script_simulation, delays_in_loops_and_states) {
    EXPECT_EQ(printed("local C = tf({0.2}, {1}, 0.1)\nlocal P = tf({1}, {1, -0.9}, {Ts = 0.1, IODelay = 0.3})\n"
                      "local T = feedback(P, C)\nlocal w = {1, 5, 20}\n"
                      "local one, loop = freqresp(T, w), freqresp(P, w)\n"
                      "for i = 1, 3 do\n  local p, t = loop[i], one[i]\n"
                      "  local re = t.re*(1 + 0.2*p.re) - 0.2*t.im*p.im - p.re\n"
                      "  local im = t.im*(1 + 0.2*p.re) + 0.2*t.re*p.im - p.im\n"
                      "  print(re^2 + im^2 < 1e-24)\nend\n"
                      "print(ss(P).A.rows)"),
              "true\ntrue\ntrue\n4\n");
    EXPECT_THAT(error_of("feedback(tf({1}, {1, 1}, {IODelay = 1}), 1)"),
                HasSubstr("approximate the delay with pade(G, n)"));
    EXPECT_THAT(error_of("ss(tf({1}, {1, 1}, {IODelay = 1}))"), HasSubstr("approximate the delay with pade(G, n)"));
    EXPECT_EQ(printed("local Gm, Pm, Wcg, Wcp, Dm = margin(tf({2}, {1, 0}, {IODelay = 0.25}))\n"
                      "print(string.format('%.6f %.6f %.6f %.6f %.6f', Gm, Pm, Wcg, Wcp, Dm))\n"
                      "print(pade(tf({1}, {1, 1}, {IODelay = 1}), 2).IODelay)"),
              "3.141593 61.352110 6.283185 2.000000 0.535398\n0\n");
}

TEST(script_simulation, habits_of_the_toolboxes) {
    EXPECT_EQ(printed("local u = prbs(5, 4)\nlocal y = lsim(tf({1}, {1, 1}), u, 0.1) + 3\nlocal d = iddata(y, u, 0.1)\n"
                      "print(srivc(d, {1, 1, 0}, {Lambda = 2, offset = 'estimate'}).report.iterations == "
                      "srivc(d, {1, 1, 0}, {lambda = 2, Offset = 'estimate'}).report.iterations)\n"
                      "print(norm(detrend(d, 0).y - d:remove_mean().y), norm(detrend(d, 1).y - detrend(d).y))\n"
                      "print(tf({1}, {1, 0.5}, 0.2).Ts)"),
              "true\n0\t0\n0.2\n");
    EXPECT_THAT(error_of("srivc(iddata(ones(9), ones(9), 1), {1, 1, 0}, {Lambda = 2, lambda = 2})"),
                HasSubstr("are equivalent"));
    // The spelling of older scripts.
    EXPECT_EQ(printed("local fig = plot({1, 2}, {1, 3}, {colour = 'red'})\n"
                      "print(norm(polyfit_report({1, 2, 4}, {1, 3, 2}, 1, {centred = false}).theta - "
                      "polyfit_report({1, 2, 4}, {1, 3, 2}, 1, {centered = false}).theta))"),
              "0\n");
    EXPECT_THAT(error_of("plot({1, 2}, {1, 3}, {colour = 'red', color = 'blue'})"), HasSubstr("are equivalent"));
    EXPECT_THAT(error_of("plot({1, 2}, {1, 3}, {colour = 'pinkish'})"), HasSubstr("option 'color' must be"));
    EXPECT_THAT(error_of("detrend({1, 2, 3}, 2)"), HasSubstr("degree 0"));
    EXPECT_THAT(error_of("bode(tf({1}, {1, 1}), 'sd', 3)"), HasSubstr("{confidence = 0.99}"));
    EXPECT_THAT(error_of("local u = prbs(5, 4)\nsrivc(iddata(u, matrix{u, u^2}, 1), {1, 1, 2, 2, 0, 0})"),
                HasSubstr("an entry is a list with one value per input"));
}

// Oracle: counted by hand; a line and a gap are three values.
TEST(figures, are_ruled_as_graph_paper) {
    EXPECT_EQ(printed("local f = plot({0, 1}, {0, 2}, {x_range = {0, 1}, y_range = {0, 2}}):rule(0.1, 0.5)\n"
                      "local c = f.curves\n"
                      "local function show(...) print((string.format(...))) end\n"
                      "show('%d %d %d %d %d', #c, #c[2].x//3, #c[3].x//3, #c[4].x//3, #c[5].x//3)\n"
                      "show('%g %g %g %g', c[2].x[1], c[2].y[1], c[2].x[2], c[2].y[2])\n"
                      "show('%s %g %g', c[2].y[3] ~= c[2].y[3], c[2].x[31], c[3].y[13])"),
              "5 11 5 3 1\n0 0 0 2\ntrue 1 2\n");
    EXPECT_THAT(error_of("plot({0, 1}, {0, 2}):rule(0.1, 0.5)"), HasSubstr("set x_range and y_range first"));
    EXPECT_THAT(error_of("plot({0, 1}, {0, 2}, {x_range = {0, 1}, y_range = {0, 2}}):rule(0, 0.5)"),
                HasSubstr("dx must be a positive number"));
}

}  // namespace test_script_simulation
