#include "numerics/validation/intervals/bootstrap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/simulation/noise.h"
#include "support/thrown_message.h"

namespace test_bootstrap {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;

/// 2/(s + 1.5) with errors of that size, through 1/(1 - color q^-1).
RefittedOutput model(double noise, double color = 0, std::uint32_t seed = 1) {
    const Vector u = prbs(5, 6);
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 1.5}});
    RandomStream random(seed);
    const ColoredNoise errors{Vector::Ones(1), Vector{{1.0, -color}}};
    const Vector y = lsim(G, u, 0.1) + errors.draw(u.size(), noise, random);
    return RefittedOutput(IdData(Matrix(y), Matrix(u), 0.1), {TransferStructure::single(1, 0), {}, Vector{{1.5, 2}}});
}

BootstrapOptions kind(BootstrapKind expected, int runs = 400) {
    BootstrapOptions options;
    options.kind = expected;
    options.runs = runs;
    return options;
}

TEST(bootstrap, agrees_with_the_covariance_where_that_holds) {  // oracle: linear theory; 400 runs: 3.5 % each
    const RefittedOutput one = model(0.05);
    const Fit fit = one.fit();
    for (const BootstrapKind expected : {BootstrapKind::kResidual, BootstrapKind::kParametric}) {
        const Bootstrap found = bootstrap(one, kind(expected));
        EXPECT_THAT(found.names, ElementsAre("a1", "b0", "gain", "T1"));
        EXPECT_LT((found.estimate.head(2) - fit.theta).cwiseAbs().maxCoeff(), 1e-12);
        for (Index i = 0; i < 2; ++i) {
            EXPECT_NEAR(found.std[i] / fit.std[i], 1, 0.12);
            EXPECT_NEAR((found.high[i] - found.low[i]) / (2 * 1.96 * fit.std[i]), 1, 0.15);
        }
        // T = 1/a1, gain = b0/a1, run by run
        EXPECT_LT((found.values.col(3) - found.values.col(0).cwiseInverse()).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((found.values.col(2) - found.values.col(1).cwiseQuotient(found.values.col(0))).cwiseAbs().maxCoeff(),
                  1e-9);
        EXPECT_TRUE(found.warnings.empty()) << message_text(found.message);
    }
}

TEST(bootstrap, is_the_same_for_every_number_of_threads) {  // oracle: one thread
    const RefittedOutput one = model(0.1);
    BootstrapOptions options = kind(BootstrapKind::kResidual, 30), alone = options;
    alone.threads = 1;
    EXPECT_EQ(bootstrap(one, options).values, bootstrap(one, alone).values);
    options.seed = 31;
    EXPECT_NE(bootstrap(one, options).values, bootstrap(one, alone).values);
}

TEST(bootstrap, colors_its_errors_where_the_record_does) {  // oracle: scatter over 200 data sets with such errors
    const int data_sets = 200;
    Vector estimates(data_sets);
    for (int k = 0; k < data_sets; ++k)
        estimates[k] = model(0.05, 0.9, static_cast<std::uint32_t>(k + 10)).fit().theta[0];
    const double scatter = std::sqrt((estimates.array() - estimates.mean()).square().mean());
    double parametric = 0, residual = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const RefittedOutput one = model(0.05, 0.9, seed);
        parametric += bootstrap(one, kind(BootstrapKind::kParametric, 60)).std[0] / 10;
        const Bootstrap plain = bootstrap(one, kind(BootstrapKind::kResidual, 60));
        residual += plain.std[0] / 10;
        EXPECT_THAT(message_text(plain.message), HasSubstr("not white"));
    }
    EXPECT_NEAR(parametric / scatter, 1, 0.3);
    EXPECT_LT(residual, 0.6 * scatter);
}

TEST(bootstrap, knows_pairs_of_poles) {  // oracle: w0 = 2, zeta = 0.3 put in
    const Vector u = prbs(6, 8);
    const TransferFunction G(Vector{{4.0}}, Vector{{1.0, 1.2, 4.0}});
    const Vector y = lsim(G, u, 0.1) + 0.02 * RandomStream(1).normal(u.size());
    const RefittedOutput one(IdData(Matrix(y), Matrix(u), 0.1),
                             {TransferStructure::single(2, 0), {}, Vector{{1.2, 4, 4}}});
    const Bootstrap found = bootstrap(one, kind(BootstrapKind::kResidual, 50));
    EXPECT_THAT(found.names, ElementsAre("a1", "a2", "b0", "gain", "w1", "zeta1"));
    EXPECT_NEAR(found.mean[4], 2, 0.05);
    EXPECT_NEAR(found.mean[5], 0.3, 0.02);
}

TEST(bootstrap, can_be_stopped) {
    BootstrapOptions options = kind(BootstrapKind::kResidual, 100);
    int asked = 0;
    options.cancel = [&] { return ++asked > 5; };
    options.threads = 1;
    const Bootstrap found = bootstrap(model(0.1), options);
    EXPECT_TRUE(found.canceled);
    EXPECT_EQ(found.values.col(0).array().isFinite().count(), 5);
}

TEST(bootstrap, says_what_it_needs) {
    EXPECT_THAT(thrown_message([&] { bootstrap(model(0.1), kind(BootstrapKind::kResidual, 5)); }), HasSubstr("`runs`"));
    BootstrapOptions options;
    options.confidence = 1.5;
    EXPECT_THAT(thrown_message([&] { bootstrap(model(0.1), options); }), HasSubstr("`confidence`"));
}

}  // namespace test_bootstrap
