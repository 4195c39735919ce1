// Data preparation in scripts. Oracle: definitions; the message about a misuse gives the remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_script_preprocess {

using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;

const std::string kDataSet =
    "local u = step_signal(100, 21, {1, 2})\n"
    "local y = 10 + lsim(tf({3}, {1, 1}), u - 1, 0.1)\n"
    "local d = iddata(y, u, 0.1)\n";

std::string said(const std::string& code) {
    return printed(kDataSet + code);
}

std::string refused(const std::string& code) {
    return error_of(kDataSet + code);
}

TEST(script_preprocess, functions_and_methods_do_the_same) {
    EXPECT_EQ(said("local a, b = detrend(d, 'start'), d:detrend('start') print(max(abs(a.y - b.y)), a.y[1], b.u[100])"),
              "0\t0\t1\n");
    EXPECT_EQ(said("print((max(abs(idfilt(d, {0, 5}).y - d:filter({0, 5}).y))))"), "0\n");
    EXPECT_EQ(said("print(resample(d, 1, 4).Ts, d:resample(1, 4).N)"), "0.4\t25\n");
    EXPECT_EQ(said("print((max(abs(resample(y, 2, 1) - d:resample(2, 1).y))))"), "0\n");
    EXPECT_EQ(said("print(merge(d, d, d).experiments, d:merge(d).experiments)"), "3\t2\n");
    EXPECT_EQ(said("print(abs(mean(detrend(y, 'mean'))) < 1e-12, abs(mean(d:remove_mean().y)) < 1e-12)"),
              "true\ttrue\n");
}

TEST(script_preprocess, stretches_are_kept_or_discarded) {
    EXPECT_EQ(said("local k = d:keep{{1, 10}, {51, 60}} print(k.experiments, k.N, k:experiment(2).t[1])"),
              "2\t20\t5\n");
    EXPECT_EQ(said("local k = d:discard{{11, 50}, {40, 90}} print(k.experiments, k.N)"), "2\t20\n");
    EXPECT_THAT(refused("d:keep{1, 10}"), HasSubstr("{{1, 200}, {350, 900}}"));
    EXPECT_THAT(refused("d:discard{{1, 99}}"), HasSubstr("no range of at least 2 samples would remain"));
    EXPECT_THAT(refused("d:keep{{90, 101}}"), HasSubstr("the data have samples 1 to 100"));
    EXPECT_THAT(refused("d:keep{{4, 7}, {1, 5}}"), HasSubstr("the ranges 1 to 5 and 4 to 7 overlap"));
    EXPECT_THAT(refused("iddata({1, 2}, {1, 2}, 1, {Tstart = 0/0})"), HasSubstr("'Tstart' must be a finite number"));
    EXPECT_THAT(refused("iddata({1, 2}, {1, 2}, nil, {SamplingInstants = {0, 1}, Tstart = 2})"),
                HasSubstr("'Tstart' cannot be combined with 'SamplingInstants'"));
}

TEST(script_preprocess, missing_and_wild_samples_are_replaced) {
    EXPECT_EQ(printed("local x, p = fillmissing({1, 0/0, 3}) print(x[2], p[1], #p)"), "2\t2\t1\n");
    EXPECT_EQ(said("y[50] = 99 local c, p = filloutliers(y) print(p[1], #p, abs(c[50] - y[49]) < 0.1)"),
              "50\t1\ttrue\n");
    EXPECT_THAT(refused("filloutliers({1, 0/0})"), HasSubstr("sample 2 of the signal is not a number (NaN)"));
    EXPECT_THAT(refused("iddata(0*y/0, u, 0.1)"), HasSubstr("fillmissing"));
}

TEST(script_preprocess, misuse_is_reported_with_the_remedy) {
    EXPECT_THAT(refused("idfilt(d, {0, 50})"), HasSubstr("must have an edge between 0 and pi/Ts = 31.416"));
    EXPECT_THAT(refused("idfilt(d, {3})"), HasSubstr("{0, w} is a low-pass filter"));
    EXPECT_THAT(refused("idfilt(d, {0, 3}, {Ts = 1})"), HasSubstr("a data object already has a sampling time"));
    EXPECT_THAT(refused("idfilt(d, {0, 3}, {zero_phase = true, start = 'zero'})"), HasSubstr("extended at both ends"));
    EXPECT_THAT(refused("idfilt(d, {0, 3}, {ordre = 3})"), HasSubstr("order"));
    EXPECT_THAT(refused("detrend(d, 'cubic')"), HasSubstr("\"linear\", \"mean\" or \"start\""));
    EXPECT_THAT(refused("detrend(d, 'mean', {samples = 3})"), HasSubstr("requires the kind \"start\""));
    EXPECT_THAT(refused("detrend(y, 'start')"), HasSubstr("specify the number of samples"));
    EXPECT_THAT(refused("resample(d, 1, 0)"), HasSubstr("between 1 and 1000"));
    EXPECT_THAT(refused("merge(d, d:resample(1, 2))"),
                AllOf(HasSubstr("has a sampling time of 0.2 s, but the first part has 0.1 s"), HasSubstr("resample")));
}

}  // namespace test_script_preprocess
