// Each issue on data with that planted defect, and no warnings on data without defects.
#include "numerics/validation/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/reader.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/plants/crane_experiments.h"
#include "numerics/plants/heat_transfer.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/difference_equation.h"

namespace test_advice {

using namespace dynlab;
using dynlab::test::random_levels;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kTs = 0.1;

struct DataSet {
    Vector u, x, y;

    IdData data() const { return IdData(Matrix(y), Matrix(u), kTs); }
};

/// 2/(s^2 + s + 4) behind a dead time, driven by random levels.
DataSet simulated_data(std::uint32_t seed = 1, double noise = 0.03, double delay = 0) {
    DataSet r;
    r.u = random_levels(1000, 8, seed);
    r.x = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}}, 0, delay), r.u, kTs);
    r.y = r.x + noise * RandomStream(seed + 100).normal(1000);
    return r;
}

std::string codes(const Advice& advice) {
    std::string all;
    for (const DataIssue& issue : advice.findings) all += issue.code + ": " + message_text(issue.message) + "\n";
    return all;
}

/// The message of an issue, or all codes if the issue is missing.
std::string said(const Advice& advice, const std::string& code) {
    const DataIssue* issue = advice.find(code);
    return issue != nullptr ? message_text(issue->message) : "no " + code + " among:\n" + codes(advice);
}

TEST(advice, clean_records_raise_no_warning) {  // oracle: nothing was put in; false alarms over 30 seeds
    int alarms = 0;
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        const Advice advice = advise(simulated_data(seed).data());
        alarms += !advice.clean();
        EXPECT_FALSE(advice.has("dead_time")) << seed << said(advice, "dead_time");
        EXPECT_TRUE(advice.clean()) << seed << "\n" << codes(advice);
    }
    EXPECT_LE(alarms, 1);
}

TEST(advice, clean_noise_free_records_raise_no_warning) {
    DataSet r = simulated_data(1, 0);
    EXPECT_TRUE(advise(r.data()).clean()) << codes(advise(r.data()));
}

TEST(advice, the_signal_to_noise_ratio_is_that_put_in) {  // oracle: known noise
    for (const double noise : {0.01, 0.1, 0.5}) {
        const DataSet r = simulated_data(3, noise);
        const double power = (r.x.array() - r.x.mean()).square().mean();
        const double decibels = 10 * std::log10(power / (noise * noise));
        const Advice advice = advise(r.data());
        const DataIssue* issue = advice.find(decibels < 10 ? "low_snr" : "noise");
        ASSERT_NE(issue, nullptr) << codes(advice);
        EXPECT_NEAR(issue->value, decibels, 0.7);
    }
}

TEST(advice, dead_time_is_reported_in_seconds_and_samples) {  // oracle: the delay put in
    const Advice advice = advise(simulated_data(2, 0.03, 0.85).data());
    ASSERT_TRUE(advice.has("dead_time")) << codes(advice);
    EXPECT_NEAR(advice.find("dead_time")->value, 0.85, 0.03);
    EXPECT_TRUE(advice.clean()) << codes(advice);
}

TEST(advice, saturation_is_found_with_its_sections) {  // oracle: clipped data
    DataSet r = simulated_data(4, 0);
    const double limit = 0.6 * r.x.maxCoeff();
    r.y = r.x.cwiseMin(limit);
    const Advice advice = advise(r.data());
    ASSERT_TRUE(advice.has("saturation")) << codes(advice);
    EXPECT_THAT(said(advice, "saturation"), AllOf(HasSubstr("% of the data"), HasSubstr("data:discard")));
    Index clipped = 0, listed = 0;
    for (Index k = 0; k < 1000; ++k) clipped += r.y[k] == limit;
    for (const Segment& section : advice.find("saturation")->sections) {
        for (Index k = section.first; k <= section.last; ++k) EXPECT_EQ(r.y[k - 1], limit);
        listed += section.last - section.first + 1;
    }
    EXPECT_GT(listed, 0.8 * static_cast<double>(clipped));
    EXPECT_FALSE(advice.discard.empty());
}

