// The discrete-time estimators as scripts use them. Oracle: the simulated systems, and the definitions of the fields.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_script_discrete {

using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

const std::string kDataSet =
    "local Go = tf({2}, {1, 4, 3})\nlocal u = prbs(7, 3)\nlocal y = lsim(Go, u, 0.2)\n"
    "local data = iddata(y, u, 0.2)\n";
const std::string kTwoInputs =
    "local u1, u2 = prbs(7, 3), prbs(7, 2):range(1, 254)\nu1 = u1:range(1, 254)\n"
    "local y = lsim(tf({0.5}, {1, -0.8}, {Ts = 1}), u1, 1) + lsim(tf({2}, {1, -0.5}, {Ts = 1}), u2, 1)\n"
    "local data = iddata(y, matrix{u1, u2}, 1)\n";

TEST(script_discrete, models_have_their_polynomials) {
    EXPECT_EQ(printed(kDataSet + "local G, D = arx(data, {2, 2, 1}), c2d(Go, 0.2)\n"
                                 "print(norm(G.A - D.den) < 1e-9, norm(G.B:range(2, 3) - D.num) < 1e-9, G.B[1])\n"
                                 "print(G.C, G.D, G.F, G.Ts, #G.names, G.names[3], #G.std, G.report.method)"),
              "true\ttrue\t0\n[1]\t[1]\t[1]\t0.2\t4\tb1\t4\tarx\n");
    for (const std::string name : {"oe", "sriv"})
        EXPECT_EQ(printed(kDataSet + "local G, D = " + name + "(data, {2, 2, 1}), c2d(Go, 0.2)\n" +
                          "print(norm(G.F - D.den) < 1e-6, G.A, #G.B, G.names[1], G.report.converged)"),
                  "true\t[1]\t3\tf1\ttrue\n");
}

TEST(script_discrete, models_work_like_all_others) {
    EXPECT_EQ(printed(kDataSet +
                      "local G = oe(data, {2, 2, 1}, {Tol = 1e-10})\nlocal C = d2c(G)\n"
                      "print(norm(C.den - Go.den) < 1e-6, norm(lsim(G, u, 0.2) - y) < 1e-6, fit(data, G) > 99.99,\n"
                      "  #pole(G), stable(G), C.IODelay)\ncompare(data, G)\nbode(G)"),
              "true\ttrue\ttrue\t2\ttrue\t0\n");
    const std::string shown = printed(kDataSet + "present(sriv(data, {2, 2, 1}))");
    for (const char* part : {"polynomial model", "  F     [1 ", "  B     [0 ", "  f1 ", "±", "Sampling time: 0.2 s",
                             "Estimated by sriv", "Poles:"})
        EXPECT_THAT(shown, HasSubstr(part));
}

TEST(script_discrete, present_of_equation_error_methods_names_the_measured_past_values) {
    for (const char* call : {"arx(data, {2, 2, 1})", "iv4(data, {2, 2, 1})", "armax(data, {2, 2, 1, 1})"})
        EXPECT_THAT(printed(kDataSet + "y = y + 0.01*randn(#y)\ndata = iddata(y, u, 0.2)\npresent(" + call + ")"),
                    HasSubstr("The fit refers to the simulation from the measured past values, without an offset.\n"))
            << call;
    EXPECT_THAT(printed(kDataSet + "present(oe(data, {2, 2, 1}, {InitialState = 'estimate', Offset = 'none'}))"),
                HasSubstr("The fit refers to the simulation from an estimated initial state, without an offset.\n"));
}

TEST(script_discrete, several_inputs) {
    EXPECT_EQ(
        printed(kTwoInputs + "local G = oe(data, {{1, 1}, {1, 1}, {1, 1}}, {Tol = 1e-10})\n"
                             "print(math.abs(G.F[1][2] + 0.8) < 1e-7, math.abs(G.B[2][2] - 2) < 1e-7, G.names[3],\n"
                             "  #G.channels, math.abs(dcgain(G.channels[2]) - 4) < 1e-6)"),
        "true\ttrue\tf1_u2\t2\ttrue\n");
    EXPECT_THAT(printed(kTwoInputs + "present(arx(data, {1, vector{2, 2}, {1, 1}}))"), HasSubstr("From input 2:"));
    EXPECT_THAT(error_of(kTwoInputs + "bode(oe(data, {{1, 1}, {1, 1}, {1, 1}}))"), HasSubstr("G.channels[1]"));
    EXPECT_THAT(error_of(kTwoInputs + "print(oe(data, {{1, 1}, {1, 1}, {1, 1}}).num)"), HasSubstr("has 2 inputs"));
    EXPECT_THAT(error_of(kTwoInputs + "oe(data, {1, 1, 1})"), HasSubstr("the data have 2 inputs"));
}

