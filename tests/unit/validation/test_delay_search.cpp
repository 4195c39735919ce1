#include "numerics/validation/delay_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"

namespace test_delay_search {

using namespace dynlab;
using testing::HasSubstr;
using testing::Not;

const TransferFunction kTrap(Vector{{-4, 0.5}}, Vector{{1, 1, 4}}, 0, 8);  // a published test problem

IdData simulated_data(const TransferFunction& G, const Vector& u, double Ts, double snr, std::uint32_t seed) {
    const Vector x = lsim(G, u, Ts);
    const double sigma = std::sqrt((x.array() - x.mean()).square().mean()) * std::pow(10, -snr / 20);
    return IdData(Matrix(x + sigma * RandomStream(seed).normal(x.size())), Matrix(u), Ts);
}

TEST(delay_search, delay_trap_is_avoided_from_default_settings) {  // oracle: the simulated system
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const DelaySearch search = search_delay(simulated_data(kTrap, prbs(8, 5), 0.1, 15, seed));
        EXPECT_LT(std::abs(search.delay - 8), 4 * search.std) << message_text(search.explanation);
        EXPECT_LT(search.std, 0.1);
        EXPECT_EQ(search.candidate.poles, 2) << message_text(search.explanation);
        EXPECT_EQ(search.candidate.zeros, 1) << message_text(search.explanation);
        EXPECT_FALSE(search.rival);
    }
}

TEST(delay_search, delays_between_samples_are_found) {  // oracle: the simulated system
    const TransferFunction G(Vector{{3}}, Vector{{1, 2, 5}}, 0, 0.437);
    IdData data = simulated_data(G, prbs(7, 12), 0.05, 20, 1);
    data.time_unit = "min";
    const DelaySearch search = search_delay(data);
    EXPECT_NEAR(search.delay, 0.437, 4 * search.std);
    EXPECT_LT(search.std, 0.02);
    EXPECT_THAT(
        message_text(search.explanation),
        testing::ContainsRegex("is [0-9.]+ min \\([0-9.]+ samples\\), with a standard error of [0-9.]+ min, in"));
    // reported to the second digit of its error: no further from the value than half of that digit, and no digit more
    const std::string reported = message_text(search.explanation).substr(std::string("The delay is ").size());
    const std::string number = reported.substr(0, reported.find(' '));
    const double digit = std::pow(10, std::floor(std::log10(search.std)) - 1);
    EXPECT_LE(std::abs(std::stod(number) - search.delay), 0.501 * digit) << message_text(search.explanation);
    EXPECT_LE(number.size(), 2 + static_cast<std::size_t>(std::lround(-std::log10(digit))))
        << message_text(search.explanation);
}

TEST(delay_search, curve_is_the_loss_of_the_best_model_at_each_delay) {  // oracle: srivc with that delay fixed
    const IdData data = simulated_data(kTrap, prbs(8, 5), 0.1, 15, 1);
    DelaySearchOptions options;
    options.poles = {2, 2};
    options.zeros = {1, 1};
    const DelaySearch search = search_delay(data, options);
    Index lowest;
    search.losses().minCoeff(&lowest);
    EXPECT_NEAR(search.grid()[lowest], 8, 0.2);
    const Fit fixed = srivc(data, TransferStructure::single(2, 1, search.grid()[lowest]));
    EXPECT_NEAR(search.losses()[lowest], fixed.loss, 1e-3 * fixed.loss);
    EXPECT_LE(search.loss(), search.losses()[lowest] * (1 + 1e-9));
}

TEST(delay_search, no_delay_is_worse_than_no_model) {  // oracle: a gain of zero leaves the output itself
    const IdData data =
        simulated_data(TransferFunction(Vector{{2}}, Vector{{1, 4, 3}}, 0, 0.1), prbs(7, 8), 0.05, 8, 1);
    DelaySearchOptions options;
    options.poles = {2, 2};
    options.zeros = {0, 0};
    options.estimation.largest_delay = 5;
    const DelaySearch search = search_delay(data, options);
    EXPECT_LE(search.losses().maxCoeff(), data.experiments.front().y.squaredNorm() / 1016 * (1 + 1e-12));
    EXPECT_TRUE(search.losses().allFinite());
}

TEST(delay_search, no_delay_is_reported) {  // oracle: the simulated system has none
    const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}});
    const DelaySearch search = search_delay(simulated_data(G, prbs(7, 8), 0.05, 10, 1));
    EXPECT_LT(search.delay, 0.1);
    EXPECT_THAT(message_text(search.explanation), HasSubstr("does not differ significantly from zero"));
}

TEST(delay_search, rivals_of_periodic_inputs_are_reported) {
    // Oracle: one period of the sine later everything looks the same but the beginning, which the noise hides.
    const Vector t = Vector::LinSpaced(2000, 0, 99.95);
    const Vector u = (2 * t).array().sin();
    const IdData data = simulated_data(TransferFunction(Vector{{1}}, Vector{{0.3, 1}}, 0, 1), u, 0.05, -15, 3);
    DelaySearchOptions options;
    options.poles = {1, 1};
    options.zeros = {0, 0};
    options.estimation.largest_delay = 6;
    const DelaySearch search = search_delay(data, options);
    ASSERT_TRUE(search.rival);
    EXPECT_THAT(message_text(search.explanation), HasSubstr("nearly as well"));
}

TEST(delay_search, same_numbers_for_any_number_of_threads) {  // oracle: one thread, bit for bit
    const IdData data = simulated_data(kTrap, prbs(8, 5), 0.1, 15, 2);
    DelaySearchOptions options;
    options.poles = {1, 2};
    options.threads = 1;
    const DelaySearch one = search_delay(data, options);
    options.threads = 4;
    const DelaySearch many = search_delay(data, options);
    EXPECT_EQ(one.delay, many.delay);
    EXPECT_EQ(one.losses(), many.losses());
}

TEST(delay_search, stops_when_asked_to) {
    DelaySearchOptions options;
    options.cancel = [] { return true; };
    EXPECT_TRUE(search_delay(simulated_data(kTrap, prbs(8, 5), 0.1, 15, 1), options).canceled);
}

TEST(delay_search, refuses_what_cannot_be_searched) {
    const IdData data = simulated_data(kTrap, prbs(8, 5), 0.1, 15, 1);
    DelaySearchOptions options;
    options.estimation.least_delay = options.estimation.largest_delay.emplace(2);
    EXPECT_THAT(thrown_message([&] { search_delay(data, options); }),
                HasSubstr("`largest_delay` must be greater than `least_delay` (2 s)"));
    options.estimation.largest_delay = 1000;
    EXPECT_THROW(search_delay(data, options), InvalidArgument);
    options = {};
    options.poles = {3, 2};
    EXPECT_THROW(search_delay(data, options), InvalidArgument);
    const IdData two(Matrix(data.experiments.front().y), Matrix::Random(data.sample_count(), 2), 0.1);
    EXPECT_THAT(thrown_message([&] { search_delay(two); }), HasSubstr("one input and one output"));
}

}  // namespace test_delay_search
