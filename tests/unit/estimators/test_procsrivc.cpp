#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/srivc.h"
#include "numerics/plants/heat_exchanger.h"
#include "numerics/plants/suspension.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/process_cases.h"

namespace test_procsrivc {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

// Levels of random length and sign, so that every structure is excited.
Vector rough_input(Index N, Index hold, double mean = 0) {
    const Vector noise = RandomStream(5).normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = mean + (noise[k / hold] > 0 ? 1 : -1);
    return u;
}

IdData siso(const Vector& y, const Vector& u, double Ts) {
    return IdData(Matrix(y), Matrix(u), Ts);
}

TransferFunction model_of(const char* structure, const Vector& parameters) {
    return ProcessModel(ProcessStructure::parse(structure), parameters).transfer_function();
}

Fit fit(const IdData& data, const char* structure, const ProcsrivcOptions& options = {}) {
    return procsrivc(data, ProcessStructure::parse(structure), options);
}

ProcsrivcOptions tight() {
    ProcsrivcOptions options;
    options.tolerance = 1e-10;
    return options;
}

bool warned(const Fit& result, const std::string& text) {
    return message_text(result.full_message()).find(text) != std::string::npos;
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "nothing was refused";
}

struct Case {
    const char* structure;
    Vector truth;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> kCases = {
        {"P1", Vector{{1.5, 0.8}}},
        {"P1", Vector{{-40.0, 3.0}}},
        {"P2", Vector{{1.2, 1.0, 0.4}}},
        {"P2", Vector{{1.2, 6.0, 0.3}}},
        {"P2U", Vector{{0.9, 0.5, 0.35}}},
        {"P2U", Vector{{-2.0, 0.3, 0.05}}},
        {"P1D", Vector{{1.5, 0.8, 0.373}}},
        {"P2DU", Vector{{0.9, 0.5, 0.35, 1.61}}},
        {"P2D", Vector{{1.2, 1.0, 0.4, 0.2}}},
    };
    return kCases;
}

TEST(procsrivc, recovers_exact_data_from_any_hold) {  // oracle: the simulated system
    const Vector u = rough_input(1000, 12);
    for (Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const Case& c : cases()) {
            IdData data = siso(lsim(model_of(c.structure, c.truth), u, 0.05, hold), u, 0.05);
            data.hold = hold;
            const auto result = fit(data, c.structure, tight());
            for (Index i = 0; i < c.truth.size(); ++i)
                EXPECT_NEAR(result.theta[i] / c.truth[i], 1, 1e-9)
                    << c.structure << " " << message_text(result.full_message());
            EXPECT_EQ(result.start.state, InitialState::kZero) << message_text(result.full_message());
        }
}

TEST(procsrivc, every_structure_is_found_again_from_default_settings) {  // oracle: the simulated system
    const Vector u = rough_input(700, 12);
    for (const ProcessModel& model : every_process()) {
        // Held, a model with as many zeros as poles has too few sampled coefficients to show its delay.
        const bool ambiguous = model.structure.text() == "P1DZ";
        const Hold hold = ambiguous ? Hold::kFoh : Hold::kZoh;
        IdData data = siso(lsim(model.transfer_function(), u, 0.05, hold), u, 0.05);
        data.hold = hold;
        const auto result = procsrivc(data, model.structure, tight());
        for (Index i = 0; i < model.parameters.size(); ++i)
            EXPECT_NEAR(result.theta[i] / model.parameters[i], 1, 1e-7)
                << model.structure.text() << " " << result.names[static_cast<std::size_t>(i)] << " "
                << message_text(result.full_message());
    }
}

TEST(procsrivc, thinned_irregular_step) {  // oracle: the simulated system of the literature, its standard errors
    const Vector truth{{2.0, 0.05, 0.1, 0.7}};
    Vector u = Vector::Zero(330);
    u.tail(300).setOnes();
    const Vector x = lsim(model_of("P2DU", truth), u, 0.01);
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean()) * std::pow(10, -15.0 / 20);
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        RandomStream random(seed);
        const Vector y = x + deviation * random.normal(330);
        std::vector<Index> kept = {0};
        for (Index k = 1; k < 330; ++k)
            if (k == 30 || random.uniform() < 0.6) kept.push_back(k);
        const Vector t = 0.01 * Vector::LinSpaced(330, 0, 329);
        const IdData thinned(Matrix(y(kept)), Matrix(u(kept)), Vector(t(kept)));
        ProcsrivcOptions options;
        options.largest_delay = 1.5;
        for (const IdData& data : {siso(y, u, 0.01), thinned}) {
            const auto result = fit(data, "P2DU", options);
            for (Index i = 0; i < 4; ++i)
                EXPECT_NEAR(result.theta[i], truth[i], 4 * result.std[i]) << message_text(result.full_message());
            EXPECT_LT(result.std[3], 0.02);
        }
    }
}