TEST(advice, a_settled_response_is_not_saturated) {  // oracle: first-order steps, exact and quantized
    Vector u = Vector::Zero(400);
    u.tail(350).setOnes();
    const Vector y = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}}), u, 0.1);
    for (const double step : {0.0, 1.0 / 4096, 1.0 / 256}) {
        const Vector z = step > 0 ? Vector((y.array() / step).round() * step) : y;
        const Advice advice = advise(IdData(Matrix(z), Matrix(u), 0.1));
        EXPECT_FALSE(advice.has("saturation")) << step << codes(advice);
        EXPECT_TRUE(advice.has("step_input"));
    }
}

TEST(advice, a_constant_input_may_be_a_step) {  // oracle: definition
    const Vector y = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}}), Vector::Ones(200), 0.1);
    const Advice step = advise(IdData(Matrix(y), Matrix(Vector::Ones(200)), 0.1));
    EXPECT_THAT(said(step, "step_input"), HasSubstr("switched on with the first sample"));
    EXPECT_TRUE(step.clean()) << codes(step);
    EXPECT_TRUE(advise(IdData(Matrix(y), Matrix(Vector::Zero(200)), 0.1)).has("constant"));
}

TEST(advice, saturated_throughout_is_reported) {  // oracle: clipped at a tenth of the range, and a dead signal
    DataSet r = simulated_data(5, 0);
    r.y = r.x.cwiseMin(0.1 * r.x.maxCoeff()).cwiseMax(0.1 * r.x.minCoeff());
    EXPECT_THAT(said(advise(r.data()), "saturation"), HasSubstr("Most of the data are saturated"));
    r.y.setConstant(5);
    EXPECT_THAT(said(advise(r.data()), "constant"), HasSubstr("stays at 5 throughout"));
}

TEST(advice, quantization_is_reported_with_its_step) {  // oracle: rounded by us
    DataSet r = simulated_data(6);
    r.y = (r.y.array() / 0.1).round() * 0.1;
    const Advice advice = advise(r.data());
    ASSERT_TRUE(advice.has("quantization")) << codes(advice);
    EXPECT_NEAR(advice.find("quantization")->value, 0.1, 1e-6);
    r.y = (simulated_data(6).y.array() / 0.001).round() * 0.001;
    EXPECT_FALSE(advise(r.data()).has("quantization"));
}

TEST(advice, outliers_are_reported_with_their_places) {  // oracle: the places
    DataSet r = simulated_data(7);
    r.y[300] += 4, r.y[700] -= 3;  // beyond what fast passages of the signal can do
    const Advice advice = advise(r.data());
    EXPECT_THAT(said(advice, "outliers"), HasSubstr("2 samples far from the neighboring samples (301, 701)"));
}

TEST(advice, offsets_are_reported) {  // oracle: the offset put in
    DataSet r = simulated_data(8);
    r.y.array() += 20;
    const Advice advice = advise(r.data());
    ASSERT_TRUE(advice.has("offset")) << codes(advice);
    EXPECT_NEAR(advice.find("offset")->value, 20, 0.05);
}

TEST(advice, a_running_start_is_reported) {  // oracle: data cut out of a movement
    DataSet r = simulated_data(9, 0.01);
    Index fastest = 0;
    (r.x.segment(101, 400) - r.x.segment(100, 400)).cwiseAbs().maxCoeff(&fastest);
    const IdData cut = r.data().range(fastest + 101, 1000);
    EXPECT_THAT(said(advise(cut), "running_start"), HasSubstr("during a transient"));
}

TEST(advice, a_drifting_plant_at_rest_does_not_begin_in_a_movement) {  // oracle: a minute at the equilibrium
    const HeatTransferExperiments experiments;
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const HeatTransferData data_sets = simulate_heat_transfer({}, experiments, seed);
        for (const PlantData* r : {&data_sets.estimation, &data_sets.validation, &data_sets.high}) {
            const Advice advice = advise(IdData(Matrix(r->y), Matrix(r->u), experiments.Ts));
            EXPECT_FALSE(advice.has("running_start")) << seed << ", from " << r->u[0] << " V\n" << codes(advice);
        }
    }
}

