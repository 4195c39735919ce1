#include "numerics/estimators/lssvf.h"

#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/criteria/estimating_terms.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/statistics/robust_covariance.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_lssvf {

using namespace dynlab;
using namespace dynlab::test;

SvfOptions cutoff(double lambda) {
    SvfOptions options;
    options.lambda = lambda;
    return options;
}

const TransferStructure kCourse = TransferStructure::single(2, 0);

TEST(lssvf, equals_least_squares_on_the_columns_of_svf) {  // oracle: second route, stored columns and QR
    const IdData data = course_system_data(0.2, 3);
    const Matrix y = state_variable_filter(data.experiments[0].y.col(0), 2, 3, 0.01, Hold::kFoh);
    const Matrix u = state_variable_filter(data.experiments[0].u.col(0), 2, 3, 0.01, Hold::kZoh);
    Matrix Phi(y.rows(), 3);
    Phi << -y.col(1), -y.col(2), u.col(2);
    const LeastSquares expected = solve_least_squares(Phi, y.col(0));
    Fit found = lssvf(data, kCourse, cutoff(3));
    EXPECT_LT(relative_difference(found.theta, expected.solution), 1e-11);
    const double variance = expected.residuals.squaredNorm() / static_cast<double>(y.rows() - 3);
    EXPECT_LT(relative_difference(found.covariance.diagonal(), variance * expected.inverse_gram.diagonal()), 1e-9);
    EXPECT_EQ(found.names, (std::vector<std::string>{"a1", "a2", "b0"}));

    color_covariance(found, data, cutoff(3), false);
    const DenominatorGroup group(data, kCourse, 0, Hold::kFoh);
    const EstimatingTerms terms = estimating_terms(group, values({1, 6, 9}), 1, found.theta);
    const Matrix covariance = robust_covariance(expected.inverse_gram, terms.Z, terms.errors).covariance;
    EXPECT_LT(relative_difference(found.covariance.diagonal(), covariance.diagonal()), 1e-9);
    EXPECT_LT(relative_difference(found.std, covariance.diagonal().cwiseSqrt()), 1e-9);
}

TEST(lssvf, long_records_keep_the_errors_of_a_white_equation_error_and_say_so) {  // oracle: nothing but the sentence
    const Index N = kMaxColoredSamples + 1;
    const Vector u = RandomStream(1).normal(N);
    const Vector y = lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.01) + 0.1 * RandomStream(2).normal(N);
    const IdData data{Matrix(y), Matrix(u), 0.01};
    Fit found = lssvf(data, kCourse, cutoff(3));
    const Matrix plain = found.covariance;
    color_covariance(found, data, cutoff(3), false);
    EXPECT_EQ(found.covariance, plain);
    EXPECT_NE(message_text(found.full_message()).find("assume a white"), std::string::npos)
        << message_text(found.full_message());
}

TEST(lssvf, delay_of_whole_samples_equals_shifted_input) {  // oracle: shift invariance
    const IdData data = course_system_data(0.2, 4);
    const Matrix u = data.experiments[0].u;
    Matrix late = Matrix::Zero(u.rows(), 1);
    late.bottomRows(u.rows() - 7) = u.topRows(u.rows() - 7);
    const IdData shifted(data.experiments[0].y, late, 0.01);
    const Fit a = lssvf(shifted, kCourse, cutoff(3));
    const Fit b = lssvf(data, TransferStructure::single(2, 0, 0.07), cutoff(3));
    EXPECT_LT(relative_difference(a.theta, b.theta), 1e-10);
    EXPECT_EQ(b.models[0].delay(), 0.07);
}

TEST(lssvf, poisson_moment_functionals_give_the_same_parameters) {  // oracle: the gain cancels
    const IdData data = course_system_data(0.2, 5);
    SvfOptions options = cutoff(3);
    options.beta = 12.5;
    EXPECT_LT(relative_difference(lssvf(data, kCourse, options).theta, lssvf(data, kCourse, cutoff(3)).theta), 1e-10);
}