TEST(procsrivc, irregular_sampling_is_exact) {  // oracle: the simulated system
    const Index N = 300;
    RandomStream random(4);
    Vector t(N);
    double time = 3;
    for (double& instant : t) {
        instant = time;
        time += 0.02 + 0.06 * random.uniform();
    }
    const Vector u = rough_input(N, 12);
    for (const char* structure : {"P1", "P2D", "P2UZ", "P1ID"})
        for (const ProcessModel& model : every_process())
            if (model.structure.text() == ProcessStructure::parse(structure).text()) {
                const IdData data(Matrix(lsim(model.transfer_function(), u, t)), Matrix(u), t);
                const auto result = procsrivc(data, model.structure, tight());
                for (Index i = 0; i < model.parameters.size(); ++i)
                    EXPECT_NEAR(result.theta[i] / model.parameters[i], 1, 1e-7)
                        << structure << message_text(result.full_message());
            }
}

// Data of a running experiment: input levels with a mean that depends on the experiment, and an offset.
IdData running(const TransferFunction& G, std::uint32_t seed, double offset, bool regular) {
    const Index N = 600, cut = 50;
    RandomStream random(seed);
    const Vector noise = random.normal(N);
    Vector u(N), t(N);
    double time = 0;
    for (Index k = 0; k < N; ++k) {
        u[k] = (noise[k / 11] > 0 ? 1 : -1) + 0.1 * offset;
        t[k] = time;
        time += regular ? 0.05 : 0.03 + 0.04 * random.uniform();
    }
    const Vector y = (regular ? lsim(G, u, 0.05) : lsim(G, u, t)).array() + offset;
    const Matrix y_cut = y.tail(N - cut), u_cut = u.tail(N - cut);
    return regular ? IdData(y_cut, u_cut, 0.05) : IdData(y_cut, u_cut, Vector(t.tail(N - cut)));
}

TEST(procsrivc, experiments_keep_their_own_states_and_offsets) {  // oracle: the simulated system
    for (const bool regular : {true, false})
        for (const ProcessModel& model : every_process()) {
            const ProcessStructure& structure = model.structure;
            if (structure.delay || structure.poles == 3) continue;  // the past of a delayed input is not recorded
            if (!regular && structure.zero) continue;               // nothing new, and slow
            const TransferFunction G = model.transfer_function();
            const IdData data = IdData::merge({running(G, 1, 5, regular), running(G, 2, -7, regular)});
            ProcsrivcOptions options = tight();
            options.initial_state = InitialState::kEstimate;
            if (!structure.integrator) options.offset = Offset::kEstimate;
            const auto result = procsrivc(data, structure, options);
            for (Index i = 0; i < model.parameters.size(); ++i)
                EXPECT_NEAR(result.theta[i] / model.parameters[i], 1, 1e-7)
                    << structure.text() << message_text(result.full_message());
            ASSERT_EQ(result.initial_values.size(), 2u);
            if (structure.integrator) continue;
            EXPECT_NEAR(result.offsets(0, 0), 5, 1e-6) << structure.text();
            EXPECT_NEAR(result.offsets(1, 0), -7, 1e-6) << structure.text();
            EXPECT_NEAR(result.fit_percent[0], 100, 1e-6);
        }
}

