// Scripts that identify a model from a data file. Oracles: the system that made the data, and the definition of each
// defect in a file.
#include "workflow/identify.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "numerics/error.h"
#include "workflow/make_report.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_identification_script {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Data of 2/(s^2 + 4s + 3) (x, with a delay of 0.33 s in late) and (s + 2)/(s^2 + 0.8s + 4) (theta), in files that
/// state their sampling in different ways.
constexpr const char* kDataSets = R"lua(
local u, Ts = prbs(6, 8), 0.05
local t = linspace(0, (#u - 1)*Ts, #u)
local x, theta = lsim(tf({2}, {1, 4, 3}), u, Ts), lsim(tf({1, 2}, {1, 0.8, 4}), u, Ts)
local late = lsim(tf({2}, {1, 4, 3}, {IODelay = 0.33}), u, Ts)
save_csv("even.csv", {t = t, u = u, x = x, theta = theta, late = late}, {units = {x = "m", theta = "rad"}})
save_csv("stated.csv", {u = u, x = x}, {Ts = Ts})
save_csv("silent.csv", {u = u, x = x})
save_mat("stated.mat", {u = u, x = x, Ts = Ts, short = u:range(1, 5), A = eye(2)})
local instants = cumsum(0.02 + 0.06*rand(800))
local w = sin(0.7*instants) + sin(1.9*instants)
save_csv("headers.csv", {["Time (ms)"] = 1000*t, ["voltage [V]"] = u, x = x
}, {columns = {"Time (ms)", "voltage [V]", "x"}})
save_csv("clock.csv", {clock = t/60, u = u, x = x}, {units = {clock = "min"}})
save_mat("matrix.mat", {y = matrix{theta, x}, u = u, Ts = Ts})
save_csv("uneven.csv", {time = instants, u = w, x = lsim(tf({2}, {1, 4, 3}), w, instants)})
local cut = 1*x
for k = 1, #x do cut[k] = math.min(x[k], 0.2) end
save_csv("cut.csv", {t = t, u = u, x = cut})
local v, z = prbs(8, 4), rbs(1020, 4)
save_csv("two.csv", {valve = v, heat = z, x = lsim(tf({2}, {1, 4, 3}), v, Ts) + lsim(tf({5}, {1, 1, 5}), z, Ts)},
         {Ts = Ts, units = {valve = "V"}})
)lua";

class identification_script : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        files_ = new WorkFolder;
        const auto made = files_->run(kDataSets).record;
        ASSERT_FALSE(made.error) << made.error->text();
        std::istringstream lines(files_->read("stated.csv"));
        std::string holes;
        int number = 0;
        for (std::string line; std::getline(lines, line); holes += line + '\n')
            if (++number > 100 && number % 97 == 0) line.erase(line.rfind(',') + 1);  // the last column is x
        files_->write("holes.csv", holes);
    }
    static void TearDownTestSuite() { delete files_; }

    static IdentifyRequest of(const std::string& file, const std::string& output = "x") {
        IdentifyRequest request;
        request.data = files_->path(file);
        request.inputs = {"u"};
        request.outputs = {output};
        return request;
    }
    static ScriptRun run(const IdentifyRequest& request) {
        ScriptRun made = files_->run(dynlab::identification_script(request));
        EXPECT_FALSE(made.record.error) << made.record.error->text();
        return made;
    }
    static std::string printed(const IdentifyRequest& request) { return run(request).printed; }
    static std::string refusal(const IdentifyRequest& request) {
        return error_of([&] { dynlab::identification_script(request); });
    }

    static WorkFolder* files_;
};
WorkFolder* identification_script::files_ = nullptr;

const auto kSystem = HasSubstr("s^2 + 4 s + 3");

TEST_F(identification_script, finds_the_system_however_a_file_states_its_sampling) {
    for (const char* file : {"even.csv", "stated.csv", "stated.mat", "clock.csv"})
        EXPECT_THAT(printed(of(file)), AllOf(kSystem, HasSubstr("fit to the estimation data: 100.00 %"))) << file;
    IdentifyRequest silent = of("silent.csv");
    silent.Ts = 0.05;
    EXPECT_THAT(printed(silent), kSystem);
    IdentifyRequest named = of("even.csv");
    named.time = "t";
    EXPECT_THAT(printed(named), kSystem);
    IdentifyRequest headers = of("headers.csv");
    for (const char* input : {"voltage", "voltage [V]"}) {
        headers.inputs = {input};
        EXPECT_THAT(printed(headers), kSystem) << input;
    }
    EXPECT_THAT(printed(of("matrix.mat", "y2")), kSystem);
}

