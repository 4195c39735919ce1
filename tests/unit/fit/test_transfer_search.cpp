#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "numerics/error.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/signals/random.h"
#include "support/search_corpus.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_transfer_search {

using namespace dynlab;
using namespace dynlab::test;

/// 3 exp(-0.4 s)/(s^2 + 2s + 4) with a little noise, N samples about `step` (s) apart.
IdData irregular_data(Index N, double step, std::uint32_t seed) {
    const Vector jitter = RandomStream(seed).uniform(N), noise = RandomStream(seed + 1).normal(N);
    const Vector levels = RandomStream(seed + 2).normal(N);
    Vector t(N), u(N);
    for (Index k = 0; k < N; ++k) {
        t[k] = step * (static_cast<double>(k) + 0.5 * jitter[k]);
        u[k] = levels[static_cast<Index>(t[k])] > 0 ? 1 : -1;
    }
    const TransferFunction G = TransferFunction(values({3}), values({1, 2, 4})).with_delay(0.4);
    return IdData(Matrix(lsim(G, u, t) + 0.02 * noise), Matrix(u), t);
}

// A fast short experiment and a slow long one, in either order.
struct Orders {
    IdData fast = irregular_data(300, 0.02, 1), slow = irregular_data(400, 0.2, 11);
    IdData fast_first = IdData::merge({fast, slow}), slow_first = IdData::merge({slow, fast});
};

TEST(transfer_search, the_order_of_unequal_experiments_does_not_matter) {  // oracle: invariance
    const Orders orders;
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    EXPECT_EQ(likely_largest_delay(orders.fast_first), likely_largest_delay(orders.slow_first));
    FitOptions options;
    options.largest_delay = 1.4;
    const DelayScan one = scan_delays(orders.fast_first, structure, options);
    const DelayScan other = scan_delays(orders.slow_first, structure, options);
    ASSERT_EQ(one.delays.size(), other.delays.size());
    EXPECT_EQ(one.delays, other.delays);
    EXPECT_LT(relative_difference(one.losses, other.losses), 1e-9);
    const TransferStructure fixed = TransferStructure::single(2, 0, 0.4);
    EXPECT_LT(relative_difference(best_cutoff_start(orders.fast_first, fixed, {}),
                                  best_cutoff_start(orders.slow_first, fixed, {})),
              1e-9);
}

TEST(transfer_search, the_likely_delay_leaves_the_shortest_record_room) {  // oracle: the promised quarter
    const IdData brief = irregular_data(80, 0.005, 21), slow = irregular_data(400, 0.2, 11);
    for (const IdData& data : {IdData::merge({brief, slow}), IdData::merge({slow, brief})})
        EXPECT_LE(likely_largest_delay(data), shortest_experiment(data) / 4);
}

/// A slow stable system in little data: the smallest simulation error is an unstable model's.
IdData nearly_integrating_data(std::uint32_t seed) {
    const Index N = 150;
    Vector u = Vector::Zero(N);
    u.segment(10, 40).setOnes();
    const Vector x = lsim(TransferFunction(values({1}), values({1, 0.003})), u, 0.1);
    return IdData(Matrix(x + 0.6 * RandomStream(seed).normal(N)), Matrix(u), 0.1);
}

// Oracle: the system is stable, and the data agree within chance; the loss of the unstable model is smaller.
TEST(transfer_search, an_unstable_model_is_given_only_where_it_is_clearly_better_or_asked_for) {
    int unstable = 0;
    const TransferStructure structure = TransferStructure::single(1, 0);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const IdData data = nearly_integrating_data(seed);
        FitOptions any, stable;
        any.stable = false;
        stable.stable = true;
        const Fit smallest = search_transfer("test", data, structure, any);
        const Fit held = search_transfer("test", data, structure, stable),
                  unasked = search_transfer("test", data, structure, {});
        EXPECT_TRUE(held.models[0].stable()) << seed;
        EXPECT_TRUE(unasked.models[0].stable()) << seed;
        EXPECT_LE(smallest.loss, held.loss * (1 + 1e-9)) << seed;
        EXPECT_LE(unasked.loss, 1.02 * smallest.loss) << seed;
        unstable += smallest.models[0].stable() ? 0 : 1;
    }
    EXPECT_GE(unstable, 3);
}

