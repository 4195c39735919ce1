#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "numerics/signals/iddata.h"
#include "support/thrown_message.h"

namespace test_iddata {

using namespace dynlab;
using testing::AllOf;
using testing::HasSubstr;

/// Two outputs and one input whose values say channel and sample: y1 = 1, 2, ..., y2 = 101, ..., u1 = 1001, ...
IdData numbered(Index N, double Ts = 0.5) {
    Matrix y(N, 2);
    y.col(0) = Vector::LinSpaced(N, 1, static_cast<double>(N));
    y.col(1) = y.col(0).array() + 100;
    return IdData(y, y.col(0).array() + 1000, Ts);
}

TEST(iddata, names_sizes_and_time) {  // oracle: definition
    const IdData data = numbered(4);
    EXPECT_EQ(data.sample_count(), 4);
    EXPECT_EQ(data.output_count(), 2);
    EXPECT_EQ(data.input_count(), 1);
    EXPECT_THAT(data.output_names, testing::ElementsAre("y1", "y2"));
    EXPECT_THAT(data.input_names, testing::ElementsAre("u1"));
    EXPECT_EQ(data.time(), (Vector{{0, 0.5, 1, 1.5}}));
    EXPECT_EQ(IdData(Vector::Ones(3), Matrix(), 1).input_count(), 0);  // a time series
}

TEST(iddata, irregular_instants) {  // oracle: definition
    const Vector t{{1.0, 1.5, 3.0}};
    const IdData data(Vector::Ones(3), Vector::Ones(3), t);
    EXPECT_FALSE(data.regular());
    EXPECT_EQ(data.time(), t);
    EXPECT_EQ(data.range(2, 3).time(), t.tail(2));
    EXPECT_EQ(data.range(2, 3).experiments[0].start_time, 1.5);
}

TEST(iddata, durations_and_mean_step_count_all_experiments) {  // oracle: the instants
    const auto sampled_at = [](const Vector& t) { return IdData(Matrix::Ones(t.size(), 1), Matrix(t.size(), 0), t); };
    const IdData short_one = sampled_at(Vector{{1, 1.5, 2}}), long_one = sampled_at(Vector{{0, 4, 6, 9, 13}});
    for (const IdData& data : {IdData::merge({short_one, long_one}), IdData::merge({long_one, short_one})})
        EXPECT_DOUBLE_EQ(data.mean_step(), (1.0 + 13.0) / (2 + 4));
    EXPECT_EQ(IdData::merge({short_one, long_one}).duration(0), 1);
    EXPECT_EQ(IdData::merge({short_one, long_one}).duration(1), 13);
    EXPECT_EQ(sampled_at(Vector{{5}}).mean_step(), 1);
    const IdData regular(Matrix::Ones(5, 1), Matrix(5, 0), 0.25);
    EXPECT_EQ(regular.mean_step(), 0.25);
    EXPECT_EQ(regular.duration(0), 1);
}

TEST(iddata, range_and_split_keep_the_clock) {  // oracle: the numbered samples
    const IdData data = numbered(10), part = data.range(3, 5);
    EXPECT_EQ(part.experiments[0].y.col(1), (Vector{{103, 104, 105}}));
    EXPECT_EQ(part.experiments[0].u, (Vector{{1003, 1004, 1005}}));
    EXPECT_EQ(part.time(), (Vector{{1, 1.5, 2}}));
    const auto [first, second] = data.split(0.66);
    EXPECT_EQ(first.sample_count(), 7);
    EXPECT_EQ(second.sample_count(), 3);
    EXPECT_EQ(second.experiments[0].y(0, 0), 8);
    EXPECT_EQ(second.time()(0), 3.5);
}

TEST(iddata, select_takes_names_along) {
    IdData data = numbered(3);
    data.output_names = {"angle", "speed"};
    const IdData swapped = data.select({2, 1}, {});
    EXPECT_EQ(swapped.experiments[0].y(0, 0), 101);
    EXPECT_EQ(swapped.input_count(), 0);
    EXPECT_THAT(swapped.output_names, testing::ElementsAre("speed", "angle"));
    EXPECT_THROW(data.select({3}, {}), InvalidArgument);
    EXPECT_THROW(data.select({}, {1}), InvalidArgument);
}

TEST(iddata, shifted_pairs_y_with_earlier_input) {  // oracle: the numbered samples
    const IdData later = numbered(5).shifted(2), earlier = numbered(5).shifted(-2);
    EXPECT_EQ(later.experiments[0].y.col(0), (Vector{{3, 4, 5}}));
    EXPECT_EQ(later.experiments[0].u, (Vector{{1001, 1002, 1003}}));
    EXPECT_EQ(later.time()(0), 1);
    EXPECT_EQ(earlier.experiments[0].y.col(0), (Vector{{1, 2, 3}}));
    EXPECT_EQ(earlier.experiments[0].u, (Vector{{1003, 1004, 1005}}));
    EXPECT_THROW(numbered(2).shifted(2), InvalidArgument);
}

TEST(iddata, merge_keeps_experiments_apart) {
    const IdData both = IdData::merge({numbered(3), numbered(5)});
    EXPECT_EQ(both.experiments.size(), 2u);
    EXPECT_EQ(both.sample_count(), 8);
    EXPECT_EQ(both.sample_count(1), 5);
    EXPECT_THAT(thrown_message([] {
                    IdData::merge({numbered(3), numbered(3, 1)});
                }),
                AllOf(HasSubstr("part 2"), HasSubstr("0.5")));
    EXPECT_THROW(both.range(1, 2), InvalidArgument);
    EXPECT_THROW(IdData::merge({}), InvalidArgument);
}

TEST(iddata, merge_takes_no_part_for_what_it_is_not) {
    IdData on_lines = numbered(3), volts = numbered(3), millivolts = numbered(3), meters = numbered(3);
    on_lines.hold = Hold::kFoh;
    volts.input_units = {"V"};
    millivolts.input_units = {"mV"};
    meters.output_units = {"", "m"};
    EXPECT_THAT(thrown_message([&] {
                    IdData::merge({numbered(3), on_lines});
                }),
                HasSubstr("the input of part 2 is linearly interpolated (foh), but the input of the first part has a "
                          "zero-order hold (zoh)"));
    EXPECT_THAT(thrown_message([&] {
                    IdData::merge({volts, millivolts});
                }),
                HasSubstr("in part 2, the unit of input 1 is mV, but in the first part it is V"));
    const IdData irregular(Matrix(Vector{{1, 2, 3}}), Matrix(Vector{{1, 0, 1}}), Vector{{0, 1, 3}});
    const IdData regular(Matrix(Vector{{1, 2, 3}}), Matrix(Vector{{1, 0, 1}}), 0.2);
    EXPECT_THAT(thrown_message([&] {
                    IdData::merge({regular, irregular});
                }),
                HasSubstr("part 2 is sampled irregularly, but the first part is sampled regularly"));
    EXPECT_THAT(thrown_message([&] {
                    IdData::merge({irregular, regular});
                }),
                HasSubstr("part 2 is sampled regularly, but the first part is sampled irregularly"));
    EXPECT_EQ(IdData::merge({irregular, irregular}).experiments.size(), 2u);
    EXPECT_EQ(IdData::merge({volts, meters, numbered(3)}).experiments.size(), 3u);  // what is not known does not differ
}

TEST(iddata, says_what_is_wrong_with_the_samples) {
    const Matrix good = Matrix::Ones(4, 2);
    Matrix bad = good;
    bad(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(thrown_message([&] { IdData(bad, good, 1); }),
                AllOf(HasSubstr("sample 3 of channel 2 of the output"), HasSubstr("NaN")));
    bad(2, 1) = std::numeric_limits<double>::infinity();
    EXPECT_THAT(thrown_message([&] { IdData(good, bad, 1); }),
                AllOf(HasSubstr("sample 3 of channel 2 of the input"), HasSubstr("infinite")));
    EXPECT_THAT(thrown_message([&] { IdData(good, Matrix::Ones(3, 1), 1); }),
                AllOf(HasSubstr("4 samples"), HasSubstr("input has 3")));
    EXPECT_THAT(thrown_message([&] { IdData(good, good, 0.0); }), HasSubstr("sampling time"));
    EXPECT_THAT(thrown_message([&] { IdData(good, good, -1.0); }), HasSubstr("-1"));
    EXPECT_THAT(thrown_message([&] { IdData(Matrix(0, 1), Matrix(), 1.0); }), HasSubstr("no samples"));
    EXPECT_THAT(thrown_message([&] { IdData(Matrix(), good, 1.0); }), HasSubstr("output"));
    EXPECT_THAT(thrown_message([&] { IdData(good, good, Vector{{0.0, 1.0, 1.0, 2.0}}); }), HasSubstr("instant 3"));
    EXPECT_THAT(thrown_message([&] { IdData(good, good, Vector{{0.0, 1.0, 2.0}}); }), HasSubstr("time vector has 3"));
}

TEST(iddata, may_hold_inputs_alone) {  // oracle: definition
    const IdData data(Matrix(5, 0), Vector::LinSpaced(5, 1, 5), 0.5);
    EXPECT_EQ(data.output_count(), 0);
    EXPECT_EQ(data.sample_count(), 5);
    EXPECT_EQ(data.range(2, 4).experiments[0].u(0, 0), 2);
    EXPECT_THAT(thrown_message([] { IdData(Matrix(5, 0), Matrix(), 1.0); }), HasSubstr("at least one input"));
}

TEST(iddata, refuses_ranges_outside_the_record) {
    const IdData data = numbered(5);
    EXPECT_THROW(data.range(0, 3), InvalidArgument);
    EXPECT_THROW(data.range(4, 3), InvalidArgument);
    EXPECT_THROW(data.range(1, 6), InvalidArgument);
    EXPECT_THROW(data.split(0), InvalidArgument);
    EXPECT_THROW(data.split(1), InvalidArgument);
}

}  // namespace test_iddata
