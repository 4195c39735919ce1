#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/hammerstein.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/lsim.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_hammerstein {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
using testing::Not;

const Vector kEdges{{-1, -0.2, 0.2, 1}};
const Vector kLevels{{-1.6, 0.1, 0.1, 2.1}};  // a dead band, and a smaller gain backwards

/// Piecewise linear: dead band from -0.2 to 0.2, gains 2.125 and 2.5.
Vector characteristic(const Vector& u) {
    return hat_functions(kEdges, u) * kLevels;
}

/// Many levels between -1 and 1, each held for some samples.
Vector levels_of(Index N, std::uint32_t seed) {
    RandomStream random(seed);
    const Vector draws = random.normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = std::tanh(0.8 * draws[k / 6]);
    u[0] = -1;
    u[6] = 1;
    return u;
}

struct System {
    TransferFunction G;
    TransferStructure structure;
};

System without_zero() {
    return {TransferFunction(values({9}), values({1, 2, 9})), TransferStructure::single(2, 0)};
}
System with_zero() {
    return {TransferFunction(values({1.5, 9}), values({1, 2, 9}), 0, 0.13), TransferStructure::single(2, 1, 0.13)};
}

IdData simulated_data(const TransferFunction& G, double noise, std::uint32_t seed, Index N = 1500) {
    const Vector u = levels_of(N, seed);
    const Vector f = characteristic(u);
    const Vector x = lsim(G, f.array() - f[0], 0.05).array() + f[0];
    return IdData(Matrix(x + noise * RandomStream(seed + 100).normal(N)), Matrix(u), 0.05);
}

HammersteinOptions at_edges(const Vector& edges) {
    HammersteinOptions options;
    options.breakpoints = edges;
    options.tolerance = 1e-9;
    return options;
}