TEST(transfer_search, a_system_that_is_unstable_is_found_unstable) {  // oracle: the simulated system
    const Index N = 300;
    Vector u = Vector::Zero(N);
    u.tail(N - 10).setOnes();
    const Vector x = lsim(TransferFunction(values({1}), values({1, -0.2})), u, 0.05);
    const IdData data(Matrix(x + 0.05 * RandomStream(2).normal(N)), Matrix(u), 0.05);
    const Fit fit = search_transfer("test", data, TransferStructure::single(1, 0), {});
    EXPECT_NEAR(fit.theta[0], -0.2, 5 * fit.std[0]);
    EXPECT_LT(fit.std[0], 0.01);
}

// Oracle: with one parameter known, what is left is a search with a parameter less; at the free optimum it costs
// nothing.
TEST(transfer_search, fixed_parameters_keep_their_values) {
    const IdData data = course_system_data(0.1, 5);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Fit free = search_transfer("test", data, structure, {});
    FitOptions options;
    options.fixed = {{"a2", free.theta[1]}};
    const Fit at_optimum = search_transfer("test", data, structure, options);
    EXPECT_LT(relative_difference(at_optimum.theta, free.theta), 1e-5);
    EXPECT_EQ(at_optimum.std[1], 0);
    EXPECT_LT(at_optimum.std[0], free.std[0]);  // what is known makes the rest surer
    options.fixed = {{"a2", 3}};
    const Fit fit = search_transfer("test", data, structure, options);
    EXPECT_DOUBLE_EQ(fit.theta[1], 3);
    EXPECT_GT(fit.loss, free.loss);
    EXPECT_NEAR(fit.theta[0], 4, 5 * fit.std[0]);
    options.fixed = {{"a3", 1}};
    EXPECT_EQ(thrown_message([&] { search_transfer("test", data, structure, options); }),
              "`fixed`: the model has no parameter a3; its parameters are a1, a2, b0");
}

// Oracle: the weighted criterion itself, searched from the two outputs' own optima.
TEST(transfer_search, weights_of_outputs_decide_what_a_common_denominator_follows) {
    const Vector u = prbs(6, 10);
    Matrix y(u.size(), 2), inputs = u;
    y.col(0) = lsim(TransferFunction(values({1}), values({1, 1})), u, 0.05);
    y.col(1) = lsim(TransferFunction(values({2}), values({1, 3})), u, 0.05);
    const IdData data(y, inputs, 0.05);
    const auto structure = TransferStructure::grid(2, 1, Denominators::kCommon, {1}, {0}, {0});
    FitOptions options;
    const auto pole = [&](double first, double second) {
        options.output_weights = values({first, second});
        return search_transfer("test", data, structure, options).theta[0];
    };
    EXPECT_NEAR(pole(1000, 1), 1, 0.01);
    EXPECT_NEAR(pole(1, 1000), 3, 0.01);
    options.output_weights = values({1, 2, 3});
    EXPECT_THROW(search_transfer("test", data, structure, options), InvalidArgument);
}

/// Two outputs of one denominator, the second with eight times the noise.
IdData unequal_outputs(Denominators denominators, TransferStructure& structure) {
    const Vector u = prbs(7, 4), a = values({1, 1.2, 4});
    Matrix y(u.size(), 2), inputs = u;
    y.col(0) = lsim(TransferFunction(values({3}), a), u, 0.1) + 0.05 * RandomStream(3).normal(u.size());
    y.col(1) = lsim(TransferFunction(values({5}), a), u, 0.1) + 0.4 * RandomStream(4).normal(u.size());
    structure = TransferStructure::grid(2, 1, denominators, {2}, {0}, {0});
    return IdData(y, inputs, 0.1);
}

TEST(transfer_search, weights_decide_nothing_between_outputs_that_share_nothing) {  // oracle: the fit without weights
    TransferStructure structure;
    const IdData data = unequal_outputs(Denominators::kPerOutput, structure);
    const Fit plain = search_transfer("test", data, structure, {});
    FitOptions options;
    options.output_weights = values({1, 1});
    const Fit weighted = search_transfer("test", data, structure, options);
    EXPECT_EQ(weighted.theta, plain.theta);
    EXPECT_EQ(weighted.covariance, plain.covariance);
}

