#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/step_test.h"
#include "numerics/plants/heat_exchanger.h"
#include "numerics/plants/suspension.h"
#include "numerics/signals/random.h"

namespace test_step_test {

using namespace dynlab;
using testing::HasSubstr;

struct Experimental {
    Index N = 1000, step = 100;
    double Ts = 0.01, u_before = 0, u_after = 1, offset = 0, noise = 0;
    std::uint32_t seed = 1;
};

// offset + K u_before at rest, then the unit step response `rise(t)` scaled to the step.
IdData data_of(const Experimental& e, double K, const std::function<double(double)>& rise) {
    RandomStream random(e.seed);
    Matrix y(e.N, 1), u(e.N, 1);
    for (Index k = 0; k < e.N; ++k) {
        u(k, 0) = k < e.step ? e.u_before : e.u_after;
        const double t = static_cast<double>(k - e.step) * e.Ts;
        y(k, 0) = e.offset + K * (e.u_before + (k < e.step ? 0 : (e.u_after - e.u_before) * rise(t)));
        y(k, 0) += e.noise * random.normal();
    }
    return IdData(y, u, e.Ts);
}

std::function<double(double)> first_order(double T, double D = 0) {
    return [=](double t) { return t < D ? 0 : -std::expm1(-(t - D) / T); };
}

std::function<double(double)> second_order(double z, double w0) {
    return [=](double t) {
        const double root = std::sqrt(1 - z * z), phase = w0 * root * t;
        return 1 - std::exp(-z * w0 * t) * (std::cos(phase) + z / root * std::sin(phase));
    };
}

double parameter(const StepTestResult& result, const std::string& name) {
    const auto found = std::find(result.names.begin(), result.names.end(), name);
    return found == result.names.end() ? std::nan("") : result.parameters[found - result.names.begin()];
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "nothing was refused";
}

TEST(step_test,
     first_order_recovers_a_clean_response) {  // oracle: analytic; ln 20 time constants to 5 %, read as three
    const Experimental e;
    const auto result = step_first_order(data_of(e, 2.5, first_order(0.8)));
    EXPECT_NEAR(parameter(result, "K"), 2.5, 2.5 * 1e-3);
    EXPECT_NEAR(parameter(result, "T"), 0.8 * std::log(20.0) / 3, 0.8 * 5e-3);
    EXPECT_NEAR(result.model.dc_gain(), parameter(result, "K"), 1e-12);
    ASSERT_EQ(result.points.size(), 1u);
    EXPECT_NEAR(result.points[0].time, 1 + 3 * parameter(result, "T"), 1e-12);
    EXPECT_NEAR(result.points[0].value, 0.95 * result.step_data.final.value, 1e-3);
}

TEST(step_test, works_from_any_level_in_either_direction) {  // oracle: invariance of the readings
    Experimental plain, shifted;
    shifted.u_before = 7;
    shifted.u_after = 4;
    shifted.offset = -30;
    const auto a = step_first_order(data_of(plain, 2.5, first_order(0.8)));
    const auto b = step_first_order(data_of(shifted, 2.5, first_order(0.8)));
    EXPECT_NEAR(parameter(a, "K"), parameter(b, "K"), 1e-9);
    EXPECT_NEAR(parameter(a, "T"), parameter(b, "T"), 1e-9);
    EXPECT_NEAR(b.step_data.initial.value, -30 + 2.5 * 7, 1e-9);
    EXPECT_EQ(b.step_data.input_before, 7);
    EXPECT_EQ(b.step_data.input_after, 4);
    EXPECT_NEAR(b.step_data.step_time, 1, 1e-12);
}

TEST(step_test, constant_input_is_a_step_at_the_first_sample) {  // oracle: invariance of the readings
    Experimental late, at_once;
    late.N = 1000;
    at_once.N = 900;
    at_once.step = 0;
    const auto a = step_second_order(data_of(late, 1.5, second_order(0.2, 6)));
    const auto b = step_second_order(data_of(at_once, 1.5, second_order(0.2, 6)));
    EXPECT_NEAR(parameter(a, "K"), parameter(b, "K"), 1e-9);
    EXPECT_NEAR(parameter(a, "z"), parameter(b, "z"), 1e-9);
    EXPECT_NEAR(parameter(a, "w0"), parameter(b, "w0"), 1e-9);
    EXPECT_EQ(b.step_data.input_before, 0);
    EXPECT_EQ(b.step_data.initial.value, 0);
}

TEST(step_test, second_order_recovers_a_clean_response) {  // oracle: analytic
    for (double z : {0.1, 0.3, 0.6}) {
        Experimental e;
        e.N = 2000;
        const auto result = step_second_order(data_of(e, -0.7, second_order(z, 5)));
        EXPECT_NEAR(parameter(result, "K"), -0.7, 0.7 * 2e-3) << z;
        EXPECT_NEAR(parameter(result, "z"), z, 2e-3) << z;
        EXPECT_NEAR(parameter(result, "w0"), 5, 5 * 3e-3) << z;
        EXPECT_NEAR(result.model.poles().real()[0], -z * 5, 0.02) << z;
    }
}

TEST(step_test, delayed_recovers_a_clean_response) {  // oracle: analytic
    Experimental e;
    e.N = 1500;
    const auto result = step_delayed(data_of(e, 3, first_order(0.9, 0.55)));
    EXPECT_NEAR(parameter(result, "K"), 3, 3e-3);
    EXPECT_NEAR(parameter(result, "T"), 0.9, 0.9 * 5e-3);
    EXPECT_NEAR(parameter(result, "D"), 0.55, 0.01);
    EXPECT_NEAR(result.model.delay(), parameter(result, "D"), 1e-15);
    ASSERT_EQ(result.points.size(), 2u);
    EXPECT_NEAR(result.points[0].value / result.step_data.final.value, 0.283, 1e-3);
    EXPECT_NEAR(result.points[1].value / result.step_data.final.value, 0.632, 1e-3);
    EXPECT_NEAR(result.points[0].time, 1 + 0.55 + 0.9 / 3, 0.01);
}

TEST(step_test, delayed_without_delay_says_so) {  // oracle: analytic
    Experimental e;
    e.noise = 1e-3;
    double least = 1;
    for (e.seed = 1; e.seed < 20; ++e.seed) {
        const auto result = step_delayed(data_of(e, 1, first_order(0.9)));
        EXPECT_GE(parameter(result, "D"), 0);
        EXPECT_LT(parameter(result, "D"), 0.02);
        EXPECT_EQ(parameter(result, "D") == 0,
                  message_text(result.message).find("The response shows no delay") != std::string::npos);
        least = std::min(least, parameter(result, "D"));
    }
    EXPECT_EQ(least, 0);
}

TEST(step_test, reads_the_heat_exchanger_through_its_noise) {  // oracle: physical truth, fixed seeds
    const HeatExchangerParameters p;
    const auto truth = heat_exchanger_truth(p);
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        const auto step_data = simulate_heat_exchanger(p, seed);
        const auto result = step_first_order(IdData(step_data.y, step_data.u, p.Ts));
        EXPECT_NEAR(parameter(result, "K") / truth.gain, 1, 0.02) << seed;
        EXPECT_NEAR(parameter(result, "T") / truth.time_constant, 1, 0.1) << seed;
        EXPECT_NEAR(result.step_data.initial.value, truth.initial_output, 0.1) << seed;
        EXPECT_NEAR(result.step_data.noise_std, p.noise_std, 0.3 * p.noise_std) << seed;
    }
}

