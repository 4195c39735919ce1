#include <gtest/gtest.h>

#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_lsim_properties {

using namespace dynlab;

constexpr Index kCount = 120;
constexpr double kTs = 0.1;

/// Models of orders 0 to 4, with and without feed-through, oscillation, integrator and delay.
const std::vector<TransferFunction>& models() {
    static const std::vector<TransferFunction> all = {
        TransferFunction(Vector{{2.0}}, Vector{{1.0}}, 0, 0.35),
        TransferFunction(Vector{{1.0}}, Vector{{0.8, 1}}, 0, 0.3),
        TransferFunction(Vector{{3, 1}}, Vector{{1, 2}}, 0, 0.05),
        TransferFunction(Vector{{2.0}}, Vector{{1, 4, 3}}),
        TransferFunction(Vector{{1, 2}}, Vector{{1, 0.1, 0}}, 0, 1.234),
        TransferFunction(Vector{{-6400, 1600}}, Vector{{1, 5, 408, 416, 1600}}, 0, 0.0999),
    };
    return all;
}

/// Instants without a pattern, a tenth of a second apart on average.
Vector irregular_instants() {
    RandomStream random(9);
    Vector t(kCount);
    double time = 0;
    for (double& instant : t) {
        instant = time;
        time += 0.02 + 0.16 * random.uniform();
    }
    return t;
}

void expect_close(const Vector& given, const Vector& expected, std::size_t model) {
    EXPECT_LT((given - expected).lpNorm<Eigen::Infinity>(), 1e-11 * (1 + expected.lpNorm<Eigen::Infinity>()))
        << "model " << model;
}

class lsim_properties : public testing::TestWithParam<Hold> {};

TEST_P(lsim_properties, responses_superpose) {  // oracle: linearity, also in the initial state
    RandomStream random(1);
    const Vector u = random.normal(kCount), v = random.normal(kCount), t = irregular_instants();
    for (std::size_t i = 0; i < models().size(); ++i) {
        const TransferFunction& G = models()[i];
        const Vector x = random.normal(G.pole_count()), sum = 2 * u - 3 * v;
        expect_close(lsim(G, sum, kTs, GetParam(), x),
                     2 * lsim(G, u, kTs, GetParam(), x / 2) - 3 * lsim(G, v, kTs, GetParam()), i);
        expect_close(lsim(G, sum, t, GetParam(), x),
                     2 * lsim(G, u, t, GetParam(), x / 2) - 3 * lsim(G, v, t, GetParam()), i);
    }
}

TEST_P(lsim_properties, a_later_input_gives_the_same_response_later) {  // oracle: time invariance
    // The shifted input begins with a held zero, so that a linearly interpolated input must also begin with zero.
    Vector u = RandomStream(2).normal(kCount);
    u(0) = 0;
    for (const Index shift : {1, 3, 7})
        for (std::size_t i = 0; i < models().size(); ++i) {
            Vector later = Vector::Zero(kCount);
            later.tail(kCount - shift) = u.head(kCount - shift);
            const Vector expected = lsim(models()[i], u, kTs, GetParam());
            const Vector given = lsim(models()[i], later, kTs, GetParam());
            EXPECT_EQ(given.head(shift), Vector::Zero(shift));
            expect_close(given.tail(kCount - shift), expected.head(kCount - shift), i);
        }
}

TEST_P(lsim_properties, the_clock_may_start_anywhere) {  // oracle: time invariance
    const Vector u = RandomStream(3).normal(kCount), t = irregular_instants();
    for (std::size_t i = 0; i < models().size(); ++i)
        expect_close(lsim(models()[i], u, t.array() + 16, GetParam()), lsim(models()[i], u, t, GetParam()), i);
}

TEST_P(lsim_properties, a_record_does_not_know_its_future) {  // oracle: causality
    const Vector u = RandomStream(4).normal(kCount);
    for (std::size_t i = 0; i < models().size(); ++i) {
        const Vector whole = lsim(models()[i], u, kTs, GetParam());
        for (const Index length : {1, 2, 5, 50})
            expect_close(lsim(models()[i], u.head(length), kTs, GetParam()), whole.head(length), i);
    }
}

TEST_P(lsim_properties, whole_sample_delays_only_shift) {  // oracle: time invariance
    const Vector u = RandomStream(5).normal(kCount);
    for (std::size_t i = 0; i < models().size(); ++i) {
        const TransferFunction& G = models()[i];
        const Vector now = lsim(G, u, kTs, GetParam()),
                     later = lsim(G.with_delay(G.delay() + 5 * kTs), u, kTs, GetParam());
        EXPECT_EQ(later.head(5), Vector::Zero(5));
        expect_close(later.tail(kCount - 5), now.head(kCount - 5), i);
    }
}

INSTANTIATE_TEST_SUITE_P(holds, lsim_properties, testing::Values(Hold::kZoh, Hold::kFoh),
                         [](const auto& hold) { return hold.param == Hold::kZoh ? "zoh" : "foh"; });

}  // namespace test_lsim_properties