TEST(advice, planted_starts_are_found_whether_the_input_rests_or_moves) {  // oracle: the movement put in
    for (const Index rest : {0, 60}) {
        int found = 0;
        for (std::uint32_t seed = 1; seed <= 10; ++seed) {
            DataSet r = simulated_data(seed);
            r.u.head(rest).setZero();
            const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}});
            const double level = seed % 2 == 0 ? 0.5 : -0.5;
            const Vector noise = r.y - r.x;
            r.y = lsim(G, r.u, kTs, Hold::kZoh, Vector{{0.0, level}}) + noise;
            found += advise(r.data()).has("running_start");
        }
        EXPECT_GE(found, 9) << "the input rests for " << rest << " samples";
    }
}

/// The rank of 20 copies of u, each later by the lag at which its autocorrelation has fallen to one half.
double excited_parameters(Vector u) {
    const Index N = u.size();
    u.array() -= u.mean();
    Index shift = 1;
    while (u.tail(N - shift).dot(u.head(N - shift)) >= 0.5 * u.squaredNorm()) ++shift;
    const Index rows = N - 19 * shift;
    Matrix copies(rows, 20);
    for (Index i = 0; i < 20; ++i) copies.col(i) = u.segment(i * shift, rows);
    copies.rowwise() -= copies.colwise().mean().eval();
    const Vector singular = singular_values(copies);
    return static_cast<double>((singular.array() > 5e-3 * singular[0]).count());
}

TEST(advice, counts_what_an_input_can_determine) {  // oracle: singular values of the copies written out
    for (const int sines : {3, 4, 6}) {
        DataSet r = simulated_data();
        for (Index k = 0; k < r.u.size(); ++k) {
            const double t = static_cast<double>(k);
            r.u[k] = 0;
            for (int i = 1; i <= sines; ++i) r.u[k] += std::sin(0.11 * i * t + i * i);
        }
        r.y = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}}), r.u, kTs) + r.y - r.x;
        const Advice advice = advise(r.data());
        const DataIssue* found = advice.find(advice.has("excitation") ? "excitation" : "poor_excitation");
        ASSERT_NE(found, nullptr) << codes(advice);
        EXPECT_EQ(found->value, excited_parameters(r.u)) << sines;
        EXPECT_EQ(found->value, 2 * sines);
    }
}

TEST(advice, poor_excitation_is_reported) {  // oracle: one sine determines two parameters, a PRBS many
    DataSet r = simulated_data();
    for (Index k = 0; k < 1000; ++k) r.u[k] = std::sin(0.13 * static_cast<double>(k));
    r.y = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}}), r.u, kTs);
    const Advice advice = advise(r.data());
    EXPECT_THAT(said(advice, "poor_excitation"),
                HasSubstr("no more than 2 parameters: it contains only about 1 frequency"));
    EXPECT_EQ(advise(simulated_data().data()).find("excitation")->value, 20);
}

TEST(advice,
     sampling_against_the_bandwidth_is_reported) {  // oracle: bandwidth 1 rad/s, sampled too rarely and too often
    const auto sampled = [](double Ts, Index hold) {
        const Vector u = random_levels(2000, hold, 11);
        const Vector y =
            lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}}), u, Ts) + 0.005 * RandomStream(2).normal(2000);
        return advise(IdData(Matrix(y), Matrix(u), Ts));
    };
    EXPECT_THAT(said(sampled(1.5, 2), "slow_sampling"), HasSubstr("sample faster"));
    EXPECT_THAT(said(sampled(0.01, 100), "fast_sampling"), HasSubstr("resample(data, 1, 20)"));
    const Advice usual = sampled(0.25, 4);
    EXPECT_FALSE(usual.has("slow_sampling") || usual.has("fast_sampling")) << codes(usual);
}

TEST(advice, band_passes_and_integrators_have_no_false_bandwidth) {  // oracle: a peak at 4 rad/s, and none at all
    const auto advised = [](const TransferFunction& G) {
        const Vector u = random_levels(2000, 10, 11);
        const Vector x = lsim(G, u, 0.05);
        const double noise = 0.01 * std::sqrt(x.squaredNorm() / 2000);
        return advise(IdData(Matrix(x + noise * RandomStream(2).normal(2000)), Matrix(u), 0.05));
    };
    for (const auto& G : {TransferFunction(Vector{{1.0, 0.4}}, Vector{{1.0, 0.8, 16.0}}),
                          TransferFunction(Vector{{1.0}}, Vector{{1.0, 2.0, 0.0}})}) {
        const Advice advice = advised(G);
        EXPECT_TRUE(advice.has("noise")) << codes(advice);  // it was fitted
        EXPECT_FALSE(advice.has("slow_sampling") || advice.has("fast_sampling")) << codes(advice);
    }
}

