#include "numerics/filters/delta_products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "numerics/filters/lanes.h"
#include "numerics/signals/random.h"

namespace test_delta_products {

using namespace dynlab;

using Long = long double;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

/// alpha of the polynomial with these roots in q.
std::array<double, kMaxDeltaOrder> polynomial(const std::vector<std::complex<double>>& poles) {
    std::vector<std::complex<double>> p{1};  // from delta^0 on
    for (const auto& pole : poles) {
        p.insert(p.begin(), 0);
        for (std::size_t j = 0; j + 1 < p.size(); ++j) p[j] += (1.0 - pole) * p[j + 1];
    }
    std::array<double, kMaxDeltaOrder> alpha = {};
    for (std::size_t j = 0; j + 1 < p.size(); ++j) alpha[j] = p[j].real();
    return alpha;
}

DeltaChain chain_of(const std::vector<std::complex<double>>& poles, const Vector& v, Index begin, double start) {
    DeltaChain chain;
    chain.order = static_cast<int>(poles.size());
    chain.alpha = polynomial(poles);
    for (int j = 0; j < chain.order; ++j) chain.start[static_cast<std::size_t>(j)] = start / (1 + j);
    chain.samples = v.data();
    chain.begin = begin;
    chain.count = v.size() - begin;
    return chain;
}

/// The columns as they are defined, sample by sample in 80 bits.
LongMatrix columns_of(const DeltaChain& chain, Index N) {
    const int n = chain.order;
    LongMatrix X = LongMatrix::Zero(N, n + 1);
    Eigen::Matrix<Long, Eigen::Dynamic, 1> x = Eigen::Matrix<Long, Eigen::Dynamic, 1>::Zero(n + 1);
    for (Index k = 0; k < N; ++k) {
        const Index place = k - chain.begin;
        if (place == 0)
            for (int j = 0; j < n; ++j) x[j] += static_cast<Long>(chain.start[static_cast<std::size_t>(j)]);
        x[n] = place >= 0 && place < chain.count ? static_cast<Long>(chain.samples[place]) : 0;
        for (int j = 0; j < n; ++j) x[n] -= static_cast<Long>(chain.alpha[static_cast<std::size_t>(j)]) * x[j];
        X.row(k) = x.transpose();
        for (int j = 0; j < n; ++j) x[j] += x[j + 1];
    }
    return X;
}

/// Largest difference, each relative to the norms of its two columns.
double difference(const ColumnMatrix& products, const LongMatrix& left, const LongMatrix& right) {
    const LongMatrix expected = left.transpose() * right;
    const LongMatrix scale = left.colwise().norm().transpose() * right.colwise().norm();
    return static_cast<double>(
        ((products.cast<Long>() - expected).array() / scale.array().max(static_cast<Long>(1e-300))).abs().maxCoeff());
}

/// Whether a regression wants the first chain's own products: not beside the chain of a sensitivity.
bool wants_first(const DeltaChain& first, const DeltaChain& second) {
    return first.order == 0 || second.order <= first.order + 1;
}

void expect_products(const DeltaChain& first, const DeltaChain& second, Index N, double rounding) {
    const bool own = wants_first(first, second);
    const auto products = delta_products(first, second, N, {own, true});
    ASSERT_TRUE(products);
    const LongMatrix X = columns_of(first, N), W = columns_of(second, N);
    if (own) {
        EXPECT_LT(difference(products->first, X, X), rounding);
    }
    EXPECT_LT(difference(products->both, X, W), rounding);
    EXPECT_LT(difference(products->second, W, W), rounding);
    const auto without_highest = delta_products(first, second, N, {false, false});
    ASSERT_TRUE(without_highest);
    const LongMatrix lower = W.leftCols(second.order);
    ASSERT_GE(without_highest->both.cols(), second.order);
    EXPECT_LT(difference(without_highest->both.leftCols(second.order), X, lower), rounding);
    EXPECT_LT(difference(without_highest->second.topLeftCorner(second.order, second.order), lower, lower), rounding);
}

std::vector<std::complex<double>> first_of(std::vector<std::complex<double>> poles, int count) {
    poles.resize(static_cast<std::size_t>(count));
    return poles;
}

struct Poles {
    const char* name;
    std::vector<std::complex<double>> poles;  ///< conjugate ones side by side
    double rounding = 1e-12;
};

void PrintTo(const Poles& kind, std::ostream* out) {
    *out << kind.name;
}

class delta_products_of : public testing::TestWithParam<Poles> {
  protected:
    /// Noise with a mean and a slow part.
    static Vector signal(int seed, Index N) {
        Vector v = RandomStream(static_cast<std::uint32_t>(seed)).normal(N);
        for (Index k = 0; k < N; ++k) v[k] += 1 + 2 * std::sin(0.01 * static_cast<double>(k));
        return v;
    }
};

// oracle: definition, sample by sample in 80 bits
TEST_P(delta_products_of, all_orders_are_the_definition_s) {
    const Index N = 1503;
    const Vector v = signal(1, N), w = signal(2, N);
    const auto& poles = GetParam().poles;
    for (const auto& [n1, n2] : std::vector<std::pair<int, int>>{
             {0, 2}, {1, 1}, {1, 2}, {1, 3}, {2, 2}, {2, 3}, {2, 4}, {2, 5}, {3, 3}, {3, 6}, {4, 4}, {4, 5}, {6, 6}}) {
        SCOPED_TRACE(std::to_string(n1) + " and " + std::to_string(n2) + " poles");
        expect_products(chain_of(first_of(poles, n1), v, 0, 0), chain_of(first_of(poles, n2), w, 0, 0), N,
                        GetParam().rounding);
    }
}

// oracle: the same; a signal begins anywhere, with a jump of the state: in the middle of a lane's segment, in the
// samples that are left over at the end, and after the data
TEST_P(delta_products_of, late_signals_are_the_definition_s) {
    const Index N = 1503;
    const Vector v = signal(1, N), w = signal(2, N);
    const auto& poles = GetParam().poles;
    for (const Index begin : {1, 7, 186, 187, 188, 700, 1495, 1496, 1500, 1502}) {
        SCOPED_TRACE("begins at " + std::to_string(begin));
        expect_products(chain_of(first_of(poles, 2), v, 0, 0.5), chain_of(first_of(poles, 4), w, begin, -2), N,
                        GetParam().rounding);
    }
    DeltaChain never = chain_of(first_of(poles, 4), w, 0, 1);
    never.begin = N + 5;
    const auto products = delta_products(chain_of(first_of(poles, 2), v, 0, 0), never, N, {false, true});
    ASSERT_TRUE(products);
    EXPECT_TRUE(products->both.isZero(0));
    EXPECT_TRUE(products->second.isZero(0));
}

// oracle: the same; segments that depend on the whole segment before, or only on its end
TEST_P(delta_products_of, records_of_all_lengths_are_the_definition_s) {
    const auto& poles = GetParam().poles;
    for (const Index N : {8 * Lanes::kWidth, 71, 2000, 4096, 30'011}) {
        const Vector v = signal(1, N), w = signal(2, N);
        SCOPED_TRACE(std::to_string(N) + " samples");
        for (const int second : {2, 3})
            expect_products(chain_of(first_of(poles, 1), v, 0, 0), chain_of(first_of(poles, second), w, 0, 0), N,
                            GetParam().rounding * std::max(1.0, static_cast<double>(N) / 3000));
    }
}

using Complex = std::complex<double>;
// An integrator's ramp and a signal without a mean are far from alike: differences lose what their bands differ by.
INSTANTIATE_TEST_SUITE_P(kind, delta_products_of,
                         testing::Values(Poles{"slow_and_fast", {0.99, 0.9, 0.97, 0.3, 0.95, 0.98}},
                                         Poles{"equal", {0.97, 0.97, 0.97, 0.97, 0.97, 0.97}},
                                         Poles{"resonant",
                                               {Complex(0.99, 0.1), Complex(0.99, -0.1), Complex(0.9, 0.2),
                                                Complex(0.9, -0.2), Complex(0.95, 0.01), Complex(0.95, -0.01)}},
                                         Poles{"at_zero", {0.98, 0.0, 0.9, 0.95, 0.97, 0.96}},
                                         Poles{"negative", {-0.5, 0.5, -0.9, 0.9, 0.1, -0.1}},
                                         Poles{"an_integrator", {1.0, 0.9, 0.95, 0.8, 0.7, 0.9}, 1e-11}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(delta_products, short_records_and_other_orders_are_left_to_others) {
    const Vector v = RandomStream(1).normal(1000);
    const DeltaChain two = chain_of({0.9, 0.8}, v, 0, 0), seven = chain_of({.9, .8, .7, .6, .5, .4, .3}, v, 0, 0);
    EXPECT_TRUE(delta_products(two, two, 8 * Lanes::kWidth));
    EXPECT_FALSE(delta_products(two, two, 8 * Lanes::kWidth - 1)) << "few samples";
    EXPECT_FALSE(delta_products(two, seven, 1000)) << "no such pair";
}

}  // namespace test_delta_products
