#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/crossvalidate.h"

namespace test_crossvalidate {

using namespace dynlab;
using testing::HasSubstr;

const TransferFunction kG(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}});
constexpr double kTs = 0.05;

IdData simulated_data(double noise) {
    const Vector u = prbs(7, 8);
    return IdData(Matrix(lsim(kG, u, kTs) + noise * RandomStream(1).normal(u.size())), Matrix(u), kTs);
}

TEST(crossvalidate, folds_cover_the_record_and_training_never_sees_them) {  // oracle: counting samples
    IdData data = simulated_data(0.1);
    const Index N = data.sample_count();
    data.experiments[0].u.col(0) = Vector::LinSpaced(N, 1, static_cast<double>(N));  // numbers its samples
    std::vector<std::vector<double>> seen;
    const auto result =
        cross_validate(data,
                       [&](const IdData& training) {
                           auto& numbers = seen.emplace_back();
                           for (const Experiment& part : training.experiments)
                               numbers.insert(numbers.end(), part.u.data(), part.u.data() + part.u.size());
                           return std::vector{kG};
                       },
                       {.folds = 7});
    ASSERT_EQ(result.folds.size(), 7u);
    Index next = 1;
    for (std::size_t k = 0; k < 7; ++k) {
        const auto& fold = result.folds[k];
        EXPECT_EQ(fold.first, next);
        next = fold.last + 1;
        EXPECT_EQ(static_cast<Index>(seen[k].size()), N - (fold.last - fold.first + 1));
        for (const double number : seen[k])
            EXPECT_TRUE(number < static_cast<double>(fold.first) || number > static_cast<double>(fold.last));
    }
    EXPECT_EQ(next, N + 1);
}

TEST(crossvalidate, the_true_model_fits_every_noise_free_fold) {  // oracle: the simulated truth
    const auto result = cross_validate(simulated_data(0), [](const IdData&) { return std::vector{kG}; });
    EXPECT_EQ(result.fit_percent.rows(), 5);
    EXPECT_GT(result.fit_percent.minCoeff(), 100 - 1e-6);
    EXPECT_LT(result.spread[0], 1e-6);
    EXPECT_THAT(message_text(result.message), HasSubstr("5 parts not used for estimation: fit 100 % on average"));
}

TEST(crossvalidate, fit_of_a_fold_is_that_of_compare) {  // oracle: second route
    const IdData data = simulated_data(0.3);
    const auto result = cross_validate(data, [](const IdData&) { return std::vector{kG}; }, {.folds = 4});
    for (Index k = 0; k < 4; ++k) {
        const auto& fold = result.folds[static_cast<std::size_t>(k)];
        const auto other = compare(data.range(fold.first, fold.last), kG, {InitialState::kEstimate, Offset::kAuto});
        EXPECT_NEAR(result.fit_percent(k, 0), other.fit_percent, 1e-10);
    }
}

TEST(crossvalidate, leaves_out_experiments) {  // oracle: counting samples
    const IdData whole = simulated_data(0.1);
    const IdData data = IdData::merge({whole.range(1, 300), whole.range(301, 500), whole.range(501, 1016)});
    std::vector<Index> sizes;
    const auto result = cross_validate(data,
                                       [&](const IdData& training) {
                                           sizes.push_back(training.sample_count());
                                           EXPECT_EQ(training.experiments.size(), 2u);
                                           return std::vector{kG};
                                       },
                                       {.by_experiment = true});
    EXPECT_EQ(sizes, (std::vector<Index>{716, 816, 500}));
    EXPECT_EQ(result.folds[2].last, 516);
}

TEST(crossvalidate, stops_when_asked_and_passes_errors_on) {
    int calls = 0;
    const auto fit = [&](const IdData&) { return ++calls, std::vector{kG}; };
    CrossValidationOptions options;
    options.cancel = [&] { return calls == 2; };
    EXPECT_EQ(cross_validate(simulated_data(0.1), fit, options).folds.size(), 2u);
    EXPECT_THROW(cross_validate(simulated_data(0.1), [](const IdData&) -> std::vector<TransferFunction> { throw 3; }),
                 int);
}

TEST(crossvalidate, an_unstable_model_is_reported_not_thrown) {
    const TransferFunction wild(Vector{{1.0}}, Vector{{1.0, -100.0}});
    int calls = 0;
    const auto result =
        cross_validate(simulated_data(0.1), [&](const IdData&) { return std::vector{++calls == 2 ? wild : kG}; },
                       {.folds = 2, .simulation = {InitialState::kZero, Offset::kNone}});
    EXPECT_TRUE(std::isfinite(result.fit_percent(0, 0)));
    EXPECT_EQ(result.fit_percent(1, 0), -std::numeric_limits<double>::infinity());
    EXPECT_THAT(message_text(result.message), HasSubstr("unstable"));
}

TEST(crossvalidate, refuses_folds_that_cannot_be) {
    const auto fit = [](const IdData&) { return std::vector{kG}; };
    EXPECT_THROW(cross_validate(simulated_data(0.1), fit, {.folds = 1}), InvalidArgument);
    EXPECT_THROW(cross_validate(simulated_data(0.1), fit, {.folds = 200}), InvalidArgument);
    EXPECT_THROW(cross_validate(simulated_data(0.1), fit, {.by_experiment = true}), InvalidArgument);
}

}  // namespace test_crossvalidate
