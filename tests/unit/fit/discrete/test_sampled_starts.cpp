#include "numerics/fit/discrete/sampled_starts.h"

#include <gtest/gtest.h>

#include "numerics/fit/simulation_error.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/linalg/polynomial.h"
#include "support/search_corpus.h"
#include "support/transfer_cases.h"

namespace test_sampled_starts {

using namespace dynlab;
using namespace dynlab::test;

constexpr double kTs = 0.5;

/// Poles -0.15 +- 4i, two radians a sample, and -2.2; a zero; the delay is 2.25 samples.
TransferFunction slowly_sampled_system() {
    return TransferFunction(values({40, 35}), multiply(values({1, 0.3, 16.0225}), values({1, 2.2})), 0, 2.25 * kTs);
}

Vector true_values() {
    const TransferFunction G = slowly_sampled_system();
    return values({G.den()[1], G.den()[2], G.den()[3], 40, 35, G.delay()});
}

IdData slowly_sampled_data(double sigma, std::uint32_t seed) {
    const Vector u = prbs(9, 2);
    const Vector x = lsim(slowly_sampled_system(), u, kTs);
    return IdData(Matrix(x + sigma * RandomStream(seed).normal(u.size())), Matrix(u), kTs);
}

TransferStructure with_free_delay(int poles, int zeros) {
    TransferStructure structure = TransferStructure::single(poles, zeros);
    structure.free_delays = true;
    return structure;
}

/// The search from these values.
Fit fit_from(const IdData& data, const TransferStructure& structure, const Vector& theta) {
    return refine_output_error(data, structure, {InitialState::kZero, false}, theta, {});
}

TEST(sampled_starts, lead_to_the_system) {  // oracle: the simulated system, without noise
    const IdData data = slowly_sampled_data(0, 1);
    const Fit poor = fit_from(data, with_free_delay(3, 1), values({3, 9, 8, -20, 8, 4}));
    ASSERT_GT(poor.loss, 0.01);
    FitOptions options;
    options.largest_delay = 5;
    const std::vector<Vector> starts = sampled_starts(data, with_free_delay(3, 1), poor, options);
    ASSERT_FALSE(starts.empty());
    EXPECT_LT(relative_difference(starts.front(), true_values()), 1e-6);
}

TEST(sampled_starts, there_are_none_where_nothing_is_missed) {  // oracle: the search from the system itself
    const IdData data = slowly_sampled_data(1, 2);
    const Fit fit = fit_from(data, with_free_delay(3, 1), true_values());
    FitOptions options;
    options.largest_delay = 5;
    EXPECT_TRUE(sampled_starts(data, with_free_delay(3, 1), fit, options).empty());
}

// Oracle: the definition, white errors without and with an effect of the input. By chance, a thousandth of all data
// sets exceeds four standard deviations of chi-squared with about twenty degrees of freedom.
TEST(sampled_starts, errors_follow_the_input_where_something_is_missed) {
    int false_alarms = 0;
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        const IdData data = slowly_sampled_data(1, seed);
        false_alarms += fast_errors_follow_input(data, fit_from(data, with_free_delay(3, 1), true_values())) ? 1 : 0;
        const Fit lower_order = fit_from(data, with_free_delay(1, 0), values({2, 4, 2.25 * kTs}));
        EXPECT_TRUE(fast_errors_follow_input(data, lower_order)) << seed;
    }
    EXPECT_LE(false_alarms, 1);
}

// Oracle: differences of a sine of w radians a sample are 2 sin(w/2) as large. For 0.25 and 0.4 radians, the squares
// are thus 0.06 and 0.16 of the sine's squares.
TEST(sampled_starts, slow_errors_are_not_theirs) {
    for (const double turn : {0.25, 0.4}) {
        const Vector u = (Vector::LinSpaced(2000, 0, 1999) * turn).array().sin();
        const Vector response = lsim(TransferFunction(values({2}), values({1, 4}), 0), u, 0.01);
        const IdData data(Matrix(response), Matrix(u), 0.01);
        const Fit poor = fit_from(data, TransferStructure::single(1, 0), values({4, 2}));
        Fit none = poor;
        none.theta[1] = 0;  // the whole output is an error then
        EXPECT_EQ(fast_errors_follow_input(data, none), turn > 0.3) << turn;
    }
}

// Oracle: white noise, and the same behind a filter with a pole at 0.5. Four standard deviations as above.
TEST(sampled_starts, colored_errors_are_distinguished_from_white_ones) {
    int false_alarms = 0;
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        IdData data = slowly_sampled_data(0, 1);
        const Fit fit = fit_from(data, with_free_delay(3, 1), true_values());
        const Vector clean = data.experiments.front().y.col(0);
        Vector noise = RandomStream(seed).normal(clean.size());
        data.experiments.front().y = Matrix(clean + noise);
        false_alarms += errors_are_colored(data, fit) ? 1 : 0;
        for (Index k = 1; k < noise.size(); ++k) noise[k] += 0.5 * noise[k - 1];
        data.experiments.front().y = Matrix(clean + noise);
        EXPECT_TRUE(errors_are_colored(data, fit)) << seed;
    }
    EXPECT_LE(false_alarms, 1);
}

// Oracle: the noise of random systems to whose best model no filtered start leads.
TEST(sampled_starts, slowly_sampled_systems_are_found_from_default_settings) {
    for (const std::uint32_t seed : {10'298U, 20'048U, 20'159U}) {
        const SearchCase one = search_case(seed, 2000);
        const Fit fit = search_transfer("test", one.data, with_free_delay(one.poles, one.zeros), {});
        EXPECT_LT(fit.loss, 1.01 * one.loss_at_truth) << seed;
    }
}

}  // namespace test_sampled_starts
