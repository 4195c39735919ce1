#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_transfer_refinement {

using namespace dynlab;
using testing::HasSubstr;

constexpr double kTs = 0.1;
const StartCondition kRest{InitialState::kZero, false};

Matrix rough_inputs(Index N, Index inputs, std::uint32_t seed = 5) {
    RandomStream stream(seed);
    Matrix u(N, inputs);
    for (Index j = 0; j < inputs; ++j) {
        const Vector noise = stream.normal(N);
        for (Index k = 0; k < N; ++k) u(k, j) = noise[k / 8] > 0 ? 1 : -1;
    }
    return u;
}

IdData simulated(const TransferStructure& structure, const Vector& theta, Index N, double sigma,
                 std::uint32_t seed = 5) {
    const Matrix u = rough_inputs(N, structure.inputs, seed);
    RandomStream noise(seed + 100);
    Matrix y(N, structure.outputs);
    const auto models = structure.models(theta);
    for (Index o = 0; o < structure.outputs; ++o) {
        y.col(o) = sigma * std::pow(10, static_cast<double>(o)) * noise.normal(N);
        for (Index i = 0; i < structure.inputs; ++i)
            y.col(o) += lsim(models[static_cast<std::size_t>(o * structure.inputs + i)], u.col(i), kTs);
    }
    return IdData(y, u, kTs);
}

FitOptions tight() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

void expect_values(const Vector& found, const Vector& expected, double tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    for (Index i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], tolerance * (1e-3 + std::abs(expected[i]))) << i;
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "nothing was refused";
}

// Common denominator of two outputs, two inputs: [a1 a2, b0 b1, b0, b0, b0].
TransferStructure common_structure() {
    return TransferStructure::grid(2, 2, Denominators::kCommon, {2}, {1, 0, 0, 0}, {0.0, 0.25, 0.0, 0.3});
}
const Vector kCommonTheta{{1.2, 2.0, 0.7, 3.0, -1.0, 2.0, 4.0}};

TEST(transfer_refinement, one_channel_is_found_again) {  // oracle: the simulated system
    const Vector truth{{1.0, 4.0, -1.0, 2.0}};
    const TransferStructure structure = TransferStructure::single(2, 1, 0.25);
    const auto result = refine_output_error(simulated(structure, truth, 500, 0), structure, kRest,
                                            Vector{{1.5, 3.0, 0.0, 1.0}}, tight());
    expect_values(result.theta, truth, 1e-10);
    EXPECT_NEAR(result.fit_percent[0], 100, 1e-8);
    EXPECT_TRUE(result.warnings.empty()) << message_text(result.full_message());
    EXPECT_EQ(result.names, (std::vector<std::string>{"a1", "a2", "b0", "b1"}));
    EXPECT_EQ(result.trace.back().theta, result.theta);
    EXPECT_EQ(result.offsets, Matrix::Zero(1, 1));
}

TEST(transfer_refinement, unstable_starts_are_mirrored) {  // oracle: the simulated system
    const Vector truth{{1.0, 4.0, 2.0}};
    const TransferStructure structure = TransferStructure::single(2, 0);
    const IdData data = simulated(structure, truth, 20000, 0);
    const auto result = refine_output_error(data, structure, kRest, Vector{{-1.5, 3.0, 1.0}}, tight());
    expect_values(result.theta, truth, 1e-9);
}

TEST(transfer_refinement, delays_between_samples_are_estimated) {  // oracle: the simulated system
    for (const int zeros : {0, 1})
        for (const double delay : {0.337, 0.4}) {
            TransferStructure structure = TransferStructure::single(2, zeros);
            structure.free_delays = true;
            Vector truth(4 + zeros);
            if (zeros == 0)
                truth << 1, 4, 2, delay;
            else
                truth << 1, 4, -1, 2, delay;
            Vector start = truth;
            start[3 + zeros] = 0.3;
            FitOptions options = tight();
            options.largest_delay = 2;
            const auto result =
                refine_output_error(simulated(structure, truth, 500, 0), structure, kRest, start, options);
            expect_values(result.theta, truth, 1e-8);
        }
}

