#include "platform/keys/secure_random.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <vector>

#include "support/equal_frequencies.h"

namespace dynlab {
namespace test_secure_random {

// oracle: the uniform distribution
TEST(secure_random, numbers_below_a_bound_are_equally_frequent) {
    constexpr int kDraws = 300'000;
    for (const std::size_t below : {2u, 3u, 99u, 180u}) {
        std::vector<int> counts(below);
        for (int i = 0; i < kDraws; ++i) ++counts.at(secure_below(below));
        test::expect_equal_frequencies(counts);
    }
    EXPECT_EQ(secure_below(1), 0u);
    EXPECT_THROW(secure_below(0), std::invalid_argument);
    EXPECT_THROW(secure_below(std::size_t{1} << 32), std::invalid_argument);
}

// oracle: two thirds of 2^32 do not divide it: a remainder would give the lower half twice as often as the upper one
TEST(secure_random, large_bounds_have_no_bias_of_a_remainder) {
    constexpr std::size_t kBelow = 2863311530u;
    constexpr int kDraws = 100'000;
    std::vector<int> halves(2);
    for (int i = 0; i < kDraws; ++i) ++halves[secure_below(kBelow) < kBelow / 2 ? 0 : 1];
    test::expect_equal_frequencies(halves);
}

// oracle: the 24 orders of four items, each as frequent
TEST(secure_random, shuffled_items_come_in_every_order) {
    constexpr int kDraws = 100'000;
    std::map<std::vector<int>, int> orders;
    for (int i = 0; i < kDraws; ++i) {
        std::vector<int> items = {1, 2, 3, 4};
        shuffle_items(items, secure_below);
        ++orders[items];
    }
    ASSERT_EQ(orders.size(), 24u);
    std::vector<int> counts;
    for (const auto& [order, count] : orders) counts.push_back(count);
    test::expect_equal_frequencies(counts);
}

// oracle: the draws are 0, so that each item changes places with the first one
TEST(secure_random, shuffling_uses_the_given_draws) {
    std::vector<int> items = {1, 2, 3};
    shuffle_items(items, [](std::size_t) { return std::size_t{0}; });
    EXPECT_EQ(items, (std::vector<int>{2, 3, 1}));
}

// oracle: sizes; 128 bits do not come twice
TEST(secure_random, bytes_and_digits_have_their_size) {
    EXPECT_EQ(secure_bytes(32).size(), 32u);
    EXPECT_NE(secure_bytes(16), secure_bytes(16));
    const std::string digits = secure_hex(32);
    EXPECT_EQ(digits.size(), 64u);
    EXPECT_EQ(digits.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_EQ(secure_hex(0), "");
}

}  // namespace test_secure_random
}  // namespace dynlab
