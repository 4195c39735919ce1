#include "numerics/filters/delta_chain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace test_delta_chain {

using namespace dynlab;

/// 1/(delta + 1 - pole)^order without a signal.
DeltaChain chain_of(double pole, int order) {
    DeltaChain chain;
    chain.order = order;
    double binomial = 1;
    for (int j = order - 1; j >= 0; --j) {
        binomial = binomial * (j + 1) / (order - j);
        chain.alpha[static_cast<std::size_t>(j)] = binomial * std::pow(1 - pole, order - j);
    }
    return chain;
}

/// What is left after so many steps of the largest of the states that begin with X_i = (1 - pole)^i alone, each in
/// these units: |F^steps|(j, i) (1 - pole)^(i - j), sample by sample.
double left_after(const DeltaChain& chain, double pole, Index steps) {
    double left = 0;
    for (int i = 0; i < chain.order; ++i) {
        std::vector<double> x(static_cast<std::size_t>(chain.order) + 1, 0.0);
        x[static_cast<std::size_t>(i)] = std::pow(1 - pole, i);
        const auto n = static_cast<std::size_t>(chain.order);
        for (Index k = 0; k < steps; ++k) {
            x[n] = 0;
            for (std::size_t j = 0; j < n; ++j) x[n] -= chain.alpha[j] * x[j];
            for (std::size_t j = 0; j < n; ++j) x[j] += x[j + 1];
        }
        for (std::size_t j = 0; j < n; ++j)
            left = std::max(left, std::abs(x[j]) / std::pow(1 - pole, static_cast<double>(j)));
    }
    return left;
}

// oracle: definition, the states sample by sample
TEST(delta_chain, its_memory_is_as_long_as_something_is_left) {
    for (const double pole : {0.5, 0.97, 0.999})
        for (const int order : {1, 2, 4}) {
            SCOPED_TRACE("pole " + std::to_string(pole) + ", order " + std::to_string(order));
            const DeltaChain chain = chain_of(pole, order);
            const Index length = memory_length(chain, 1'000'000);
            EXPECT_LE(left_after(chain, pole, length), 1e-18);
            EXPECT_GT(left_after(chain, pole, length * 3 / 4 - 1), 1e-19) << "more steps than are needed";
        }
}

TEST(delta_chain, a_memory_is_never_longer_than_asked_for) {
    EXPECT_EQ(memory_length(chain_of(0.999, 2), 1000), 1000);
    EXPECT_EQ(memory_length(chain_of(1, 2), 1000), 1000) << "integrators forget nothing";
    for (const int order : {1, 2})
        EXPECT_EQ(memory_length(chain_of(1.2, order), 100'000), 100'000) << "what grows and overflows is not forgotten";
    EXPECT_EQ(memory_length(DeltaChain(), 1000), 0) << "no state";
}

}  // namespace test_delta_chain
