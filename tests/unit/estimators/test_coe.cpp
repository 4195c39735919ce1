#include "numerics/estimators/coe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/srivc.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_coe {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const TransferStructure kCourse = TransferStructure::single(2, 0);

FitOptions exact() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

TransferStructure with_free_delay(int poles, int zeros) {
    TransferStructure structure = TransferStructure::single(poles, zeros);
    structure.free_delays = true;
    return structure;
}

/// White noise of a signal-to-noise ratio 20 log10(std x/std e).
Vector with_noise(const Vector& x, double decibel, std::uint32_t seed) {
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean()) * std::pow(10, -decibel / 20);
    return x + deviation * RandomStream(seed).normal(x.size());
}

/// Each value within so many standard errors of the truth.
void expect_near_truth(const Fit& found, const Vector& truth, double errors) {
    for (Index i = 0; i < truth.size(); ++i)
        EXPECT_LT(std::abs(found.theta[i] - truth[i]), errors * found.std[i])
            << found.names[static_cast<std::size_t>(i)] << ": " << found.theta[i] << " for " << truth[i] << "; "
            << message_text(found.full_message());
}

IdData simulated_data(const Vector& y, const Vector& u, double Ts) {
    return IdData(Matrix(y), Matrix(u), Ts);
}

TEST(coe, equals_srivc_on_noisy_sets) {  // oracle: the fixed point of SRIVC is the output-error optimum
    for (const char* set : {"sys2_s0.2_seed1", "sys2_s0.4_seed1", "rg_snr10_seed1"}) {
        const IdData data = reference_data(set, 0.01);
        const TransferStructure structure = set[0] == 'r' ? TransferStructure::single(4, 1) : kCourse;
        const Fit a = coe(data, structure, exact()), b = srivc(data, structure, exact());
        EXPECT_LT(relative_difference(a.theta, b.theta), 1e-8) << set;
        EXPECT_LT(relative_difference(a.std, b.std), 1e-7) << set;
    }
}

TEST(coe, noise_free_records_give_the_truth) {  // oracle: the simulated system
    EXPECT_LT(relative_difference(coe(course_system_data(0, 1), kCourse, exact()).theta, values({4, 3, 2})), 1e-9);
    EXPECT_LT(
        relative_difference(coe(reference_data("rg_noisefree", 0.01), TransferStructure::single(4, 1), exact()).theta,
                            values({5, 408, 416, 1600, -6400, 1600})),
        1e-9);
}

// oracle: a published test problem in which local searches end in a wrong delay
TEST(coe, delay_trap_is_avoided_from_default_settings) {
    const Vector u = prbs(8, 5);
    const Vector x = lsim(TransferFunction(values({-4, 0.5}), values({1, 1, 4}), 0, 8), u, 0.1);
    for (const std::uint32_t seed : {1, 2, 3}) {
        const IdData data(Matrix(with_noise(x, 15, seed)), Matrix(u), 0.1);
        for (const auto method : {coe, srivc}) {
            const Fit found = method(data, with_free_delay(2, 1), {}, {});
            EXPECT_NEAR(found.models[0].delay(), 8, 0.1) << message_text(found.full_message());
            EXPECT_LT(std::abs(found.theta[0] - 1), 4 * found.std[0]) << message_text(found.full_message());
            EXPECT_LT(std::abs(found.theta[1] - 4), 4 * found.std[1]) << message_text(found.full_message());
            EXPECT_GE(found.delay_grid.size(), 20);
        }
    }
}

