#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "numerics/estimators/oe.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/sriv.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/assessment.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/statistics/robust_covariance.h"
#include "numerics/validation/compare.h"

namespace test_assessment {

using namespace dynlab;

constexpr double kTs = 0.05;

Vector ar1(Index N, double pole, std::uint32_t seed) {
    Vector e = RandomStream(seed).normal(N);
    for (Index k = 1; k < N; ++k) e[k] += pole * e[k - 1];
    return e;
}

// Derivatives of the outputs of all data sets, stacked, by central differences; values that enter linearly are
// refitted, which projects them out.
Matrix differences(const std::function<Vector(const Vector&)>& output, const Vector& theta) {
    Matrix Psi(output(theta).size(), theta.size());
    for (Index i = 0; i < theta.size(); ++i) {
        const double h = 1e-5 * std::max(1.0, std::abs(theta[i]));
        Vector above = theta, below = theta;
        above[i] += h, below[i] -= h;
        Psi.col(i) = (output(above) - output(below)) / (2 * h);
    }
    return Psi;
}

Fit estimate_of(const TransferStructure& structure, const Vector& theta, const StartCondition& start) {
    Fit estimate;
    estimate.structure = structure;
    estimate.theta = theta;
    estimate.models = structure.models(theta);
    estimate.covariance = Matrix::Identity(theta.size(), theta.size());
    estimate.start = start;
    return estimate;
}

// The robust covariance by the other route: compare_all() simulates and refits what enters linearly.
void expect_second_route(const IdData& data, const TransferStructure& structure, const Vector& theta,
                         const StartCondition& start, Index linear_unknowns) {
    const CompareOptions options{start.state, start.offset ? Offset::kEstimate : Offset::kNone};
    const auto output = [&](const Vector& at) {
        const Comparison all = compare_all(data, structure.models(at), options);
        std::vector<double> stacked;
        for (Index i = 0; i < data.output_count(); ++i)
            for (std::size_t k = 0; k < data.experiments.size(); ++k) {
                const Vector& part = all.results[k][static_cast<std::size_t>(i)].output;
                stacked.insert(stacked.end(), part.begin(), part.end());
            }
        return Vector(Eigen::Map<const Vector>(stacked.data(), static_cast<Index>(stacked.size())));
    };
    const Index N = data.sample_count(), ny = data.output_count();
    Vector y(N * ny);
    std::vector<Index> lengths;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) lengths.push_back(data.sample_count(k));
    for (Index i = 0, row = 0; i < ny; ++i)
        for (const Experiment& experiment : data.experiments) {
            y.segment(row, experiment.y.rows()) = experiment.y.col(i);
            row += experiment.y.rows();
        }
    // A change of theta also moves the refitted values along with the residual; to first order in the residual the
    // projected sensitivities are what remains, so the residual is kept small here.
    Matrix Psi = differences(output, theta);
    Vector errors = y - output(theta);
    for (Index i = 0; i < ny; ++i) {
        const double size = errors.segment(i * N, N).norm();
        Psi.middleRows(i * N, N) /= size;
        errors.segment(i * N, N) /= size;
    }
    const RobustCovariance expected = robust_covariance(Psi, errors, lengths, ny);
    const double free = static_cast<double>(y.size() - theta.size());
    const double freedom = free / (free - static_cast<double>(linear_unknowns));
    const Assessment actual = assess(data, estimate_of(structure, theta, start));
    EXPECT_EQ(actual.bandwidth, expected.bandwidth);
    EXPECT_LT((actual.covariance - freedom * expected.covariance).norm(), 1e-4 * actual.covariance.norm());
}