TEST(step_test, reads_the_suspension_through_its_noise) {  // oracle: physical truth, fixed seeds
    const SuspensionParameters p;
    const auto truth = suspension_truth(p);
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        const auto step_data = simulate_suspension(p, seed);
        const auto result = step_second_order(IdData(step_data.y, step_data.u, p.Ts));
        EXPECT_NEAR(parameter(result, "K") / truth.gain, 1, 0.02) << seed;
        EXPECT_NEAR(parameter(result, "z") / truth.damping_ratio, 1, 0.05) << seed;
        EXPECT_NEAR(parameter(result, "w0") / truth.natural_frequency, 1, 0.03) << seed;
    }
}

TEST(step_test, survives_an_outlier) {  // oracle: definition of a robust level
    Experimental e;
    IdData data = data_of(e, 2, first_order(0.8));
    data.experiments[0].y(50, 0) = 40;
    data.experiments[0].y(990, 0) = -40;
    const auto result = step_delayed(data);
    EXPECT_NEAR(parameter(result, "K"), 2, 0.01);
}

TEST(step_test, reads_irregular_samples) {  // oracle: analytic
    RandomStream random(4);
    const Index N = 800;
    Vector t(N);
    t[0] = 0;
    for (Index k = 1; k < N; ++k) t[k] = t[k - 1] + 0.005 + 0.01 * random.uniform();
    Matrix u(N, 1), y(N, 1);
    const double start = t[100];
    for (Index k = 0; k < N; ++k) {
        u(k, 0) = k < 100 ? 0 : 2;
        y(k, 0) = k < 100 ? 0 : 2 * 1.5 * first_order(0.7, 0.3)(t[k] - start);
    }
    const auto result = step_delayed(IdData(y, u, t));
    EXPECT_NEAR(parameter(result, "T"), 0.7, 0.02);
    EXPECT_NEAR(parameter(result, "D"), 0.3, 0.02);
}