TEST(coe, delays_between_samples_are_found_with_their_error) {  // oracle: the simulated system and its scatter
    const Vector u = prbs(7, 12);
    const Vector x = lsim(TransferFunction(values({3}), values({1, 2, 5}), 0, 0.437), u, 0.05);
    FitOptions options;
    options.largest_delay = 2;
    Vector delays(20);
    double reported = 0;
    for (Index k = 0; k < delays.size(); ++k) {
        const IdData data(Matrix(with_noise(x, 15, static_cast<std::uint32_t>(k + 1))), Matrix(u), 0.05);
        const Fit found = srivc(data, with_free_delay(2, 0), options);
        delays[k] = found.theta[3];
        reported += found.std[3] / 20;
    }
    const double scatter = std::sqrt((delays.array() - delays.mean()).square().sum() / 19);
    EXPECT_NEAR(delays.mean(), 0.437, 3 * reported / std::sqrt(20.0));
    EXPECT_NEAR(scatter / reported, 1, 0.5);
}

TEST(coe, irregular_sampling_recovers_the_system) {  // oracle: a published test problem, three standard errors
    const Index N = 3000;
    RandomStream random(5);
    Vector t(N), u(N);
    double time = 0;
    for (Index k = 0; k < N; ++k) {
        t[k] = time;
        u[k] = std::sin(0.714 * time) + std::sin(1.428 * time) + std::sin(2.142 * time);
        time += 0.01 + 0.09 * random.uniform();
    }
    const Vector x = lsim(TransferFunction(values({5}), values({1, 2.8, 4})), u, t);
    expect_near_truth(srivc(IdData(Matrix(with_noise(x, 10, 2)), Matrix(u), t), kCourse, {}), values({2.8, 4, 5}), 3);
}

TEST(coe, stiff_system_is_recovered) {  // oracle: a published test problem, three standard errors
    const Vector u = prbs(7, 10);
    const Vector den = values({2000, 210, 1});
    const Vector x = lsim(TransferFunction(values({200, 2}), den), u, 2);
    const IdData data(Matrix(with_noise(x, 10, 3)), Matrix(u), 2);
    expect_near_truth(srivc(data, TransferStructure::single(2, 1), {}), values({0.105, 0.0005, 0.1, 0.001}), 3);
}

TEST(coe, two_inputs_with_their_own_poles_are_recovered) {  // oracle: a published test problem, three standard errors
    Matrix u(1270, 2);
    u << prbs(9, 6).head(1270), prbs(7, 10);
    const Vector x = lsim(TransferFunction(values({4}), values({1, 2, 4}), 0, 0.03), u.col(0), 0.01) +
                     lsim(TransferFunction(values({1}), values({1, 1, 1}), 0, 0.05), u.col(1), 0.01);
    const TransferStructure structure =
        TransferStructure::grid(1, 2, Denominators::kPerChannel, {2}, {0}, {0.03, 0.05});
    expect_near_truth(srivc(IdData(Matrix(with_noise(x, 10, 4)), u, 0.01), structure, {}), values({2, 4, 4, 1, 1, 1}),
                      3);
}

// oracle: the simulated system; data cut from a running experiment, on another level
TEST(coe, initial_state_and_offset_are_recovered_and_chosen) {
    const Vector u = prbs(7, 8);
    const Vector x = lsim(TransferFunction(values({5}), values({1, 0.6, 9})), u, 0.05);
    const Vector y = with_noise(x, 20, 5).array() + 1.5;
    const IdData cut(Matrix(y.tail(700)), Matrix(u.tail(700)), 0.05);
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    const Fit estimated = srivc(cut, kCourse, options);
    expect_near_truth(estimated, values({0.6, 9, 5}), 3);
    EXPECT_NEAR(estimated.offsets(0, 0), 1.5, 0.05);
    options.initial_state = InitialState::kAuto;
    options.offset = Offset::kAuto;
    const Fit chosen = srivc(cut, kCourse, options);
    EXPECT_EQ(chosen.start.state, InitialState::kEstimate) << message_text(chosen.full_message());
    EXPECT_TRUE(chosen.start.offset);
    EXPECT_GT(chosen.fit_percent[0], srivc(cut, kCourse, FitOptions{}.from_rest()).fit_percent[0] + 5);
}