/// `noise`: what the errors of one output are multiplied with for the next.
IdData cut_data(const TransferStructure& structure, const Vector& theta, Index nu, std::uint32_t seed,
                double noise = 1) {
    const auto models = structure.models(theta);
    const Index N = 500, ny = structure.outputs;
    Matrix u(N, nu), y(N, ny);
    for (Index j = 0; j < nu; ++j) {
        const Vector levels = RandomStream(seed + static_cast<std::uint32_t>(j)).normal(N);
        for (Index k = 0; k < N; ++k) u(k, j) = 1.5 + (levels[k / (8 + 3 * j)] > 0 ? 1 : -1);
    }
    for (Index i = 0; i < ny; ++i) {
        const auto own_seed = seed + 10 + static_cast<std::uint32_t>(i);
        y.col(i) = 1e-5 * std::pow(noise, static_cast<double>(i)) * ar1(N, 0.7, own_seed);
        for (Index j = 0; j < nu; ++j) y.col(i) += lsim(models[static_cast<std::size_t>(i * nu + j)], u.col(j), kTs);
    }
    return IdData(y, u, kTs);
}

TEST(assessment, one_channel_from_rest) {  // oracle: differences of compare_all()
    const auto structure = TransferStructure::single(2, 1);
    const Vector theta{{2.0, 5.0, 1.0, 4.0}};
    const IdData data = cut_data(structure, theta, 1, 1);
    expect_second_route(data, structure, theta, {InitialState::kZero, false}, 0);
    expect_second_route(data, structure, theta, {InitialState::kZero, true}, 1);
}

TEST(assessment, one_channel_cut_from_a_running_experiment) {  // oracle: differences of compare_all()
    const auto structure = TransferStructure::single(2, 0);
    const Vector theta{{2.0, 5.0, 4.0}};
    const IdData data = cut_data(structure, theta, 1, 3).range(101, 500);
    expect_second_route(data, structure, theta, {InitialState::kEstimate, true}, 3);
}

TEST(assessment, several_experiments_and_channels) {  // oracle: differences of compare_all()
    const auto structure =
        TransferStructure::grid(2, 2, Denominators::kPerOutput, {2, 2, 1, 1}, {0, 1, 0, 0}, {0, 0.1, 0.07, 0});
    const Vector theta{{2.0, 5.0, 4.0, 1.0, 3.0, 0.8, 1.0, 2.0}};
    const IdData whole = cut_data(structure, theta, 2, 5);
    expect_second_route(IdData::merge({whole, cut_data(structure, theta, 2, 25)}), structure, theta,
                        {InitialState::kZero, false}, 0);
}

TEST(assessment, outputs_that_share_a_denominator) {  // oracle: differences of compare_all()
    const auto structure = TransferStructure::grid(2, 1, Denominators::kCommon, {2}, {0, 1}, {0, 0.1});
    const Vector theta{{2.0, 5.0, 4.0, 3.0, 1.0}};
    const IdData data = cut_data(structure, theta, 1, 6, 20);
    expect_second_route(data, structure, theta, {InitialState::kZero, false}, 0);
    expect_second_route(data, structure, theta, {InitialState::kEstimate, true}, 6);
}

TEST(assessment, an_output_given_twice_in_two_units_teaches_nothing_new) {  // oracle: the fit of the one output
    const auto single = TransferStructure::single(2, 0);
    const auto twice = TransferStructure::grid(2, 1, Denominators::kCommon, {2}, {0, 0}, {0, 0});
    const Vector u = prbs(7, 8);
    const Vector y =
        lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}}), u, kTs) + 0.1 * ar1(u.size(), 0.7, 1);
    Matrix both(y.size(), 2);
    both << y, -1000 * y;
    const IdData one(Matrix(y), Matrix(u), kTs), two(both, Matrix(u), kTs);
    const Fit alone = srivc(one, single), joint = srivc(two, twice);
    EXPECT_LT((joint.theta.head(3) - alone.theta).cwiseQuotient(alone.theta).norm(), 1e-4);
    const Vector expected = assess(one, alone).std, std = assess(two, joint).std;
    // The windows are those of 3 and of 4 parameters.
    for (Index i = 0; i < 3; ++i) EXPECT_NEAR(std[i] / expected[i], 1, 0.03) << i;
    EXPECT_NEAR(std[3] / (1000 * expected[2]), 1, 0.03);
}

