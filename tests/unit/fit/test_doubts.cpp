// Oracles: what was put into the records; the system's own parameters; a second route to the same fit.
#include "numerics/fit/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/estimators/armax.h"
#include "numerics/estimators/bj.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/rivc.h"
#include "numerics/estimators/sriv.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/assessment.h"
#include "numerics/fit/integrated_input.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/message_texts.h"
#include "support/transfer_cases.h"
#include "support/without_doubts.h"

namespace test_doubts {

using namespace dynlab;
using namespace dynlab::test;
using testing::EndsWith;
using testing::HasSubstr;

constexpr double kTs = 0.05;
const TransferStructure kStructure = TransferStructure::single(2, 0);

/// 3/(s^2 + 4 s + 3) with errors that are white, or that follow each other where they are `coloured`.
IdData record_with(double constant, bool coloured = false) {
    const Vector u = prbs(8, 6);
    Vector e = RandomStream(4).normal(u.size());
    for (Index k = 1; k < e.size() && coloured; ++k) e[k] += 0.95 * e[k - 1];
    const Vector y = lsim(TransferFunction(values({3}), values({1, 4, 3})), u, kTs) + 0.03 * e;
    return IdData(Matrix(y.array() + constant), Matrix(u), kTs);
}

TEST(doubts, offset_in_the_record_is_a_missed_option_of_srivc_and_coe) {
    const IdData data = record_with(2);
    for (const auto& method : {srivc, coe}) {
        const Fit fit = method(data, kStructure, {}, {});
        ASSERT_TRUE(fit.doubts.missed_option);
        EXPECT_TRUE(fit.doubts.missed_option->start.offset);
        EXPECT_EQ(fit.doubts.missed_option->start.state, InitialState::kZero);
        EXPECT_FALSE(fit.doubts.missed_option->feedthrough);
        EXPECT_THAT(texts_of(fit.warnings), testing::Contains(HasSubstr("With `offset` = \"estimate\" the fit is 9")));
        EXPECT_THAT(message_text(fit.full_message()), EndsWith(message_text(fit.warnings.back())));
        FitOptions with_offset;
        with_offset.offset = Offset::kEstimate;
        const Fit better = method(data, kStructure, with_offset, {});
        EXPECT_NEAR(fit.doubts.missed_option->better_fit_percent, better.fit_percent[0], 1e-3);
        EXPECT_NEAR(better.offsets(0, 0), 2, 0.02);
        EXPECT_FALSE(better.doubts.missed_option);
    }
    EXPECT_FALSE(srivc(record_with(0), kStructure).doubts.missed_option);
}

TEST(doubts, start_that_is_given_is_not_questioned) {
    FitOptions given;
    given.start_is_given = true;
    const Fit fit = srivc(record_with(2), kStructure, given);
    EXPECT_FALSE(fit.doubts.missed_option);
    EXPECT_TRUE(fit.doubts.assessment);
}

TEST(doubts, assessment_sees_the_colour_that_errors_were_given) {
    const Fit plain = srivc(record_with(0), kStructure), fit = srivc(record_with(0, true), kStructure);
    ASSERT_TRUE(plain.doubts.assessment);
    EXPECT_TRUE(plain.doubts.assessment->white);
    ASSERT_TRUE(fit.doubts.assessment);
    EXPECT_FALSE(fit.doubts.assessment->white);
    EXPECT_GT(fit.doubts.assessment->std[2], 1.5 * fit.std[2]);
}

// Oracle: a model of the noise takes the place of the assessment.
TEST(doubts, rivc_is_not_assessed_and_misses_the_offset) {
    const Fit fit = rivc(record_with(2), kStructure, {0, 1});
    EXPECT_FALSE(fit.doubts.assessment);
    ASSERT_TRUE(fit.doubts.missed_option);
    EXPECT_TRUE(fit.doubts.missed_option->start.offset);
}

// Oracle: the record of a difference equation with a constant, of which only fits of the simulation are asked.
TEST(doubts, offset_in_a_sampled_record_is_a_missed_option_of_oe_and_sriv) {
    RandomStream random(3);
    Vector u = random.normal(400), x = Vector::Zero(400);
    for (Index k = 2; k < 400; ++k) x[k] = 1.6 * x[k - 1] - 0.7 * x[k - 2] + 0.5 * u[k - 1];
    const IdData data(Matrix((x + 0.2 * random.normal(400)).array() + 2), Matrix(u), 1);
    const PolynomialOrders orders = PolynomialOrders::output_error({1}, {2}, {1});
    for (const auto& method : {oe, sriv}) {
        const Fit fit = method(data, orders, {});
        ASSERT_TRUE(fit.doubts.missed_option);
        EXPECT_TRUE(fit.doubts.missed_option->start.offset);
        EXPECT_TRUE(fit.doubts.assessment);
    }
    PolynomialOrders with_noise = orders;
    with_noise.nd = 1;
    const Fit noisy = bj(data, with_noise);
    EXPECT_FALSE(noisy.doubts.missed_option);
    EXPECT_TRUE(noisy.doubts.assessment);
    PolynomialOrders equation = PolynomialOrders::arx(2, {1}, {1});
    const Fit equation_fit = armax(data, equation);
    EXPECT_FALSE(equation_fit.doubts.missed_option);
    EXPECT_TRUE(equation_fit.doubts.assessment);
}

// Oracle: the same estimate, of which nothing is asked.
TEST(doubts, fits_of_studies_are_the_same_without_doubts) {
    const IdData data = record_with(2);
    const auto expect_bare = [](const Fit& with, const Fit& bare) {
        EXPECT_EQ(with.theta, bare.theta);
        EXPECT_EQ(with.covariance, bare.covariance);
        EXPECT_FALSE(bare.doubts.missed_option);
        EXPECT_FALSE(bare.doubts.assessment);
    };
    expect_bare(srivc(data, kStructure), srivc(data, kStructure, without_doubts()));
    expect_bare(procsrivc(data, ProcessStructure::parse("P2")),
                procsrivc(data, ProcessStructure::parse("P2"), without_doubts<ProcsrivcOptions>()));
    EXPECT_TRUE(procsrivc(data, ProcessStructure::parse("P2")).doubts.assessment);
}

// Oracle: the integrated record, to whose model the integrator is appended by hand.
TEST(doubts, integration_is_a_fit_of_the_integrated_input) {
    const Vector u = prbs(8, 6);
    const Vector y =
        lsim(TransferFunction(values({3}), values({1, 2, 0})), u, kTs) + 0.02 * RandomStream(9).normal(u.size());
    const IdData data{Matrix(y), Matrix(u), kTs};
    const TransferStructure structure = TransferStructure::single(1, 0);
    FitOptions wanted;
    wanted.integration = true;
    const Fit fit = srivc(data, structure, wanted);
    Fit by_hand = srivc(integrated_inputs(data), structure, without_doubts());
    append_integrator(by_hand);
    EXPECT_EQ(fit.theta, by_hand.theta);
    EXPECT_EQ(fit.models.front().den(), by_hand.models.front().den());
    EXPECT_EQ(fit.models.front().pole_count(), 2);
    ASSERT_TRUE(fit.doubts.assessment);
    EXPECT_TRUE(fit.doubts.assessment->white);
    wanted.offset = Offset::kRemove;
    EXPECT_THROW(srivc(data, structure, wanted), InvalidArgument);
}

}  // namespace test_doubts