TEST(lssvf, fast_sampling_without_noise_gives_the_truth_for_several_inputs) {  // oracle: the simulated system
    const Vector u1 = prbs(5, 40).head(1200), u2 = prbs(6, 23).head(1200);
    const Vector den = values({1, 2, 4});
    const Vector y = lsim(TransferFunction(values({3, 1}), den), u1, 0.01) +
                     lsim(TransferFunction(values({-2}), den, 0, 0.05), u2, 0.01);
    Matrix u(1200, 2);
    u << u1, u2;
    const TransferStructure structure = TransferStructure::grid(1, 2, Denominators::kPerOutput, {2}, {1, 0}, {0, 0.05});
    const Fit found = lssvf(IdData(Matrix(y), u, 0.01), structure, cutoff(4));
    EXPECT_LT(relative_difference(found.theta, values({2, 4, 3, 1, -2})), 1e-3);  // y is not straight between samples
    EXPECT_EQ(found.names, (std::vector<std::string>{"a1", "a2", "b0_u1", "b1_u1", "b0_u2"}));
}

TEST(lssvf, order_of_experiments_does_not_matter) {  // oracle: invariance
    const IdData a = course_system_data(0.2, 6), b = course_system_data(0.2, 7);
    const Vector one = lssvf(IdData::merge({a, b}), kCourse, cutoff(3)).theta;
    EXPECT_LT(relative_difference(one, lssvf(IdData::merge({b, a}), kCourse, cutoff(3)).theta), 1e-12);
    EXPECT_GT(relative_difference(one, lssvf(a, kCourse, cutoff(3)).theta), 1e-3);
}

TEST(lssvf, irregular_instants_that_are_regular_give_the_same) {  // oracle: second route through matrix exponentials
    const IdData data = course_system_data(0.2, 8);
    const IdData irregular(data.experiments[0].y, data.experiments[0].u, data.time());
    EXPECT_LT(relative_difference(lssvf(irregular, kCourse, cutoff(3)).theta, lssvf(data, kCourse, cutoff(3)).theta),
              1e-7);
}

TEST(lssvf, warns_of_a_cutoff_far_from_the_band) {  // oracle: the system's poles are -1 and -3
    const IdData data = course_system_data(0, 1);
    EXPECT_NE(message_text(lssvf(data, kCourse, cutoff(100)).full_message()).find("choose lambda"), std::string::npos);
    EXPECT_EQ(message_text(lssvf(data, kCourse, cutoff(3)).full_message()).find("choose lambda"), std::string::npos);
}

TEST(lssvf, refuses_bad_input_in_words) {  // oracle: the sentence names what is wrong
    const IdData data = course_system_data(0.2, 1);
    const auto says = [&](const IdData& d, const TransferStructure& s, const SvfOptions& o, const std::string& words) {
        EXPECT_NE(thrown_message([&] { lssvf(d, s, o); }).find(words), std::string::npos)
            << thrown_message([&] { lssvf(d, s, o); });
    };
    says(data, kCourse, cutoff(0), "lambda");
    says(data, kCourse, cutoff(-3), "lambda");
    says(data.range(1, 5), kCourse, cutoff(3), "samples are needed");
    says(data, TransferStructure::single(2, 0, 15), cutoff(3), "not shorter than the data");
    const Matrix y = data.experiments[0].y, zero = Matrix::Zero(y.rows(), 1);
    says(IdData(y, zero, 0.01), kCourse, cutoff(3), "zero in all samples");
    says(IdData(y, Matrix(y.rows(), 0), 0.01), kCourse, cutoff(3), "no input");
    says(IdData(Matrix::Constant(y.rows(), 1, 2.5), data.experiments[0].u, 0.01), kCourse, cutoff(3), "never changes");
    says(IdData(Matrix(y.array() + 5), Matrix::Ones(y.rows(), 1), 0.01), kCourse, cutoff(3), "no excitation");
}

TEST(lssvf, refused_constant_input_is_no_experiment) {  // oracle: justification, two systems with equal data
    // At rest at gain times input, a fast and a slow system of equal gain give the same data.
    const Vector u = Vector::Ones(200);
    const TransferFunction fast(values({8}), values({1, 6, 4})), slow(values({2}), values({1, 3, 1}));
    EXPECT_EQ(fast.dc_gain(), slow.dc_gain());
    const IdData data_set(Matrix(2 * u), Matrix(u), 0.1);
    EXPECT_FALSE(thrown_message([&] { lssvf(data_set, kCourse, cutoff(3)); }).empty());
}

}  // namespace test_lssvf