// Oracle: G^-1 (sum_o v_o J_o'J_o) G^-1, G = sum_o J_o'J_o, with sensitivities by differences of the simulation.
TEST(transfer_search, the_covariance_under_given_weights_is_that_of_each_output_s_noise) {
    TransferStructure structure;
    const IdData data = unequal_outputs(Denominators::kCommon, structure);
    FitOptions options;
    options.output_weights = values({1, 1});
    const Fit fit = search_transfer("test", data, structure, options);
    const Vector u = data.experiments[0].u.col(0);
    const auto simulated = [&](const Vector& theta, Index output) {
        return lsim(TransferFunction(theta.segment(2 + output, 1), values({1, theta[0], theta[1]})), u, 0.1);
    };
    Matrix gram = Matrix::Zero(4, 4), middle = gram;
    for (Index output = 0; output < 2; ++output) {
        Matrix J(u.size(), 4);
        for (Index i = 0; i < 4; ++i) {
            const Vector step = 1e-5 * Vector::Unit(4, i);
            J.col(i) = (simulated(fit.theta + step, output) - simulated(fit.theta - step, output)) / 2e-5;
        }
        gram += J.transpose() * J;
        middle += fit.noise_variance[output] * J.transpose() * J;
        EXPECT_NEAR(std::sqrt(fit.noise_variance[output]) / (output == 0 ? 0.05 : 0.4), 1, 0.1);
    }
    const Matrix inverse = solve_by_lu(gram, Matrix::Identity(4, 4)).x;
    const Matrix expected = inverse * middle * inverse;
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR(fit.std[i] / std::sqrt(expected(i, i)), 1, 1e-3) << i;
}

// Oracle: the optimum that the search without a start finds; a start elsewhere leads to the valley beside it.
TEST(transfer_search, begins_at_a_start_or_a_delay_that_is_given) {
    const IdData data = delayed_data();
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    const Fit unasked = search_transfer("test", data, structure, {});
    SearchAids near_truth, delay;
    near_truth.start = values({1.3, 3.3, 2.8, 0.5});
    delay.delays = {0.5};
    for (const SearchAids& aids : {near_truth, delay}) {
        const Fit fit = search_transfer("test", data, structure, {}, aids);
        EXPECT_LT(relative_difference(fit.theta, unasked.theta), 1e-4);
        EXPECT_EQ(fit.delay_grid.size(), 0);
    }
}

// Oracle: the search that begins at the least delay alone. On these data, the scan, which goes from neighbor to
// neighbor, misses the solution of that search.
TEST(transfer_search, the_solution_for_the_least_delay_is_never_lost) {
    for (const std::uint32_t seed : {40'301U, 40'597U}) {
        const SearchCase one = search_case(seed, 1000);
        TransferStructure structure = TransferStructure::single(one.poles, one.zeros);
        structure.free_delays = true;
        SearchAids least;
        least.delays = {0};
        const FitOptions rest = FitOptions{}.from_rest();
        const Fit begun = search_transfer("test", one.data, structure, rest, least);
        EXPECT_LE(search_transfer("test", one.data, structure, rest).loss, begun.loss * (1 + 1e-4)) << seed;
    }
}

// Oracle: the true system's loss. One of the searches ends at poles of 1e6 rad/s, and the simulation of that model by
// irregular steps of 0.1 s is not a number: such an end must lose against the others.
TEST(transfer_search, an_end_that_cannot_be_simulated_loses) {
    const SearchCase one = search_case(10'042, 5000, true);
    TransferStructure structure = TransferStructure::single(one.poles, one.zeros);
    structure.free_delays = one.delayed;
    EXPECT_LT(search_transfer("test", one.data, structure, {}).loss, one.loss_at_truth);
}

// Oracle: the simulated system. The data begin with the step and have a constant offset.
TEST(transfer_search, a_step_at_the_first_sample_on_a_constant_is_fitted) {
    const Index N = 400;
    const Vector u = Vector::Constant(N, 2.0);
    const Vector x = lsim(TransferFunction(values({0.6}), values({1, 0.9, 0.2})), u, 0.1);
    const IdData data(Matrix((x + 0.02 * RandomStream(7).normal(N)).array() + 21.5), Matrix(u), 0.1);
    FitOptions options;
    options.offset = Offset::kAuto;
    const Fit fit = search_transfer("test", data, TransferStructure::single(2, 0), options);
    EXPECT_NEAR(fit.offsets(0, 0), 21.5, 0.05);
    EXPECT_NEAR(fit.theta[1], 0.2, 5 * fit.std[1]);
    EXPECT_NEAR(fit.theta[2], 0.6, 5 * fit.std[2]);
}

// Oracle: the simulated system. The data contain no noise, so that only the unknown inputs before them can disturb.
TEST(transfer_search, inputs_from_before_a_record_do_no_harm_to_its_delay) {
    const Vector u = prbs(8, 4);
    const Vector y = lsim(TransferFunction(values({2}), values({1, 1.2}), 0, 1.73), u, 0.1);
    const IdData cut = IdData(Matrix(y), Matrix(u), 0.1).range(301, 700);
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    const Fit fit = search_transfer("test", cut, structure, options);
    EXPECT_LT(relative_difference(fit.theta, values({1.2, 2, 1.73})), 1e-6);
    EXPECT_GT(fit.fit_percent[0], 99.9999);
}

/// A data set of data/, whose columns are t, u and y.
IdData course_data(const std::string& name) {
    std::ifstream file(DYNLAB_SOURCE_DIR "/data/" + name + "/" + name + ".csv");
    std::vector<double> t, u, y;
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        double a = 0, b = 0, c = 0;
        char comma = 0;
        if (!(cells >> a >> comma >> b >> comma >> c)) continue;  // the head
        t.push_back(a);
        u.push_back(b);
        y.push_back(c);
    }
    const auto N = static_cast<Index>(t.size());
    return IdData(Matrix(Vector::Map(y.data(), N)), Matrix(Vector::Map(u.data(), N)), t[1] - t[0]);
}

