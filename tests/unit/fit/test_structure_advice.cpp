// Oracles: data made with a known cause, of random systems; the fit by the structure that is named; statistics with
// fixed seeds.
#include "numerics/fit/structure_advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/number_text.h"
#include "base/reader.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/srivc.h"
#include "numerics/linalg/polynomial.h"
#include "support/transfer_cases.h"

namespace test_structure_advice {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

/// The defects planted in the data of a random system.
struct Planted {
    bool offset = false, running = false, direct = false, late = false;
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
    if (planted.late) {
        constexpr Index kLate = 7;
        const Vector early = y;
        y.tail(N - kLate) = early.head(N - kLate);
        y.head(kLate) = noise * random.normal(kLate);
    }
    if (planted.offset) y.array() += uniform(random, 0.6, 3) * spread;
    if (planted.running) {  // the input before the data was four higher
        Vector more = Vector::Zero(N + before);
        more.head(before).setConstant(4);
        y += lsim(TransferFunction(num, den), more, Ts).tail(N);
    }
    return {IdData(Matrix(y), Matrix(u.tail(N)), Ts), TransferStructure::single(n, m)};
}

std::optional<StructureAdvice> missed_of(const Case& made) {
    return missed_structure(made.data, srivc(made.data, made.structure), {});
}

/// Of ten cases, of how many this is missed.
int missed_in(const Planted& planted, StructureAdviceCode code) {
    int count = 0;
    for (std::uint32_t seed = 1000; seed < 1010; ++seed) {
        const auto missed = missed_of(random_case(seed, planted));
        count += missed && missed->code == code ? 1 : 0;
    }
    return count;
}

int alarms(const Planted& planted, std::uint32_t data_sets, std::string& sentences) {
    int count = 0;
    for (std::uint32_t seed = 0; seed < data_sets; ++seed) {
        const auto missed = missed_of(random_case(seed, planted));
        if (!missed) continue;
        ++count;
        sentences += message_text(sentence_of(*missed)) + "\n";
    }
    return count;
}

TEST(structure_advice, nothing_is_missed_by_true_structures_from_rest) {
    std::string sentences;
    EXPECT_LE(alarms({}, 200, sentences), 1) << sentences;
}

TEST(structure_advice, nothing_is_missed_by_true_structures_with_other_starts) {
    std::string sentences;
    EXPECT_LE(alarms({.offset = true, .running = true}, 60, sentences), 1) << sentences;
}

TEST(structure_advice, direct_feedthroughs_are_found) {
    EXPECT_GE(missed_in({.direct = true}, StructureAdviceCode::kFeedthrough), 9);
}

TEST(structure_advice, missing_poles_are_no_feedthrough) {
    EXPECT_EQ(missed_in({.more_poles = 1}, StructureAdviceCode::kFeedthrough), 0);
}

TEST(structure_advice, delays_are_found) {
    EXPECT_GE(missed_in({.late = true}, StructureAdviceCode::kDelay), 8);
}

TEST(structure_advice, an_input_that_was_logged_late_is_named) {  // oracle: the column shifted by us
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        Vector u = RandomStream(seed).normal(601);
        for (Index k = 0; k < u.size(); ++k) u[k] = u[k - k % 8] > 0 ? 1 : -1;
        const Vector y = lsim(TransferFunction(values({30}), values({1, 6, 30})), u, 0.05) +
                         0.02 * RandomStream(seed + 100).normal(601);
        const auto structure = TransferStructure::single(2, 0);
        const IdData late{Matrix(y.tail(600)), Matrix(u.head(600)), 0.05};
        const auto missed = missed_of({late, structure});
        ASSERT_TRUE(missed) << seed;
        EXPECT_EQ(missed->code, StructureAdviceCode::kLate) << seed;
        EXPECT_NEAR(missed->better_fit_percent, srivc(late.shifted(-1), structure).fit_percent[0], 0.01) << seed;
        EXPECT_THAT(message_text(sentence_of(*missed)), HasSubstr("data:shift(-1)")) << seed;
    }
    for (const Planted& other : {Planted{.direct = true}, Planted{.late = true}, Planted{.more_poles = 1}})
        EXPECT_EQ(missed_in(other, StructureAdviceCode::kLate), 0) << other.direct << other.late;
}

