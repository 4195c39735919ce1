// Oracles: the values put into the data; the system's own parameters; a second route to the same fit.
#include "numerics/fit/diagnostics.h"

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
#include "numerics/fit/integrated_input.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/transfer_cases.h"

namespace test_diagnostics {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

constexpr double kTs = 0.05;
const TransferStructure kStructure = TransferStructure::single(2, 0);

/// 3/(s^2 + 4 s + 3) with errors that are white, or that follow each other where they are `colored`.
IdData data_with(double constant, bool colored = false) {
    const Vector u = prbs(8, 6);
    Vector e = RandomStream(4).normal(u.size());
    for (Index k = 1; k < e.size() && colored; ++k) e[k] += 0.95 * e[k - 1];
    const Vector y = lsim(TransferFunction(values({3}), values({1, 4, 3})), u, kTs) + 0.03 * e;
    return IdData(Matrix(y.array() + constant), Matrix(u), kTs);
}

/// The same with a part of the input that the output follows at once.
IdData data_with_feedthrough() {
    IdData data = data_with(0);
    data.experiments[0].y += data.experiments[0].u;
    return data;
}

TEST(diagnostics, feedthrough_is_missed_by_srivc_and_coe) {
    const IdData data = data_with_feedthrough();
    for (const auto& method : {srivc, coe}) {
        const Diagnostics found = diagnose(method(data, kStructure, {}, {}), data, {});
        ASSERT_TRUE(found.missed);
        EXPECT_EQ(found.missed->code, StructureAdviceCode::kFeedthrough);
        EXPECT_EQ(found.missed->option, "zeros");
        EXPECT_EQ(found.missed->value, 2);
        ASSERT_EQ(found.warnings().size(), 1U);
        EXPECT_THAT(message_text(found.warnings()[0]), HasSubstr("With as many zeros as poles, the fit is 9"));
        const Fit better = method(data, TransferStructure::single(2, 2), {}, {});
        EXPECT_NEAR(found.missed->better_fit_percent, better.fit_percent[0], 1e-3);
        EXPECT_FALSE(diagnose(better, data, {}).missed);
    }
}

TEST(diagnostics, nothing_is_missed_of_a_record_with_an_offset) {
    const IdData data = data_with(2);
    const Diagnostics found = diagnose(srivc(data, kStructure), data, {});
    EXPECT_FALSE(found.missed);
    EXPECT_TRUE(found.warnings().empty());
    ASSERT_TRUE(found.assessment);
    EXPECT_TRUE(found.assessment->white);
}

TEST(diagnostics, assessment_sees_the_color_that_errors_were_given) {
    const IdData data = data_with(0, true);
    const Fit fit = srivc(data, kStructure);
    const Diagnostics plain = diagnose(srivc(data_with(0), kStructure), data_with(0), {}),
                      found = diagnose(fit, data, {});
    ASSERT_TRUE(plain.assessment);
    EXPECT_TRUE(plain.assessment->white);
    ASSERT_TRUE(found.assessment);
    EXPECT_FALSE(found.assessment->white);
    EXPECT_GT(found.assessment->std[2], 1.5 * fit.std[2]);
}

// Oracle: a model of the noise takes the place of the assessment.
TEST(diagnostics, rivc_is_not_assessed_and_misses_the_feedthrough) {
    const IdData data = data_with_feedthrough();
    const Diagnostics found = diagnose(rivc(data, kStructure, {0, 1}), data, {});
    EXPECT_FALSE(found.assessment);
    ASSERT_TRUE(found.missed);
    EXPECT_EQ(found.missed->code, StructureAdviceCode::kFeedthrough);
}

TEST(diagnostics, difference_equations_and_process_models_are_assessed) {
    RandomStream random(3);
    Vector u = random.normal(400), x = Vector::Zero(400);
    for (Index k = 2; k < 400; ++k) x[k] = 1.6 * x[k - 1] - 0.7 * x[k - 2] + 0.5 * u[k - 1];
    const IdData data(Matrix((x + 0.2 * random.normal(400)).array() + 2), Matrix(u), 1);
    const PolynomialOrders orders = PolynomialOrders::output_error({1}, {2}, {1});
    for (const auto& method : {oe, sriv}) {
        const Fit fit = method(data, orders, {});
        EXPECT_TRUE(fit.start.offset);
        EXPECT_TRUE(diagnose(fit, data, {}).assessment);
    }
    PolynomialOrders with_noise = orders;
    with_noise.nd = 1;
    EXPECT_TRUE(diagnose(bj(data, with_noise), data, {}).assessment);
    EXPECT_TRUE(diagnose(armax(data, PolynomialOrders::arx(2, {1}, {1})), data, {}).assessment);
    const IdData other = data_with(2);
    EXPECT_TRUE(diagnose(procsrivc(other, ProcessStructure::parse("P2")), other, {}).assessment);
}

// Oracle: the integrated data, to whose model the integrator is appended by hand.
TEST(diagnostics, integration_is_a_fit_of_the_integrated_input) {
    const Vector u = prbs(8, 6);
    const Vector y =
        lsim(TransferFunction(values({3}), values({1, 2, 0})), u, kTs) + 0.02 * RandomStream(9).normal(u.size());
    const IdData data{Matrix(y), Matrix(u), kTs};
    const TransferStructure structure = TransferStructure::single(1, 0);
    FitOptions expected;
    expected.integration = true;
    const Fit fit = srivc(data, structure, expected);
    Fit by_hand = srivc(integrated_inputs(data), structure);
    append_integrator(by_hand);
    EXPECT_EQ(fit.theta, by_hand.theta);
    EXPECT_EQ(fit.models.front().den(), by_hand.models.front().den());
    EXPECT_EQ(fit.models.front().pole_count(), 2);
    const Diagnostics found = diagnose(fit, data, expected);
    ASSERT_TRUE(found.assessment);
    EXPECT_TRUE(found.assessment->white);
    expected.offset = Offset::kRemove;
    EXPECT_THROW(srivc(data, structure, expected), InvalidArgument);
}

// Oracle: diagnose() at once; what the deferred ones hold of the data is given back when all is computed.
TEST(diagnostics, deferred_ones_are_the_same_and_let_the_data_go) {
    const auto data = std::make_shared<const IdData>(data_with_feedthrough());
    const Fit fit = srivc(*data, kStructure);
    const Diagnostics now = diagnose(fit, *data, {});
    const DeferredDiagnostics deferred(fit, data, {}), copy = deferred;
    EXPECT_EQ(data.use_count(), 2);
    ASSERT_TRUE(copy.assessment());
    EXPECT_EQ(copy.assessment()->std, now.assessment->std);
    EXPECT_EQ(copy.assessment(), deferred.assessment()) << "computed once";
    EXPECT_EQ(data.use_count(), 2);
    ASSERT_TRUE(deferred.missed());
    EXPECT_EQ(deferred.missed()->better_fit_percent, now.missed->better_fit_percent);
    EXPECT_EQ(data.use_count(), 1);
    EXPECT_FALSE(DeferredDiagnostics().missed());
    EXPECT_FALSE(DeferredDiagnostics().assessment());
    EXPECT_TRUE(DeferredDiagnostics(now).missed());
}

}  // namespace test_diagnostics
