#include "numerics/estimators/rivc.h"

#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/srivc.h"
#include "support/colored_noise.h"
#include "support/thrown_message.h"

namespace test_rivc {

using namespace dynlab;
using namespace dynlab::test;

const TransferStructure kCourse = TransferStructure::single(2, 0);

FitOptions exact() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

TEST(rivc, noise_free_records_give_the_truth) {  // oracle: the simulated system
    const Fit found = rivc(course_system_data(0, 1), kCourse, {1, 2}, exact());
    EXPECT_LT(relative_difference(found.theta, values({4, 3, 2})), 1e-9) << message_text(found.full_message());
    EXPECT_TRUE(found.std.allFinite());
}

TEST(rivc, without_a_noise_model_it_is_srivc) {  // oracle: srivc's fixed point
    for (const char* set : {"sys2_s0.2_seed1", "sys2_s0.4_seed1", "rg_snr10_seed1"}) {
        const IdData data = reference_data(set, 0.01);
        const TransferStructure structure = set[0] == 'r' ? TransferStructure::single(4, 1) : kCourse;
        const Fit a = rivc(data, structure, {0, 0}, exact());
        const Fit b = srivc(data, structure, exact());
        EXPECT_LT(relative_difference(a.theta, b.theta), 1e-8) << set;
        EXPECT_LT(relative_difference(a.std, b.std), 1e-6) << set;
        EXPECT_EQ(a.noise->C, Vector::Ones(1));
        EXPECT_EQ(a.noise->D, Vector::Ones(1));
    }
}

// oracle: the published test problem's system and noise
TEST(rivc, finds_model_and_noise_within_their_errors) {
    for (const std::uint32_t seed : {1, 2, 3}) {
        const Fit found = rivc(ColoredProblem().simulated_data(seed), kCourse, {1, 2});
        EXPECT_EQ(found.termination, Termination::kConverged) << message_text(found.full_message());
        const Vector truth = values({4, 3, 2});
        for (Index i = 0; i < 3; ++i) EXPECT_NEAR(found.theta[i], truth[i], 3 * found.std[i]) << seed;
        EXPECT_NEAR(found.noise->C[1], 0.9, 3 * found.noise->C_std[1]) << seed;
        EXPECT_NEAR(found.noise->D[1], -1, 3 * found.noise->D_std[1]) << seed;
        EXPECT_NEAR(found.noise->D[2], 0.2, 3 * found.noise->D_std[2]) << seed;
    }
}

// oracle: the definition, instruments orthogonal to the prediction error, with sensitivities by differences
TEST(rivc, instruments_are_orthogonal_to_the_prediction_error) {
    const IdData data = ColoredProblem().simulated_data(4);
    const Fit found = rivc(data, kCourse, {1, 2}, exact());
    ArmaNoise noise = ArmaNoise::white(1, 2);
    noise.C = found.noise->C;
    noise.D = found.noise->D;
    const Vector u = data.experiments[0].u.col(0), y = data.experiments[0].y.col(0);
    const auto error = [&](const Vector& theta) -> Vector {
        return whitened(noise, y - lsim(TransferFunction(theta.tail(1), values({1, theta[0], theta[1]})), u, 0.05));
    };
    const Vector e = error(found.theta);
    for (Index i = 0; i < 3; ++i) {
        Vector above = found.theta, below = found.theta;
        above[i] += 1e-5;
        below[i] -= 1e-5;
        const Vector z = (error(above) - error(below)) / 2e-5;
        EXPECT_LT(std::abs(z.dot(e)) / (z.norm() * e.norm()), 1e-7) << i;
    }
}

TEST(rivc, delays_offsets_inputs_and_experiments) {  // oracle: the simulated systems
    const Vector u = prbs(7, 8), w = prbs(7, 5).replicate(2, 1).topRows(u.size());
    const Vector x = lsim(TransferFunction(values({2}), values({1, 4, 3}), 0, 0.33), u, 0.05);
    const Vector v = 0.05 * arma_signal(values({1}), values({1, -0.8}), u.size(), 3);
    TransferStructure free = kCourse;
    free.free_delays = true;
    FitOptions options;
    options.offset = Offset::kEstimate;
    const Fit late = rivc(IdData(Matrix(x.array() + 5 + v.array()), Matrix(u), 0.05), free, {0, 1}, options);
    EXPECT_NEAR(late.theta[3], 0.33, 4 * late.std[3]) << message_text(late.full_message());
    EXPECT_NEAR(late.offsets(0, 0), 5, 0.2) << message_text(late.full_message());
    EXPECT_NEAR(late.noise->D[1], -0.8, 4 * late.noise->D_std[1]);
    EXPECT_GE(late.delay_grid.size(), 5);

    Matrix inputs(u.size(), 2);
    inputs << u, w;
    const Vector second = lsim(TransferFunction(values({1}), values({1, 0.8})), w, 0.05);
    const Vector first = lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05);
    const IdData one(Matrix(first + second + v), inputs, 0.05);
    const auto structure = TransferStructure::grid(1, 2, Denominators::kPerChannel, {2, 1}, {0, 0}, {0, 0});
    const Fit both = rivc(IdData::merge({one, one}), structure, {0, 1});
    const Vector truth = values({4, 3, 2, 0.8, 1});
    for (Index i = 0; i < 5; ++i)
        EXPECT_NEAR(both.theta[i], truth[i], 6 * both.std[i]) << message_text(both.full_message());
}

