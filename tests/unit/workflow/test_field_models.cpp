// Models of data as measured at the first attempt, and the messages about them. Oracle: the systems that simulated the
// data (tests/reference/data/field); for two_modes, the smallest loss of 10 random starts by scipy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "workflow/identify.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_field_models {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class field_models : public testing::Test {
  protected:
    /// Runs `code` after `data`, of columns of the file, whose time is t where its sampling time is wanted.
    void model(const std::string& file, const std::string& columns, const std::string& code) {
        const std::string time = columns.find("d.Ts") == std::string::npos ? "" : ", {time = 't'}";
        run_ = work_.run("local d = load('" + std::string(DYNLAB_SOURCE_DIR "/tests/reference/data/field/") + file +
                         ".csv'" + time + ")\nlocal data = iddata(" + columns + ")\n" + code);
        EXPECT_FALSE(run_.record.error) << run_.record.error->text();
    }
    double value(const std::string& name) const {
        const auto found = run_.record.values.find(name);
        return found == run_.record.values.end() ? NAN : found->second.number.value_or(NAN);
    }
    const std::string& printed() const { return run_.printed; }

    WorkFolder work_;
    ScriptRun run_;
};

TEST_F(field_models, step_before_the_record_leaves_the_gain_open) {
    model("valve", "d.temp, d.valve, d.Ts", R"lua(
for name, G in pairs{process = procsrivc(data, "P1D"), transfer = tfsrivc(data, 1, 0)} do
  report.value(name, -1/pole(G).re[1])
  for i = 1, #G.param do print(name, i, G.std[i] < 1e6) end
  print(G.report.message)
end)lua");
    EXPECT_NEAR(value("process"), 25, 0.5);
    EXPECT_NEAR(value("transfer"), 25, 0.5);
    EXPECT_THAT(printed(), AllOf(HasSubstr("process\t1\tfalse"), HasSubstr("process\t2\ttrue"),
                                 HasSubstr("transfer\t2\tfalse"), HasSubstr("The input never changes. The gain")));
}

TEST_F(field_models, unstable_plant_in_a_loop_is_no_drift) {
    model("loop", "d.y, d.u, d.Ts, {Reference = d.r}", R"lua(
for _, finding in ipairs(advice(iddata(d.y, d.u, d.Ts))) do print("code " .. finding.code) end
local G = clsrivc(data, {1, 1, 0})
report.value("a1", G.den[2]) report.value("b0", G.num[1]))lua");
    EXPECT_NEAR(value("a1"), -0.8, 0.02);
    EXPECT_NEAR(value("b0"), 1.5, 0.02);
    EXPECT_THAT(printed(), HasSubstr("code feedback"));
    for (const char* wrong : {"random_walk", "drift", "nonlinear", "noise", "low_snr"})
        EXPECT_THAT(printed(), Not(HasSubstr("code " + std::string(wrong))));
}

TEST_F(field_models, input_that_rests_is_named) {
    model("two_heaters", "d.T1, matrix{d.Q1, d.Q2}, d.Ts, {InputName = {'Q1', 'Q2'}}", R"lua(
print(select(2, pcall(tfsrivc, data, 1, 0)))
local G = tfsrivc(data:select({1}, {1}), 1, 0, {TdMax = 0})
report.value("gain", dcgain(G)) report.value("T", 1/G.den[2]))lua");
    EXPECT_THAT(printed(), HasSubstr("the input Q2 never changes"));
    EXPECT_NEAR(value("gain"), 0.6, 0.005);
    EXPECT_NEAR(value("T"), 135, 1);
}

TEST_F(field_models, input_logged_late_is_shifted) {
    model("late", "d.y, d.u, d.Ts", R"lua(
for _, finding in ipairs(advice(data)) do print("code " .. finding.code) end
print("fit: " .. tfsrivc(data, 2, 0).report.message)
delayest(data)
local G = tfsrivc(data:shift(-1), 2, 0)
report.value("a1", G.den[2]) report.value("a2", G.den[3]))lua");
    EXPECT_THAT(printed(), AllOf(HasSubstr("code late_input"), Not(HasSubstr("code running_start"))));
    EXPECT_THAT(printed(), testing::ContainsRegex("fit: [^\n]*With the input shifted by one sample [^\n]*logged late"));
    EXPECT_THAT(printed(), testing::ContainsRegex("The delay is [^\n]*logged late"));
    EXPECT_NEAR(value("a1"), 6, 0.1);
    EXPECT_NEAR(value("a2"), 30, 0.3);
}

TEST_F(field_models, equations_about_an_operating_point_say_so) {
    model("heater", "d.T, d.Q, d.Ts", R"lua(
for _, method in ipairs{arx, iv4} do print(method(data, {2, 2, 1}).report.message) end
local G = sriv(data, {2, 2, 1})
report.value("gain", dcgain(G)))lua");
    EXPECT_THAT(printed(), testing::ContainsRegex("With an offset of 23[^\n]* sriv or oe[^\n]*\n[^\n]*With an offset"));
    EXPECT_NEAR(value("gain"), 0.6, 0.005);
}

