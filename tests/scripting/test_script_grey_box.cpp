// Grey-box models as scripts write them. Oracles: values by hand, coe, the numbers that a simulation was made with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "script_run.h"

namespace dynlab::test {
namespace test_script_grey_box {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Data of 2/(s^2 + 0.8 s + 3) with noise, and a model of it.
const std::string kDataSet = R"(
rng(1)
local u = prbs(5, 8)
local data = iddata(lsim(tf({2}, {1, 0.8, 3}), u, 0.1) + 0.1*randn(#u), u, 0.1)
local names = {a1 = {1, min = 0}, a2 = 2, b = 1}
local function f(t, x, u, p) return {x[2], p.b*u - p.a2*x[1] - p.a1*x[2]} end
)";

TEST(script_grey_box, of_a_linear_model_is_coe_in_every_form) {  // oracle: coe
    const std::string text = printed(kDataSet + R"(
local wanted = coe(data, {1, 2, 0}, {Tol = 1e-10, InitialState = "zero", Offset = "none"})
local function says(m)
    local G = greyest(data, m, {Tol = 1e-10, RelTol = 1e-11})
    print(max(abs(G.param - wanted.param)) < 1e-6, max(abs(G.std - wanted.std)) < 1e-6,
          abs(fit(data, G) - fit(data, wanted, {InitialState = "zero", Offset = "none"})) < 1e-6)
    return G
end
local G = says(idgrey(f, names, {states = 2}))
says(idgrey(function(p) return {{0, 1}, {-p.a2, -p.a1}}, {{0}, {p.b}}, {{1, 0}} end, names, {states = 2}))
says(idgrey(function(t, x, u, p) return {x.v, p.b*u[1] - p.a2*x.y - p.a1*x.v} end, names, {states = {"y", "v"}}))
print(G.param.a1 == G.param[1], G.a2 == G.param[2], G.std.b == G.std[3], #G.param)
)");
    EXPECT_EQ(text, "true\ttrue\ttrue\ntrue\ttrue\ttrue\ntrue\ttrue\ttrue\ntrue\ttrue\ttrue\t3\n");
}

TEST(script_grey_box, of_state_space_form_is_a_linear_model) {  // oracle: gain b/a2 and poles of the estimate
    const std::string text = printed(kDataSet + R"(
local G = greyest(data, idgrey(function(p) return {{0, 1}, {-p.a2, -p.a1}}, {{0}, {p.b}}, {{1, 0}} end, names, {states = 2}))
print(abs(dcgain(G) - G.b/G.a2) < 1e-12, abs(damp(G)[1] - G.a2^0.5) < 1e-12, #lsim(G, u, 0.1) == #u)
)");
    EXPECT_EQ(text, "true\ttrue\ttrue\n");
    EXPECT_THAT(error_of(kDataSet + R"(
local G = greyest(data, idgrey(function(t, x, u, p) return {x[2], p.b*u - p.a2*sin(x[1]) - p.a1*x[2]} end, names, {states = 2}))
bode(G))"),
                HasSubstr("must be a linear model, but this grey-box model is not linear"));
}

TEST(script_grey_box, of_functions_that_cannot_be_followed_is_the_same) {  // oracle: the followed one
    const std::string text = printed(kDataSet + R"(
local traced = greyest(data, idgrey(f, names, {states = 2}))
local m = idgrey(function(t, x, u, p)
    if x[1] > 0 then return {x[2], p.b*u - p.a2*x[1] - p.a1*x[2]} end
    return {x[2], p.b*u - p.a2*x[1] - p.a1*x[2]}
end, names, {states = 2})
local called = greyest(data, m)
print(max(abs(called.param - traced.param)) < 1e-5, max(abs(called.std - traced.std)) < 1e-5)
)");
    EXPECT_THAT(text, HasSubstr("about a hundred times as long"));
    EXPECT_THAT(text, HasSubstr("where(c, a, b), which returns a if c > 0"));
    EXPECT_THAT(text, HasSubstr("true\ttrue\n"));
    for (const std::string name : {"sin", "cos", "tan", "atan", "exp", "log", "sqrt", "abs"}) {
        EXPECT_THAT(printed(kDataSet + "local m = idgrey(function(t, x, u, p) return {x[2], p.b*u - p.a2*math." + name +
                            "(x[1]) - p.a1*x[2]} end, names, {states = 2})"),
                    HasSubstr("math." + name + " accepts only numbers, so write " + name + "(...)"));
    }
    // A decision that Lua makes in silence: == of two kinds of values is false.
    EXPECT_THAT(printed(kDataSet + R"(
local m = idgrey(function(t, x, u, p)
    if u == 0 then return {x[2], 0} end
    return {x[2], p.b*u - p.a2*x[1] - p.a1*x[2]}
end, names, {states = 2})
)"),
                HasSubstr("the function returns different results when it is called again"));
}

TEST(script_grey_box, follows_all_functions) {  // oracle: the same functions of numbers
    const std::string text = printed(R"(
local function f(t, x, u, p)
    return {sin(x[1]) + cos(x[2])*tan(p.k) - tanh(u)*exp(-x[1]^2) + log(p.k + 2)/sqrt(p.k) + atan(t),
            abs(x[1]) - sign(x[2]) + max(x[1], p.k) - min(x[2], 0.3) + where(x[1] - 0.2, x[2], -x[2]) + where(gt(x[1], 0.1), 2, x[1]) - where(ge(0.1, x[2]), 1, x[2]) + where(le(x[1], 0.3), x[2], 5) + where(lt(x[2], 0.1), x[1], 7)}
end
print(idgrey(f, {k = 0.7}, {states = 2, x0 = {0.25, -0.4}}))
)");
    EXPECT_THAT(text,
                AllOf(HasSubstr("grey-box model with 2 states (x1, x2), 1 input"), Not(HasSubstr("each evaluation"))));
}

TEST(script_grey_box, starts_from_parameters_and_estimates) {  // oracle: the decay that was made
    const std::string text = printed(R"(
rng(2)
local t = range(0, 0.1, 5)
local data = iddata(3*exp(-0.7*t) + 0.001*randn(#t), zeros(#t), 0.1)
local function decay(t, x, u, p) return {-p.r*x[1]} end
local by_name = greyest(data, idgrey(decay, {r = 1, h = {1, min = 0}}, {states = 1, x0 = {"h"}}))
local by_function = greyest(data, idgrey(decay, {r = 1, h = 1}, {states = 1, x0 = function(p) return {p.h} end}))
local estimated = greyest(data, idgrey(decay, {r = 1}, {states = 1, x0 = "estimate"}))
local all = greyest(data, idgrey(decay, {r = 1}, {states = 1}), {InitialState = "estimate"})
print(abs(by_name.h - 3) < 0.01, abs(by_name.h - by_function.h) < 1e-6, abs(estimated.x0[1] - by_name.h) < 1e-6,
      abs(all.r - by_name.r) < 1e-6, abs(by_name.r - 0.7) < 0.01)
print(by_name)
)");
    EXPECT_THAT(text, HasSubstr("true\ttrue\ttrue\ttrue\ttrue\n"));
    EXPECT_THAT(text, HasSubstr("95 %:"));
}

TEST(script_grey_box, is_compared_presented_and_tested) {  // oracle: definition
    const std::string text = printed(kDataSet + R"(
local G = greyest(data, idgrey(f, names, {states = 2}))
present(G)
local _, tests = resid(data, G, {quiet = true})
print(tests.white, compare(data, G) ~= nil, #G.report.outputs[1] == #u, G.report.converged)
)");
    EXPECT_THAT(text, AllOf(HasSubstr("grey-box model (states: x1, x2)"),
                            HasSubstr("The grey-box search converged after"), HasSubstr("true\ttrue\ttrue\ttrue\n")));
}

TEST(script_grey_box, refuses_in_words) {  // oracle: the mistakes written here
    const auto refusal = [](const std::string& call) { return error_of(kDataSet + call); };
    EXPECT_THAT(refusal("idgrey(function(t, x, u, p) return {x[1]} end, names, {states = 2})"),
                HasSubstr("f must return one derivative per state (2 states: x1, x2), but it returned 1 value"));
    EXPECT_THAT(refusal("idgrey(function(t, x, u, p) return {x[1], 'a'} end, names, {states = 2})"),
                HasSubstr("its element 2 is the string \"a\""));
    EXPECT_THAT(refusal("idgrey(function(t, x, u, p) return {x[1], p.a3} end, names, {states = 2})"),
                HasSubstr("p has no parameter a3; the parameters are a1, a2, b"));
    EXPECT_THAT(refusal("idgrey(function(t, x, u, p) return {x.v, x.q} end, names, {states = {'y', 'v'}})"),
                HasSubstr("x has no state q; the states are y, v"));
    EXPECT_THAT(refusal("idgrey(f, {a1 = {1, mn = 0}}, {states = 2})"), HasSubstr("'mn' is not one of these fields"));
    EXPECT_THAT(refusal("idgrey(f, {a1 = {3, max = 2}, a2 = 1, b = 1}, {states = 2})"),
                HasSubstr("initial value of the parameter a1 is 3, which is outside the bounds -Inf and 2"));
    EXPECT_THAT(refusal("idgrey(function(t, x, u, p) return {p.a1*x[1] + u}, {x[1]} end, {a1 = 1}, {states = 1})"),
                HasSubstr("must return only the derivatives, in one table"));
    EXPECT_THAT(refusal("idgrey(f, names, {states = 2, outputs = function(t, x, u, p) return x[1], x[2] end})"),
                HasSubstr("must return the outputs in one table"));
    EXPECT_THAT(refusal("idgrey(f, names, {states = 2, x0 = function(p) return 1, 2 end})"),
                HasSubstr("must return the initial states in one table"));
    EXPECT_THAT(refusal("idgrey(f, names)"), HasSubstr("option 'states'"));
    EXPECT_THAT(refusal("idgrey(f, names, {states = 2, x0 = {1}})"),
                AllOf(HasSubstr("a table of 2 values"), HasSubstr("but a table of 1 value was given")));
    EXPECT_THAT(refusal("idgrey(f, names, {states = 2, x0 = {'q', 0}})"), HasSubstr("the parameters are a1, a2, b"));
    EXPECT_THAT(
        refusal(
            "greyest(data, idgrey(f, names, {states = 2, outputs = function(t, x, u, p) return {x[1], x[2]} end}))"),
        HasSubstr("greyest: the model returns 2 outputs, but the data have 1"));
    EXPECT_THAT(
        refusal("greyest(data, idgrey(function(t, x, u, p) return {p.a1*x[1]^3 + u[2]} end, {a1 = 1}, {states = 1}))"),
        HasSubstr("greyest: the model has 2 inputs, but the data have 1"));
    EXPECT_THAT(
        refusal(
            "greyest(data, idgrey(function(t, x, u, p) return {p.a1*x[1]^3 + u} end, {a1 = 50}, {states = {'h'}}))"),
        HasSubstr("the state h becomes infinite"));
    EXPECT_THAT(refusal("greyest(data, idgrey(function(t, x, u, p) return {-p.a1*sqrt(x[1]) - 1} end, {a1 = 1}, "
                        "{states = {'h'}, x0 = {1}}))"),
                HasSubstr("the derivative of the state h is NaN for h = -"));
    EXPECT_THAT(refusal("greyest(data, idgrey(function(t, x, u, p) return {-p.a1/p.b*x[1] + u} end, "
                        "{a1 = 1, b = {0, fixed = true}}, {states = {'h'}}))"),
                HasSubstr("a coefficient in the derivative of the state h is not a finite number"));
    EXPECT_THAT(refusal("greyest(data, idgrey(f, names, {states = 2}), {RelTol = 2})"),
                HasSubstr("option 'RelTol' must be between 1e-13 and 0.01, but 2 was given"));
    EXPECT_THAT(refusal("greyest(data, idgrey(function(t, x, u, p) return {p.a1*sqrt(x[1] - 1) + u} end, {a1 = 1}, "
                        "{states = {'h'}}))"),
                HasSubstr("sqrt: the function is undefined for the negative number -1"));
}

}  // namespace test_script_grey_box
}  // namespace dynlab::test