TEST(assessment, irregular_sampling_and_as_many_zeros_as_poles) {  // oracle: differences of compare_all()
    const auto structure = TransferStructure::single(2, 2);
    const Vector theta{{2.0, 5.0, 0.5, 1.0, 4.0}};
    const IdData regular = cut_data(structure, theta, 1, 7);
    expect_second_route(regular, structure, theta, {InitialState::kZero, false}, 0);
    Vector t(500);
    const Vector jitter = RandomStream(2).uniform(500);
    for (Index k = 0; k < 500; ++k) t[k] = 3 + kTs * (static_cast<double>(k) + 0.4 * jitter[k]);
    const Matrix u = regular.experiments[0].u;
    const Vector y = lsim(structure.models(theta)[0], u.col(0), t) + 1e-5 * ar1(500, 0.8, 3);
    const auto proper = TransferStructure::single(2, 0);
    const Vector smaller{{2.0, 5.0, 4.0}};
    const Vector z = lsim(proper.models(smaller)[0], u.col(0), t) + 1e-5 * ar1(500, 0.8, 3);
    expect_second_route(IdData(Matrix(y), u, t), structure, theta, {InitialState::kZero, false}, 0);
    expect_second_route(IdData(Matrix(z), u, t), proper, smaller, {InitialState::kEstimate, false}, 2);
}

TEST(assessment, process_models_with_delay) {  // oracle: differences of lsim over the process parameters
    const Vector u = prbs(6, 8).array() + 0.3;
    const ProcessModel process(ProcessStructure::parse("P1D"), Vector{{2.0, 0.8, 0.23}});
    const Vector y = lsim(process.transfer_function(), u, kTs) + 0.1 * ar1(u.size(), 0.8, 1);
    const IdData data(Matrix(y), Matrix(u), kTs);
    ProcsrivcOptions options;
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kNone;
    const auto fitted = procsrivc(data, process.structure, options);
    const Assessment actual = assess(data, fitted);
    EXPECT_FALSE(actual.white);
    EXPECT_GT(actual.std[0], 1.5 * fitted.std[0]);
    const auto output = [&](const Vector& parameters) {
        return lsim(ProcessModel(process.structure, parameters).transfer_function(), u, kTs);
    };
    const auto expected = robust_covariance(differences(output, fitted.theta), y - fitted.output);
    EXPECT_EQ(actual.bandwidth, expected.bandwidth);
    EXPECT_LT((actual.covariance - expected.covariance).norm(), 1e-6 * actual.covariance.norm());
}

TEST(assessment, process_models_with_zero_and_integrator_sampled_irregularly) {  // oracle: differences of lsim
    Vector t(500);
    const Vector jitter = RandomStream(2).uniform(500), u = prbs(6, 8).head(500).array() + 0.3;
    for (Index k = 0; k < 500; ++k) t[k] = kTs * (static_cast<double>(k) + 0.4 * jitter[k]);
    ProcsrivcOptions options;
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kNone;
    for (const auto& [structure, parameters] : std::vector<std::pair<const char*, Vector>>{
             {"P1Z", Vector{{2.0, 0.8, 0.3}}}, {"P2DIZ", Vector{{0.5, 0.8, 0.2, -0.3, 0.23}}}}) {
        const ProcessModel process(ProcessStructure::parse(structure), parameters);
        const auto output = [&](const Vector& values) {
            return lsim(ProcessModel(process.structure, values).transfer_function(), u, t);
        };
        const Vector x = output(parameters);
        const auto simulated_data = [&](std::uint32_t seed) {
            return IdData(Matrix(x + 0.05 * ar1(500, 0.8, seed)), Matrix(u), t);
        };
        const IdData data = IdData::merge({simulated_data(1), simulated_data(2)});
        const auto fitted = procsrivc(data, process.structure, options);
        const Assessment actual = assess(data, fitted);
        const Matrix one = differences(output, fitted.theta);
        Matrix both(1000, one.cols());
        both << one, one;
        Vector y(1000);
        y << data.experiments[0].y, data.experiments[1].y;
        const auto expected = robust_covariance(both, y - fitted.output, {500, 500});
        EXPECT_LT((actual.covariance - expected.covariance).norm(), 1e-5 * actual.covariance.norm()) << structure;
    }
}