TEST(script_discrete, orders_are_explained) {
    const auto refusal = [](const std::string& call) { return error_of(kDataSet + call); };
    EXPECT_EQ(
        refusal("arx(data, {2, 1})"),
        "lesson.lua:5: arx: argument 2 (orders) must be {na, nb, nk} (na: poles; nb: coefficients of B; nk: samples "
        "of input delay, 1 for systems without direct feedthrough), but the list has 2 entries");
    EXPECT_THAT(refusal("oe(data, {2, 2, 0.5})"), HasSubstr("nk is 0.5; specify an integer from 0 to 1000000"));
    EXPECT_THAT(refusal("sriv(data, {2, -2, 1})"), HasSubstr("nf is -2"));
    EXPECT_THAT(refusal("oe(data, {2, 'x', 1})"), HasSubstr("nf is the string \"x\""));
    EXPECT_THAT(refusal("oe(data, {2, {1, 'x'}, 1})"), HasSubstr("nf contains the string \"x\""));
    EXPECT_THAT(refusal("oe(data)"), HasSubstr("it is missing"));
    EXPECT_THAT(refusal("arx(data, {{1, 2}, 1, 1})"), HasSubstr("na, the number of poles, must be one value"));
    EXPECT_THAT(refusal("oe(data, {0, 2, 1})"), HasSubstr("nb, the number of coefficients of B, must be between 1"));
    EXPECT_THAT(refusal("oe(data, {2, 2, 1}, {Offst = 'none'})"), HasSubstr("did you mean 'Offset'?"));
    EXPECT_THAT(refusal("oe(data, {2, 2, 1}, {InitialState = 'rest'})"),
                HasSubstr("option 'InitialState' must be one of \"none\""));
    EXPECT_THAT(refusal("print(Go.A)"), HasSubstr("discrete-time polynomial models"));
}

// Oracle: the simulated system. Every method gets the option Integration.
TEST(script_discrete, integration_adds_an_integrator) {
    const std::string data_set =
        "local u = prbs(7, 6)\nlocal data = iddata(lsim(tf({3}, {1, 2, 0}), u, 0.05), u, 0.05)\n";
    EXPECT_THAT(printed(data_set + "local G = srivc(data, {1, 1, 0}, {Integration = true})\n"
                                   "print(G.den[3] == 0, norm(G.den - vector{1, 2, 0}) < 1e-4, #G.param)"),
                HasSubstr("true\ttrue\t2"));
    EXPECT_THAT(printed(data_set + "local G = oe(data, {2, 1, 1}, {Integration = true})\n"
                                   "print(norm(G.F - c2d(tf({3}, {1, 2, 0}), 0.05).den) < 1e-6)"),
                HasSubstr("true"));
    for (const char* call : {"arx(data, {1, 2, 1}, {Integration = true})", "iv4(data, {1, 2, 1}, {Integration = true})",
                             "armax(data, {1, 2, 0, 1}, {Integration = true})"})
        EXPECT_THAT(printed(data_set + "local G = " + call +
                            "\nprint(norm(G.den - c2d(tf({3}, {1, 2, 0}), 0.05).den) < 1e-6, #G.F, #G.param, "
                            "fit(data, G) > 99.9)"),
                    HasSubstr("true\t2\t3\ttrue"))
            << call;
    for (const char* call : {"rivc(data, {1, 0, 0, 1, 0}, {Integration = true})",
                             "tfrivc(data, 1, 0, {nd = 0, IODelay = 0, Integration = true})"})
        EXPECT_THAT(printed(data_set + "local G = " + call +
                            "\nprint(G.den[3] == 0, norm(G.den - vector{1, 2, 0}) < 1e-4, #G.param)"),
                    HasSubstr("true\ttrue\t2"))
            << call;
}

}  // namespace test_script_discrete