// Oracle: the fit that the structure leads to, made as a user would make it.
TEST(structure_advice, missing_pole_is_named_with_the_fit_that_is_reached) {
    const Vector u = prbs(8, 8);
    const Vector y =
        lsim(TransferFunction(values({4}), values({1, 0.6, 4})), u, 0.1) + 0.02 * RandomStream(6).normal(u.size());
    const IdData data(Matrix(y), Matrix(u), 0.1);
    const Fit given = coe(data, TransferStructure::single(1, 0)), better = coe(data, TransferStructure::single(2, 0));
    const auto missed = missed_structure(data, given, {});
    ASSERT_TRUE(missed);
    EXPECT_EQ(missed->code, StructureAdviceCode::kPole);
    EXPECT_EQ(missed->option, "poles");
    EXPECT_EQ(missed->value, 2);
    EXPECT_NEAR(missed->better_fit_percent, better.fit_percent[0], 1e-3);
    EXPECT_NEAR(missed->fit_percent, given.fit_percent[0], 1e-9);
    EXPECT_EQ(message_text(sentence_of(*missed)),
              "With one more pole, the fit is " + number_text(better.fit_percent[0], 4) + " % instead of " +
                  number_text(given.fit_percent[0], 4) +
                  " %: the residuals of the current model are correlated with the input.");
    EXPECT_FALSE(missed_structure(data, better, {}));
}

// Oracle: the same data with an additional output, whose model is complete.
TEST(structure_advice, of_several_outputs_the_one_is_named) {
    const Case made = random_case(1003, {.direct = true});
    const Vector& u = made.data.experiments[0].u.col(0);
    Matrix y(u.size(), 2);
    y.col(0) =
        lsim(TransferFunction(values({2}), values({1, 2})), u, made.data.Ts) + 0.05 * RandomStream(3).normal(u.size());
    y.col(1) = made.data.experiments[0].y.col(0);
    const IdData both(y, Matrix(u), made.data.Ts);
    const int n = made.structure.poles[0], m = made.structure.channels[0].zeros;
    const auto structure = TransferStructure::grid(2, 1, Denominators::kPerChannel, {1, n}, {0, m}, {0});
    const auto missed = missed_structure(both, srivc(both, structure), {});
    ASSERT_TRUE(missed);
    EXPECT_EQ(missed->output, both.output_names[1]);
    EXPECT_THAT(message_text(sentence_of(*missed)), HasSubstr("the fit of " + both.output_names[1] + " is"));
}

// Oracle: a feedthrough in long data, of which only the beginning is fitted again.
TEST(structure_advice, of_a_long_record_its_beginning) {
    const Index N = 120'000;
    RandomStream random(5);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = k % 20 == 0 || k == 0 ? random.normal() : u[k - 1];
    Vector y = lsim(TransferFunction(values({3}), values({1, 3})), u, 0.1) + 0.1 * random.normal(N);
    const auto structure = TransferStructure::single(1, 0);
    EXPECT_FALSE(missed_of({IdData(Matrix(y), Matrix(u), 0.1), structure}));
    y += u;
    const auto missed = missed_of({IdData(Matrix(y), Matrix(u), 0.1), structure});
    ASSERT_TRUE(missed);
    EXPECT_EQ(missed->code, StructureAdviceCode::kFeedthrough);
    EXPECT_EQ(missed->samples, 100'000);
    EXPECT_THAT(message_text(sentence_of(*missed)),
                HasSubstr("With as many zeros as poles, the fit of the first 100000 samples is"));
}

TEST(structure_advice, a_drift_is_named_before_a_feedthrough) {  // oracle: the line put in, and the fit without it
    const Vector u = prbs(8, 6).head(1500), x = lsim(TransferFunction(values({2}), values({1, 1.4, 2})), u, 0.1);
    const IdData data(Matrix(x + Vector::LinSpaced(1500, 0, 3) + 0.1 * RandomStream(2).normal(1500)), Matrix(u), 0.1);
    FitOptions stable;
    stable.stable = true;
    for (const FitOptions& options : {FitOptions{}, stable}) {
        const Fit fit = coe(data, TransferStructure::single(2, 0), options);
        const auto missed = missed_structure(data, fit, options);
        ASSERT_TRUE(missed) << message_text(fit.full_message());
        EXPECT_EQ(missed->code, StructureAdviceCode::kLine) << message_text(sentence_of(*missed));
        EXPECT_THAT(message_text(sentence_of(*missed)), HasSubstr("detrend"));
    }
}

}  // namespace test_structure_advice
