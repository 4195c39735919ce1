#include "numerics/estimators/srivc.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Dense>

#include "base/reader.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_srivc {

using namespace dynlab;
using namespace dynlab::test;

const TransferStructure kCourse = TransferStructure::single(2, 0);

FitOptions exact() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

TEST(srivc, output_error_is_orthogonal_to_its_sensitivities) {  // oracle: stationarity of the output-error criterion
    const IdData data = course_system_data(0.4, 11);
    const Fit found = srivc(data, kCourse, exact());
    EXPECT_EQ(found.termination, Termination::kConverged);
    const Vector den = found.models[0].den(), num = found.models[0].num();
    const Matrix all = transfer_sensitivities(num, den, 0, data.experiments[0].u.col(0), 0.01, Hold::kZoh);
    const Vector error = data.experiments[0].y.col(0) - all.col(0);
    for (Index i = 1; i <= 3; ++i)
        EXPECT_LT(std::abs(all.col(i).dot(error)) / (all.col(i).norm() * error.norm()), 1e-9) << i;
    EXPECT_NEAR(found.noise_variance[0], error.squaredNorm() / 1497, 1e-12);
    const Matrix psi = all.middleCols(1, 3);
    const Matrix covariance = found.noise_variance[0] * (psi.transpose() * psi).inverse();
    EXPECT_LT(relative_difference(found.covariance.diagonal(), covariance.diagonal()), 1e-8);
}

TEST(srivc, noise_free_records_give_the_truth) {  // oracle: the simulated system
    EXPECT_LT(relative_difference(srivc(course_system_data(0, 1), kCourse, exact()).theta, values({4, 3, 2})), 1e-9);
    EXPECT_LT(
        relative_difference(srivc(reference_data("rg_noisefree", 0.01), TransferStructure::single(4, 1), exact()).theta,
                            values({5, 408, 416, 1600, -6400, 1600})),
        1e-9);
}

TEST(srivc, hold_of_the_output_does_not_move_the_result) {  // oracle: the criterion knows no hold of y
    const IdData data = course_system_data(0.2, 12);
    FitOptions zoh = exact();
    zoh.hold_y = Hold::kZoh;
    EXPECT_LT(relative_difference(srivc(data, kCourse, zoh).theta, srivc(data, kCourse, exact()).theta), 1e-8);
}

TEST(srivc, start_does_not_move_the_result) {  // oracle: the fixed point knows no start
    const IdData data = course_system_data(0.2, 13);
    const Vector expected = srivc(data, kCourse, exact()).theta;
    for (const double lambda : {0.5, 3.0, 25.0}) {
        FitOptions options = exact();
        options.lambda = lambda;
        EXPECT_LT(relative_difference(srivc(data, kCourse, options).theta, expected), 1e-8) << lambda;
    }
}

TEST(srivc, separate_denominators_are_found_by_back_fitting) {  // oracle: the simulated system, without noise
    const Vector u1 = prbs(9, 6).head(1270), u2 = prbs(7, 10);
    const Vector y = lsim(TransferFunction(values({4}), values({1, 2, 4}), 0, 0.03), u1, 0.01) +
                     lsim(TransferFunction(values({1}), values({1, 1, 1}), 0, 0.05), u2, 0.01);
    Matrix u(1270, 2);
    u << u1, u2;
    const TransferStructure structure =
        TransferStructure::grid(1, 2, Denominators::kPerChannel, {2}, {0}, {0.03, 0.05});
    const Fit found = srivc(IdData(Matrix(y), u, 0.01), structure, exact());
    EXPECT_LT(relative_difference(found.theta, values({2, 4, 4, 1, 1, 1})), 1e-8) << message_text(found.full_message());
}

TEST(srivc, irregular_sampling_without_noise_gives_the_truth) {  // oracle: the simulated system
    const Index N = 1500;
    RandomStream random(5);
    Vector t(N), u(N);
    double time = 0;
    for (Index k = 0; k < N; ++k) {
        t[k] = time;
        u[k] = std::sin(0.714 * time) + std::sin(1.428 * time) + std::sin(2.142 * time);
        time += 0.01 + 0.09 * random.uniform();
    }
    IdData data(Matrix(lsim(TransferFunction(values({5}), values({1, 2.8, 4})), u, t)), Matrix(u), t);
    const Fit found = srivc(data, kCourse, exact());
    EXPECT_LT(relative_difference(found.theta, values({2.8, 4, 5})), 1e-8) << message_text(found.full_message());
}