TEST(advice, degrees_declared_as_radians_are_reported) {  // oracle: the unit put in
    DataSet r = simulated_data(12);
    r.y *= 30;
    IdData data = r.data();
    data.output_units = {"rad"};
    EXPECT_THAT(said(advise(data), "degrees"), AllOf(HasSubstr("probably degrees"), HasSubstr("pi/180")));
    data.output_units = {"deg"};
    EXPECT_FALSE(advise(data).has("degrees"));
    IdData small = simulated_data(12).data();
    small.output_units = {"rad"};
    EXPECT_FALSE(advise(small).has("degrees"));
}

TEST(advice, wrong_columns_are_reported) {  // oracle: columns mixed up by us
    const DataSet r = simulated_data(13, 0.02);
    const Vector t = Vector::LinSpaced(1000, 0, 99.9);
    EXPECT_THAT(said(advise(IdData(Matrix(r.y), Matrix(t), kTs)), "time_column"), HasSubstr(", like a time"));
    EXPECT_THAT(said(advise(IdData(Matrix(r.y), Matrix(r.y), kTs)), "same_column"), HasSubstr("read twice"));
    EXPECT_THAT(said(advise(IdData(Matrix(r.u), Matrix(r.y), kTs)), "causality"), HasSubstr("exchanged"));
}

TEST(advice, sampling_instants_are_looked_at) {  // oracle: instants put together by us
    const DataSet r = simulated_data(14);
    Vector mixed(1000), gaps(1000);
    for (Index k = 0; k < 1000; ++k) {
        mixed[k] = k < 600 ? 0.1 * static_cast<double>(k) : 60 + 0.2 * static_cast<double>(k - 600);
        gaps[k] = 0.1 * static_cast<double>(k + (k > 400 ? 3 : 0) + (k > 800 ? 1 : 0));
    }
    EXPECT_THAT(said(advise(IdData(Matrix(r.y), Matrix(r.u), mixed)), "mixed_sampling"),
                HasSubstr("600 steps of 0.1 s and 399 steps of 0.2 s"));
    EXPECT_THAT(said(advise(IdData(Matrix(r.y), Matrix(r.u), gaps)), "gaps"),
                HasSubstr("jumps at 2 places, first after sample 401"));
    const Vector even = Vector::LinSpaced(1000, 0, 99.9);
    EXPECT_FALSE(advise(IdData(Matrix(r.y), Matrix(r.u), even)).has("gaps"));
}

TEST(advice, sections_that_do_not_follow_are_reported) {  // oracle: the section that the test corrupts
    DataSet r = simulated_data(15, 0.02);
    for (Index k = 500; k < 570; ++k) r.y[k] += 0.8 * std::sin(0.09 * static_cast<double>(k - 500));
    const Advice advice = advise(r.data());
    ASSERT_TRUE(advice.has("nonlinear")) << codes(advice);
    ASSERT_EQ(advice.discard.size(), 1u);
    EXPECT_LE(advice.discard[0].first, 530);
    EXPECT_GE(advice.discard[0].last, 540);
}

TEST(advice, short_records_are_reported) {
    EXPECT_THAT(said(advise(simulated_data().data().range(1, 40)), "short"), HasSubstr("only 40 samples"));
}

TEST(advice, outputs_are_evaluated_separately) {  // oracle: only the second has an offset
    const DataSet r = simulated_data(16);
    Matrix y(1000, 2);
    y << r.y, r.y.array() + 9;
    const Advice advice = advise(IdData(y, Matrix(r.u), kTs));
    ASSERT_TRUE(advice.has("offset")) << codes(advice);
    EXPECT_EQ(advice.find("offset")->channel, "y2");
}

