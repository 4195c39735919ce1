#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/monte_carlo.h"
#include "support/thrown_message.h"

namespace test_monte_carlo {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;

MonteCarloStudy first_order_study() {
    return {TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0}}), prbs(5, 4), 0.1, Hold::kZoh, 0.3, {}, 40, 7};
}

/// Statistics of the data themselves, so that every sample counts.
MonteCarloEstimate moments(const IdData& data) {
    const auto y = data.experiments.front().y.col(0);
    return {Vector{{y.mean(), y.squaredNorm()}}, Vector{{0.1, 0.2}}, {"a1", "b0"}};
}

const MonteCarloMethod kMoments{"moments", moments};

TEST(monte_carlo, runs_use_consecutive_seeds) {  // oracle: the data sets made separately
    const MonteCarloStudy study = first_order_study();
    const MonteCarlo result = monte_carlo(study, {kMoments});
    const Vector x = lsim(study.system, study.u, study.Ts);
    for (Index k = 0; k < study.runs; ++k) {
        const Vector y = x + 0.3 * RandomStream(static_cast<std::uint32_t>(7 + k)).normal(x.size());
        EXPECT_NEAR(result.results[0].theta(k, 0), y.mean(), 1e-14);
        EXPECT_NEAR(result.results[0].theta(k, 1), y.squaredNorm(), 1e-11);
    }
}

TEST(monte_carlo, same_numbers_for_any_number_of_threads) {  // oracle: one thread, bit for bit
    MonteCarloStudy study = first_order_study();
    study.threads = 1;
    const MonteCarlo one = monte_carlo(study, {kMoments, {"again", moments, false}});
    for (const int threads : {2, 3, 8}) {
        study.threads = threads;
        const MonteCarlo many = monte_carlo(study, {kMoments, {"again", moments, false}});
        for (std::size_t j = 0; j < 2; ++j) {
            EXPECT_EQ(many.results[j].theta, one.results[j].theta);
            EXPECT_EQ(many.results[j].mean, one.results[j].mean);
            EXPECT_EQ(many.results[j].spread, one.results[j].spread);
        }
    }
}

TEST(monte_carlo, methods_that_are_not_concurrent_stay_in_the_callers_thread) {
    const auto caller = std::this_thread::get_id();
    monte_carlo(first_order_study(), {{"own",
                                       [&](const IdData& data) {
                                           EXPECT_EQ(std::this_thread::get_id(), caller);
                                           return moments(data);
                                       },
                                       false}});
}

TEST(monte_carlo, statistics) {  // oracle: by hand, estimates 1, 2, .., 40
    std::atomic<int> count = 0;
    MonteCarloStudy study = first_order_study();
    study.threads = 1;
    const MonteCarlo result = monte_carlo(
        study, {{"count", [&](const IdData&) {
                     return MonteCarloEstimate{Vector{{double(++count), 2.5}}, Vector{{0.5, 0.1}}, {"a1", "b0"}};
                 }}});
    const MonteCarloResult& r = result.results[0];
    EXPECT_DOUBLE_EQ(r.mean[0], 20.5);
    EXPECT_DOUBLE_EQ(r.median[0], 20.5);
    EXPECT_DOUBLE_EQ(r.low[0], 1);
    EXPECT_DOUBLE_EQ(r.high[0], 40);
    EXPECT_DOUBLE_EQ(r.reported[0], 0.5);
    EXPECT_NEAR(r.spread[0], std::sqrt(40.0 * 41 / 12), 1e-12);
    EXPECT_NEAR(r.spread[1], 0, 1e-15);
    EXPECT_THAT(r.truth, ElementsAre(1, 2));
    EXPECT_NEAR(r.bias[0], 19.5, 1e-12);
}

TEST(monte_carlo, snr_scales_the_noise) {  // oracle: the definition 20 log10(std x/std e)
    MonteCarloStudy study = first_order_study();
    study.sigma.reset();
    study.snr = 10;
    const Vector x = lsim(study.system, study.u, study.Ts);
    const MonteCarlo result = monte_carlo(study, {kMoments});
    EXPECT_NEAR(result.sigma, std::sqrt((x.array() - x.mean()).square().mean() / 10), 1e-14);
    EXPECT_NEAR(result.snr, 10, 1e-12);
}