TEST_F(field_models, input_that_moves_between_the_samples_is_no_feedthrough) {
    IdentifyRequest request;
    request.data = DYNLAB_SOURCE_DIR "/tests/reference/data/field/vel_pos.csv";
    request.inputs = {"velocity"}, request.outputs = {"position"};
    request.poles = 1;
    for (const bool moving : {false, true}) {
        request.moving_input = moving;
        run_ = work_.run(identification_script(request) + "\nreport.value('b0', G.num[1])\n");
        ASSERT_FALSE(run_.record.error) << run_.record.error->text();
        EXPECT_NEAR(value("b0"), 1, 0.001);
        EXPECT_THAT(printed(), Not(HasSubstr("direct feedthrough")));
        EXPECT_EQ(printed().find("InterSample = \"foh\"") == std::string::npos, moving) << printed();
    }
}

TEST_F(field_models, fewer_poles_than_modes_find_the_better_mode) {
    model("two_modes", "d.y, d.u, 0.08", R"lua(
local process = procsrivc(data, "P2U").report
report.value("procsrivc", process.loss) report.value("srivc", srivc(data, {1, 2, 0}).report.loss)
report.value("delayed", tfsrivc(data, 2, 0).report.loss)
local four = tfsrivc(data, 4, 0, {TdMax = 0}).report
report.value("four", four.loss)
print(four.message))lua");
    for (const char* two : {"procsrivc", "srivc", "delayed"}) EXPECT_LT(value(two), 2.1411) << two;
    EXPECT_LT(value("four"), 2.1374);
    EXPECT_THAT(printed(), Not(HasSubstr("loss -")));
}

TEST_F(field_models, zero_and_delay_within_a_sample_have_no_errors) {
    model("p1dz", "d.y, d.u, 0.05", R"lua(
local G = procsrivc(data, "P1DZ")
for i, name in ipairs{"Kp", "Tp1", "Tz", "Td"} do report.value(name, G.param[i]) print(name, G.std[i] < 1e6) end
report.value("error", G.std[1]))lua");
    EXPECT_NEAR(value("Kp"), 1.7, 3 * value("error"));
    EXPECT_THAT(printed(), AllOf(HasSubstr("Kp\ttrue"), HasSubstr("Tz\tfalse"), HasSubstr("Td\tfalse")));
}

TEST_F(field_models, drift_is_called_a_drift) {
    model("drift", "d.y, d.u, 0.1", R"lua(
for _, options in ipairs{{}, {Stable = true}, {Offset = "estimate"}} do print(tfsrivc(data, 2, 0, options).report.message) end
local G = tfsrivc(detrend(data), 2, 0)
report.value("a1", G.den[2]) report.value("a2", G.den[3]))lua");
    EXPECT_THAT(printed(), AllOf(testing::ContainsRegex("the output drifts[^\n]*\n[^\n]*the output drifts[^\n]*\n"),
                                 Not(HasSubstr("feedthrough"))));
    EXPECT_NEAR(value("a1"), 1.4, 0.05);
    EXPECT_NEAR(value("a2"), 2, 0.05);
}

// Oracle: van der Pol's law, solved by Runge and Kutta's method in steps of 2 ms.
TEST_F(field_models, equations_that_do_not_reproduce_the_record_say_so) {
    run_ = work_.run(R"lua(
local N, Ts, n = 1000, 0.02, 10
local x, v = zeros(N), zeros(N)
x[1] = 1
local function f(x, v) return v, (1 - x^2)*v - x end
for k = 1, N - 1 do
  local a, b, h = x[k], v[k], Ts/n
  for _ = 1, n do
    local p1, q1 = f(a, b)
    local p2, q2 = f(a + h/2*p1, b + h/2*q1)
    local p3, q3 = f(a + h/2*p2, b + h/2*q2)
    local p4, q4 = f(a + h*p3, b + h*q3)
    a, b = a + h/6*(p1 + 2*p2 + 2*p3 + p4), b + h/6*(q1 + 2*q2 + 2*q3 + q4)
  end
  x[k + 1], v[k + 1] = a, b
end
local data = iddata(matrix{x, v}, nil, Ts, {OutputName = {"x", "v"}})
for _, degree in ipairs{2, 3} do
  local model = sindy(data, {degree = degree})
  print(degree, #model.report.warnings, model)
end)lua");
    ASSERT_FALSE(run_.record.error) << run_.record.error->text();
    EXPECT_THAT(printed(), testing::ContainsRegex("2\t1\tdx/dt(.|\n)*do not reproduce the data(.|\n)*3\t0\tdx/dt"));
    EXPECT_THAT(printed(), HasSubstr("dv/dt = -1*x + 1*v - 1*x^2*v"));
}

}  // namespace test_field_models
}  // namespace dynlab::test