TEST_F(identification_script, takes_several_inputs) {
    IdentifyRequest two = of("two.csv");
    two.inputs = {"valve", "heat"};
    const auto [record, text] = run(two);
    EXPECT_THAT(text, AllOf(kSystem, HasSubstr("s^2 + s + 5"), HasSubstr("fit to the estimation data: 100.00 %")));
    EXPECT_EQ(record.values.at("input").text, "valve, heat");
    EXPECT_EQ(record.values.at("input_2").text, "heat");
    EXPECT_TRUE(record.figures.contains("responses_of_2"));
    two.inputs = {"valve", "cold"};
    EXPECT_THAT(refusal(two), HasSubstr("'cold'"));
}

TEST_F(identification_script, fills_missing_samples_and_reports_doubts_about_the_data) {
    EXPECT_THAT(printed(of("holes.csv")), AllOf(HasSubstr("holes.csv: missing numbers were replaced"),
                                                HasSubstr("missing output samples are linearly interpolated"),
                                                HasSubstr("fit to the estimation data: 9")));
    EXPECT_THAT(printed(of("cut.csv")), HasSubstr("! The output x saturates"));  // as advice() marks a warning
}

/// Data of 2/(s^2 + 4s + 3), sampled every `kStep` s. A cell is left out where `keeps_u` or `keeps_y` returns false.
std::string logged(const std::function<bool(int, bool)>& keeps_u, const std::function<bool(int)>& keeps_y,
                   const char* missing = "", bool two_inputs = false) {
    constexpr double kStep = 0.02;
    std::string text = two_inputs ? "t,u,v,x\n" : "t,u,x\n";
    double u = 1, v = -1, x = 0, rate = 0;
    unsigned state = 7;
    for (int i = 0; i < 2000; ++i) {
        bool changes = false, v_changes = false;
        if (i % 40 == 0) {
            state = state * 1103515245u + 12345u;
            const double next = state >> 16 & 1 ? 1 : -1, v_next = state >> 17 & 1 ? 1 : -1;
            changes = next != u || i == 0, v_changes = v_next != v || i == 0;
            u = next, v = v_next;
        }
        const auto cell = [&](bool kept, double value) {
            return kept ? fmt::format("{:.9g}", value) : std::string(missing);
        };
        text += fmt::format("{:.2f},{}", i * kStep, cell(keeps_u(i, changes), u));
        if (two_inputs) text += "," + cell(keeps_u(i, v_changes), v);
        text += "," + cell(keeps_y(i), x) + "\n";
        const double drive = u + (two_inputs ? v : 0);
        for (int k = 0; k < 100; ++k) {  // small Euler steps
            const double h = kStep / 100, slope = 2 * drive - 4 * rate - 3 * x;
            x += h * rate, rate += h * slope;
        }
    }
    return text;
}

// oracle: the system that made the data; linear interpolation between two changes of the input would give another one
TEST_F(identification_script, inputs_with_missing_samples_are_held_and_outputs_interpolated) {
    const auto always = [](int) { return true; };
    const auto on_change = [](int, bool changes) { return changes; };
    const auto a1_of = [&](const std::string& text, std::vector<std::string> inputs = {"u"}) {
        files_->write("logged.csv", text);
        IdentifyRequest request = of("logged.csv");
        request.inputs = std::move(inputs);
        const ScriptRun made = files_->run(dynlab::identification_script(request) +
                                           "\nreport.value(\"a\", (G.channels or {G})[1].den[2])\n");
        EXPECT_FALSE(made.record.error) << made.record.error->text();
        EXPECT_THAT(made.printed, HasSubstr("no value in"));
        return made.record.error ? 0 : made.record.values.at("a").number.value_or(NAN);
    };
    for (const char* missing : {"", "NaN", "NA", "-", "null"})
        EXPECT_NEAR(a1_of(logged(on_change, always, missing)), 4, 0.04) << missing;
    EXPECT_NEAR(a1_of(logged([](int i, bool) { return i % 10 == 0; }, always)), 4, 0.04) << "a tenth of the rate";
    EXPECT_NEAR(a1_of(logged([](int i, bool changes) { return changes || i % 7 == 0; }, always)), 4, 0.04);
    EXPECT_NEAR(a1_of(logged([](int i, bool) { return i % 4 == 0; }, [](int i) { return i % 5 == 0; })), 4, 0.1);
    EXPECT_NEAR(a1_of(logged([](int, bool) { return true; }, [](int i) { return i % 3 != 1; })), 4, 0.05)
        << "output alone";
    EXPECT_NEAR(a1_of(logged(on_change, [](int i) { return i % 3 != 1; })), 4, 0.05);
    EXPECT_NEAR(a1_of(logged(on_change, always, "", true), {"u", "v"}), 4, 0.05) << "two inputs";
    EXPECT_NEAR(a1_of(logged([](int i, bool) { return i % 8 == 0; }, always, "", true), {"u", "v"}), 4, 0.05);
    files_->write("logged.csv", logged(on_change, [](int i) { return i % 50 == 0; }));
    const auto stopped = files_->run(dynlab::identification_script(of("logged.csv"))).record.error;
    ASSERT_TRUE(stopped);
    EXPECT_THAT(stopped->text(), AllOf(HasSubstr("fillmissing"), HasSubstr("previous"), HasSubstr("SamplingInstants")));
}

