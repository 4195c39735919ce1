// Models learned from data and intervals, as scripts use them. Oracles: the equations that the scripts simulate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace dynlab::test {
namespace test_script_learning {

using testing::HasSubstr;

/// y, u of a polynomial difference equation, and data.
const std::string kNarxData = R"(rng(1)
local u = 2*rand(300) - 1
local y = zeros(300)
for k = 3, 300 do y[k] = 0.5*y[k-1] + 0.8*u[k-2] + u[k-1]^2 - 0.05*y[k-2]^2 end
local data = iddata(y, u, 1)
)";

/// Prey and predators, and data without inputs.
const std::string kSindyData = R"(local N, Ts = 400, 0.05
local p, q = zeros(N), zeros(N)
local x, y = 10, 5
for k = 1, N do
  p[k], q[k] = x, y
  for i = 1, 50 do
    local h = Ts/50
    local fx, fy = 1.1*x - 0.4*x*y, 0.1*x*y - 0.4*y
    local mx, my = x + h/2*fx, y + h/2*fy
    x, y = x + h*(1.1*mx - 0.4*mx*my), y + h*(0.1*mx*my - 0.4*my)
  end
end
local data = iddata(matrix{p, q}, nil, Ts, {OutputName = {"prey", "hunters"}})
)";

