// Data as loggers, spreadsheets and instruments write them, read at the first attempt. Oracle: the plants that
// simulated them. Their sources: tests/reference/data/field; families: tests/unit/data_io.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "workflow/data_summary.h"
#include "workflow/identify.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_field_records {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kFolder = DYNLAB_SOURCE_DIR "/tests/reference/data/field/";

class field_records : public testing::Test {
  protected:
    static IdentifyRequest of(const std::string& file, const std::string& input, const std::string& output,
                              const std::string& time = "") {
        IdentifyRequest request;
        request.data = kFolder + file;
        request.inputs = {input}, request.outputs = {output};
        request.poles = 1;
        request.time = time;
        return request;
    }
    /// The time constant of the one pole that `dynlab identify` finds.
    double time_constant(const IdentifyRequest& request) {
        const ScriptRun run = work_.run(identification_script(request) + "\nreport.value(\"T\", 1/G.den[2])\n");
        EXPECT_FALSE(run.record.error) << request.data << ": " << run.record.error->text();
        printed_ = run.printed;
        return run.record.error ? NAN : run.record.values.at("T").number.value_or(NAN);
    }
    static std::string refusal(const IdentifyRequest& request) {
        return error_of([&] { identification_script(request); });
    }
    static std::string look(const std::string& file) { return summarize_data(kFolder + file, {}).text; }

    WorkFolder work_;
    std::string printed_;
};

TEST_F(field_records, time_constant_is_the_same_however_the_time_is_called) {
    for (const auto& [file, time] : {std::pair{"time_ms.csv", "time_ms"},
                                     {"minutes.csv", "time (min.)"},
                                     {"millis.csv", "millis"},
                                     {"slash.csv", "t/ms"},
                                     {"TimeUS.csv", "TimeUS"}}) {
        EXPECT_NEAR(time_constant(of(file, "pwm", "speed")), 0.15, 0.002) << file;
        EXPECT_NEAR(time_constant(of(file, "pwm", "speed", time)), 0.15, 0.002) << file;
        EXPECT_THAT(look(file), HasSubstr("every 0.02 s")) << file;
    }
    EXPECT_NEAR(time_constant(of("days.csv", "pwm", "speed", "Date")), 4500, 60);
    EXPECT_THAT(printed_,
                AllOf(testing::StartsWith("days.csv: the time column 'Date' has no unit; dynlab assumes days"),
                      HasSubstr("--time-unit")));
    EXPECT_NEAR(time_constant(of("days.csv", "pwm", "speed")), 4500, 60);
    EXPECT_NEAR(time_constant(of("clock.csv", "pwm", "speed", "clock")), 4, 0.2);
    EXPECT_NEAR(time_constant(of("clock.csv", "pwm", "speed")), 4, 0.2);
}

TEST_F(field_records, input_that_is_logged_on_change_is_held) {
    IdentifyRequest request = of("log.csv", "u", "y");
    request.poles = 2;
    const ScriptRun run = work_.run(identification_script(request) +
                                    "\nreport.value(\"a1\", G.den[2]) report.value(\"a2\", G.den[3])\n"
                                    "report.value(\"b0\", G.num[1])\n");
    ASSERT_FALSE(run.record.error) << run.record.error->text();
    EXPECT_NEAR(run.record.values.at("a1").number.value_or(NAN), 2, 0.05);
    EXPECT_NEAR(run.record.values.at("a2").number.value_or(NAN), 4, 0.1);
    EXPECT_NEAR(run.record.values.at("b0").number.value_or(NAN), 4, 0.1);
    EXPECT_THAT(
        run.printed,
        AllOf(HasSubstr("no value in 1480 of 1500 samples; missing input samples are replaced with the previous value"),
              HasSubstr("method = \"previous\"")));
}

TEST_F(field_records, columns_of_decibels_and_degrees_are_a_response) {
    work_.write("analyser.csv", read_file(std::string(kFolder) + "analyser.csv"));
    const ScriptRun run = work_.run(R"lua(
local d = load("analyser.csv")
for _, w in ipairs{2*math.pi*d.Frequency, d.Frequency} do
  local G = tfsrivc(idfrd({d.Gain, d.Phase}, w), 2, 0)
  print(string.format("w0 %.0f zeta %.2f gain %.1f delay %.4f", math.sqrt(G.den[3]), G.den[2]/(2*math.sqrt(G.den[3])), dcgain(G), G.IODelay))
end
local db = idfrd({1*d.Gain, 1*d.Phase}, 2*math.pi*d.Frequency, {form = "dB"})
print(db.magnitude[1], db.phase[1])
)lua");
    ASSERT_FALSE(run.record.error) << run.record.error->text();
    EXPECT_THAT(run.printed,
                AllOf(HasSubstr("w0 503 zeta 0.10 gain 2.0 delay 0.0020"),
                      HasSubstr("the magnitude in dB and the phase in degrees"), HasSubstr("frequencies are in Hz")));
}