// oracle: the simulated system. Unknown inputs from before the data affect their first 1.2 s
TEST(rivc, a_record_cut_from_a_running_experiment) {
    const Vector u = prbs(7, 8);
    const Vector x = lsim(TransferFunction(values({2}), values({1, 4, 3}), 0, 1.2), u, 0.05);
    FitOptions options = exact();
    options.initial_state = InitialState::kEstimate;
    TransferStructure late = kCourse;
    late.channels[0].delay = 1.2;
    const Fit found = rivc(IdData(Matrix(x), Matrix(u), 0.05).range(301, 900), late, {0, 1}, options);
    EXPECT_LT(relative_difference(found.theta, values({4, 3, 2})), 1e-7) << message_text(found.full_message());

    // What does not count makes no noise either.
    const Vector v = 0.05 * arma_signal(values({1}), values({1, -0.8}), u.size(), 5);
    const Fit noisy = rivc(IdData(Matrix(x + v), Matrix(u), 0.05).range(301, 900), late, {0, 1}, options);
    EXPECT_NEAR(noisy.noise->D[1], -0.8, 3 * noisy.noise->D_std[1]);
    EXPECT_NEAR(std::sqrt(noisy.noise_variance[0]), 0.05, 0.005);
    for (Index i = 0; i < 3; ++i) EXPECT_NEAR(noisy.theta[i], values({4, 3, 2})[i], 3 * noisy.std[i]);
}

TEST(rivc, refuses_what_it_cannot_do) {
    const IdData data = ColoredProblem().simulated_data(1);
    const Matrix u = data.experiments[0].u, y = data.experiments[0].y;
    Vector t = Vector::LinSpaced(u.rows(), 0, 50);
    t[3] += 0.01;
    const auto says = [](const std::string& message, const char* part) {
        return message.find(part) != std::string::npos;
    };
    EXPECT_TRUE(says(thrown_message([&] { rivc(IdData(y, u, t), kCourse, {1, 2}); }), "sampled regularly"));
    EXPECT_TRUE(says(thrown_message([&] { rivc(data, kCourse, {-1, 2}); }), "must be nonnegative"));
    EXPECT_TRUE(says(thrown_message([&] { rivc(data.range(1, 15), kCourse, {1, 2}); }), "at least 18 samples"));
    EXPECT_TRUE(says(thrown_message([&] { rivc(IdData(y, 0 * u, 0.05), kCourse, {1, 2}); }), "is zero in all samples"));
    EXPECT_TRUE(says(thrown_message([&] {
                         rivc(IdData(y.replicate(1, 2), u, 0.05),
                              TransferStructure::grid(2, 1, Denominators::kPerChannel, {2}, {0}, {0}), {1, 2});
                     }),
                     "one output"));
}

TEST(rivc, always_answers) {
    FitOptions options;
    options.max_iterations = 1;
    const Fit stopped = rivc(ColoredProblem().simulated_data(1), kCourse, {1, 2}, options);
    EXPECT_EQ(stopped.termination, Termination::kIterationLimit);
    EXPECT_TRUE(stopped.theta.allFinite() && stopped.std.allFinite());
    EXPECT_NE(message_text(stopped.full_message()).find("`max_iterations` = 1"), std::string::npos);
    options.cancel = [] { return true; };
    EXPECT_TRUE(rivc(ColoredProblem().simulated_data(1), kCourse, {1, 2}, options).theta.allFinite());
}

}  // namespace test_rivc