TEST(script_learning, narx_is_evaluated_by_its_free_run) {
    EXPECT_EQ(printed(kNarxData + R"(
local G = narx(data, {2, 2, 1})
print(#G.names, fit(data, G) > 99.999, #G.param == #G.std)
print(G.report.prediction_fit_percent > 99.999, #G.report.bic >= 5)
compare(data, G, arx(data, {2, 2, 1}))
print(fit_measures(data, G).fit_percent > 99.999)
local z = lsim(G, u, 1, {x0 = {y[1], y[2]}})
print(max(abs(z - y)) < 1e-6)
print(tostring(G):match("y1%(k%) =") ~= nil)
)"),
              "4\ttrue\ttrue\ntrue\ttrue\ntrue\ntrue\ntrue\n");
}

TEST(script_learning, sindy_takes_degrees_and_libraries) {
    EXPECT_EQ(printed(kSindyData + R"(
local G = sindy(data)
print(G)
local H = sindy(data, {weak = true, names = {"x", "y", "xy"}, library = function(x, u)
  return {x.prey, x.hunters, x[1]*x[2]}
end})
print(#H.names, H.names[1])
local a, b = fit(data, H)
print(a > 99, b > 99)
local z = lsim(H, zeros(10), Ts, {x0 = {10, 5}})
print(math.abs(z[{10, 1}] - p[10]) < 0.01)
)"),
              "dprey/dt = 1.1*prey - 0.4*prey*hunters\ndhunters/dt = -0.4*hunters + 0.1*prey*hunters\n"
              "4\tprey: x\ntrue\ttrue\ntrue\n");
}

TEST(script_learning, dmdc_is_a_state_space_model) {
    EXPECT_EQ(printed(R"(
local u = prbs(7, 3)
local y = lsim(tf({2}, {1, 1, 3}), u, 0.2)
local data = iddata(y, u, 0.2)
local G = dmdc(data, {delays = 2})
print(G.B.rows, fit(data, G) > 99, dcgain(G) - 2/3 < 1e-3)
print(#lsim(ss(G), u, 0.2) == #u)
)"),
              "3\ttrue\ttrue\ntrue\n");
}

TEST(script_learning, a_lost_run_is_reported) {
    const std::string lost = R"(
local u = randn(60)
local y = zeros(60)
for k = 2, 60 do y[k] = (k < 10 and 1.9 or 0.1)*y[k-1] + u[k-1] end
local G = narx(iddata(y:range(1, 9), u:range(1, 9), 0.1), {1, 1, 1}, {degree = 1, terms = 2})
)";
    EXPECT_THAT(printed(lost + "print(fit(iddata(y, u, 0.1), G))"), HasSubstr("diverges at t ="));
    EXPECT_THAT(printed(lost + "lsim(G, ones(100), 0.1)"), HasSubstr("diverges at t ="));
    EXPECT_THAT(printed(lost + "local m = fit_measures(iddata(y, u, 0.1), G) print(m.fit_percent, m.rmse, m.yic)"),
                HasSubstr("-Inf\tInf\tnil"));
}

TEST(script_learning, bad_input_is_refused_in_words) {
    const auto expect = [](const std::string& code, const std::string& words) {
        EXPECT_THAT(printed(code), HasSubstr(words)) << code;
    };
    expect(kNarxData + "narx(data, {2, 2})", "but the list has 2 entries");
    expect(kNarxData + "narx(data, {2, 2, 1}, {terms = 40})", "the lags and the degree allow only 15 candidates");
    expect(kSindyData + "sindy(data, {library = 3})", "'library' must be a function(x, u)");
    expect(kSindyData + "sindy(data, {library = function(x) return 3 end})", "must return a list of vectors");
    expect(kSindyData + "sindy(data, {library = function(x) return {x[1], vector{1, 2}} end})",
           "function 2 of the library returned 2 values for 400 samples");
    expect(kSindyData + "sindy(data, {library = function(x) return {x[1], 'a'} end})",
           "must return a vector or a number");
    expect(kSindyData + "sindy(data, {library = function(x) return {1/(x[1] - x[1][1])} end})",
           "returned Inf at sample 1");
    expect(kSindyData + "sindy(data, {library = function(x) return {x[1]} end, names = {'a', 'b'}})",
           "'names' has 2 strings, but the library returns 1 function");
    expect(kSindyData + "sindy(data, {library = function(x) return {x[1]} end, degree = 2})", "cannot be combined");
    expect(kSindyData + "sindy(data, {library = function(x) error('own') end})", "own");
    expect(kSindyData + "local G = sindy(data) bode(G)", "must be a linear model, but this model from sindy is not");
    expect(kSindyData + "bode(tf({1}, {1, 1}), sindy(data))", "must be a linear model");
    expect(kSindyData + "sindy(data, {library = function(x) return {x.prey, x.foxes} end})",
           "x has no state foxes; the states are prey, hunters");
    expect(kSindyData + "sindy(data, {library = function(x, u) return {x[1], u[1]} end})",
           "u has no input 1; it has no inputs");
    expect(kSindyData + "sindy(data, {library = function(x) return x[1], x[2] end})", "must return one list");
    expect(kNarxData + "narx(data[{1, 30}], {3, 3, 1}, {degree = 3})",
           "27 samples have all required past values, which is too few for 84 candidate terms. Use at least 58 "
           "more samples, or set degree = 1 or {na, nb, nk} = {1, 1, 1}");
    expect(kNarxData + "dmdc(data, {rank = 5})", "rank is 5, but a snapshot has only 1");
}

TEST(script_learning, intervals_of_an_estimate) {
    const std::string data_set = R"(rng(1)
local u = prbs(5, 4)
local y = lsim(tf({2}, {1, 1.5}, {IODelay = 0.33}), u, 0.1) + 0.2*randn(#u)
local data = iddata(y, u, 0.1)
local G = procsrivc(data, "P1D", {InitialState = "zero", Offset = "none"})
)";
    EXPECT_THAT(printed(data_set + R"(
local fig, B = bootstrap(G, data, {runs = 40})
print(#B.names, B.low[3] < 0.33, B.high[3] > 0.33)
local fig, P = profile(G, data, "Td", {points = 7})
print(P.low < 0.33, P.high > 0.33)
)"),
                testing::AllOf(HasSubstr("3\ttrue\ttrue\n"), HasSubstr("\ntrue\ttrue\n")));
    EXPECT_THAT(printed(data_set + "profile(G, data, 'a1')"), HasSubstr("its parameters are Kp, Tp1, Td"));
    EXPECT_THAT(printed(data_set + "bootstrap(lssvf(data, {1, 1, 3}, 2), data)"),
                HasSubstr("this model, estimated by lssvf, is not suitable"));
    EXPECT_THAT(printed(data_set + "bootstrap(tf({1}, {1, 1}), data)"),
                testing::AllOf(HasSubstr("specified, not estimated"),
                               HasSubstr("with procsrivc, tfsrivc, tfrivc, srivc, rivc, coe or tfcoe, without")));
}

TEST(script_learning, impulseest_takes_lags_and_a_kernel) {
    EXPECT_EQ(printed(R"(
local u = prbs(6, 3)
local y = lsim(tf({2}, {1, 1.5}), u, 0.2) + 0.01*randn(#u)
local data = iddata(y, u, 0.2)
for _, kernel in ipairs{"TC", "DC", "SS"} do
  local fig, H = impulseest(data, 20, {Kernel = kernel})
  print(#H.t, H.decay > 0 and H.decay < 1, H.scale > 0)
end
)")
                      .size() > 100,
              true);
    EXPECT_THAT(printed("impulseest(iddata(randn(50), randn(50), 1), 30)"),
                HasSubstr("30 lags need at least 90 samples"));
    EXPECT_THAT(printed("impulseest(iddata(randn(50), randn(50), 1), {Kernel = 'AB'})"), HasSubstr("Kernel"));
}

}  // namespace test_script_learning
}  // namespace dynlab::test