TEST(srivc, long_records_start_on_their_beginning) {  // oracle: the same fixed point from a given cut-off
    const Vector u = prbs(14, 20).head(160'000);
    const TransferFunction G(values({2}), values({1, 4, 3}));
    const Vector y = lsim(G, u, 0.01) + 0.2 * RandomStream(3).normal(u.size());
    const IdData data{Matrix(y), Matrix(u), 0.01};
    const Fit found = srivc(data, kCourse, exact());
    EXPECT_EQ(found.termination, Termination::kConverged);
    const Matrix all = transfer_sensitivities(found.models[0].num(), found.models[0].den(), 0, u, 0.01, Hold::kZoh);
    const Vector error = y - all.col(0);
    for (Index i = 1; i <= 3; ++i)
        EXPECT_LT(std::abs(all.col(i).dot(error)) / (all.col(i).norm() * error.norm()), 1e-8) << i;
}

TEST(srivc, stops_when_asked_to_and_still_gives_a_model) {  // oracle: definition of the callback
    const IdData data = course_system_data(0.2, 14);
    FitOptions options;
    options.lambda = 3;
    int asked = 0;
    options.cancel = [&] { return ++asked > 2; };
    const Fit found = srivc(data, kCourse, options);
    EXPECT_EQ(found.termination, Termination::kCanceled);
    EXPECT_TRUE(found.theta.allFinite());
    EXPECT_EQ(found.trace.size(), 2u);
}

TEST(srivc, refuses_bad_input_in_words) {  // oracle: the sentence names what is wrong
    const IdData data = course_system_data(0.2, 1);
    FitOptions options;
    options.tolerance = -1;
    EXPECT_NE(thrown_message([&] { srivc(data, kCourse, options); }).find("`tolerance`"), std::string::npos);
    EXPECT_NE(thrown_message([&] { srivc(data.range(1, 8), kCourse, {}); }).find("9 samples"), std::string::npos);
    EXPECT_NE(thrown_message([&] { TransferStructure::single(2, 3); }).find("zeros"), std::string::npos);
    EXPECT_NE(thrown_message([&] { TransferStructure::single(0, 0); }).find("poles"), std::string::npos);
}

// oracle: the simulated system without noise; with noise on one output only, the other's accuracy
TEST(srivc, outputs_with_a_common_denominator_share_what_they_know) {
    const Vector u = prbs(6, 30), den = values({1, 2, 9});
    Matrix y(u.size(), 2);
    y << lsim(TransferFunction(values({3}), den), u, 0.01), lsim(TransferFunction(values({-1, 2}), den), u, 0.01);
    const TransferStructure structure = TransferStructure::grid(2, 1, Denominators::kCommon, {2}, {0, 1}, {0});
    const Vector truth = values({2, 9, 3, -1, 2});
    EXPECT_LT(relative_difference(srivc(IdData(y, Matrix(u), 0.01), structure, exact()).theta, truth), 1e-8);
    y.col(0) += 0.3 * RandomStream(2).normal(u.size());
    const Fit found = srivc(IdData(y, Matrix(u), 0.01), structure, exact());
    EXPECT_LT(relative_difference(found.theta.head(2), truth.head(2)), 1e-6) << message_text(found.full_message());
    EXPECT_LT(std::abs(found.theta[2] - 3), 4 * found.std[2]);
    EXPECT_GT(found.trace.front().change, 1e-6) << "the trace begins with the first of all passes";
}

// oracle: two delays and numerators that give the same samples, as n + 1 weights of the sampled response follow from
// n + 2 values
TEST(srivc, reports_delays_that_held_inputs_cannot_show) {
    const Vector u = prbs(7, 8), a = values({1, 3, 4});
    const Vector x = lsim(TransferFunction(values({0.5, 1, 2}), a, 0, 0.33), u, 0.05);
    const IdData data(Matrix(x), Matrix(u), 0.05);
    TransferStructure fixed = TransferStructure::single(2, 2, 0.31);
    const Fit other = srivc(data, fixed);
    EXPECT_LT(other.loss, 1e-12 * x.squaredNorm());
    fixed.free_delays = true;
    const char* doubt = "is known only to within one sampling time";
    const Fit ambiguous = srivc(data, fixed);
    EXPECT_NE(message_text(ambiguous.full_message()).find(doubt), std::string::npos);
    for (Index i = 0; i < ambiguous.std.size(); ++i)  // a1, a2, b2 are found whatever the delay: b2 = gain a2
        EXPECT_EQ(std::isinf(ambiguous.std[i]), i == 2 || i == 3 || i == 5) << ambiguous.names[i];
    TransferStructure proper = TransferStructure::single(2, 1);
    proper.free_delays = true;
    EXPECT_EQ(message_text(srivc(data, proper).full_message()).find(doubt), std::string::npos);
}

TEST(srivc, passes_suffice_for_fixed_delays_from_rest_with_one_denominator) {  // oracle: the rule of srivc.h
    const TransferStructure plain = TransferStructure::single(2, 0);
    const FitOptions rest = FitOptions{}.from_rest();
    EXPECT_TRUE(srivc_passes_suffice(plain, rest));
    EXPECT_FALSE(srivc_passes_suffice(plain, {}));
    EXPECT_TRUE(srivc_passes_suffice(TransferStructure::grid(1, 2, Denominators::kPerOutput, {2}, {0}, {0, 0}), rest));
    EXPECT_FALSE(
        srivc_passes_suffice(TransferStructure::grid(1, 2, Denominators::kPerChannel, {2}, {0}, {0, 0}), rest));
    TransferStructure delayed = plain;
    delayed.free_delays = true;
    EXPECT_FALSE(srivc_passes_suffice(delayed, rest));
    FitOptions moving = rest, offset = rest, held = rest;
    moving.initial_state = InitialState::kEstimate;
    offset.offset = Offset::kEstimate;
    held.fixed = {{"a1", 3}};
    for (const FitOptions& options : {moving, offset, held}) EXPECT_FALSE(srivc_passes_suffice(plain, options));
}

// oracle: the passes alone
TEST(srivc, result_equals_the_passes_where_they_settle) {
    const IdData data = course_system_data(0.4, 11);
    const TransferStructure structure = TransferStructure::single(2, 0);
    EXPECT_EQ(srivc(data, structure).theta, srivc_by_passes(data, structure, {}).theta);
}

TEST(srivc, search_from_a_given_start_ends_at_the_same_minimum) {  // oracle: the least loss is the same from anywhere
    const IdData data = course_system_data(0.4, 11);
    const TransferStructure structure = TransferStructure::single(2, 0);
    SearchAids aids;
    aids.start = Vector(srivc(data, structure).theta * 1.2);
    EXPECT_LT(relative_difference(srivc(data, structure, {}, aids).theta, srivc(data, structure).theta), 1e-5);
}

// oracle: nested models; with its third pole far away the larger one is the smaller one
TEST(srivc, superfluous_poles_leave_the_fit_as_good) {
    const TransferFunction truth(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = prbs(7, 8);
    const Vector x = lsim(truth, u, 0.05);
    for (const std::uint32_t seed : {1, 2, 3}) {
        const IdData data(x + 0.1 * RandomStream(seed).normal(x.size()), u, 0.05);
        for (const int poles : {3, 4}) {
            const Fit large = srivc(data, TransferStructure::single(poles, 0));
            EXPECT_LT(large.loss, 1.01 * srivc(data, kCourse).loss)
                << poles << ": " << message_text(large.full_message());
        }
    }
}

// oracle: nested models
TEST(srivc, passes_in_a_bad_minimum_are_followed_by_a_search) {
    const TransferFunction G(values({-6400, 1600}), values({1, 5, 408, 416, 1600}));
    constexpr double kTs = 0.05;
    const Vector u = prbs(8, 3), x = lsim(G, u, kTs);
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const Vector y = x + 0.35 * RandomStream(seed).normal(x.size());
        const IdData data{Matrix(y), Matrix(u), kTs};
        const Fit two = srivc(data, TransferStructure::single(2, 0)),
                  three = srivc(data, TransferStructure::single(3, 0));
        EXPECT_LE(three.loss, two.loss) << seed;
    }
}

// oracle: the passes' own end; an estimate that is good is given back as it is
TEST(srivc, good_passes_are_the_result) {
    const TransferFunction truth(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = prbs(7, 8);
    const Vector x = lsim(truth, u, 0.05);
    const IdData data(x + 0.1 * RandomStream(1).normal(x.size()), u, 0.05);
    const Fit passes = srivc_by_passes(data, kCourse, {});
    EXPECT_EQ(search_where_passes_fail(passes, data, {}, {}).theta, passes.theta);
}

// oracle: the same minimum by the passes
TEST(srivc, search_alone_ends_where_good_passes_end) {
    const TransferFunction truth(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = prbs(7, 8);
    const Vector x = lsim(truth, u, 0.05);
    const IdData data(x + 0.1 * RandomStream(2).normal(x.size()), u, 0.05);
    FitOptions options;
    options.tolerance = 1e-10;
    const Fit passes = srivc_by_passes(data, kCourse, options),
              searched = search_transfer("srivc", data, kCourse, options);
    EXPECT_LT((searched.theta - passes.theta).norm(), 1e-6 * passes.theta.norm());
}

}  // namespace test_srivc