TEST(hammerstein, hat_functions_share_out_every_value) {  // oracle: definition
    const Matrix hats = hat_functions(kEdges, values({-3, -1, -0.6, 0.1, 0.2, 0.6, 1, 4}));
    EXPECT_LT((hats.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-15);
    EXPECT_LT((hats.row(2) - Eigen::RowVector4d(0.5, 0.5, 0, 0)).norm(), 1e-15);
    EXPECT_LT((hats.row(3) - Eigen::RowVector4d(0, 0.25, 0.75, 0)).norm(), 1e-15);
    EXPECT_EQ(hats(4, 2), 1);
    EXPECT_EQ(hats(0, 0), 1);
    EXPECT_EQ(hats(7, 3), 1);
}

TEST(hammerstein, recovers_a_dead_band_without_noise) {  // oracle: the simulated system
    for (const System& system : {without_zero(), with_zero()}) {
        const auto result = hammerstein(simulated_data(system.G, 0, 1), system.structure, at_edges(kEdges));
        EXPECT_LT((result.characteristic->levels - kLevels).cwiseAbs().maxCoeff(), 1e-6)
            << message_text(result.full_message());
        EXPECT_LT((result.models[0].den() - system.G.den()).cwiseAbs().maxCoeff(), 1e-5);
        EXPECT_LT((result.models[0].num() - system.G.num()).cwiseAbs().maxCoeff(), 1e-5);
        EXPECT_NEAR(result.models[0].dc_gain(), 1, 1e-12);
        EXPECT_GT(result.fit_percent[0], 100 - 1e-4);
        EXPECT_LT(result.characteristic->linear_fit_percent, 95);
    }
}

TEST(hammerstein, finds_the_delay_together_with_the_rest) {  // oracle: the simulated system
    System system = with_zero();
    system.structure.free_delays = true;
    const auto result = hammerstein(simulated_data(system.G, 0.01, 2), system.structure, at_edges(kEdges));
    ASSERT_EQ(result.names.back(), "Td");
    EXPECT_NEAR(result.models[0].delay(), 0.13, 4 * result.std[result.std.size() - 1])
        << message_text(result.full_message());
    EXPECT_LT(result.std[result.std.size() - 1], 0.01);
}

// Oracle: statistics with fixed seeds; white noise, so that the covariance is right.
TEST(hammerstein, scatters_as_its_standard_errors_say) {
    constexpr Index kRuns = 60;
    const System system = without_zero();
    Matrix thetas(6, kRuns), errors(6, kRuns);
    for (Index run = 0; run < kRuns; ++run) {
        const auto result = hammerstein(simulated_data(system.G, 0.2, static_cast<std::uint32_t>(run + 1)),
                                        system.structure, at_edges(kEdges));
        thetas.col(run) = result.theta;
        errors.col(run) = result.std;
    }
    const Vector truth = values({2, 9, -1.6, 0.1, 0.1, 2.1});
    for (Index i = 0; i < 6; ++i) {
        const double mean = thetas.row(i).mean();
        const double spread = std::sqrt((thetas.row(i).array() - mean).square().sum() / (kRuns - 1));
        EXPECT_NEAR(mean, truth[i], 3.5 * spread / std::sqrt(double(kRuns))) << i;
        EXPECT_NEAR(spread / errors.row(i).mean(), 1, 0.3) << i;
    }
}

TEST(hammerstein, errors_are_orthogonal_to_what_the_parameters_do) {  // oracle: the loss nearby, simulated by lsim
    const System system = with_zero();
    const IdData data = simulated_data(system.G, 0.1, 3);
    const auto result = hammerstein(data, system.structure, at_edges(kEdges));
    const Vector u = data.experiments[0].u, y = data.experiments[0].y;
    const auto loss = [&](const Vector& theta) {  // [a1 a2 b0 f1..f4]
        const TransferFunction G(values({theta[2], theta[1]}), values({1, theta[0], theta[1]}), 0, 0.13);
        const Vector f = hat_functions(kEdges, u) * theta.tail(4);
        const Vector x = lsim(G, f.array() - f[0], 0.05).array() + f[0];
        return (y - x).squaredNorm() / static_cast<double>(y.size());
    };
    EXPECT_NEAR(loss(result.theta), result.loss, 1e-9);
    for (Index i = 0; i < result.theta.size(); ++i) {
        const Vector step = 1e-4 * Vector::Unit(result.theta.size(), i);
        EXPECT_LT(std::abs(loss(result.theta + step) - loss(result.theta - step)) / 2e-4, 1e-4 * result.loss) << i;
        EXPECT_GT(loss(result.theta + 10 * step), result.loss) << i;
    }
}

TEST(hammerstein, bins_do_without_edges_that_the_input_does_not_visit) {  // oracle: definition
    const System system = without_zero();
    IdData data = simulated_data(system.G, 0.02, 4);
    HammersteinOptions options;
    options.bins = 8;
    const auto equal = hammerstein(data, system.structure, options);
    EXPECT_EQ(equal.characteristic->breakpoints.size(), 9);
    EXPECT_GT(equal.fit_percent[0], equal.characteristic->linear_fit_percent + 5) << message_text(equal.full_message());
    const auto wide = hammerstein(data, system.structure, at_edges(values({-9, -5, -1, -0.2, 0.2, 1, 4})));
    EXPECT_EQ(wide.characteristic->breakpoints.size(), 4) << wide.characteristic->breakpoints.transpose();
    EXPECT_THAT(message_text(wide.full_message()), HasSubstr("too few input values nearby"));
}

// Oracle: a held input of three values, of which the two edges about zero know only the mean; at these values the
// simulated characteristic.
TEST(hammerstein, an_input_of_few_values_has_these_as_edges) {
    const TransferFunction G = without_zero().G;
    Vector u(900);
    for (Index k = 0; k < u.size(); ++k) u[k] = static_cast<double>((k / 30 * 7) % 3) - 1;
    const Vector f = characteristic(u);
    const Vector y = lsim(G, f.array() - f[0], 0.05).array() + f[0];
    const IdData data{Matrix(y), Matrix(u), 0.05};
    for (const Vector& edges : {kEdges, values({-1, -0.5, 0.5, 1})}) {
        const auto result = hammerstein(data, without_zero().structure, at_edges(edges));
        ASSERT_EQ(result.characteristic->breakpoints, values({-1, 0, 1})) << message_text(result.full_message());
        EXPECT_LT(
            (result.characteristic->levels - characteristic(result.characteristic->breakpoints)).cwiseAbs().maxCoeff(),
            1e-6);
        EXPECT_THAT(
            message_text(result.full_message()),
            HasSubstr("The input has only 3 distinct values, which are the bin edges; `breakpoints` is ignored"));
    }
    const auto as_asked = hammerstein(data, without_zero().structure, at_edges(values({-1, 0, 1})));
    EXPECT_THAT(message_text(as_asked.full_message()), Not(HasSubstr("distinct values")));
    const auto by_bins = hammerstein(data, without_zero().structure, at_edges({}));
    EXPECT_THAT(message_text(by_bins.full_message()), HasSubstr("3 distinct values, which are the bin edges. Between"));
}

// oracle: second route, coe; two points lie on a line, so the model is linear with an offset
TEST(hammerstein, of_a_binary_input_is_the_linear_model_with_an_offset) {
    const Vector u = prbs(4, 50);
    const Vector f = 0.5 + 1.5 * u.array();
    const Vector x = lsim(without_zero().G, f.array() - f[0], 0.05).array() + f[0];
    const IdData data(Matrix(x + 0.2 * RandomStream(1).normal(u.size())), Matrix(u), 0.05);
    const auto result = hammerstein(data, without_zero().structure, at_edges(values({-1, 1})));
    FitOptions options;
    options.initial_state = InitialState::kSteady;
    options.offset = Offset::kEstimate;
    options.tolerance = 1e-9;
    const Fit linear = coe(data, without_zero().structure, options);
    EXPECT_LT((result.theta.head(2) - linear.theta.head(2)).cwiseQuotient(linear.theta.head(2)).norm(), 1e-6);
    EXPECT_NEAR(result.loss / linear.loss, 1, 1e-9);
}

TEST(hammerstein, reports_when_a_line_would_do) {  // oracle: the simulated system is linear
    const Vector u = levels_of(1500, 5);
    const Vector y = lsim(without_zero().G, u.array() - u[0], 0.05).array() + u[0];
    const IdData data(Matrix(y + 0.05 * RandomStream(1).normal(1500)), Matrix(u), 0.05);
    const auto result = hammerstein(data, TransferStructure::single(2, 0), HammersteinOptions());
    EXPECT_THAT(message_text(result.full_message()), HasSubstr("A linear model fits equally well"));
    for (Index i = 0; i < result.characteristic->levels.size(); ++i)
        EXPECT_NEAR(result.characteristic->levels[i], result.characteristic->breakpoints[i],
                    4 * result.characteristic->levels_std[i])
            << i;
}

TEST(hammerstein, record_that_begins_at_zero_input_is_distinguished) {  // oracle: the levels put in
    const Vector u = levels_of(1500, 7), f = characteristic(u);
    for (const double before : {0.0, f[0]}) {
        const Vector y = lsim(without_zero().G, f.array() - before, 0.05).array() + before;
        const Fit fit = hammerstein({Matrix(y), Matrix(u), 0.05}, without_zero().structure, at_edges(kEdges));
        EXPECT_LT((fit.characteristic->levels - kLevels).cwiseAbs().maxCoeff(), 1e-6);
        EXPECT_EQ(fit.start.state, before == 0 ? InitialState::kZero : InitialState::kSteady);
    }
}

TEST(hammerstein, refuses_what_it_cannot_fit) {  // oracle: definitions
    const System system = without_zero();
    const IdData data = simulated_data(system.G, 0.1, 1, 300);
    const auto refusal = [&](const IdData& given, const HammersteinOptions& options) {
        return thrown_message([&] { hammerstein(given, system.structure, options); });
    };
    EXPECT_THAT(refusal(data, at_edges(values({1, 0}))), HasSubstr("`breakpoints` must increase"));
    EXPECT_THAT(refusal(data, at_edges(values({20, 30}))), HasSubstr("bin edges"));
    HammersteinOptions options;
    options.bins = 0;
    EXPECT_THAT(refusal(data, options), HasSubstr("`bins` must be between"));
    options = {};
    options.offset = Offset::kEstimate;
    EXPECT_THAT(refusal(data, options), HasSubstr("`offset` must be"));
    IdData other = data;
    other.hold = Hold::kFoh;
    EXPECT_THAT(refusal(other, {}), HasSubstr("zero-order hold"));
}

}  // namespace test_hammerstein