TEST_F(field_records, even_instants_make_regular_data) {
    const ScriptRun run = work_.run(R"lua(
local t = range(0, 399)*0.1
local u = prbs(7, 4):range(1, 400)
local data = iddata(lsim(tf({2}, {1, 1}), u, 0.1), u, nil, {SamplingInstants = t})
print(data.Ts, arx(data, {1, 1, 1}).Ts)
t[7] = t[7] + 0.03
print(select(2, pcall(arx, iddata(u, u, nil, {SamplingInstants = t}), {1, 1, 1})))
)lua");
    ASSERT_FALSE(run.record.error) << run.record.error->text();
    EXPECT_THAT(run.printed, AllOf(HasSubstr("0.1\t0.1"), HasSubstr("interp1"), Not(HasSubstr("resample"))));
}

TEST_F(field_records, two_records_side_by_side_keep_their_clocks) {
    EXPECT_THAT(look("two.csv"), HasSubstr("a table of 4 columns and 4 rows"));
    EXPECT_THAT(look("rates.csv"), HasSubstr("the file has several time columns (Time_u, Time_y)"));
    EXPECT_THAT(refusal(of("rates.csv", "u", "y")), AllOf(HasSubstr("several time columns"), HasSubstr("interp1")));
    for (const char* time : {"Time_u", "Time_y (s)"})
        EXPECT_THAT(refusal(of("rates.csv", "u", "y", time)), HasSubstr("belongs to the time column")) << time;
}

TEST_F(field_records, cells_of_switches_percents_and_thousands_are_numbers) {
    EXPECT_NEAR(time_constant(of("onoff.csv", "heater", "temp")), 4, 0.2);
    EXPECT_THAT(printed_, HasSubstr("column heater contains the words on and off, which are read as 1 and 0"));
    EXPECT_NEAR(time_constant(of("percent.csv", "valve", "level")), 4, 0.2);
    EXPECT_NEAR(time_constant(of("milliers.csv", "d\u00E9bit", "pression")), 4, 0.2);
    EXPECT_THAT(look("monitor.txt"), HasSubstr("every 0.5 s"));
    EXPECT_THAT(look("percent.csv"), HasSubstr("the unit of the column is %"));
}

TEST_F(field_records, exports_of_instruments_are_tables_with_a_time) {
    EXPECT_NEAR(time_constant(of("record.lvm", "valve", "tacho")), 0.4, 0.02);
    EXPECT_THAT(look("record.lvm"), HasSubstr("column X_Value, from 0 s to 1.19 s, every 0.01 s"));
    EXPECT_THAT(look("rigol.csv"), HasSubstr("column X, from -0.005 s to -0.004524 s, every 4e-06 s"));
    EXPECT_THAT(look("pairs.csv"), HasSubstr("the minimum and the maximum of an interval"));
    EXPECT_THAT(refusal(of("pairs.csv", "C1", "C2")), HasSubstr("--Ts"));
}

TEST_F(field_records, rows_written_twice_are_left_out) {
    EXPECT_THAT(look("rows_twice.csv"), AllOf(HasSubstr("rows repeat the row before them"), HasSubstr("every 0.1 s")));
    EXPECT_EQ(refusal(of("rows_twice.csv", "u", "y")), "");
}

TEST_F(field_records, sampling_time_that_contradicts_the_file_is_reported) {
    work_.write("wheel.csv", read_file(std::string(kFolder) + "wheel.csv"));
    const ScriptRun run = work_.run(
        "local d = load('wheel.csv') iddata(d.velocity, d.voltage, 0.05) iddata(d.velocity, d.voltage, 0.004)");
    EXPECT_EQ(run.printed,
              "iddata: the sampling time is 0.05 s, but according to the time column 'time' of the file it is 0.004 s; "
              "check the argument Ts\n");
    IdentifyRequest request = of("wheel.csv", "voltage", "velocity");
    request.Ts = 0.05;
    EXPECT_THAT(identification_script(request),
                HasSubstr("The sampling time 0.05 s was given, but according to the time column 'time'"));
}

}  // namespace test_field_records
}  // namespace dynlab::test