TEST(procsrivc, the_same_record_twice_halves_the_variance) {  // oracle: least squares, sums of two equal halves
    const IdData one = running(model_of("P2", Vector{{1.2, 1.0, 0.4}}), 3, 4, true);
    IdData noisy = one;
    noisy.experiments[0].y += 0.1 * RandomStream(8).normal(one.sample_count());
    ProcsrivcOptions options = tight();
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    const auto single = fit(noisy, "P2", options), twice = fit(IdData::merge({noisy, noisy}), "P2", options);
    const double N = static_cast<double>(one.sample_count());
    for (Index i = 0; i < 3; ++i) {
        EXPECT_NEAR(twice.theta[i] / single.theta[i], 1, 1e-8);
        EXPECT_NEAR(twice.std[i] / single.std[i], std::sqrt((N - 6) / (2 * N - 9)), 1e-6);
    }
    EXPECT_NEAR(twice.fit_percent[0], single.fit_percent[0], 1e-8);
    EXPECT_NEAR(twice.offsets(1, 0), twice.offsets(0, 0), 1e-8);
}

TEST(procsrivc, a_held_input_cannot_place_the_delay_of_a_jump) {  // oracle: two parameter sets, one sampled system
    const Vector u = rough_input(700, 12);
    const Vector y = lsim(model_of("P1DZ", Vector{{1.3, 1.7, -0.45, 0.373}}), u, 0.05);
    const auto result = fit(siso(y, u, 0.05), "P1DZ", tight());
    EXPECT_GT(result.fit_percent[0], 100 - 1e-6);
    EXPECT_TRUE(warned(result, "cannot be distinguished within one sampling time"))
        << message_text(result.full_message());
}

TEST(procsrivc, integrating_process_cut_from_a_running_experiment) {  // oracle: the simulated system
    const Vector u = rough_input(1000, 15, 0.1), truth{{0.4, 0.7}};
    const Vector y = lsim(model_of("P1I", truth), u, 0.05).array() + 12;
    const IdData data = siso(y.tail(950), u.tail(950), 0.05);
    const auto result = fit(data, "P1I", tight());
    EXPECT_EQ(result.start.state, InitialState::kEstimate) << message_text(result.full_message());
    EXPECT_FALSE(result.start.offset);
    for (Index i = 0; i < 2; ++i) EXPECT_NEAR(result.theta[i] / truth[i], 1, 1e-8);
    EXPECT_NEAR(result.initial_values[0][0], y[50], 1e-6);
    ProcsrivcOptions options;
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    EXPECT_THAT(refusal([&] { fit(data, "P1I", options); }), HasSubstr("already includes the output level"));
    options.initial_state = InitialState::kSteady;
    EXPECT_THAT(refusal([&] { fit(data, "P1I", options); }), HasSubstr("is at rest only for zero input"));
}

TEST(procsrivc, does_not_depend_on_the_unit_of_time) {  // oracle: invariance
    const Vector u = rough_input(800, 15),
                 y = lsim(model_of("P2D", Vector{{1.2, 1.0, 0.4, 0.21}}), u, 0.05) + 0.1 * RandomStream(2).normal(800);
    const auto seconds = fit(siso(y, u, 0.05), "P2D", tight()), micro = fit(siso(y, u, 0.05e-6), "P2D", tight());
    EXPECT_NEAR(micro.theta[0], seconds.theta[0], 1e-10);
    EXPECT_NEAR(micro.theta[1] * 1e6, seconds.theta[1], 1e-9);
    EXPECT_NEAR(micro.std[3] * 1e6, seconds.std[3], 1e-9);
    EXPECT_NEAR(micro.covariance(0, 1) * 1e6, seconds.covariance(0, 1), 1e-9);
}

TEST(procsrivc, initial_state_and_offset_are_found) {  // oracle: the simulated system, cut from a running experiment
    const Vector u = rough_input(1000, 15, 2);
    for (const Case& c : cases()) {
        if (ProcessStructure::parse(c.structure).delay) continue;  // the past of a delayed input is not recorded
        const Vector y = lsim(model_of(c.structure, c.truth), u, 0.05).array() + 12;
        ProcsrivcOptions options = tight();
        options.initial_state = InitialState::kEstimate;
        options.offset = Offset::kEstimate;
        const auto result = fit(siso(y.tail(950), u.tail(950), 0.05), c.structure, options);
        for (Index i = 0; i < c.truth.size(); ++i)
            EXPECT_NEAR(result.theta[i] / c.truth[i], 1, 1e-8)
                << c.structure << " " << message_text(result.full_message());
        EXPECT_NEAR(result.offsets(0, 0), 12, 1e-6) << c.structure;
        EXPECT_NEAR(result.initial_values[0][0], y[50] - 12 - c.truth[0] * u[50], 1e-6) << c.structure;
        const auto chosen = fit(siso(y.tail(950), u.tail(950), 0.05), c.structure);
        EXPECT_EQ(chosen.start.state, InitialState::kEstimate) << c.structure;
        EXPECT_TRUE(chosen.start.offset) << c.structure;
    }
}