TEST(transfer_refinement, biproper_models_are_found_again) {  // oracle: the simulated system
    const Vector truth{{1.0, 4.0, 0.5, -1.0, 2.0, 0.237}};
    for (const Hold hold : {Hold::kZoh, Hold::kFoh}) {
        TransferStructure structure = TransferStructure::single(2, 2, 0.237);
        const Matrix u = rough_inputs(400, 1);
        IdData data(lsim(structure.models(truth.head(5))[0], u.col(0), kTs, hold), u, kTs);
        data.hold = hold;
        const auto known = refine_output_error(data, structure, kRest, Vector{{1.5, 3.0, 0.0, 0.0, 1.0}}, tight());
        expect_values(known.theta, truth.head(5), 1e-9);
        structure.free_delays = true;
        Vector start = truth;
        start[5] = 0.2;
        const auto delayed = refine_output_error(data, structure, kRest, start, tight());
        // Sampled and held, such a model has 2n + 1 coefficients for the 2n + 2 that it would take to find the delay.
        if (hold == Hold::kZoh)
            EXPECT_THAT(message_text(delayed.full_message()), HasSubstr("known only to within one sampling time"));
        else
            expect_values(delayed.theta, truth, 1e-8);
    }
}

TEST(transfer_refinement, initial_states_and_offsets_of_every_experiment) {  // oracle: the simulated system
    const Vector truth{{1.0, 4.0, 2.0}};
    const TransferStructure structure = TransferStructure::single(2, 0);
    std::vector<IdData> parts;
    std::vector<Vector> before;
    for (std::uint32_t e = 0; e < 2; ++e) {
        IdData part = simulated(structure, truth, 400, 0, 5 + e);
        part.experiments[0].y.array() += 10 * (e + 1.0);
        before.push_back(part.experiments[0].y.col(0));
        parts.push_back(part.range(58, 400));
    }
    const auto result = refine_output_error(IdData::merge(parts), structure, {InitialState::kEstimate, true},
                                            Vector{{1.5, 3.0, 1.0}}, tight());
    expect_values(result.theta, truth, 1e-9);
    ASSERT_EQ(result.initial_values.size(), 2u);
    for (std::size_t e = 0; e < 2; ++e) {
        const double offset = 10 * (static_cast<double>(e) + 1);
        EXPECT_NEAR(result.offsets(static_cast<Index>(e), 0), offset, 1e-8);
        const double rest = 0.5 * parts[e].experiments[0].u(0, 0);
        EXPECT_NEAR(result.initial_values[e][0], before[e][57] - offset - rest, 1e-8);
    }
    EXPECT_EQ(value_count(structure, result.start, 2), 3 + 2 * 3);
}

TEST(transfer_refinement, common_denominator_is_found_again) {  // oracle: the simulated system
    const TransferStructure structure = common_structure();
    const auto result = refine_output_error(simulated(structure, kCommonTheta, 600, 0), structure, kRest,
                                            Vector{{1.5, 2.5, 0.0, 2.0, -2.0, 1.0, 1.0}}, tight());
    expect_values(result.theta, kCommonTheta, 1e-9);
    EXPECT_EQ(result.models.size(), 4u);
}

TEST(transfer_refinement, noisier_outputs_count_less) {  // oracle: statistics; fixed seeds, known noise levels
    const TransferStructure structure = common_structure();
    double squares = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const IdData data = simulated(structure, kCommonTheta, 600, 0.02, seed);
        const auto result = refine_output_error(data, structure, kRest, kCommonTheta, {});
        EXPECT_NEAR(std::sqrt(result.noise_variance[0]) / 0.02, 1, 0.12);
        EXPECT_NEAR(std::sqrt(result.noise_variance[1]) / 0.2, 1, 0.12);
        squares += (result.theta - kCommonTheta).cwiseQuotient(result.std).squaredNorm();
    }
    EXPECT_NEAR(squares / (20 * 7), 1, 0.35);
}

TEST(transfer_refinement, separate_outputs_are_separate_problems) {  // oracle: second route, one output at a time
    const TransferStructure structure =
        TransferStructure::grid(2, 2, Denominators::kPerOutput, {2, 2, 1, 1}, {1, 0, 0, 0}, {0.0});
    const Vector truth{{1.2, 2.0, 0.7, 3.0, -1.0, 0.8, 2.0, 4.0}};
    const IdData data = simulated(structure, truth, 500, 0.05);
    const auto all = refine_output_error(data, structure, {InitialState::kEstimate, true}, truth, tight());
    const auto first = refine_output_error(data.select({1}, {1, 2}),
                                           TransferStructure::grid(1, 2, Denominators::kCommon, {2}, {1, 0}, {0.0}),
                                           {InitialState::kEstimate, true}, truth.head(5), tight());
    expect_values(all.theta.head(5), first.theta, 1e-9);
    EXPECT_TRUE(all.covariance.topLeftCorner(5, 5).isApprox(first.covariance, 1e-8));
    EXPECT_TRUE(all.covariance.topRightCorner(5, 3).isZero(0));
    EXPECT_EQ(all.initial_values[0].size(), 3);
    EXPECT_EQ(all.trace.back().theta, all.theta);
    for (Index i = 0; i < truth.size(); ++i) EXPECT_NEAR(all.theta[i], truth[i], 5 * all.std[i]);
}