// oracle: the defect put in
TEST_F(identification_script, doubts_about_the_data_are_printed_and_no_part_of_the_report) {
    ReportRequest request =
        report_of_script(parse_percent_script(dynlab::identification_script(of("cut.csv")), files_->path("cut.lua")),
                         files_->path("cut.md"));
    std::string printed;
    request.print = [&printed](const std::string& text) { printed += text; };
    make_report(request);
    EXPECT_THAT(printed, HasSubstr("The output x saturates"));
    EXPECT_THAT(files_->read("cut.md"), AllOf(HasSubstr("From u to x"), Not(HasSubstr("saturates"))));
}

TEST_F(identification_script, takes_uneven_instants_as_they_are) {
    const std::string script = dynlab::identification_script(of("uneven.csv"));
    EXPECT_THAT(script, HasSubstr("SamplingInstants = record.t"));
    EXPECT_THAT(files_->run(script).printed, HasSubstr("fit to the estimation data: 100.00 %"));
}

TEST_F(identification_script, estimates_a_delay_or_takes_the_given_one) {
    for (const std::optional<double> delay : {std::optional<double>(), std::optional(0.33)}) {
        IdentifyRequest late = of("even.csv", "late");
        late.delay = delay;
        EXPECT_THAT(printed(late), AllOf(HasSubstr("Delay: 0.33 s"), kSystem)) << delay.value_or(-1);
    }
}

TEST_F(identification_script, finds_the_number_of_poles) {
    IdentifyRequest any = of("even.csv", "theta");
    any.poles.reset();
    const auto [record, text] = run(any);
    EXPECT_THAT(text, AllOf(HasSubstr("2 poles"), HasSubstr("s^2 + 0.8 s + 4")));
    EXPECT_EQ(record.values.at("poles").number.value_or(NAN), 2);
    EXPECT_EQ(record.values.at("zeros").number.value_or(NAN), 1);
    IdentifyRequest late = of("even.csv", "late");
    late.poles.reset(), late.delay.reset();
    late.zeros = 0;
    EXPECT_THAT(printed(late), AllOf(HasSubstr("Delay: 0.33 s"), kSystem));
}

TEST_F(identification_script, makes_a_model_of_each_output_and_tries_it_on_other_data) {
    IdentifyRequest both = of("even.csv");
    both.outputs = {"x", "theta"};
    both.zeros = 1;
    both.validation = files_->path("even.csv");
    const auto [record, text] = run(both);
    EXPECT_THAT(text, AllOf(kSystem, HasSubstr("s^2 + 0.8 s + 4"), HasSubstr("fit to the validation data: 100.00 %")));
    EXPECT_EQ(record.values.at("output_1").text, "x");
    EXPECT_EQ(record.values.at("output_2").text, "theta");
}

TEST_F(identification_script, names_cannot_act_as_code) {
    const std::string name = "a\"]] .. os.exit(7) --`{b}$x.csv";
    files_->write(name, files_->read("stated.csv"));
    EXPECT_THAT(printed(of(name)), kSystem);
}