TEST(procsrivc, heat_exchanger_just_works) {  // oracle: physical truth, standard errors, fixed seeds
    const HeatExchangerParameters p;
    const auto truth = heat_exchanger_truth(p);
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const auto data_set = simulate_heat_exchanger(p, seed);
        const auto result = fit(siso(data_set.y, data_set.u, p.Ts), "P1");
        EXPECT_EQ(result.start.state, InitialState::kSteady) << message_text(result.full_message());
        EXPECT_TRUE(result.start.offset);
        EXPECT_NEAR(result.theta[0], truth.gain, 4 * result.std[0]) << seed;
        EXPECT_NEAR(result.theta[1], truth.time_constant, 4 * result.std[1]) << seed;
        EXPECT_NEAR(result.offsets(0, 0), truth.output_at_zero_input, 0.2) << seed;
        EXPECT_LT(result.std[1], 0.02 * truth.time_constant);
        EXPECT_TRUE(result.warnings.empty()) << message_text(result.full_message());
    }
}

TEST(procsrivc, heat_exchanger_with_the_operating_point_removed) {  // oracle: physical truth
    HeatExchangerParameters p;
    p.noise_std = p.resolution = 0;
    const auto truth = heat_exchanger_truth(p);
    const auto data_set = simulate_heat_exchanger(p, 1);
    ProcsrivcOptions options = tight();
    options.offset = Offset::kRemove;
    const auto result = fit(siso(data_set.y, data_set.u, p.Ts), "P1", options);
    EXPECT_NEAR(result.theta[0] / truth.gain, 1, 1e-9);
    EXPECT_NEAR(result.theta[1] / truth.time_constant, 1, 1e-9);
    EXPECT_NEAR(result.removed[0][0].output, truth.initial_output, 1e-12);
    EXPECT_LT((result.output - data_set.y).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(procsrivc, offsets_hold_the_operating_point_that_was_taken_off) {  // oracle: the model simulated about it
    const TransferFunction G = model_of("P1", Vector{{2, 0.7}});
    const Vector u = rough_input(300, 15, 4);
    const IdData data = IdData::merge({siso(lsim(G, u, 0.1).array() + 12, u, 0.1), siso(lsim(G, -u, 0.1), -u, 0.1)});
    ProcsrivcOptions options = tight();
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kRemove;
    const Fit result = fit(data, "P1", options);
    for (Index e = 0; e < 2; ++e) {
        const Vector own = e == 0 ? u : Vector(-u);
        const Vector simulated = lsim(result.models[0], own.array() - own.mean(), 0.1).array() + result.offsets(e, 0);
        EXPECT_LT((simulated - result.output.segment(300 * e, 300)).cwiseAbs().maxCoeff(), 1e-9) << e;
    }
}

TEST(procsrivc, suspension_just_works) {  // oracle: physical truth, standard errors, fixed seeds
    const SuspensionParameters p;
    const auto truth = suspension_truth(p);
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const auto data_set = simulate_suspension(p, seed);
        const auto result = fit(siso(data_set.y, data_set.u, p.Ts), "P2U");
        EXPECT_NEAR(result.theta[0], truth.gain, 4 * result.std[0]) << seed << message_text(result.full_message());
        EXPECT_NEAR(result.theta[1], 1 / truth.natural_frequency, 4 * result.std[1]) << seed;
        EXPECT_NEAR(result.theta[2], truth.damping_ratio, 4 * result.std[2]) << seed;
        EXPECT_GT(result.fit_percent[0], 90);
        EXPECT_TRUE(result.warnings.empty()) << message_text(result.full_message());
    }
}

TEST(procsrivc, unit_step_at_sample_one_with_an_offset) {  // oracle: the simulated system
    const Vector u = Vector::Ones(400);
    for (const Case& c : cases()) {
        if (c.truth[1] > 5) continue;  // would not settle within the data
        const Vector y = lsim(model_of(c.structure, c.truth), u, 0.05).array() - 3;
        const auto result = fit(siso(y, u, 0.05), c.structure, tight());
        for (Index i = 0; i < c.truth.size(); ++i)
            EXPECT_NEAR(result.theta[i] / c.truth[i], 1, 1e-7)
                << c.structure << " " << message_text(result.full_message());
        EXPECT_NEAR(result.offsets(0, 0), -3, 1e-7) << c.structure;
    }
}

TEST(procsrivc, delay_needs_the_grid) {  // oracle: the simulated system; a local search from 0 would miss it
    const Vector truth{{2.0, 0.05, 0.1, 0.7}};
    const Vector u = rough_input(600, 40);
    const Vector y = lsim(model_of("P2DU", truth), u, 0.01) + 0.3 * RandomStream(1).normal(600);
    ProcsrivcOptions options;
    options.largest_delay = 1.5;
    const auto result = fit(siso(y, u, 0.01), "P2DU", options);
    for (Index i = 0; i < 4; ++i)
        EXPECT_NEAR(result.theta[i], truth[i], 4 * result.std[i]) << message_text(result.full_message());
    Index best = 0;
    result.delay_loss.minCoeff(&best);
    EXPECT_NEAR(result.delay_grid[best], 0.7, 0.05);
    EXPECT_EQ(result.delay_grid.size(), result.delay_loss.size());
    EXPECT_EQ(result.delay_grid[0], 0);
    EXPECT_LE(result.delay_grid.size(), 100);
}

// Oracle: the simulated system. Between the delays of the grid, fifty samples apart, the input changes ten times.
TEST(procsrivc, a_delay_in_a_long_record_is_found_between_the_delays_of_the_grid) {
    const Index N = 20'000;
    const Vector u = rough_input(N, 5);
    for (const double delay : {1.23, 2.71, 4.02}) {
        const Vector truth{{1.5, 0.4, delay}};
        const Vector y = lsim(model_of("P1D", truth), u, 0.05) + 0.1 * RandomStream(8).normal(N);
        const Fit found = fit(siso(y, u, 0.05), "P1D");
        for (Index i = 0; i < truth.size(); ++i) EXPECT_NEAR(found.theta[i], truth[i], 5 * found.std[i]) << delay;
        EXPECT_LT(found.std[2], 0.02);
    }
}

// Oracle: the simulated system. The data contain no noise, so that only the unknown inputs before them can disturb.
TEST(procsrivc, inputs_from_before_a_record_do_no_harm) {
    const Vector u = rough_input(900, 7), truth{{2, 0.6, 1.13}};
    const IdData cut = siso(lsim(model_of("P1D", truth), u, 0.1), u, 0.1).range(301, 900);
    ProcsrivcOptions options = tight();
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kNone;
    const Fit found = fit(cut, "P1D", options);
    for (Index i = 0; i < truth.size(); ++i) EXPECT_NEAR(found.theta[i], truth[i], 1e-6 * truth[i]) << i;
}

TEST(procsrivc, delay_options_bound_the_answer) {  // oracle: the simulated system
    const Vector u = rough_input(600, 40);
    const IdData data = siso(lsim(model_of("P1D", Vector{{2.0, 0.3, 0.7}}), u, 0.01), u, 0.01);
    ProcsrivcOptions options;
    options.largest_delay = 0.5;
    const auto low = fit(data, "P1D", options);
    EXPECT_NEAR(low.theta[2], 0.5, 1e-9);
    EXPECT_TRUE(warned(low, "increase `largest_delay`")) << message_text(low.full_message());
    EXPECT_EQ(low.std[2], 0);
    options.largest_delay = 2;
    options.least_delay = 0.8;
    const auto high = fit(data, "P1D", options);
    EXPECT_NEAR(high.theta[2], 0.8, 1e-9);
    EXPECT_TRUE(warned(high, "decrease `least_delay`")) << message_text(high.full_message());
    options.least_delay = options.largest_delay.emplace(0.7);
    const auto known = fit(data, "P1D", options);
    EXPECT_NEAR(known.theta[1], 0.3, 1e-6);
    EXPECT_NEAR(known.theta[2], 0.7, 1e-15);
}

TEST(procsrivc, doubtful_results_come_with_a_sentence) {  // oracle: the simulated system
    const Vector u = rough_input(600, 30), e = RandomStream(3).normal(600);
    const Vector y = lsim(model_of("P1", Vector{{2.0, 0.5}}), u, 0.05);
    EXPECT_TRUE(warned(fit(siso(y, u, 0.05), "P2"), "fewer poles"));
    EXPECT_TRUE(warned(fit(siso(lsim(model_of("P1", Vector{{2.0, 0.5}}), u, 0.05), u, 0.05), "P1D"), "No delay"));
    const Vector swinging = lsim(model_of("P2U", Vector{{1.0, 0.5, 0.3}}), u, 0.05) + 0.05 * e;
    EXPECT_TRUE(warned(fit(siso(swinging, u, 0.05), "P2"), "nearly equal"));
    EXPECT_TRUE(
        warned(fit(siso(lsim(model_of("P2", Vector{{1.0, 2.0, 0.2}}), u, 0.05), u, 0.05), "P2U"), "P2 without U"));
    EXPECT_TRUE(warned(fit(siso(e, u, 0.05), "P1"), "do not reliably determine"));
    ProcsrivcOptions hurried;
    hurried.max_iterations = 1;
    const auto result = fit(siso(y + e, u, 0.05), "P1", hurried);
    EXPECT_EQ(result.termination, Termination::kIterationLimit);
    EXPECT_TRUE(warned(result, "`max_iterations` = 1")) << message_text(result.full_message());
    EXPECT_GT(result.fit_percent[0], 0);
}

TEST(procsrivc, can_be_canceled) {  // oracle: definition
    const Vector u = rough_input(600, 30), y = lsim(model_of("P1", Vector{{2.0, 0.5}}), u, 0.05);
    ProcsrivcOptions options;
    int asked = 0;
    options.cancel = [&] { return ++asked > 1; };
    const auto result = fit(siso(y, u, 0.05), "P1", options);
    EXPECT_EQ(result.termination, Termination::kCanceled);
    EXPECT_TRUE(result.theta.allFinite());
}

TEST(procsrivc, refuses_what_it_cannot_fit) {
    const Vector u = rough_input(100, 10), y = lsim(model_of("P1", Vector{{2.0, 0.5}}), u, 0.05);
    const IdData data = siso(y, u, 0.05);
    EXPECT_THAT(refusal([&] { fit(siso(y, Vector::Zero(100), 0.05), "P1"); }), HasSubstr("is zero in all samples"));
    EXPECT_THAT(refusal([&] { fit(siso(Vector::Ones(100), u, 0.05), "P1"); }), HasSubstr("never changes"));
    EXPECT_THAT(refusal([&] { fit(siso(y.head(5), u.head(5), 0.05), "P1"); }), HasSubstr("at least 6 samples"));
    EXPECT_THAT(refusal([&] { fit(IdData(Matrix(y), Matrix::Random(100, 2), 0.05), "P1"); }),
                HasSubstr("one input and one output"));
    ProcsrivcOptions options;
    options.least_delay = 2;
    options.largest_delay = 1;
    EXPECT_THAT(refusal([&] { fit(data, "P1D", options); }), HasSubstr("`largest_delay` must be at least"));
    options = {};
    options.largest_delay = 100;
    EXPECT_THAT(refusal([&] { fit(data, "P1D", options); }), HasSubstr("shorter than the data"));
    options = {};
    options.tolerance = -1;
    EXPECT_THAT(refusal([&] { fit(data, "P1", options); }), HasSubstr("`tolerance`"));
    options = {};
    options.delay_count = 0;
    EXPECT_THAT(refusal([&] { fit(data, "P1", options); }), HasSubstr("`delay_count`"));
}

// For long data, the start comes from the beginning. The end must still be the optimum of all data.
TEST(procsrivc, a_long_record_ends_at_its_own_optimum) {  // oracle: second route, srivc without a structure of lags
    const Index N = 60'000;
    const Vector u = rough_input(N, 12), e = 0.3 * RandomStream(9).normal(N);
    const IdData data = siso(lsim(model_of("P2", Vector{{1.2, 1.0, 0.4}}), u, 0.05) + e, u, 0.05);
    const auto result = fit(data, "P2", tight());
    FitOptions options;
    options.tolerance = 1e-11;
    const Fit free = srivc(data, TransferStructure::single(2, 0), options);
    const TransferFunction &G = result.models[0], &expected = free.models[0];
    EXPECT_LT((G.den() - expected.den()).cwiseAbs().maxCoeff(), 1e-7) << message_text(result.full_message());
    EXPECT_LT((G.num() - expected.num()).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_NEAR(result.loss, free.loss, 1e-12);
    EXPECT_EQ(result.start.state, InitialState::kZero) << message_text(result.full_message());
}

TEST(procsrivc, a_long_record_chooses_its_start_as_a_whole) {  // oracle: the simulated system
    const Index N = 100'000;
    const double gain = 1.2, offset = 0.0022;  // six standard errors of the whole, three of the beginning
    const Vector u = rough_input(N, 12, 0.5), e = 0.1 * RandomStream(9).normal(N);
    const Vector y = lsim(model_of("P1", Vector{{gain, 0.8}}), Vector(u.array() - u[0]), 0.05).array() + gain * u[0];
    const auto result = fit(siso(Vector(y + e).array() + offset, u, 0.05), "P1");
    EXPECT_EQ(result.start.state, InitialState::kSteady) << message_text(result.full_message());
    EXPECT_TRUE(result.start.offset) << message_text(result.full_message());
    EXPECT_NEAR(result.offsets(0, 0), offset, 4 * 0.1 / std::sqrt(1e5));
    for (const auto& [i, truth] : {std::pair{0, gain}, std::pair{1, 0.8}})
        EXPECT_NEAR(result.theta[i], truth, 4 * result.std[i]);
}

TEST(procsrivc, a_beginning_that_has_no_information_is_no_start) {  // oracle: the simulated system
    const Index N = 60'000, silent = 25'000;
    Vector u = rough_input(N, 12);
    u.head(silent).setZero();
    const Vector slow{{1.2, 2000.0}}, e = 0.05 * RandomStream(9).normal(N);  // as long as the beginning
    for (const Vector& truth : {Vector{{1.2, 0.8}}, slow}) {
        if (truth == slow) u = rough_input(N, 3000);
        const auto result = fit(siso(lsim(model_of("P1", truth), u, 0.05) + e, u, 0.05), "P1");
        for (Index i = 0; i < 2; ++i)
            EXPECT_NEAR(result.theta[i], truth[i], 4 * result.std[i]) << message_text(result.full_message());
    }
}

TEST(procsrivc, zero_and_delay_of_p1dz_have_no_standard_errors) {  // oracle: n + 1 weights for n + 2 values; the truth
    const Vector u = rough_input(2000, 12);
    const Vector x = lsim(model_of("P1DZ", Vector{{1.7, 2.0, -0.9, 0.43}}), u, 0.05);
    const Fit found = fit(siso(x + 0.08 * RandomStream(8).normal(2000), u, 0.05), "P1DZ");
    const std::string message = message_text(found.full_message());
    EXPECT_THAT(message, HasSubstr("Tz and Td cannot be distinguished"));
    EXPECT_EQ(message.find("condition number"), std::string::npos) << message;
    EXPECT_TRUE(std::isinf(found.std[2]) && std::isinf(found.std[3])) << found.std.transpose();
    EXPECT_LT(std::abs(found.theta[0] - 1.7), 4 * found.std[0]);
    EXPECT_LT(std::abs(found.theta[1] - 2), 4 * found.std[1]);
}

TEST(procsrivc,
     a_step_before_the_record_determines_only_its_time_constant) {  // oracle: 25 s; the gain is undetermined
    const Vector t = Vector::LinSpaced(300, 0, 149.5);
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const Vector y = 49.2 - 12 * (-t.array() / 25).exp() + 0.05 * RandomStream(seed).normal(300).array();
        const Fit found = fit(siso(y, Vector::Constant(300, 55), 0.5), "P1D");
        EXPECT_NEAR(found.theta[1], 25, 0.5) << seed;
        EXPECT_TRUE(std::isinf(found.std[0]) && std::isinf(found.std[2])) << found.std.transpose();
        EXPECT_THAT(message_text(found.full_message()), HasSubstr("assume that the input was zero"));
    }
}

}  // namespace test_procsrivc