TEST(transfer_refinement, doubts_are_reported) {  // oracle: the simulated system
    const TransferStructure plain = TransferStructure::single(1, 0);
    const IdData data = simulated(plain, Vector{{0.8, 2.0}}, 400, 0.01);
    const auto canceling =
        refine_output_error(data, TransferStructure::single(2, 1), kRest, Vector{{3.0, 2.0, 2.0, 4.0}}, {});
    EXPECT_THAT(message_text(canceling.full_message()), HasSubstr("nearly cancel")) << canceling.theta;
    FitOptions options;
    options.max_iterations = 1;
    EXPECT_THAT(message_text(refine_output_error(data, plain, kRest, Vector{{3.0, 1.0}}, options).full_message()),
                HasSubstr("`max_iterations` = 1"));
    options = {};
    options.cancel = [] { return true; };
    EXPECT_THAT(message_text(refine_output_error(data, plain, kRest, Vector{{3.0, 1.0}}, options).full_message()),
                HasSubstr("interrupted"));
    TransferStructure delayed = plain;
    delayed.free_delays = true;
    const IdData late = simulated(delayed, Vector{{0.8, 2.0, 1.0}}, 400, 0.01);
    options = {};
    options.largest_delay = 0.6;
    EXPECT_THAT(
        message_text(refine_output_error(late, delayed, kRest, Vector{{0.8, 2.0, 0.5}}, options).full_message()),
        HasSubstr("increase `largest_delay`"));
    options.least_delay = 1.3;
    options.largest_delay = 2;
    EXPECT_THAT(
        message_text(refine_output_error(late, delayed, kRest, Vector{{0.8, 2.0, 1.5}}, options).full_message()),
        HasSubstr("decrease `least_delay`"));
    options.least_delay = 0;
    EXPECT_THAT(
        message_text(refine_output_error(data, delayed, kRest, Vector{{0.8, 2.0, 0.05}}, options).full_message()),
        HasSubstr("without delay"));
}

TEST(transfer_refinement, refuses_what_cannot_be_estimated) {
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Vector theta{{1.0, 4.0, 2.0}};
    const IdData data = simulated(structure, theta, 100, 0);
    const auto refine = [&](const IdData& d, const TransferStructure& s, const StartCondition& c, const Vector& start) {
        return refusal([&] { refine_output_error(d, s, c, start, {}); });
    };
    EXPECT_THAT(refine(data, structure, kRest, Vector::Ones(2)),
                HasSubstr("The number of initial values must be 3, but is 2"));
    EXPECT_THAT(refine(data.range(1, 8), structure, kRest, theta), HasSubstr("at least 9 samples"));
    const IdData pieces = IdData::merge({data.range(1, 4), data.range(41, 44), data.range(21, 24)});
    EXPECT_THAT(refine(pieces, structure, {InitialState::kEstimate, true}, theta),
                HasSubstr("estimates 12 values and needs more samples than that"));
    EXPECT_THAT(
        refine(data, TransferStructure::grid(1, 2, Denominators::kCommon, {2}, {0}, {0.0}), kRest, Vector::Ones(4)),
        HasSubstr("2 inputs"));
    EXPECT_THAT(refine(data, TransferStructure::single(2, 0, 100), kRest, theta),
                HasSubstr("not shorter than the data"));
    EXPECT_THAT(refine(IdData(data.experiments[0].y, Matrix::Zero(100, 1), kTs), structure, kRest, theta),
                HasSubstr("zero in all samples"));
    EXPECT_THAT(refine(IdData(Matrix::Ones(100, 1), data.experiments[0].u, kTs), structure, kRest, theta),
                HasSubstr("never changes"));
}

}  // namespace test_transfer_refinement
