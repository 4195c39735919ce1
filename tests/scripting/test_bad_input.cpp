// Oracle: definitions. What cannot be estimated is refused with a sentence that names the reason, by every method of
// the catalog; refusals for poor excitation are shown to be right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "numerics/criteria/process_output.h"
#include "numerics/estimators/method_catalog.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/simulation/lsim.h"
#include "script_run.h"

namespace test_bad_input {

using namespace dynlab;
using dynlab::test::printed;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// How scripts call each method on the data `d`: with orders that suit them, and with wrong ones.
struct Calls {
    std::string good;
    std::vector<std::string> wrong;
};

/// `wrong` and `good` are tables of orders, `rest` the arguments after them.
Calls ordered(const std::string& name, const std::string& good, const std::vector<std::string>& wrong,
              const std::string& rest = "") {
    const auto call = [&](const std::string& orders) { return name + "(d, " + orders + rest + ")"; };
    Calls calls{call(good), {}};
    for (const std::string& orders : wrong) calls.wrong.push_back(call(orders));
    for (const char* orders :
         {"{2, 1}", "{2, 1, 0, 0}", "{2, -1, 0}", "{2, 1.5, 0}", "{2, 1, -1}", "{2, 1, {}}", "2", "'a'", "nil"})
        calls.wrong.push_back(call(orders));
    return calls;
}

Calls filtered(const std::string& name) {
    return ordered(name, "{2, 1, 0}", {"{1, 3, 0}", "{0, 1, 0}", "{2, 0, 0}", "{1e5, 1, 0}"}, ", 3");
}

Calls output_error(const std::string& name) {
    return ordered(name, "{1, 2, 1}", {"{0, 2, 0}", "{1, 1e5, 0}"});
}

Calls with_noise_orders(const std::string& name) {
    return ordered(name, "{1, 0, 1, 2, 1}",
                   {"{0, 0, 1, 2, 0}", "{4, 0, 1, 2, 0}", "{1, -1, 1, 2, 0}", "{1, 0, 0.5, 2, 0}", "{1, 0, 1, 0, 0}",
                    "{1, {0, 0}, 1, 2, 0}", "{1, 0, 1, 1e5, 0}"});
}

Calls named(const std::string& name) {
    return {name + "(d, 2, 0)",
            {name + "(d, 2)", name + "(d, 0, 0)", name + "(d, 1, 2)", name + "(d, -1, 0)", name + "(d, 2.5, 0)",
             name + "(d, {2, 0})"}};
}

Calls subspace(const std::string& name) {
    return {name + "(d, 2)",
            {name + "(d)", name + "(d, 0)", name + "(d, -1)", name + "(d, 2.5)", name + "(d, 1e5)", name + "(d, 'a')",
             name + "(d, {2, 1, 0})", name + "(d, 2, {BlockRows = 2})", name + "(d, 2, {Weighting = 'none'})"}};
}

Calls structured(const std::string& name) {
    std::vector<std::string> wrong;
    for (const char* structure : {"'Q'", "'P'", "'P4'", "'P1U'", "'P1DD'", "'P2X'", "{2, 1}", "nil"})
        wrong.push_back(name + "(d, " + structure + ")");
    return {name + "(d, 'P2')", wrong};
}

Calls reading(const std::string& name) {
    return {name + "(d)", {name + "(d, {1, 2, 0})", name + "()"}};
}

/// `wrong` holds what follows the data.
Calls shown(const std::string& name, const std::vector<std::string>& wrong) {
    Calls calls{name + "(d)", {name + "()", name + "(u)"}};
    for (const std::string& rest : wrong) calls.wrong.push_back(name + "(d, " + rest + ")");
    return calls;
}

const std::map<std::string, Calls>& dynamic_methods() {
    static const std::map<std::string, Calls> kMethods = {
        {"lssvf", filtered("lssvf")},
        {"lsgpmf", filtered("lsgpmf")},
        {"ivsvf", filtered("ivsvf")},
        {"ivgpmf", filtered("ivgpmf")},
        {"rlssvf", filtered("rlssvf")},
        {"rivsvf", filtered("rivsvf")},
        {"srivc", output_error("srivc")},
        {"coe", output_error("coe")},
        {"rivc", with_noise_orders("rivc")},
        {"tfrivc", named("tfrivc")},
        {"tfsrivc", named("tfsrivc")},
        {"tfcoe", named("tfcoe")},
        {"procsrivc", structured("procsrivc")},
        {"arx", ordered("arx", "{2, 2, 1}", {"{2, 0, 1}", "{1e5, 1, 1}"})},
        {"oe", output_error("oe")},
        {"sriv", output_error("sriv")},
        {"n4sid", subspace("n4sid")},
        {"hammerstein", named("hammerstein")},
        {"iv4", ordered("iv4", "{2, 2, 1}", {"{2, 0, 1}", "{1e5, 1, 1}"})},
        {"armax",
         {"armax(d, {2, 2, 1, 1})",
          {"armax(d, {2, 2, 1})", "armax(d, {2, 0, 1, 1})", "armax(d, {2, 2, -1, 1})", "armax(d, {2, 2, {1, 1}, 1})",
           "armax(d, {2, 2, 1e5, 1})", "armax(d, {2, 2, 0.5, 1})", "armax(d, {{2, 2}, 2, 1, 1})",
           "armax(d, {2, 2, 1, {}})", "armax(d, 'a')", "armax(d, nil)"}}},
        {"bj",
         {"bj(d, {1, 0, 1, 2, 1})",
          {"bj(d, {0, 0, 1, 2, 0})", "bj(d, {1, -1, 1, 2, 0})", "bj(d, {1, 0, 0.5, 2, 0})",
           "bj(d, {1, {0, 0}, 1, 2, 0})", "bj(d, {1, 0, 1, 1e5, 0})", "bj(d, {1, 0, 1, 2})", "bj(d, 2)",
           "bj(d, nil)"}}},
        {"etfe", shown("etfe", {"{smooth = -1}", "{smooth = 300}", "{window = 3}", "2, 1", "'a'"})},
        {"spa",
         shown("spa", {"{window = 1}", "{window = 504}", "{w = {100}}", "{w = 'a'}", "{confidence = 2}", "'a'"})},
        {"bla",
         {"bla(d, {period = 504})",
          {"bla(d)", "bla(u)", "bla(d, {period = 100})", "bla(d, {period = 505})", "bla(d, {period = 3})",
           "bla(d, {period = 504, realizations = 5})", "bla(d, {period = 504, realizations = 0})",
           "bla(d, {period = 504, transient = 1})", "bla(d, {period = 504, least_input = 2})",
           "bla(d, {period = 504, InterSample = 'x'})", "bla(d, 504)"}}},
        {"impulseest", shown("impulseest", {"{lags = 200}", "{lags = 401}", "{lags = 1.5}", "{smooth = 3}", "'a'"})},
        {"cra", shown("cra", {"{lags = 200}", "{whitening = 101}", "{whitening = -1}", "{confidence = 0}", "'a'"})},
        {"step_first_order", reading("step_first_order")},
        {"step_second_order", reading("step_second_order")},
        {"step_delayed", reading("step_delayed")},
    };
    return kMethods;
}

const std::string kDataSet =
    "rng(1)\n"
    "local u = prbs(6, 8)\n"
    "local N = #u\n"
    "local G = tf({2}, {1, 4, 3})\n"
    "local e = randn(N)\n"
    "local y = lsim(G, u, 0.05) + 0.05*e\n"
    "local d = iddata(y, u, 0.05)\n";

/// The error that stops the statements after the data set, or all their output.
std::string said(const std::string& code) {
    return printed(kDataSet + code);
}

TEST(bad_input, the_table_holds_every_method) {
    // Methods that need more than a data set have separate tests: script_loops, script_learning, script_grey_box.
    const std::set<std::string> others = {"lsq",     "polyfit_report", "forecast", "gradient_descent",
                                          "greyest", "idgrey",         "clivsvf",  "clsrivc",
                                          "rsrivc",  "narx",           "sindy",    "dmdc"};
    for (const MethodEntry& method : method_catalog())
        for (const std::string& name : method.lua_names)
            EXPECT_TRUE(dynamic_methods().contains(name) || others.contains(name)) << name;
}

TEST(bad_input, signals_with_the_sampling_time_0_are_refused_for_it) {
    for (const char* call : {"sine(1, 4, 0)", "chirp(1, 2, 4, 0)", "multisine({1}, 4, 0)"})
        EXPECT_THAT(printed(call), HasSubstr("the sampling time must be a positive number of seconds, but it is 0"))
            << call;
    for (const char* call : {"sine(1, 1/0, 1)", "chirp(1, 2, 1/0, 1)", "multisine({1}, 1/0, 1)"})
        EXPECT_THAT(printed(call), HasSubstr("the duration must be between 0.5 and 1e10 sampling times")) << call;
}

TEST(bad_input, data_are_checked_when_they_are_made) {
    const std::vector<std::pair<std::string, std::string>> kCases = {
        {"iddata(y*(0/0), u, 0.05)", "sample 1 of the output is not a number (NaN)"},
        {"iddata(y, u*(0/0), 0.05)", "sample 1 of the input is not a number (NaN)"},
        {"(function() y[7] = 0/0 return iddata(y, u, 0.05) end)()", "sample 7 of the output is not a number (NaN)"},
        {"(function() u[9] = 1/0 return iddata(y, u, 0.05) end)()", "sample 9 of the input is infinite"},
        {"iddata(1e300*y, u, 0.05)", "too large for sums of squares: use a larger unit"},
        {"iddata(y, 1e-300*u, 0.05)", "too small for sums of squares: use a smaller unit"},
        {"iddata(y, u, 0)", "the sampling time must be a positive number of seconds, but it is 0"},
        {"iddata(y, u, -1)", "the sampling time must be a positive number of seconds, but it is -1"},
        {"iddata(y, u, 0/0)", "the sampling time must be a positive number of seconds, but it is NaN"},
        {"iddata({1, 2, 3}, {1, 0, 1}, nil, {SamplingInstants = {0, 2, 1}})",
         "instant 3 is 1 and the previous instant is 2"},
        {"iddata({1, 2, 3}, {1, 0, 1}, nil, {SamplingInstants = {0, 2, 2}})",
         "instant 3 is 2 and the previous instant is 2"},
        {"iddata({1, 2, 3}, {1, 0, 1}, nil, {SamplingInstants = {0, 2}})", "3 samples, but the time vector has 2"},
        {"iddata({1, 2}, {1}, 1)", "the output has 2 samples, but the input has 1"},
        {"iddata(nil, nil, 1)", "y and u are both nil; specify at least one of them"},
        {"iddata({}, {}, 1)", "must have rows or columns, but the table is empty"},
        {"iddata({theta = y, t = u}, u, 1)", "the table contains t, theta; use one of these entries, such as data.t"},
        {"iddata(y, u, {0, 0.1, 0.3})", "iddata(y, u, nil, {SamplingInstants = t})"},
        {"iddata(y, matrix{u, e}, 0.05, {InputName = {'a', 'a'}})", "the name 'a' is used for two channels"},
        {"iddata(y, u, 0.05, {InputName = 'a', OutputName = 'a'})", "the name 'a' is used for two channels"},
        {"iddata(y, u, 0.05, {InputName = {'a', 'b'}})", "has 2 strings for 1 channel"},
    };
    for (const auto& [code, sentence] : kCases)
        EXPECT_THAT(said("print(" + code + ")"), AllOf(StartsWith("ERROR"), HasSubstr(sentence))) << code;
}

TEST(bad_input, every_method_refuses_data_it_cannot_use) {
    const auto excitation = AnyOf(HasSubstr("excit"), HasSubstr("no dynamics can be estimated"), HasSubstr("no step"),
                                  HasSubstr("does not respond to the step"), HasSubstr("not a step"));
    const auto zero_input = AnyOf(excitation, HasSubstr("is zero in all samples, so its effect cannot be estimated"));
    const std::vector<std::pair<std::string, testing::Matcher<std::string>>> kCases = {
        {"iddata({1, 2, 3}, {1, 0, 1}, 0.1)", AnyOf(HasSubstr("sample"), HasSubstr("not a step"))},
        {"iddata({1}, {1}, 0.1)", AnyOf(HasSubstr("sample"), HasSubstr("never changes"))},
        {"iddata(y, zeros(N), 0.05)", zero_input},
        {"iddata(5 + 0.1*e, 2*ones(N), 0.05)", excitation},
        {"iddata(3*ones(N), u, 0.05)",
         AnyOf(testing::ContainsRegex("output( [a-z0-9]+)? never changes"), HasSubstr("not a step"))},
        {"iddata(y, nil, 0.05)", HasSubstr("input")},
        {"y", HasSubstr("must be an iddata object, but a vector of 504 values was given")},
        {"G", HasSubstr("must be an iddata object, but a model was given")},
    };
    for (const auto& [data, sentence] : kCases)
        for (const auto& [name, calls] : dynamic_methods())
            EXPECT_THAT(said("d = " + data + "\nprint(" + calls.good + ")"), AllOf(StartsWith("ERROR"), sentence))
                << name << " " << data;
}

// Around zero a constant input could be a step to which nothing answers.
TEST(bad_input, a_constant_input_without_a_transient_is_refused) {
    for (const char* call :
         {"srivc(d, {1, 2, 0})", "coe(d, {1, 2, 0})", "tfsrivc(d, 2, 0)", "procsrivc(d, 'P2')",
          "rivc(d, {1, 0, 1, 2, 0})", "tfcoe(d, 2, 0, {InitialState = 'auto', Offset = 'auto'})", "oe(d, {2, 2, 1})",
          "bj(d, {2, 0, 1, 2, 1})", "sriv(d, {2, 2, 1}, {InitialState = 'auto', Offset = 'auto'})"})
        for (const char* seed : {"1", "2", "3"})
            EXPECT_THAT(said(std::string("rng(") + seed + ")\nd = iddata(0.1*randn(400), ones(400), 0.05)\nprint(" +
                             call + ")"),
                        AllOf(StartsWith("ERROR"), HasSubstr("the output shows no transient")))
                << call << seed;
}

TEST(bad_input, wrong_orders_are_refused_with_their_meaning) {
    for (const auto& [name, calls] : dynamic_methods())
        for (const std::string& call : calls.wrong)
            EXPECT_THAT(said("print(" + call + ")"),
                        AllOf(StartsWith("ERROR"), HasSubstr(name + ": "), Not(HasSubstr("least squares:"))))
                << call;
    EXPECT_THAT(said("lssvf(d, {2, 1}, 3)"),
                HasSubstr("{na, nb, nk} (na: poles; nb: coefficients of B; nk: samples of delay)"));
    const auto continuous = HasSubstr("poles; nb: coefficients of B; nk: samples of delay), but nb is 4; with na");
    for (const char* name : {"lssvf", "lsgpmf", "ivsvf", "ivgpmf"})
        EXPECT_THAT(said(std::string(name) + "(d, {2, 4, 0}, 3)"), continuous) << name;
    for (const char* call : {"srivc(d, {4, 2, 0})", "coe(d, {4, 2, 0})", "rivc(d, {4, 0, 1, 2, 0})"})
        EXPECT_THAT(said(call), AllOf(HasSubstr("nf: poles; nk: samples of delay)"),
                                      HasSubstr("but nb is 4; with nf = 2, specify a value between 1 and 3")))
            << call;
    for (const char* call : {"srivc(d, {1, 0, 0})", "coe(d, {1, 0, 0})", "rivc(d, {1, 0, 1, 0, 0})"})
        EXPECT_THAT(said(call), HasSubstr("but nf is 0; specify at least 1")) << call;
}

TEST(bad_input, delays_must_be_shorter_than_the_record) {
    for (const char* call :
         {"lssvf(d, {2, 1, 600}, 3)", "lsgpmf(d, {2, 1, 600}, 3)", "ivsvf(d, {2, 1, 600}, 3)",
          "ivgpmf(d, {2, 1, 600}, 3)", "srivc(d, {1, 2, 600})", "coe(d, {1, 2, 600})", "rivc(d, {1, 0, 1, 2, 600})",
          "arx(d, {2, 2, 600})", "iv4(d, {2, 2, 600})", "armax(d, {2, 2, 1, 600})", "bj(d, {2, 0, 1, 2, 600})",
          "oe(d, {2, 2, 600})", "sriv(d, {2, 2, 600})"})
        EXPECT_THAT(said(call), AllOf(StartsWith("ERROR"), HasSubstr("not shorter than the data"))) << call;
    for (const char* call : {"tfsrivc(d, 2, 0, {TdMax = 30})", "tfrivc(d, 2, 0, {TdMax = 30})",
                             "tfcoe(d, 2, 0, {TdMax = 30})", "procsrivc(d, 'P1D', {TdMax = 30})"})
        EXPECT_THAT(said(call), AllOf(StartsWith("ERROR"), HasSubstr("must be shorter than the data"))) << call;
}

TEST(bad_input, cut_off_frequencies_are_refused_or_doubted) {
    for (const char* name : {"lssvf", "ivsvf", "lsgpmf", "ivgpmf"}) {
        const std::string start = std::string("local M = ") + name + "(d, {2, 1, 0}, ";
        for (const char* lambda : {"0", "-1", "0/0", "1/0"})
            EXPECT_THAT(said(start + lambda + ")"),
                        AllOf(StartsWith("ERROR"), HasSubstr("must be a positive number of rad/s, but is")))
                << name << lambda;
        for (const char* lambda : {"1e-4", "1e5"})
            EXPECT_THAT(said(start + lambda + ")\nprint(M.report.message)"),
                        AllOf(HasSubstr("is far from the estimated poles"),
                              HasSubstr("choose lambda slightly above the bandwidth")))
                << name << lambda;
        EXPECT_THAT(said(start + "3)\nprint(M.report.message)"), Not(HasSubstr("far"))) << name;
    }
    for (const char* name : {"srivc", "coe"})
        EXPECT_THAT(said(std::string(name) + "(d, {1, 2, 0}, {lambda = 0})"),
                    AllOf(StartsWith("ERROR"), HasSubstr("lambda must be a positive number")));
}

TEST(bad_input, unstable_models_are_reported) {
    EXPECT_THAT(said("local M = lssvf(iddata(-lsim(tf({1}, {1, -0.2}), u, 0.05), u, 0.05), {1, 1, 0}, 1)\n"
                     "print(M.report.message)"),
                HasSubstr("The model is unstable. Unless the system is also unstable, srivc with Stable = true"));
    for (const char* call : {"arx(z, {1, 1, 1})", "iv4(z, {1, 1, 1})", "armax(z, {1, 1, 1, 1})", "oe(z, {1, 1, 1})"})
        EXPECT_THAT(said("local z = iddata(-lsim(tf({1}, {1, -0.2}), u, 0.05), u, 0.05)\nlocal M = " +
                         std::string(call) + "\nassert(not stable(M))\nprint(M.report.message)"),
                    HasSubstr("or sriv, which keeps the poles inside the circle"))
            << call;
}

TEST(bad_input, models_of_the_wrong_kind_are_refused) {
    const std::string models =
        "local P = procsrivc(d, 'P1')\nlocal D = arx(d, {2, 2, 1})\n"
        "local M = srivc(iddata(y, matrix{u, e}, 0.05), {{1, 1}, {2, 2}, {0, 0}})\n";
    const std::vector<std::pair<std::string, std::string>> kCases = {
        {"compare(d, M)",
         "the model needs one transfer function from each input to each output of the data (1 input and 1 output)"},
        {"resid(d, M)",
         "the model needs one transfer function from each input to each output of the data (1 input and 1 output)"},
        {"fit_measures(d, M)", "must have one input and one output"},
        {"lsim(M, u, 0.05)", "must have one input and one output"},
        {"compare(iddata(y, u, 0.1), D)", "the sampling time of the discrete-time model is 0.05 s"},
        {"compare(d, tf({1, 0, 0}, {1, 1}))", "a simulation needs a model with at least as many poles as zeros"},
        {"compare(d, 3)", "argument 2 (G) must be a model, but 3 was given"},
        {"compare(d, P, {labels = {'a', 'b'}})", "option 'labels' has 2 strings for 1 model"},
        {"compare(d, P, P, {labels = 'a'})", "option 'labels' has 1 string for 2 models"},
        {"test_your_model(P, d, {labels = {'a', 'b'}})", "option 'labels' has 2 strings for 1 model"},
        {"fit(d, 'a')", "must be a model"},
        {"bode(d)", "must be a model, but an iddata object was given"},
        {"present(d)", "must be a model, but an iddata object was given"},
        {"step_construction(P)", "must be a model returned by step_first_order, step_second_order or step_delayed"},
        {"crossvalidate(d, P)", "must be a function of a data object, but a model was given"},
        {"d2c(P)", "the model is already a continuous-time model"},
        {"forecast(3, 1)", "must be a regression result"},
    };
    for (const auto& [code, sentence] : kCases)
        EXPECT_THAT(said(models + "print(" + code + ")"), AllOf(StartsWith("ERROR"), HasSubstr(sentence))) << code;
}

TEST(bad_input, static_methods_refuse_what_has_no_answer) {
    const std::vector<std::pair<std::string, std::string>> kCases = {
        {"lsq(matrix{u}, {1, 2})", "504 rows, but the right-hand side has 2 values"},
        {"lsq(matrix{u*(0/0)}, y)", "not finite"},
        {"lsq(matrix{{1, 2}}, {1})", "cannot determine 2 parameters"},
        {"gradient_descent(matrix{zeros(3)}, {1, 2, 3})", "gradient_descent: all regressors are zero"},
        {"gradient_descent(matrix{u}, y*(0/0))", "only finite numbers"},
        {"polyfit_report({1, 1, 1}, {1, 2, 3}, 1)", "at least 2 distinct values of x"},
    };
    for (const auto& [code, sentence] : kCases)
        EXPECT_THAT(said("print(" + code + ")"), AllOf(StartsWith("ERROR"), HasSubstr(sentence))) << code;
}

// Why zero and resting inputs are refused: no parameter, or the gain alone, can move the simulated output.
TEST(bad_input, poor_inputs_leave_the_parameters_without_effect) {  // oracle: exact sensitivities
    const Vector num{{2.0}}, den{{1.0, 4.0, 3.0}};
    const Matrix silent = transfer_sensitivities(num, den, 0.02, Vector::Zero(200), 0.05, Hold::kZoh);
    EXPECT_EQ(silent.cwiseAbs().maxCoeff(), 0);

    const ProcessStructure structure = ProcessStructure::parse("P2DU");
    const IdData data(Matrix(Vector::Zero(200)), Matrix(Vector::Constant(200, 3.0)), 1);
    const TransferOutput resting(transfer_structure(structure), {InitialState::kSteady, false}, data, 0, 20,
                                 at_rest(structure));
    Vector output;
    Matrix sensitivities;
    process_output(structure, resting).simulate(Vector{{2.0, 4.0, 0.3, 5.0}}, output, &sensitivities);
    EXPECT_EQ(sensitivities.rightCols(3).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ((output.array() - 6).abs().maxCoeff(), 0);
}

// A step from rest at the first sample is a constant input as well, and is not refused.
TEST(bad_input, a_step_at_the_first_sample_is_no_poor_input) {  // oracle: the simulated system
    for (const char* call : {"srivc(d, {1, 2, 0})", "coe(d, {1, 2, 0})", "procsrivc(d, 'P2')", "lssvf(d, {2, 1, 0}, 3)",
                             "oe(d, {2, 2, 1})", "bj(d, {2, 0, 1, 2, 1})", "sriv(d, {2, 2, 1})"})
        EXPECT_THAT(said("d = iddata(lsim(G, ones(N), 0.05) + 0.01*e, ones(N), 0.05)\nprint(" + std::string(call) +
                         ".report.message)"),
                    Not(HasSubstr("ERROR")))
            << call;
}

}  // namespace test_bad_input