TEST(monte_carlo, failures_of_single_runs_are_counted_and_reported) {
    const MonteCarlo result =
        monte_carlo(first_order_study(), {{"picky", [](const IdData& data) {
                                               MonteCarloEstimate estimate = moments(data);
                                               if (data.experiments[0].y(1, 0) < 0)
                                                   throw InvalidArgument("the second sample is negative");
                                               estimate.converged = data.experiments[0].y(2, 0) > 0;
                                               return estimate;
                                           }}});
    const MonteCarloResult& r = result.results[0];
    int negative = 0, unsettled = 0;
    const MonteCarloStudy study = first_order_study();
    const Vector x = lsim(study.system, study.u, study.Ts);
    for (Index k = 0; k < study.runs; ++k) {
        const Vector y = x + 0.3 * RandomStream(static_cast<std::uint32_t>(7 + k)).normal(x.size());
        negative += y[1] < 0;
        unsettled += y[1] >= 0 && y[2] <= 0;
    }
    EXPECT_GT(negative, 0);
    EXPECT_EQ(r.failed, negative);
    EXPECT_EQ(r.estimated, study.runs - negative);
    EXPECT_EQ(r.not_converged, unsettled);
    EXPECT_EQ(message_text(r.first_failure), "the second sample is negative");
    EXPECT_EQ((r.theta.col(0).array().isNaN()).count(), negative);
}

TEST(monte_carlo, refuses_a_method_that_never_works) {
    EXPECT_THAT(thrown_message([] {
                    monte_carlo(first_order_study(), {{"broken", [](const IdData&) -> MonteCarloEstimate {
                                                           throw InvalidArgument("lambda is missing");
                                                       }}});
                }),
                HasSubstr("every run of 'broken' failed; the first error: lambda is missing"));
}

TEST(monte_carlo, cancel_keeps_what_was_done) {
    MonteCarloStudy study = first_order_study();
    study.threads = 1;
    std::size_t done = 0;
    study.progress = [&](std::size_t count) { done = count; };
    study.cancel = [&] { return done >= 10; };
    const MonteCarlo result = monte_carlo(study, {kMoments});
    EXPECT_TRUE(result.canceled);
    EXPECT_EQ(result.results[0].estimated, 10);
    EXPECT_EQ(result.results[0].failed, 0);
    study.cancel = [] { return true; };
    EXPECT_EQ(monte_carlo(study, {kMoments}).results[0].estimated, 0);
}

TEST(monte_carlo, progress_counts_to_the_end) {
    MonteCarloStudy study = first_order_study();
    std::size_t last = 0;
    study.progress = [&](std::size_t count) {
        EXPECT_EQ(count, last + 1);
        last = count;
    };
    monte_carlo(study, {kMoments, {"again", moments, false}});
    EXPECT_EQ(last, 80u);
}

TEST(monte_carlo, parameters_without_names_get_the_systems) {
    const auto bare = [](Index d) { return [d](const IdData&) { return MonteCarloEstimate{Vector::Ones(d), {}}; }; };
    const MonteCarlo result = monte_carlo(first_order_study(), {{"two", bare(2)}, {"three", bare(3)}});
    EXPECT_THAT(result.results[0].names, ElementsAre("a1", "b0"));
    EXPECT_THAT(result.results[1].names, ElementsAre("theta1", "theta2", "theta3"));
    EXPECT_EQ(result.results[1].truth.size(), 0);
    EXPECT_TRUE(std::isnan(result.results[0].reported[0]));
}

TEST(monte_carlo, refuses_unsuitable_studies) {
    const auto message = [](auto change) {
        MonteCarloStudy study = first_order_study();
        change(study);
        return thrown_message([&] { monte_carlo(study, {kMoments}); });
    };
    EXPECT_THAT(message([](MonteCarloStudy& s) { s.snr = 10; }), HasSubstr("either sigma"));
    EXPECT_THAT(message([](MonteCarloStudy& s) { s.sigma = -1; }), HasSubstr("sigma"));
    EXPECT_THAT(message([](MonteCarloStudy& s) { s.runs = 1; }), HasSubstr("runs"));
    EXPECT_THAT(message([](MonteCarloStudy& s) { s.threads = -1; }), HasSubstr("threads"));
    EXPECT_THAT(message([](MonteCarloStudy& s) { s.sigma.reset(), s.snr = 3, s.u.setZero(); }), HasSubstr("snr"));
    EXPECT_THAT(message([](MonteCarloStudy& s) {
                    s.system = TransferFunction(Vector{{1.0}}, Vector{{1.0, -500.0}});
                    s.u = prbs(9, 4);
                }),
                HasSubstr("unstable"));
    EXPECT_THAT(thrown_message([] { monte_carlo(first_order_study(), {}); }), HasSubstr("at least one estimator"));
    EXPECT_THAT(thrown_message([] {
                    monte_carlo(first_order_study(), {kMoments, kMoments});
                }),
                HasSubstr("two estimators"));
}

}  // namespace test_monte_carlo