/// Random levels of any height, each `hold` samples long.
Vector random_heights(Index N, Index hold, std::uint32_t seed) {
    const Vector heights = RandomStream(seed).normal(N / hold + 1);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = heights[k / hold];
    return u;
}

/// The response to random heights bent by a function of the input, with noise of 1 %.
template <class Bend>
IdData bent_at_input(const Bend& bend) {
    const Vector u = random_heights(1500, 8, 21);
    const Vector x = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}}), u.unaryExpr(bend), kTs);
    const double size = std::sqrt(x.squaredNorm() / 1500);
    return IdData(Matrix(x + 0.01 * size * RandomStream(22).normal(1500)), Matrix(u), kTs);
}

TEST(advice,
     an_applied_input_is_never_saturated) {  // oracle: definition; the old rule found a limit in every staircase
    DataSet r = simulated_data();
    r.u = random_heights(1000, 12, 3).cwiseMin(1).cwiseMax(-1);
    r.y =
        lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}}), r.u, kTs) + 0.01 * RandomStream(5).normal(1000);
    const Advice advice = advise(r.data());
    EXPECT_TRUE(advice.clean()) << codes(advice);
    EXPECT_TRUE(advice.discard.empty());
}

TEST(advice, a_clock_that_jitters_is_no_fault) {  // oracle: ticks of a millisecond
    const DataSet r = simulated_data(14);
    Vector t(1000);
    for (Index k = 0; k < 1000; ++k) t[k] = std::floor(10.4 * static_cast<double>(k)) / 1000;
    EXPECT_TRUE(advise(IdData(Matrix(r.y), Matrix(r.u), t)).clean());
}

TEST(advice, drift_is_reported_with_its_size) {  // oracle: the line put in
    DataSet r = simulated_data(17);
    r.y += Vector::LinSpaced(1000, 0, 1.5);
    const Advice advice = advise(r.data());
    ASSERT_TRUE(advice.has("drift")) << codes(advice);
    EXPECT_NEAR(advice.find("drift")->value, 1.5, 0.2);
    EXPECT_FALSE(advice.has("low_snr"));
}

TEST(advice, a_drift_that_a_slow_pole_could_run_out_from_is_reported) {  // oracle: the lines put in
    for (const double rise : {-2.0, 1.0}) {
        DataSet r = simulated_data(21);
        r.y += Vector::LinSpaced(1000, 0, rise);
        const Advice advice = advise(r.data());
        ASSERT_TRUE(advice.has("drift")) << codes(advice);
        EXPECT_NEAR(advice.find("drift")->value, rise, 0.2);
    }
}

TEST(advice, a_random_walk_is_reported) {  // oracle: sums of seeded normal numbers
    DataSet r = simulated_data(18);
    double walk = 0;
    RandomStream steps(40);
    for (Index k = 0; k < 1000; ++k) r.y[k] += walk += 0.03 * steps.normal();
    const Advice advice = advise(r.data());
    EXPECT_TRUE(advice.has("random_walk") || advice.has("drift")) << codes(advice);
}

TEST(advice, curves_and_play_are_reported_where_they_are) {  // oracle: functions applied by us
    EXPECT_THAT(said(advise(bent_at_input([](double u) { return u + 0.2 * u * u; })), "nonlinear"),
                HasSubstr("u1 acts through a nonlinear characteristic"));
    EXPECT_THAT(said(advise(bent_at_input([](double u) { return std::copysign(std::max(0.0, std::abs(u) - 0.5), u); })),
                     "nonlinear"),
                HasSubstr("dead band"));
    double play = 0;
    const IdData loose = bent_at_input([&play](double u) { return play = std::clamp(play, u - 0.4, u + 0.4); });
    EXPECT_THAT(said(advise(loose), "nonlinear"), HasSubstr("backlash"));
    EXPECT_TRUE(advise(bent_at_input([](double u) { return 3 * u; })).clean());
}

TEST(advice, a_limit_under_noise_is_reported) {  // oracle: clipped before the noise, so that no section is constant
    const Vector u = random_heights(1500, 8, 31);
    Vector y = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}}), u, kTs);
    y = y.cwiseMin(0.5 * y.maxCoeff()) + 0.01 * RandomStream(32).normal(1500);
    EXPECT_THAT(said(advise(IdData(Matrix(y), Matrix(u), kTs)), "saturation"), HasSubstr("saturates at a limit"));
}

