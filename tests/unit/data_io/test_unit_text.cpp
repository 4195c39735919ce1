#include "data_io/tables/time_text.h"
#include "data_io/tables/unit_text.h"

#include <gtest/gtest.h>

namespace dynlab {
namespace test_unit_text {

// Oracle: the SI brochure's symbols and prefixes, and words that are none of them.
TEST(unit_text, knows_units) {
    for (const char* unit : {"s",     "ms",         "\u00B5s", "V",       "mV",
                             "kPa",   "m/s",        "m/s^2",   "m s-2",   "m\u00B7s\u207B\u00B2",
                             "rad/s", "\u00B0C",    "deg C",   "%",       "rpm",
                             "Nm",    "N.m",        "N*m",     "l/min",   "1/s",
                             "kg/m3", "kg/m\u00B3", "Volts",   "seconds", "W/(m2 K)",
                             "dB",    "k\u03A9",    "-"})
        EXPECT_TRUE(is_unit(unit)) << unit;
    for (const char* word :
         {"", "u", "y", "speed", "filtered", "raw", "x1", "left wheel", "2", "1", "theta", "a long text that is none"})
        EXPECT_FALSE(is_unit(word)) << word;
}

TEST(unit_text, takes_headers_apart) {
    const auto check = [](const char* header, const char* name, const char* unit) {
        EXPECT_EQ(split_unit(header).name, name) << header;
        EXPECT_EQ(split_unit(header).unit, unit) << header;
    };
    check("time (s)", "time", "s");
    check(" u [V] ", "u", "V");
    check("force[N]", "force", "N");
    check("T_out (\u00B0C)", "T_out", "\u00B0C");
    check("level [counts since start]", "level", "counts since start");
    check("y (filtered)", "y (filtered)", "");
    check("x[1]", "x[1]", "");
    check("(s)", "(s)", "");
    check("plain", "plain", "");
    check("C1 in V", "C1", "V");
    check("t in ms", "t", "ms");
    check("time (10 ms)", "time", "10 ms");
    check("Time (Millisecond)", "Time", "Millisecond");
    check("made in Japan", "made in Japan", "");
}

TEST(unit_text, knows_seconds) {
    EXPECT_EQ(seconds_of("ms"), 1e-3);
    EXPECT_EQ(seconds_of("min"), 60);
    EXPECT_EQ(seconds_of("h"), 3600);
    EXPECT_EQ(seconds_of("V"), std::nullopt);
    EXPECT_EQ(seconds_of("mS"), std::nullopt) << "millisiemens";
    EXPECT_EQ(seconds_of("mS", true), 1e-3);
    EXPECT_EQ(seconds_of("1/100 s", true), 0.01);
}

}  // namespace test_unit_text
}  // namespace dynlab
