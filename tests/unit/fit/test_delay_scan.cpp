// Oracles: fits at fixed delays, and the delays of the data.
#include "numerics/fit/delay_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/reader.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/signals/random.h"
#include "support/transfer_cases.h"

namespace test_delay_scan {

using namespace dynlab;
using namespace dynlab::test;

// Oracle: the joint search at every fixed delay. Far from the true delay several minima lie close together.
TEST(delay_scan, loss_over_the_delay_is_that_of_fixed_delays) {
    const IdData data = delayed_data();
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    FitOptions options;
    options.largest_delay = 3;
    const DelayScan scan = scan_delays(data, structure, options);
    ASSERT_GT(scan.delays.size(), 25);
    for (Index i = 0; i < scan.delays.size(); i += 4) {
        const double fixed =
            search_transfer("test", data, TransferStructure::single(2, 0, scan.delays[i]), FitOptions().from_rest())
                .loss;
        EXPECT_LT(scan.losses[i], 1.03 * fixed) << scan.delays[i];
        EXPECT_GT(scan.losses[i], 0.999 * fixed) << scan.delays[i];
    }
}

// Oracle: the delay of the data.
TEST(delay_scan, the_range_of_delays_grows_until_the_delay_is_in_it) {
    const Index N = 600;
    Vector u = Vector::Zero(N);
    u.tail(N - 10).setOnes();
    const Vector y =
        lsim(TransferFunction(values({1}), values({1, 0.5}), 0, 7.3), u, 0.1) + 0.02 * RandomStream(5).normal(N);
    const IdData data{Matrix(y), Matrix(u), 0.1};
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    const Fit fit = search_transfer("test", data, structure, {});
    EXPECT_NEAR(fit.theta[2], 7.3, 0.05);
}

// Oracle: the beginning that is scanned has 50,000 samples, of which no delay may be longer than a quarter.
TEST(delay_scan, delays_stay_within_the_part_of_a_long_record_that_is_scanned) {
    const Index N = 400'000;
    Vector u = Vector::Ones(N);
    u.head(100).setZero();
    const Vector y =
        lsim(TransferFunction(values({1}), values({1, 0.5}), 0, 2.3), u, 0.1) + 0.02 * RandomStream(6).normal(N);
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    const DelayScan scan = scan_delays(IdData{Matrix(y), Matrix(u), 0.1}, structure, {});
    EXPECT_LE(scan.largest, 50'000 * 0.1 / 4);
    EXPECT_NEAR(scan.starts.front()[2], 2.3, 0.3);
}

/// A pole and a delay (s) behind a binary input that rests up to a sample, at irregular instants.
IdData irregular_data(double delay, Index rest) {
    const Index N = 3100;
    RandomStream random(9);
    Vector t = Vector::Zero(N), u = prbs(12, 5).head(N);
    for (Index k = 1; k < N; ++k) t[k] = t[k - 1] + 0.01 + 0.08 * random.uniform();
    u.head(rest).setZero();
    const Vector x = lsim(TransferFunction(values({1}), values({1, 0.5}), 0, delay), u, t);
    return {x + 0.02 * random.normal(N), u, t};
}

// Oracle: the delays of the data. The beginning shows the delay of the first data set. The delay of the second is
// longer than a quarter of the beginning. In the third, nothing moves in the beginning.
TEST(delay_scan, the_beginning_of_an_irregular_record_is_scanned_where_it_represents_the_whole) {
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    for (const auto& [delay, rest] : {std::pair{1.3, 0}, std::pair{27.0, 0}, std::pair{1.3, 1600}}) {
        const IdData data = irregular_data(delay, rest);
        const DelayScan scan = scan_delays(data, structure, {});
        EXPECT_NEAR(scan.starts.front()[2], delay, 0.1) << rest;
        EXPECT_NEAR(search_transfer("test", data, structure, {}).theta[2], delay, 0.02) << rest;
    }
}

/// White noise, late at the output by so many samples, with as much noise.
IdData late_data(Index samples, Index delay, std::uint32_t seed) {
    RandomStream random(seed);
    const Vector u = random.normal(samples);
    Vector y = random.normal(samples);
    if (delay < samples) y.tail(samples - delay) += u.head(samples - delay);
    return IdData(Matrix(y), Matrix(u), 0.1);
}

TEST(delay_scan, later_response_is_found_beyond_the_range_only) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const IdData data = late_data(400, 150, seed);
        const std::optional<double> later = later_response(data, 0, 0, 2);
        ASSERT_TRUE(later);
        EXPECT_NEAR(*later, 15, 1e-9);
        EXPECT_FALSE(later_response(data, 0, 0, 16));
        EXPECT_FALSE(later_response(late_data(400, 400, seed), 0, 0, 2)) << seed;  // no response at all
    }
}

TEST(delay_scan, delay_beyond_the_range_is_a_warning_with_the_option) {
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    const IdData data = late_data(400, 150, 3);
    EXPECT_THAT(message_text(search_transfer("test", data, structure, {}).full_message()),
                testing::HasSubstr("The output responds about 15 s after the input, beyond the limit of the search "
                                   "(`largest_delay` = "));
    FitOptions wide;
    wide.largest_delay = 18;
    const Fit found = search_transfer("test", data, structure, wide);
    EXPECT_NEAR(found.models.front().delay(), 15, 0.2);
    EXPECT_THAT(message_text(found.full_message()), testing::Not(testing::HasSubstr("beyond the limit")));
}

}  // namespace test_delay_scan