TEST(advice, a_running_controller_is_reported) {  // oracle: the loop closed by us, and the same plant without it
    const Vector reference = random_heights(2000, 25, 6), noise = 0.05 * RandomStream(7).normal(2000);
    const double a = std::exp(-kTs);
    for (const bool closed : {true, false}) {
        Vector u(2000), y(2000);
        double x = 0, command = 0;
        for (Index k = 0; k < 2000; ++k) {
            u[k] = closed ? command : reference[k];
            y[k] = x + noise[k];
            x = a * x + (1 - a) * u[k];
            command = 2 * (reference[k] - y[k]);
        }
        const Advice advice = advise(IdData(Matrix(y), Matrix(u), kTs));
        EXPECT_EQ(advice.has("feedback"), closed) << codes(advice);
    }
}

TEST(advice, an_integrator_is_reported) {  // oracle: the pole put in
    const Vector u = random_levels(1500, 8, 41);
    const Vector x = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 2.0, 0.0}}), u, kTs);
    const Advice advice = advise(IdData(Matrix(x + 0.02 * RandomStream(42).normal(1500)), Matrix(u), kTs));
    EXPECT_THAT(said(advice, "integrator"), HasSubstr("and does not settle"));
}

TEST(advice, an_extrapolated_offset_is_reported_as_such) {  // oracle: the input never comes near zero
    DataSet r = simulated_data(8);
    r.u.array() += 10;
    r.y.array() += 23.4567;
    EXPECT_THAT(said(advise(r.data()), "offset"), AllOf(HasSubstr("extrapolation"), HasSubstr("from 9 to 11"),
                                                        HasSubstr("y1 is about 18.5 when u1 is zero")));
}

TEST(advice, a_crane_at_rest_does_not_begin_in_a_movement) {  // oracle: a second of rest, read as 0.012 rad
    const CraneExperiments experiments;
    for (const std::uint32_t seed : {1u, 2u})
        for (const CraneData& crane : simulate_crane({}, experiments, seed)) {
            if (crane.name != "estimation" && crane.name != "validation") continue;
            const Advice advice = advise(IdData(Matrix(crane.theta), Matrix(crane.u), experiments.Ts));
            EXPECT_FALSE(advice.has("running_start")) << crane.name << seed << codes(advice);
            ASSERT_TRUE(advice.has("offset")) << crane.name << seed << codes(advice);
            EXPECT_NEAR(advice.find("offset")->value, 0.012, 0.001) << crane.name << seed;
            EXPECT_EQ(advice.find("offset")->weight, Weight::kNote) << crane.name << seed;
            if (advice.has("dead_time")) {  // it is the motor's lag
                EXPECT_THAT(said(advice, "dead_time"), HasSubstr("another pole")) << crane.name << seed;
            }
        }
}

TEST(advice, a_rest_without_an_offset_is_no_offset) {  // oracle: noise about zero, a level, a slope, put in
    DataSet r = simulated_data(21);
    r.u.head(60).setZero();
    const Vector x = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}}), r.u, kTs);
    const Vector noise = 0.02 * RandomStream(22).normal(x.size());
    EXPECT_FALSE(advise(IdData(Matrix(x + noise), Matrix(r.u), kTs)).has("offset"));
    const Vector shifted = (x + noise).array() + 0.06;
    const Advice advice = advise(IdData(Matrix(shifted), Matrix(r.u), kTs));
    ASSERT_TRUE(advice.has("offset")) << codes(advice);
    EXPECT_NEAR(advice.find("offset")->value, 0.06, 0.01);
    const Vector rising = x + noise + Vector::LinSpaced(x.size(), 0, 0.12 * static_cast<double>(x.size()) / 60);
    EXPECT_FALSE(advise(IdData(Matrix(rising), Matrix(r.u), kTs)).has("offset"));
}