TEST(transfer_search, a_pole_more_fits_no_worse_where_the_poorer_model_is_found_late) {
    // Oracle: nesting. With three poles a search from one start of several finds the better minimum, after 50
    // iterations.
    const IdData data = course_data("heat_exchanger");
    ASSERT_GT(data.sample_count(), 100);
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    const Fit three = search_transfer("test", data, TransferStructure::single(3, 0), options);
    const Fit four = search_transfer("test", data, TransferStructure::single(4, 0), options);
    EXPECT_LE(four.loss, three.loss * (1 + 1e-6));
}

// Oracle: all models of one pole from 0.01 to 1000 rad/s, each with its best gain, from rest. The systems swing, so
// that the loss of one pole has a second minimum at a slow one.
TEST(transfer_search, one_pole_for_a_swing_is_the_best_one_pole) {
    constexpr double kTs = 0.02;
    const Vector u = prbs(7, 12);
    const std::vector<TransferFunction> systems{{values({1, 0}), values({1, 0.3, 25})},
                                                {values({-1, 0}), values({1, 10.2, 27, 250})},
                                                {values({1, 0}), values({1, 4, 29, 100})}};
    for (const TransferFunction& G : systems) {
        const Vector x = lsim(G, u, kTs);
        const double size = std::sqrt((x.array() - x.mean()).square().mean());
        const Vector y = x + 0.05 * size * RandomStream(1).normal(x.size());
        double least = kInfinity;
        for (int k = -32; k <= 48; ++k) {
            const Vector one = lsim(TransferFunction(values({1}), values({1, std::pow(10, k / 16.0)})), u, kTs);
            least = std::min(least, (y - one * (one.dot(y) / one.squaredNorm())).squaredNorm());
        }
        for (const InitialState state : {InitialState::kZero, InitialState::kEstimate}) {
            FitOptions options;
            options.initial_state = state;
            const Fit fit =
                search_transfer("test", IdData(Matrix(y), Matrix(u), kTs), TransferStructure::single(1, 0), options);
            EXPECT_LE(fit.loss * static_cast<double>(y.size()), 1.001 * least) << G.den().transpose();
        }
    }
}

// Oracle: the losses of undamped and damped pairs of poles on a fine grid. The system is unstable, so that
// the best stable model lies on the bound.
TEST(transfer_search, the_best_stable_model_may_lie_on_the_bound) {
    constexpr double kTs = 0.1;
    const Vector u = prbs(8, 6).head(800);
    const TransferFunction G(values({1}), values({1, -0.02, 0.04}));
    const Vector x = lsim(G, u, kTs);
    const Vector y = x + 0.05 * x.cwiseAbs().maxCoeff() * RandomStream(3).normal(x.size());
    double least = kInfinity;
    for (int i = 0; i <= 200; ++i)
        for (const double damping : {0.0, 1e-4, 1e-3, 1e-2, 0.1}) {
            const double w = 0.01 * std::pow(100.0, i / 200.0);
            const Vector one = lsim(TransferFunction(values({1}), values({1, 2 * damping * w, w * w})), u, kTs);
            least = std::min(least, (y - one * (one.dot(y) / one.squaredNorm())).squaredNorm());
        }
    FitOptions options;
    options.stable = true;
    const Fit fit =
        search_transfer("test", IdData(Matrix(y), Matrix(u), kTs), TransferStructure::single(2, 0), options);
    EXPECT_TRUE(fit.models[0].stable());
    EXPECT_LE(fit.loss * static_cast<double>(y.size()), 1.001 * least);
}

}  // namespace test_transfer_search
