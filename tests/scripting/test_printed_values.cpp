// What print and show make of values. Oracle: written by hand, as a reader wants to see it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_printed_values {

using dynlab::test::printed;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(printed_values, numbers_have_seven_digits_and_whole_ones_all) {
    EXPECT_EQ(printed("print(1/3, 2*math.pi, 0.5, 12345678, 123456789012, 1e-7/3)"),
              "0.3333333\t6.283185\t0.5\t12345678\t123456789012\t3.333333e-08\n");
    EXPECT_EQ(printed("print(2^40, {1/3})"), "1099511627776\t{0.3333333}\n");
    EXPECT_EQ(printed("print(tostring(1/3))"), "0.33333333333333\n") << "a text keeps what can be calculated with";
}

TEST(printed_values, short_tables_have_one_line_and_long_ones_a_line_for_each_entry) {
    EXPECT_EQ(printed("print({1, 2, name = 'x'})"), "{1, 2, name = \"x\"}\n");
    EXPECT_EQ(
        printed("print({title = 'a text that takes a good part of a line', further = 'and one that goes beyond it', "
                "sizes = {1, 2}})"),
        "{\n"
        "  further = \"and one that goes beyond it\",\n"
        "  sizes = {1, 2},\n"
        "  title = \"a text that takes a good part of a line\"\n"
        "}\n");
    EXPECT_EQ(printed("print({cov = matrix{{1, 2}, {3, 4}}})"), "{\n  cov =\n  1  2\n  3  4\n}\n");
    EXPECT_EQ(printed("local t = {} for i = 1, 20 do t[i] = 100000 + i end print(t)"),
              "{\n"
              "  100001, 100002, 100003, 100004, 100005, 100006, 100007, 100008, 100009,\n"
              "  100010, 100011, 100012, 100013, 100014, 100015, 100016, 100017, 100018,\n"
              "  100019, 100020\n"
              "}\n");
}

TEST(printed_values, records_and_reports_of_fits_are_lists) {
    EXPECT_THAT(printed("print(load('crane'))"),
                AllOf(StartsWith("{\n  estimation = {\n    t = [0 0.02 "), HasSubstr("\n  validation = {\n    t = ")));
    const std::string report = printed(
        "local u = prbs(5, 4) local G = arx(iddata(lsim(c2d(tf({1}, {1, 1}), 0.1), u, 0.1), u, 0.1), {1, 1, 1}) "
        "print(G.report)");
    EXPECT_THAT(report, AllOf(StartsWith("{\n"), ContainsRegex("\n  method = \"arx\",?\n")));
}

TEST(printed_values, blocks_of_lines_do_not_run_together) {
    const std::string two = printed("local G = tf({1}, {1, 2}) print(G) print(G) print('text') print(G)");
    EXPECT_EQ(two, "  1\n-----\ns + 2\n\n  1\n-----\ns + 2\ntext\n  1\n-----\ns + 2\n");
    EXPECT_EQ(printed("print(matrix{{1}, {2}}) print(matrix{{3}, {4}})"), "1\n2\n\n3\n4\n");
    EXPECT_EQ(printed("local G = tf({1}, {1, 2})\nG\nG"), "  1\n-----\ns + 2\n\n  1\n-----\ns + 2\n");
}

TEST(printed_values, advice_is_not_followed_by_its_table) {
    const std::string text = printed("local d = load('crane').steps print(advice(iddata(d.x, d.u, 0.02)))");
    EXPECT_THAT(text,
                ContainsRegex("\n\\([0-9]+ issues?; the result a = advice.data. has the fields a\\[1\\].message"));
    EXPECT_THAT(text, Not(HasSubstr("message =")));
}

TEST(printed_values, a_missing_sampling_time_is_reported_once) {
    const std::string said = "iddata: no sampling time was given, so dynlab uses 1 s; write iddata(y, u, Ts)\n";
    EXPECT_EQ(printed("local v = vector{1, 2, 3} iddata(v, v) iddata(v, v)"), said);
    EXPECT_EQ(printed("local v = vector{1, 2, 3} iddata(v, v, 1) iddata(v, v, nil, {SamplingInstants = {0, 1, 3}})"),
              "");
}

// Models print s, whatever their data count time in.
TEST(printed_values, another_unit_of_time_is_reported_once) {
    const std::string said =
        printed("local v = vector{1, 2, 3} iddata(v, v, 1, {TimeUnit = 'min'}) iddata(v, v, 1, {TimeUnit = 'min'})");
    EXPECT_THAT(said, ContainsRegex(
                          "^iddata: these data, and models .* have the time unit min\\. .* the actual unit is min\n$"));
    EXPECT_EQ(printed("local v = vector{1, 2, 3} iddata(v, v, 1, {TimeUnit = 's'})"), "");
}

}  // namespace test_printed_values