TEST_F(identification_script, a_request_that_a_file_cannot_serve_names_the_columns_of_the_file) {
    IdentifyRequest request = of("even.csv");
    request.outputs = {"x", "teta"};
    EXPECT_THAT(refusal(request),
                AllOf(HasSubstr("'teta'"), HasSubstr("did you mean 'theta'?"), HasSubstr("late, t, theta, u, x")));
    request = of("even.csv");
    request.inputs = {"v"};
    EXPECT_THAT(refusal(request), HasSubstr("'v'"));
    request = of("even.csv");
    request.time = "late";
    EXPECT_THAT(refusal(request), HasSubstr("the time column 'late' must increase, but sample"));
    EXPECT_THAT(refusal(of("silent.csv")), HasSubstr("silent.csv"));
    EXPECT_THAT(refusal(of("stated.mat", "short")), AllOf(HasSubstr("'short' has 5"), HasSubstr("'u' has")));
    EXPECT_THAT(refusal(of("matrix.mat", "y3")), HasSubstr("u, y1, y2"));
    request = of("stated.mat");
    request.inputs = {"A"};
    EXPECT_THAT(refusal(request), HasSubstr("'A'"));
    request = of("even.csv", "theta");
    request.validation = files_->path("stated.mat");
    EXPECT_THAT(refusal(request), HasSubstr("stated.mat has no numeric column 'theta'"));
    request.validation = files_->path("none.csv");
    EXPECT_THAT(refusal(request), HasSubstr("none.csv"));
    EXPECT_THAT(refusal(of("nowhere.csv")), HasSubstr("nowhere.csv"));
    request = of("");
    request.data = "crane";
    request.outputs = {"y"};
    EXPECT_THAT(refusal(request),
                AllOf(HasSubstr("'u'"), HasSubstr("estimation.t, estimation.theta, estimation.u, estimation.x")));
    request = of("even.csv");
    request.delay = 1e6;
    const auto stopped = files_->run(dynlab::identification_script(request)).record.error;
    ASSERT_TRUE(stopped);
    EXPECT_THAT(stopped->text(), HasSubstr("delay"));
}

TEST(identify_request, of_orders_delay_or_names_that_make_no_sense_is_refused) {
    const auto refused = [](const std::function<void(IdentifyRequest&)>& change, const std::string& words) {
        IdentifyRequest request;
        request.data = "d.csv";
        request.inputs = {"u"}, request.outputs = {"x"};
        EXPECT_EQ(error_of([&] { request.validate(); }), "");
        change(request);
        EXPECT_THROW(request.validate(), InvalidArgument) << words;
        EXPECT_THAT(error_of([&] { request.validate(); }), HasSubstr(words));
    };
    refused([](auto& r) { r.outputs.clear(); }, "at least one output");
    refused([](auto& r) { r.inputs.clear(); }, "at least one input");
    refused([](auto& r) { r.inputs = {"u", "v", "u"}; }, "the input 'u' is given twice");
    refused([](auto& r) { r.outputs = {"x", "x"}; }, "the output 'x' is given twice");
    refused([](auto& r) { r.outputs = {"u"}; }, "cannot be both input and output");
    refused([](auto& r) { r.poles = 0; }, "at least 1, not 0");
    refused([](auto& r) { r.zeros = 3; }, "from 0 to the number of poles, 2, but it is 3");
    refused([](auto& r) { r.zeros = -1; }, "is -1");
    refused([](auto& r) { r.delay = -1; }, "must be nonnegative, but it is -1 s");
    refused([](auto& r) { r.delay = NAN; }, "the delay must be nonnegative");
    refused([](auto& r) { r.Ts = 0; }, "Ts must be positive");
    refused([](auto& r) { r.Ts = 1, r.time = "t"; }, "give either --Ts or --time, not both");
    refused([](auto& r) { r.poles.reset(), r.delay = 0.3; },
            "requires --delay 0 or --delay auto, but the delay is 0.3 s");
    refused([](auto& r) { r.poles.reset(), r.zeros = 4; }, "the number of zeros must be at most 3, but it is 4");
    refused([](auto& r) { r.poles.reset(), r.zeros = -1; }, "but it is -1");
    refused(
        [](auto& r) {
            r.poles.reset(), r.inputs = {"u", "v"};
        },
        "--poles auto supports only one input, but 2 inputs were given; specify the number of poles");
}

}  // namespace test_identification_script
}  // namespace dynlab::test