TEST(advice, long_records_keep_their_dynamics) {  // oracle: known noise, a pole of a tenth of the data's rate
    const Index N = 60000;
    const Vector u = random_levels(N, 7, 51);
    const Vector x = lsim(TransferFunction(Vector{{6.0}}, Vector{{1.0, 6.0}}), u, kTs);
    const double size = std::sqrt(x.squaredNorm() / static_cast<double>(N));
    const Advice advice = advise(IdData(Matrix(x + 0.1 * size * RandomStream(52).normal(N)), Matrix(u), kTs));
    ASSERT_TRUE(advice.has("noise")) << codes(advice);
    EXPECT_NEAR(advice.find("noise")->value, 20, 0.5);
    EXPECT_TRUE(advice.clean()) << codes(advice);
}

TEST(advice, a_record_that_begins_slowly_is_fitted_whole_and_sample_by_sample) {  // oracle: the system put in
    const Index N = 10000;
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = std::sin(0.02 * kTs * static_cast<double>(k));
    u.tail(7000) += random_levels(7000, 6, 61);
    const double delay = 0.43;  // of a second, 4.3 samples: a block holds two
    const Vector x = lsim(TransferFunction(Vector{{4.0}}, Vector{{1.0, 1.0, 4.0}}, 0, delay), u, kTs);
    const double size = std::sqrt(x.squaredNorm() / static_cast<double>(N));
    const Advice advice = advise(IdData(Matrix(x + 0.05 * size * RandomStream(62).normal(N)), Matrix(u), kTs));
    ASSERT_TRUE(advice.has("dead_time")) << codes(advice);
    EXPECT_NEAR(advice.find("dead_time")->value, delay, 0.01);
    EXPECT_NEAR(advice.find("noise")->value, 26.02, 0.3);
    EXPECT_TRUE(advice.clean()) << codes(advice);
}

/// sin(2e-5 k^2) through 1/(s + 0.5), sampled at 0.2 s, with noise 10 dB below.
IdData noisy_chirp(std::uint32_t seed) {
    Vector u(1200);
    for (Index k = 0; k < u.size(); ++k) u[k] = std::sin(2e-5 * static_cast<double>((k + 1) * (k + 1)));
    const Vector x = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 0.5}}), u, 0.2);
    const double size = std::sqrt((x.array() - x.mean()).square().mean());
    return IdData(Matrix(x + std::pow(10, -0.5) * size * RandomStream(seed).normal(u.size())), Matrix(u), 0.2);
}

TEST(advice,
     smooth_inputs_are_not_called_exchanged) {  // oracle: columns in order, no loop, sampling far above the band
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const Advice advice = advise(noisy_chirp(seed));
        EXPECT_FALSE(advice.has("causality") || advice.has("slow_sampling")) << seed << codes(advice);
    }
}

TEST(advice, outliers_of_any_height_are_found) {  // oracle: the places, every 97th sample
    const Vector u = random_levels(3000, 8, 3);
    const Vector x = lsim(TransferFunction(Vector{{-1.0, 2.0}}, Vector{{1.0, 3.0, 2.0}}), u, kTs);
    const double size = std::sqrt((x.array() - x.mean()).square().mean());
    for (const double height : {3.0, 6.0, 12.0}) {
        Vector y = x + 0.1 * size * RandomStream(4).normal(3000);
        for (Index k = 36; k < 3000; k += 97) y[k] += height * size;
        const Advice advice = advise(IdData(Matrix(y), Matrix(u), kTs));
        EXPECT_THAT(said(advice, "outliers"), HasSubstr("31 samples far from")) << height;
        EXPECT_FALSE(advice.has("low_snr")) << height << codes(advice);
    }
}

TEST(advice, noise_that_forgets_is_no_random_walk) {  // oracle: AR(0.9) noise, which settles within 20 samples
    int walks = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        DataSet r = simulated_data(seed, 0);
        Vector e = RandomStream(seed + 500).normal(1000);
        for (Index k = 1; k < e.size(); ++k) e[k] += 0.9 * e[k - 1];
        r.y = r.x + 0.03 * e;
        const Advice advice = advise(r.data());
        walks += advice.has("random_walk") || advice.has("drift") || advice.has("running_start");
    }
    EXPECT_LE(walks, 1);
}