TEST(coe, free_delay_without_noise_is_exact) {  // oracle: the simulated system
    const Vector u = prbs(8, 7);
    for (const double delay : {0.0, 0.5, 1.2345}) {
        const TransferFunction G(values({2}), values({1, 4, 3}), 0, delay);
        const auto found = coe(simulated_data(lsim(G, u, 0.05), u, 0.05), with_free_delay(2, 0), exact());
        EXPECT_LT((found.theta - values({4, 3, 2, delay})).cwiseAbs().maxCoeff(), 1e-8)
            << message_text(found.full_message());
    }
}

TEST(coe, two_inputs_with_denominators_of_their_own) {  // oracle: the simulated system of the literature
    const Vector u1 = prbs(9, 6).head(1270), u2 = prbs(7, 10);
    const Vector x = lsim(TransferFunction(values({4}), values({1, 2, 4}), 0, 0.03), u1, 0.01) +
                     lsim(TransferFunction(values({1}), values({1, 1, 1}), 0, 0.05), u2, 0.01);
    Matrix u(1270, 2);
    u << u1, u2;
    const TransferStructure structure =
        TransferStructure::grid(1, 2, Denominators::kPerChannel, {2}, {0}, {0.03, 0.05});
    const Vector truth = values({2, 4, 4, 1, 1, 1});
    EXPECT_LT(relative_difference(coe(IdData(Matrix(x), u, 0.01), structure, exact()).theta, truth), 1e-9);
    expect_near_truth(coe(IdData(Matrix(with_noise(x, 10, 1)), u, 0.01), structure), truth, 4);
}

TEST(coe, running_experiment) {  // oracle: the simulated system, cut from a running experiment, with an offset
    const Vector u = prbs(8, 9).array() + 0.7;
    const Vector x = lsim(TransferFunction(values({2}), values({1, 0.4, 3})), u, 0.05).array() + 6;
    const Index first = 131, last = 900;
    const IdData whole = simulated_data(x, u, 0.05), noisy_data = IdData(Matrix(with_noise(x, 20, 1)), Matrix(u), 0.05);
    FitOptions options = exact();
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    const auto found = coe(whole.range(first, last), kCourse, options);
    EXPECT_LT(relative_difference(found.theta, values({0.4, 3, 2})), 1e-9) << message_text(found.full_message());
    EXPECT_NEAR(found.offsets(0, 0), 6, 1e-8);
    EXPECT_NEAR(found.initial_values[0][0], x[first - 1] - 6 - 2.0 / 3 * u[first - 1], 1e-8);
    options.initial_state = InitialState::kAuto;
    options.offset = Offset::kAuto;
    const auto chosen = coe(noisy_data.range(first, last), kCourse, options);
    EXPECT_EQ(chosen.start.state, InitialState::kEstimate) << message_text(chosen.full_message());
    EXPECT_TRUE(chosen.start.offset);
    expect_near_truth(chosen, values({0.4, 3, 2}), 4);
    const auto wrong = coe(noisy_data.range(first, last), kCourse, FitOptions{}.from_rest());
    EXPECT_LT(wrong.fit_percent[0] + 20, chosen.fit_percent[0]);
}

TEST(coe, rest_is_recognized) {  // oracle: the simulated system, from rest without offset
    const IdData data = course_system_data(0.2, 4);
    FitOptions options;
    options.initial_state = InitialState::kAuto;
    options.offset = Offset::kAuto;
    const auto found = coe(data, kCourse, options);
    EXPECT_EQ(found.start.state, InitialState::kZero) << message_text(found.full_message());
    EXPECT_FALSE(found.start.offset);
}

TEST(coe, operating_point_can_be_removed) {  // oracle: the simulated system, about an operating point
    const Vector u = prbs(8, 5);
    const Vector x = lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05);
    FitOptions options = exact().from_rest();
    const auto expected = coe(simulated_data(x.array() - x.mean(), u.array() - u.mean(), 0.05), kCourse, options);
    options.offset = Offset::kRemove;
    const auto found = coe(simulated_data(x.array() + 40, u.array() + 7, 0.05), kCourse, options);
    EXPECT_LT(relative_difference(found.theta, expected.theta), 1e-8);
    EXPECT_NEAR(found.offsets(0, 0), 40 + x.mean(), 1e-10);
}

