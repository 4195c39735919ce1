// Oracles: records made with a known cause, of random systems; the fit by the option that is told; statistics with
// fixed seeds.
#include "numerics/fit/missed_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/number_text.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "numerics/estimators/srivc.h"
#include "numerics/linalg/polynomial.h"
#include "support/transfer_cases.h"
#include "support/without_doubts.h"

namespace test_missed_options {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

/// What is planted in a record of a random system.
struct Planted {
    bool offset = false, running = false, direct = false;
    int more_poles = 0;  ///< that the fitted structure lacks
};

struct Case {
    IdData data;
    TransferStructure structure;
};

double uniform(RandomStream& random, double low, double high) {
    return low + (high - low) * random.uniform();
}

/// One to three poles between 0.05 and 0.4 per sample, real and in pairs, driven by a random telegraph signal; noise of
/// 5 to 35 dB.
Case random_case(std::uint32_t seed, const Planted& planted) {
    RandomStream random(seed);
    const int n = 1 + static_cast<int>(seed % 3);
    const int m = static_cast<int>(uniform(random, 0, n - 1e-9));
    const double Ts = 0.1;
    Vector den = Vector::Ones(1), num = Vector::Ones(1);
    for (int left = n + planted.more_poles; left > 0;) {
        const double w = uniform(random, 0.5, 4), zeta = uniform(random, 0.1, 0.9);
        const bool pair = left > 1 && random.uniform() < 0.5;
        den = multiply(den, pair ? values({1, 2 * zeta * w, w * w}) : values({1, w}));
        left -= pair ? 2 : 1;
    }
    for (int zero = 0; zero < m; ++zero) num = multiply(num, values({1, uniform(random, 1, 6)}));
    num *= den[den.size() - 1] / num[num.size() - 1];
    if (planted.direct) {
        Vector direct = uniform(random, 0.4, 1) * den;
        direct.tail(num.size()) += num;
        num = direct;
    }
    const Index N = 200 + static_cast<Index>(uniform(random, 0, 1800)), before = planted.running ? 60 : 0;
    Vector u(N + before);
    double level = 1;
    for (double& value : u) {
        if (uniform(random, 0, 1) < 0.12) level = -level;
        value = level;
    }
    Vector y = lsim(TransferFunction(num, den), u, Ts).tail(N);
    const double spread = std::sqrt((y.array() - y.mean()).square().mean());
    const double noise = spread * std::pow(10, -uniform(random, 5, 35) / 20);
    y += noise * random.normal(N);
    if (planted.offset) y.array() += uniform(random, 0.6, 3) * spread;
    if (planted.running) {  // the input before the record was four higher
        Vector more = Vector::Zero(N + before);
        more.head(before).setConstant(4);
        y += lsim(TransferFunction(num, den), more, Ts).tail(N);
    }
    return {IdData(Matrix(y), Matrix(u.tail(N)), Ts), TransferStructure::single(n, m)};
}

std::optional<MissedOption> missed_of(const Case& made) {
    const FitOptions options = without_doubts();
    return missed_option(made.data, srivc(made.data, made.structure, options), options);
}

/// Of ten cases, of how many a missed option is found that is `wanted`.
int missed_in(const Planted& planted, bool (*wanted)(const MissedOption&)) {
    int count = 0;
    for (std::uint32_t seed = 1000; seed < 1010; ++seed) {
        const auto missed = missed_of(random_case(seed, planted));
        count += missed && wanted(*missed) ? 1 : 0;
    }
    return count;
}

bool is_offset(const MissedOption& missed) {
    return !missed.feedthrough && missed.start.offset && missed.start.state == InitialState::kZero;
}
bool is_start(const MissedOption& missed) {
    return !missed.feedthrough && !missed.start.offset && missed.start.state != InitialState::kZero;
}
bool has_offset(const MissedOption& missed) {
    return !missed.feedthrough && missed.start.offset;
}
bool is_feedthrough(const MissedOption& missed) {
    return missed.feedthrough;
}

TEST(missed_options, nothing_is_told_of_records_from_rest) {
    int alarms = 0;
    std::string sentences;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const auto missed = missed_of(random_case(seed, {}));
        if (!missed) continue;
        ++alarms;
        sentences += message_text(sentence_of(*missed)) + "\n";
    }
    EXPECT_LE(alarms, 1) << sentences;
}

TEST(missed_options, constants_are_told) {
    EXPECT_GE(missed_in({.offset = true}, is_offset), 9);
}

TEST(missed_options, running_starts_are_told) {
    EXPECT_GE(missed_in({.running = true}, is_start), 9);
}

TEST(missed_options, both_are_told) {
    EXPECT_GE(missed_in({.offset = true, .running = true}, has_offset), 9);
}

TEST(missed_options, direct_feedthroughs_are_told) {
    EXPECT_GE(missed_in({.direct = true}, is_feedthrough), 9);
}

TEST(missed_options, missing_poles_are_no_feedthrough) {
    EXPECT_EQ(missed_in({.more_poles = 1}, is_feedthrough), 0);
}

// Oracle: the fit that the option leads to, made as a user would make it.
TEST(missed_options, the_fit_that_is_told_is_the_one_that_is_reached) {
    const Case made = random_case(7, {.offset = true});
    FitOptions with_offset;
    with_offset.offset = Offset::kEstimate;
    const Fit given = coe(made.data, made.structure), better = coe(made.data, made.structure, with_offset);
    const auto missed = missed_option(made.data, given, {});
    ASSERT_TRUE(missed);
    EXPECT_TRUE(missed->start.offset);
    EXPECT_NEAR(missed->better_fit_percent, better.fit_percent[0], 1e-3);
    EXPECT_NEAR(missed->fit_percent, given.fit_percent[0], 1e-9);
    EXPECT_THAT(message_text(sentence_of(*missed)),
                HasSubstr("the fit is " + number_text(better.fit_percent[0], 4) + " % instead of " +
                          number_text(given.fit_percent[0], 4) + " %: the output stands on a constant"));
    EXPECT_FALSE(missed_option(made.data, better, with_offset));
}