TEST(step_test, refuses_an_input_that_is_no_step) {
    Experimental e;
    IdData pulse = data_of(e, 1, first_order(0.5));
    pulse.experiments[0].u.bottomRows(200).setZero();
    EXPECT_THAT(refusal([&] { step_first_order(pulse); }), HasSubstr("changes 2 times"));
    IdData stairs = data_of(e, 1, first_order(0.5));
    stairs.experiments[0].u.middleRows(300, 50).setConstant(0.7);
    EXPECT_THAT(refusal([&] { step_first_order(stairs); }), HasSubstr("but the two levels"));
    IdData nothing = data_of(e, 1, first_order(0.5));
    nothing.experiments[0].u.setZero();
    EXPECT_THAT(refusal([&] { step_first_order(nothing); }), HasSubstr("zero in all samples"));
}

TEST(step_test, accepts_a_noisy_step_input) {  // oracle: the same data with a clean input
    Experimental e;
    IdData data = data_of(e, 2, first_order(0.5));
    const auto clean = step_first_order(data);
    RandomStream random(2);
    for (Index k = 0; k < e.N; ++k) data.experiments[0].u(k, 0) += 0.02 * (random.uniform() - 0.5);
    EXPECT_NEAR(parameter(step_first_order(data), "K"), parameter(clean, "K"), 0.01);
}

TEST(step_test, refuses_a_response_that_has_not_settled) {  // justified: the final level would be 10 % off
    Experimental e;
    e.N = 100 + 230;
    EXPECT_THAT(refusal([&] { step_first_order(data_of(e, 1, first_order(1))); }), HasSubstr("has not settled"));
    e.N = 100 + 600;
    EXPECT_NO_THROW(step_first_order(data_of(e, 1, first_order(1))));
    e.N = 1000;
    EXPECT_THAT(refusal([&] { step_second_order(data_of(e, 1, second_order(0.01, 5))); }),
                HasSubstr("has not settled"));
}

TEST(step_test, refuses_a_response_without_overshoot) {  // justified: a first-order response has none
    Experimental e;
    const IdData data = data_of(e, 1, first_order(0.8));
    EXPECT_THAT(refusal([&] { step_second_order(data); }), HasSubstr("does not overshoot"));
    EXPECT_NO_THROW(step_first_order(data));
    e.noise = 0.02;
    EXPECT_THAT(refusal([&] { step_second_order(data_of(e, 1, first_order(0.8))); }), HasSubstr("does not overshoot"));
}

TEST(step_test, refuses_an_output_that_does_not_answer) {  // justified: it is noise alone
    Experimental e;
    e.noise = 0.1;
    EXPECT_THAT(refusal([&] { step_first_order(data_of(e, 0, first_order(0.8))); }), HasSubstr("does not respond"));
}

TEST(step_test, refuses_records_it_cannot_read) {
    Experimental e;
    e.N = 105;
    EXPECT_THAT(refusal([&] { step_first_order(data_of(e, 1, first_order(0.8))); }), HasSubstr("5 samples"));
    e.N = 1000;
    EXPECT_THAT(refusal([&] { step_first_order(data_of(e, 1, first_order(1e-4))); }), HasSubstr("sample faster"));
    for (const double D : {0.0, 0.013, 0.02})
        EXPECT_THAT(refusal([&] { step_delayed(data_of(e, 1, first_order(1e-4, D))); }),
                    HasSubstr("from 28.3 % to 63.2 % within one sample"))
            << D;
    const IdData two_inputs(Matrix::Zero(50, 1), Matrix::Ones(50, 2), 1.0);
    EXPECT_THAT(refusal([&] { step_first_order(two_inputs); }), HasSubstr("one input"));
}

}  // namespace test_step_test