TEST(coe, whole_sample_shifts_are_delays) {  // oracle: invariance
    const Vector u = prbs(8, 5), y = with_noise(lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05), 15, 1);
    const Index shift = 6, N = u.size();
    Vector later = Vector::Zero(N + shift), held = Vector::Zero(N + shift);
    later.tail(N) = y;
    held.head(N) = u;
    held.tail(shift).setConstant(u[N - 1]);
    const auto plain = coe(simulated_data(y, u, 0.05), kCourse, exact());
    const auto shifted = coe(simulated_data(later, held, 0.05), TransferStructure::single(2, 0, 0.3), exact());
    EXPECT_LT(relative_difference(shifted.theta, plain.theta), 1e-8);
}

TEST(coe, stops_when_asked_to_and_still_gives_a_model) {  // oracle: definition of the callback
    FitOptions options;
    options.cancel = [] { return true; };
    const auto found = coe(course_system_data(0.2, 1), kCourse, options);
    EXPECT_EQ(found.termination, Termination::kCanceled);
    EXPECT_TRUE(found.theta.allFinite());
}

TEST(coe, refuses_bad_input_in_words) {  // oracle: the sentence names what is wrong
    const IdData data = course_system_data(0.2, 1);
    const auto refusal = [](const IdData& d, const TransferStructure& structure, const FitOptions& options = {}) {
        return thrown_message([&] { coe(d, structure, options); });
    };
    EXPECT_THAT(refusal(data.range(1, 8), kCourse), HasSubstr("9 samples"));
    IdData still = data;
    still.experiments[0].u.setZero();
    EXPECT_THAT(refusal(still, kCourse), HasSubstr("zero in all samples"));
    still = data;
    still.experiments[0].y.setConstant(3);
    EXPECT_THAT(refusal(still, kCourse), HasSubstr("never changes"));
    EXPECT_THAT(refusal(data, TransferStructure::single(2, 0, 20)), HasSubstr("not shorter than the data"));
    EXPECT_THAT(refusal(data, TransferStructure::grid(1, 2, Denominators::kCommon, {2}, {0}, {0.0})),
                HasSubstr("2 inputs"));
    FitOptions options;
    options.tolerance = 0;
    EXPECT_THAT(refusal(data, kCourse, options), HasSubstr("`tolerance`"));
    options = {};
    options.largest_delay = 30;
    EXPECT_THAT(refusal(data, with_free_delay(2, 0), options), HasSubstr("`largest_delay` must be shorter"));
    options.largest_delay = 1;
    options.least_delay = 2;
    EXPECT_THAT(refusal(data, with_free_delay(2, 0), options), HasSubstr("at least `least_delay`"));
}

TEST(coe, zero_input_has_no_information) {  // oracle: the criterion
    const Vector zero = Vector::Zero(100);
    EXPECT_EQ(lsim(TransferFunction(values({2}), values({1, 4, 3})), zero, 0.01),
              lsim(TransferFunction(values({7}), values({1, 2, 9})), zero, 0.01));
}

TEST(coe, refuses_bad_options_in_words) {  // oracle: the sentence names the option
    const IdData data = course_system_data(0.2, 1);
    FitOptions options;
    options.largest_delay = 20;
    EXPECT_NE(thrown_message([&] { coe(data, with_free_delay(2, 0), options); }).find("`largest_delay`"),
              std::string::npos);
    options.least_delay = 1;
    options.largest_delay = 0.5;
    EXPECT_NE(thrown_message([&] { coe(data, with_free_delay(2, 0), options); }).find("`largest_delay`"),
              std::string::npos);
}

}  // namespace test_coe