// Oracle: the same record with one output more, which has nothing to tell.
TEST(missed_options, of_several_outputs_the_one_is_named) {
    const Case made = random_case(7, {.offset = true});
    const Vector& u = made.data.experiments[0].u.col(0);
    Matrix y(u.size(), 2);
    y.col(0) =
        lsim(TransferFunction(values({2}), values({1, 2})), u, made.data.Ts) + 0.05 * RandomStream(3).normal(u.size());
    y.col(1) = made.data.experiments[0].y.col(0);
    const IdData both(y, Matrix(u), made.data.Ts);
    const auto structure = TransferStructure::grid(2, 1, Denominators::kPerChannel, {2}, {0}, {0});
    const auto missed = missed_option(both, srivc(both, structure), {});
    ASSERT_TRUE(missed);
    EXPECT_EQ(missed->output, both.output_names[1]);
    EXPECT_THAT(message_text(sentence_of(*missed)), HasSubstr("the fit of " + both.output_names[1] + " is"));
}

// Oracle: an offset in a long record, of which only the beginning is fitted anew.
TEST(missed_options, of_a_long_record_its_beginning) {
    const Index N = 120'000;
    RandomStream random(5);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = k % 20 == 0 || k == 0 ? random.normal() : u[k - 1];
    Vector y = lsim(TransferFunction(values({3}), values({1, 3})), u, 0.1) + 0.1 * random.normal(N);
    const auto structure = TransferStructure::single(1, 0);
    EXPECT_FALSE(missed_of({IdData(Matrix(y), Matrix(u), 0.1), structure}));
    y.array() += 1;
    const auto missed = missed_of({IdData(Matrix(y), Matrix(u), 0.1), structure});
    ASSERT_TRUE(missed);
    EXPECT_TRUE(is_offset(*missed));
    EXPECT_THAT(message_text(sentence_of(*missed)),
                HasSubstr("With `offset` = \"estimate\" the fit of the first 100000 samples is"));
}

/// y = B/F u and white noise; cut from a record that ran before where it is `running`.
IdData sampled_case(std::uint32_t seed, bool offset, bool running) {
    RandomStream random(seed);
    const Index before = running ? 4 : 0, N = 300 + before;
    Vector u(N), x(N);
    for (Index k = 0; k < N; ++k) {
        u[k] = random.normal();
        x[k] = (k > 0 ? 1.6 * x[k - 1] + 0.5 * u[k - 1] : running ? 12 : 0) - (k > 1 ? 0.7 * x[k - 2] : 0);
    }
    const Vector y = x + 0.2 * random.normal(N) + Vector::Constant(N, offset ? 2 : 0);
    return IdData(Matrix(y.tail(300)), Matrix(u.tail(300)), 1);
}

int missed_in_sampled(bool offset, bool running, bool (*wanted)(const MissedOption&)) {
    int count = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed)
        for (const auto& method : {oe, sriv}) {
            const IdData data = sampled_case(seed, offset, running);
            const PolynomialOrders orders = PolynomialOrders::output_error({1}, {2}, {1});
            const auto again = [&](const FitOptions& options) { return method(data, orders, options); };
            const FitOptions plain = without_doubts();
            const auto missed = missed_discrete_option(data, again(plain), plain, again);
            count += missed && wanted(*missed) ? 1 : 0;
        }
    return count;
}

// Oracle: what was put into the records, 20 of each for oe and for sriv.
TEST(missed_options, of_difference_equations_constants_and_starts_are_told) {
    const auto any = [](const MissedOption&) { return true; };
    const auto estimated_start = [](const MissedOption& missed) {
        return is_start(missed) && missed.start.state == InitialState::kEstimate;
    };
    const auto both = [](const MissedOption& missed) {
        return has_offset(missed) && missed.start.state == InitialState::kEstimate;
    };
    EXPECT_EQ(missed_in_sampled(false, false, any), 0);
    EXPECT_GE(missed_in_sampled(true, false, is_offset), 38);
    EXPECT_GE(missed_in_sampled(false, true, estimated_start), 38);
    EXPECT_GE(missed_in_sampled(true, true, both), 38);
}

// Oracle: the fit that the option leads to, made as a user would make it.
TEST(missed_options, of_difference_equations_the_fit_that_is_told_is_reached) {
    const IdData data = sampled_case(3, true, false);
    const PolynomialOrders orders = PolynomialOrders::output_error({1}, {2}, {1});
    FitOptions with_offset;
    with_offset.offset = Offset::kEstimate;
    const Fit given = oe(data, orders), better = oe(data, orders, with_offset);
    const auto again = [&](const FitOptions& options) { return oe(data, orders, options); };
    const auto missed = missed_discrete_option(data, given, {}, again);
    ASSERT_TRUE(missed);
    EXPECT_THAT(message_text(sentence_of(*missed)),
                HasSubstr("the fit is " + number_text(better.fit_percent[0], 4) + " % instead of " +
                          number_text(given.fit_percent[0], 4) + " %: the output stands on a constant"));
    EXPECT_FALSE(missed_discrete_option(data, better, with_offset, again));
}

}  // namespace test_missed_options