TEST(advice, an_unstable_plant_in_a_loop_is_named) {  // oracle: 1.5/(s - 0.8) behind a proportional controller
    const Index N = 1500;
    const double Ts = 0.05, f = std::exp(0.8 * Ts), g = 1.5 / 0.8 * (f - 1);
    const Vector reference = random_heights(N, 40, 11), noise = 0.03 * RandomStream(12).normal(N);
    Vector u(N), y(N);
    double x = 0;
    for (Index k = 0; k < N; ++k) {
        y[k] = x + noise[k];
        u[k] = 1.5 * (reference[k] - y[k]);
        x = f * x + g * u[k];
    }
    const Advice advice = advise(IdData(Matrix(y), Matrix(u), Ts));
    EXPECT_THAT(said(advice, "feedback"), HasSubstr("a controller was active"));
    for (const char* wrong : {"random_walk", "drift", "nonlinear", "noise", "causality"})
        EXPECT_FALSE(advice.has(wrong)) << said(advice, wrong);
}

TEST(advice, an_input_logged_late_is_named) {  // oracle: the column shifted by us
    const Vector u = random_levels(1001, 8, 15);
    const Vector x = lsim(TransferFunction(Vector{{30.0}}, Vector{{1.0, 6.0, 30.0}}), u, 0.02);
    const Vector y = x + 0.01 * RandomStream(16).normal(1001);
    EXPECT_THAT(said(advise(IdData(Matrix(y.tail(1000)), Matrix(u.head(1000)), 0.02)), "late_input"),
                HasSubstr("data:shift(-1)"));
    EXPECT_FALSE(advise(IdData(Matrix(y), Matrix(u), 0.02)).has("late_input"));
}

TEST(advice, an_angle_that_jumps_by_a_turn_is_named) {  // oracle: wrapped by us
    DataSet r = simulated_data(19, 0.01);
    r.y *= 250 / r.x.cwiseAbs().maxCoeff();
    EXPECT_FALSE(advise(r.data()).has("wrapped"));
    r.y = r.y.unaryExpr([](double v) { return v - 360 * std::floor((v + 180) / 360); });
    const Advice advice = advise(r.data());
    EXPECT_THAT(said(advice, "wrapped"), HasSubstr("unwrap(x, 360)"));
    EXPECT_FALSE(advice.has("nonlinear") || advice.has("saturation")) << codes(advice);
}

TEST(advice, a_load_on_an_integrator_is_named_with_its_size) {  // oracle: the load put in
    const Vector u = random_levels(1000, 8, 41);
    const Vector x = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 2.0, 0.0}}), Vector(u.array() - 0.4), kTs);
    const Advice advice = advise(IdData(Matrix(x + 0.02 * RandomStream(42).normal(1000)), Matrix(u), kTs));
    ASSERT_TRUE(advice.has("load")) << codes(advice);
    EXPECT_NEAR(advice.find("load")->value, -0.4, 0.04);
    EXPECT_FALSE(advice.has("drift") || advice.has("random_walk")) << codes(advice);
}

TEST(advice, one_of_several_inputs_that_rests_is_named) {  // oracle: the input held by us
    const DataSet r = simulated_data(20);
    Matrix u(1000, 2);
    u << r.u, Vector::Constant(1000, 20);
    IdData data(Matrix(r.y), u, kTs);
    data.input_names = {"Q1", "Q2"};
    EXPECT_THAT(said(advise(data), "constant"), AllOf(HasSubstr("The input Q2 stays at 20"), HasSubstr("offset")));
}

TEST(advice, a_lag_is_not_called_a_dead_time) {  // oracle: four poles, no delay; and a delay of ten samples
    DataSet r = simulated_data(22);
    r.x = lsim(TransferFunction(Vector{{4.0}}, Vector{{1.0, 1.0, 4.0}}) *
                   TransferFunction(Vector{{16.0}}, Vector{{1.0, 8.0, 16.0}}),
               r.u, kTs);
    r.y = r.x + 0.03 * RandomStream(23).normal(1000);
    const Advice advice = advise(r.data());
    if (advice.has("dead_time")) {
        EXPECT_THAT(said(advice, "dead_time"), HasSubstr("another pole: compare both"));
    }
    EXPECT_THAT(said(advise(simulated_data(2, 0.03, 1.0).data()), "dead_time"), HasSubstr("Add a dead time"));
}

}  // namespace test_advice
