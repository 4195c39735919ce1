// Which column is the time and what its numbers mean. Oracle: the sampling with which each table is made.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "data_io/data_file.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/message_texts.h"

namespace dynlab {
namespace test_time_column {

using test::texts_of;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

using Cell = std::function<std::string(int)>;

/// Equal steps in a unit, written with so many digits.
Cell steps(double step, int decimals = 0, double first = 0) {
    return [=](int i) { return fmt::format("{:.{}f}", first + i * step, decimals); };
}

class time_column : public testing::Test {
  protected:
    /// A table of 40 rows of the time, u and y.
    LoadedData read(const std::string& header, const Cell& cell, const ImportOptions& options = {}) {
        std::string text = "\"" + header + "\";u;y\n";
        for (int i = 0; i < 40; ++i) text += fmt::format("{};{};{}\n", cell(i), i / 10 % 2, i + 0.5);
        write_file_atomically(file_, text);
        return read_data_file(file_, true, options);
    }
    /// The step that is found; or what is asked instead.
    std::string found(const std::string& header, const Cell& cell, const ImportOptions& options = {}) {
        try {
            const LoadedData data = read(header, cell, options);
            if (data.time.question) return message_text(*data.time.question);
            if (!data.time.clock) return "no time";
            return fmt::format("{:.5g}{}", data.time.clock->spacing.step,
                               data.time.clock->spacing.even ? "" : " uneven");
        } catch (const EnvironmentError& error) {
            return error.what();
        }
    }
    /// The same by the column's name, which must not matter.
    std::string found_by_name(const std::string& header, const Cell& cell) {
        ImportOptions options;
        options.time = header;
        return found(header, cell, options);
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "x.csv";
};

TEST_F(time_column, unit_in_a_header_or_name_is_that_of_the_numbers) {
    for (const char* header : {"t_ms",
                               "time_ms",
                               "TIME_MS",
                               "Time (ms)",
                               "Time [ms]",
                               "time(ms)",
                               "t/ms",
                               "t in ms",
                               "Time, ms",
                               "time ms",
                               "Time - ms",
                               "time {ms}",
                               "elapsed_time_ms",
                               "timestamp_ms",
                               "ms",
                               "millis",
                               "Time (Millisecond)",
                               "Time (mS)",
                               "Time (MS)",
                               "Zeit (ms)",
                               "Zeit_ms",
                               "temps (ms)",
                               "t [msec]",
                               "Time (milliseconds)",
                               "time_msec",
                               "timeMs"}) {
        EXPECT_EQ(found(header, steps(20)), "0.02") << header;
        EXPECT_EQ(found_by_name(header, steps(20)), "0.02") << header;
    }
    for (const char* header : {"TimeUS", "time(us)", "t_us", "micros", "Time [\u00B5s]", "timestamp_us", "time (usec)",
                               "elapsed_us", "Zeit in \u00B5s", "t/us"}) {
        EXPECT_EQ(found(header, steps(20000)), "0.02") << header;
        EXPECT_EQ(found_by_name(header, steps(20000)), "0.02") << header;
    }
    for (const char* header : {"time_ns", "t (ns)", "Time [ns]", "timestamp_ns"})
        EXPECT_EQ(found(header, steps(20e6)), "0.02") << header;
    for (const char* header : {"time (min)", "time (min.)", "time_min", "temps (mn)", "t [minutes]", "Zeit (Minuten)"})
        EXPECT_EQ(found(header, steps(0.5, 1)), "30") << header;
    for (const char* header : {"time (h)", "t_h", "Time [hours]", "Zeit (Stunden)", "heures", "temps (heures)"})
        EXPECT_EQ(found(header, steps(0.25, 2)), "900") << header;
    for (const char* header : {"time (days)", "t [d]", "Zeit (Tage)", "days", "temps (jours)"})
        EXPECT_EQ(found(header, steps(0.125, 3)), "10800") << header;
    for (const char* header : {"t", "time", "Time (s)", "t_s", "Zeit", "temps", "seconds", "Time [sec]", "time (sec.)",
                               "t in s", "in s", "elapsed", "Uhrzeit (s)", "time_s"}) {
        EXPECT_EQ(found(header, steps(0.02, 2)), "0.02") << header;
        EXPECT_EQ(found_by_name(header, steps(0.02, 2)), "0.02") << header;
    }
    EXPECT_EQ(found("time (10 ms)", steps(2)), "0.02");
    EXPECT_EQ(found("Time (1/100 s)", steps(2)), "0.02");
    EXPECT_EQ(found("time (x 10 ms)", steps(2)), "0.02");
    EXPECT_THAT(read("t_ms", steps(20)).notes, IsEmpty()) << "nothing was guessed";
}

TEST_F(time_column, unit_below_the_header_is_that_of_the_numbers) {
    for (const auto& [unit, step] :
         {std::pair{"ms", 20.0}, {"(ms)", 20}, {"[us]", 2e4}, {"min", 1.0 / 3000}, {"s", 0.02}}) {
        std::string text = fmt::format("Time,u,y\n{},V,V\n", unit);
        for (int i = 0; i < 40; ++i) text += fmt::format("{:.12g},1,{}\n", i * step, i);
        write_file_atomically(file_, text);
        const LoadedData data = read_data_file(file_, true);
        ASSERT_TRUE(data.time.clock) << unit;
        EXPECT_NEAR(data.time.clock->spacing.step, 0.02, 1e-9) << unit;
    }
}

TEST_F(time_column, two_likely_units_are_asked_for_and_can_be_stated) {
    for (const double step : {5.0, 20.0, 50.0, 100.0, 1000.0, 20000.0, 250000.0})
        for (const char* header : {"time", "t", "timestamp", "Zeit"})
            EXPECT_THAT(found(header, steps(step)), HasSubstr("time_unit")) << header << step;
    ImportOptions options;
    options.time_unit = "ms";
    EXPECT_EQ(found("time", steps(20), options), "0.02");
    options.time = "time";
    EXPECT_EQ(std::get<double>(read("time", steps(20), options).variables.at("Ts").value), 0.02);
    options.time_unit = "us";
    EXPECT_EQ(found("time", steps(20000), options), "0.02");
    options.time_unit = "V";
    EXPECT_THAT(found("time", steps(20), options), HasSubstr("has the unit V, which is not a unit of time"));
}

TEST_F(time_column, stated_sampling_time_decides_between_units_and_is_compared) {
    const auto with_Ts = [this](const char* Ts, double step) {
        std::string text = fmt::format("# Ts: {}\ntime,u\n", Ts);
        for (int i = 0; i < 40; ++i) text += fmt::format("{},{}\n", i * step, i % 3);
        write_file_atomically(file_, text);
        return read_data_file(file_, true);
    };
    for (const auto& [Ts, step] : {std::pair{"0.02", 20.0}, {"20 ms", 20}, {"0.02 s", 20000}, {"20", 20}}) {
        const LoadedData data = with_Ts(Ts, step);
        ASSERT_TRUE(data.time.clock) << Ts;
        EXPECT_NEAR(data.time.clock->spacing.step, std::string(Ts) == "20" ? 20 : 0.02, 1e-12) << Ts;
    }
    EXPECT_THAT(texts_of(with_Ts("0.01", 0.02).notes),
                Contains(HasSubstr("specifies Ts = 0.01 s, but its time column 'time' advances by 0.02 s")));
    EXPECT_THAT(with_Ts("0.02", 0.02).notes, IsEmpty());
}

TEST_F(time_column, whole_seconds_are_assumed_with_a_note) {
    for (const double step : {1.0, 2.0, 30.0, 60.0, 600.0, 3600.0}) {
        EXPECT_EQ(found("time", steps(step)), fmt::format("{:.5g}", step));
        EXPECT_THAT(texts_of(read("time", steps(step)).notes),
                    Contains(testing::AllOf(HasSubstr("assumes s"), HasSubstr("--time-unit"))));
    }
}

TEST_F(time_column, numbers_since_1970_and_days_of_spreadsheets_are_known) {
    EXPECT_EQ(found("timestamp", steps(1, 0, 1741687925)), "1");
    EXPECT_EQ(found("timestamp", steps(0.5, 3, 1741687925)), "0.5");
    EXPECT_EQ(found("epoch", steps(20, 0, 1741687925118)), "0.02");
    EXPECT_EQ(found("time", steps(100, 0, 1741687925000)), "0.1");
    EXPECT_EQ(found("ts_ms", steps(100, 0, 1741687925000)), "no time");
    EXPECT_EQ(found_by_name("ts", steps(100, 0, 1741687925000)), "0.1");
    EXPECT_EQ(found("timestamp_ms", steps(250, 0, 1741687925000)), "0.25");
    EXPECT_EQ(found("timestamp", steps(20000, 0, 1741687925118000)), "0.02");
    EXPECT_EQ(found("time", steps(60, 0, 1700000000)), "60");
    EXPECT_EQ(found("Unix time (s)", steps(0.1, 2, 1700000000)), "0.1");
    const Cell ten_minutes = [](int i) { return fmt::format("{:.9f}", 45719.416666667 + i / 144.0); };
    for (const char* header : {"Date", "time", "Zeit", "datetime"})
        EXPECT_EQ(found(header, ten_minutes), "600") << header;
    EXPECT_EQ(found_by_name("Date", ten_minutes), "600");
    EXPECT_EQ(found("Date", [](int i) { return fmt::format("{:.8f}", 45719.4 + i / 86400.0); }), "1");
    EXPECT_EQ(found("time", [](int i) { return fmt::format("{:.10f}", 739687.4 + i / 1440.0); }), "60");
    const LoadedData data = read("Date", ten_minutes, {.time = "Date"});
    EXPECT_EQ(std::get<Vector>(data.variables.at("t").value)[0], 0);
    EXPECT_THAT(texts_of(data.notes), Contains(HasSubstr("assumes days")));
    EXPECT_EQ(found("time", steps(0.02, 2, 45000)), "0.02") << "seconds of a day";
}

TEST_F(time_column, counters_that_begin_again_are_counted_on) {
    const auto counter = [](double step, double first, double range) -> Cell {
        return [=](int i) { return fmt::format("{:.0f}", std::fmod(first + i * step, range)); };
    };
    EXPECT_EQ(found("millis", counter(20, 65536 - 300, 65536)), "0.02");
    EXPECT_EQ(found("t_ms", counter(100, 65000, 65536)), "0.1");
    EXPECT_EQ(found("micros", counter(20000, 4294967296 - 300000, 4294967296)), "0.02");
    EXPECT_EQ(found("millis", counter(10, 4294967296 - 95, 4294967296)), "0.01");
    EXPECT_EQ(found("time_us", counter(1000, 65500, 65536)), "0.001");
    EXPECT_EQ(found("t_us", counter(250, 16777216 - 1000, 16777216)), "0.00025");
    EXPECT_EQ(found("ticks (ms)", counter(50, 65536 - 77, 65536)), "0.05");
    EXPECT_EQ(found("time (s)", counter(10, 86400 - 200, 86400)), "10") << "seconds of the day";
    EXPECT_EQ(found("time (min)", [](int i) { return fmt::format("{}", (1430 + i) % 1440); }), "60");
    EXPECT_THAT(texts_of(read("millis", counter(20, 65536 - 300, 65536)).notes),
                Contains(HasSubstr("wraps around at 65536")));
    EXPECT_THAT(found("millis", [](int i) { return fmt::format("{}", i % 20 * 20); }), HasSubstr("must increase"));
}

std::string clock_text(double seconds, const char* form) {
    const int whole = static_cast<int>(std::floor(seconds + 1e-9)), h = whole / 3600 % 24, m = whole / 60 % 60,
              s = whole % 60;
    const int ms = static_cast<int>(std::lround((seconds - whole) * 1000));
    const std::string expected = form;
    if (expected == "hms") return fmt::format("{:02}:{:02}:{:02}", h, m, s);
    if (expected == "ms") return fmt::format("{:02}:{:02}:{:02}.{:03}", h, m, s, ms);
    if (expected == "comma") return fmt::format("{:02}:{:02}:{:02},{:03}", h, m, s, ms);
    if (expected == "ampm") return fmt::format("{}:{:02}:{:02} {}", (h + 11) % 12 + 1, m, s, h < 12 ? "AM" : "PM");
    return fmt::format("{}:{:02}:{:02}", (h + 11) % 12 + 1, m, s);
}

TEST_F(time_column, times_of_day_are_seconds_past_midnight_too) {
    const auto clock = [](double first, double step, const char* form) -> Cell {
        return [=](int i) { return clock_text(first + i * step, form); };
    };
    for (const char* header : {"clock", "Time", "Uhrzeit", "heure", "stamp", "x"}) {
        EXPECT_EQ(found(header, clock(36725, 0.5, "ms")), "0.5") << header;
        EXPECT_EQ(found_by_name(header, clock(36725, 0.5, "ms")), "0.5") << header;
    }
    EXPECT_EQ(found("clock", clock(36725, 2, "hms")), "2");
    EXPECT_EQ(found("clock", clock(36725, 0.25, "comma")), "0.25");
    EXPECT_EQ(found("clock", clock(86390, 1, "hms")), "1");
    EXPECT_EQ(found("clock", clock(86395, 0.5, "ms")), "0.5");
    EXPECT_EQ(found("clock", clock(86400 - 1200, 60, "ampm")), "60");
    EXPECT_EQ(found("clock", clock(43200 - 100, 10, "ampm")), "10");
    EXPECT_EQ(found("clock", clock(43200 + 3600 - 100, 10, "twelve")), "10");
    EXPECT_THAT(texts_of(read("clock", clock(86390, 1, "hms")).notes), Contains(HasSubstr("pass midnight")));
    const Cell two_fields = [](int i) { return fmt::format("{:02}:{:02}", i / 60, i % 60); };
    EXPECT_THAT(found("clock", two_fields), HasSubstr("hours and minutes, or minutes and seconds"));
    EXPECT_EQ(found("clock", two_fields, {.time_unit = "h"}), "60");
    EXPECT_EQ(found("clock", two_fields, {.time_unit = "min"}), "1");
    EXPECT_EQ(found("clock", [](int i) { return fmt::format("{:02}:{:02}.5", i / 60, i % 60); }), "1");
    EXPECT_EQ(found("elapsed", [](int i) { return fmt::format("{}:{:02}:00", 23 + i / 2, i % 2 * 30); }), "1800");
}

TEST_F(time_column, days_are_read_in_the_order_that_makes_even_steps) {
    const auto same_day = [](const char* day) -> Cell {
        return [=](int i) { return fmt::format("{} 10:{:02}:{:02}", day, i / 6, i % 6 * 10); };
    };
    for (const char* day : {"2025-03-11", "2025/03/11", "11.03.2025", "11.3.25", "03/04/2025", "13/03/2025",
                            "3/13/2025", "11-Mar-2025", "11 Mar 2025", "04-03-2025", "1/2/25"})
        EXPECT_EQ(found("Date", same_day(day)), "10") << day;
    for (const char* zone : {"Z", "+01:00", "-0530", " UTC", ""})
        EXPECT_EQ(
            found("time",
                  [=](int i) { return fmt::format("2025-03-11T23:59:{:02}.{}00{}", 30 + i / 2, i % 2 * 5, zone); }),
            "0.5")
            << zone;
    EXPECT_EQ(found("time", [](int i) { return fmt::format("20250311T1402{:02}", i); }), "1");
    EXPECT_EQ(found("Datum", [](int i) { return fmt::format("{:02}.{:02}.2025 12:00", 1 + i % 28, 2 + i / 28); }),
              "86400");
    EXPECT_EQ(found("Date", [](int i) { return fmt::format("{:02}/{:02}/2025", 1 + i % 28, 2 + i / 28); }), "86400");
    EXPECT_EQ(found("Date", [](int i) { return fmt::format("{:02}/{:02}/2025", 2 + i / 28, 1 + i % 28); }), "86400");
    const Cell midnight = [](int i) {
        return i < 20 ? fmt::format("2025-03-11 23:59:{}", 40 + i) : fmt::format("2025-03-12 00:00:{:02}", i - 20);
    };
    EXPECT_EQ(found("Date", midnight), "1");
    // 2/1, 3/2, 4/3, ...: with either order the steps are about a month
    const Cell either = [](int i) { return fmt::format("{}/{}/{}", 1 + i % 6, 2 + i % 6, 2000 + i / 6); };
    EXPECT_THAT(found("Date", either), HasSubstr("dd/mm/yyyy"));
    EXPECT_THAT(found("Date", either, {.time_unit = "dd/mm/yyyy"}), HasSubstr("uneven"));
}

TEST_F(time_column, clocks_of_several_columns_are_one_or_asked_for) {
    const auto table = [this](const std::string& text) {
        write_file_atomically(file_, text);
        return read_data_file(file_, true);
    };
    std::string two_rates = "Time_u (s),u,Time_y (s),y\n", same = "Time,a,Time,b\n", dated = "Date,Time,y\n",
                both = two_rates;
    std::string in_two_units = "timestamp_ms,elapsed_s,y\n";
    for (int i = 0; i < 60; ++i) {
        two_rates += fmt::format("{},1,", 0.1 * i) + (i < 12 ? fmt::format("{},{}\n", 0.5 * i, i) : ",\n");
        both += fmt::format("{},1,{},1\n", 0.1 * i, 0.5 * i);
        same += fmt::format("{0},1,{0},2\n", 0.1 * i);
        dated += fmt::format("2025-03-11,10:00:{:02},2\n", i);
        in_two_units += fmt::format("{},{},1\n", 1741687925000 + 100 * i, 0.1 * i);
    }
    for (const std::string& text : {two_rates, both}) {
        const LoadedData data = table(text);
        ASSERT_TRUE(data.time.question);
        EXPECT_THAT(message_text(*data.time.question), HasSubstr("several time columns (Time_u, Time_y)"));
    }
    for (const std::string& text : {same, in_two_units}) {
        ASSERT_TRUE(table(text).time.clock) << text.substr(0, 60);
        EXPECT_NEAR(table(text).time.clock->spacing.step, 0.1, 1e-12);
    }
    EXPECT_EQ(table(dated).time.clock->name, "Time");
    EXPECT_EQ(table(dated).time.clock->spacing.step, 1);
}

TEST_F(time_column, rows_written_twice_are_left_out_and_other_equal_times_explained) {
    std::string twice = "t,u,y\n", pairs = "in s,C1 in V\n", coarse = "time,y\n", all = "t,y\n";
    for (int i = 0; i < 40; ++i) {
        for (int k = 0; k < (i % 15 == 7 ? 2 : 1); ++k) twice += fmt::format("{},0,{}\n", 0.1 * i, i);
        pairs += fmt::format("{0},{1}\n{0},{2}\n", 0.01 * i, i, i + 1);
        coarse += fmt::format("{},{}\n", 1741687925 + i / 7, i);
        all += fmt::format("{0},{1}\n{0},{1}\n", 0.1 * i, i);
    }
    const auto table = [this](const std::string& text) {
        write_file_atomically(file_, text);
        return read_data_file(file_, true);
    };
    const LoadedData data = table(twice);
    EXPECT_EQ(data.rows, 40);
    EXPECT_EQ(std::get<Vector>(data.variables.at("y").value), Vector(Vector::LinSpaced(40, 0, 39)));
    EXPECT_THAT(texts_of(data.notes), Contains(HasSubstr("3 rows repeat the row before them")));
    EXPECT_EQ(table(all).rows, 40);
    EXPECT_THAT(message_text(*table(pairs).time.question), HasSubstr("the minimum and the maximum of an interval"));
    EXPECT_THAT(message_text(*table(coarse).time.question), HasSubstr("is too coarse"));
}

}  // namespace test_time_column
}  // namespace dynlab