TEST(assessment, difference_equations) {  // oracle: differences of the simulation, its linear part refitted by hand
    const Vector f{{-1.5, 0.7}};
    const double b = 0.2;
    const auto simulated = [&](const Vector& theta, const Vector& u) {
        Vector x = Vector::Zero(u.size());
        for (Index k = 1; k < u.size(); ++k)
            x[k] = theta[2] * u[k - 1] - theta[0] * x[k - 1] - (k > 1 ? theta[1] * x[k - 2] : 0);
        return x;
    };
    const Vector u = prbs(6, 8), x = simulated(Vector{{f[0], f[1], b}}, u), v = 0.02 * ar1(u.size(), 0.8, 4);
    const Index N = 400;
    const auto orders = PolynomialOrders::output_error({1}, {2}, {1});
    FitOptions options;
    options.tolerance = 1e-10;
    const IdData whole(Matrix(x + v), Matrix(u), kTs);
    const auto rest = oe(whole, orders, options);
    const auto of_rest = [&](const Vector& theta) { return simulated(theta, u); };
    const auto expected = robust_covariance(differences(of_rest, rest.theta), x + v - of_rest(rest.theta));
    const Assessment actual = assess(whole, rest);
    EXPECT_FALSE(actual.white);
    EXPECT_EQ(actual.bandwidth, expected.bandwidth);
    EXPECT_LT((actual.covariance - expected.covariance).norm(), 1e-5 * actual.covariance.norm());
    EXPECT_GT(actual.std[2], 1.2 * rest.std[2]);

    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    const Vector small = 1e-5 * v, cut_u = u.tail(N), y = Vector((x + small).tail(N)).array() + 3;
    const IdData cut(Matrix(y), Matrix(cut_u), kTs);
    const auto running = sriv(cut, orders, options);
    const auto refitted = [&](const Vector& theta) -> Vector {
        const Vector driven = simulated(theta, cut_u);
        Matrix linear = Matrix::Ones(N, 3);
        for (Index j = 0; j < 2; ++j)  // the free motions, from y(-1) and y(-2) in turn
            for (Index k = 0; k < N; ++k)
                linear(k, j) = -theta[0] * (k > 0 ? linear(k - 1, j) : (j == 0 ? 1 : 0)) -
                               theta[1] * (k > 1 ? linear(k - 2, j) : (k == 1 ? (j == 0 ? 1 : 0) : (j == 0 ? 0 : 1)));
        return driven + linear * linear.colPivHouseholderQr().solve(y - driven);
    };
    const auto of_cut = robust_covariance(differences(refitted, running.theta), y - refitted(running.theta));
    const Assessment cut_actual = assess(cut, running);
    const double freedom = static_cast<double>(N - 3) / static_cast<double>(N - 6);
    EXPECT_LT((cut_actual.covariance - freedom * of_cut.covariance).norm(), 1e-3 * cut_actual.covariance.norm());
}

TEST(assessment, parameters_held_at_a_bound_stay_certain) {  // oracle: the definition
    const Vector u = prbs(6, 8);
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 1.0}});
    const IdData data(Matrix(lsim(G, u, kTs) + 0.1 * ar1(u.size(), 0.8, 1)), Matrix(u), kTs);
    const auto structure = TransferStructure::single(1, 0);
    Fit estimate = estimate_of(structure, Vector{{1.0, 2.0}}, {InitialState::kZero, false});
    estimate.covariance(0, 0) = 0;
    const Assessment held = assess(data, estimate);
    EXPECT_EQ(held.std[0], 0);
    EXPECT_GT(held.std[1], 0);
}

}  // namespace test_assessment
