#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/reader.h"
#include "numerics/estimators/n4sid.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_n4sid {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

/// Two inputs, two outputs, three states, all four transfer functions of them.
StateSpace square_system(bool feedthrough) {
    const Matrix A{{0.9, 0.2, 0}, {-0.2, 0.8, 0.1}, {0, 0, 0.5}}, B{{1, 0.2}, {0, 1}, {0.5, -1}};
    const Matrix C{{1, 0, 1}, {0, 2, -1}}, D{{0.3, 0}, {-0.1, 2}};
    return StateSpace(A, B, C, feedthrough ? D : Matrix::Zero(2, 2), 0.1);
}

Matrix simulated(const StateSpace& system, const Matrix& u, Vector x) {
    Matrix y(u.rows(), system.C.rows());
    for (Index k = 0; k < u.rows(); ++k) {
        const Vector input = u.row(k).transpose();
        y.row(k) = (system.C * x + system.D * input).transpose();
        x = system.A * x + system.B * input;
    }
    return y;
}

Matrix noise(Index N, Index columns, std::uint32_t seed) {
    return RandomStream(seed).normal(N * columns).reshaped(N, columns);
}

IdData simulated_data(const StateSpace& system, Index N, double sigma, std::uint32_t seed) {
    const Matrix u = noise(N, system.B.cols(), seed).array() + 0.5;
    const Vector x0 = noise(system.order(), 1, seed + 1);
    return IdData(Matrix(simulated(system, u, x0) + sigma * noise(N, system.C.rows(), seed + 2)), u, 0.1);
}

StateSpace single(const StateSpace& system) {
    return StateSpace(system.A, system.B.leftCols(1), system.C.topRows(1), system.D.topLeftCorner(1, 1), system.Ts);
}

/// Largest distance of an eigenvalue from the nearest of the others.
double distance(const ComplexVector& found, const ComplexVector& truth) {
    double worst = 0;
    for (const Complex& value : truth) worst = std::max(worst, (found.array() - value).abs().minCoeff());
    return worst;
}

/// Markov parameters D, CB, CAB, ...: what the system is, whatever its coordinates.
double markov_distance(const StateSpace& a, const StateSpace& b) {
    double worst = (a.D - b.D).cwiseAbs().maxCoeff();
    Matrix left = a.B, right = b.B;
    for (int k = 0; k < 20; ++k, left = a.A * left, right = b.A * right)
        worst = std::max(worst, (a.C * left - b.C * right).cwiseAbs().maxCoeff());
    return worst;
}

const SubspaceWeighting kWeightings[] = {SubspaceWeighting::kMoesp, SubspaceWeighting::kN4sid, SubspaceWeighting::kCva};

SubspaceOptions with(SubspaceWeighting weighting, bool feedthrough, int block_rows = 0) {
    SubspaceOptions options;
    options.weighting = weighting;
    options.feedthrough = feedthrough;
    options.block_rows = block_rows;
    return options;
}

TEST(n4sid, recovers_noise_free_systems) {  // oracle: the simulated system
    for (const bool feedthrough : {false, true})
        for (const SubspaceWeighting weighting : kWeightings)
            for (const StateSpace& system : {square_system(feedthrough), single(square_system(feedthrough))}) {
                const IdData data =
                    IdData::merge({simulated_data(system, 400, 0, 1), simulated_data(system, 300, 0, 5)});
                const auto result = n4sid(data, 3, with(weighting, feedthrough));
                EXPECT_LT(distance(result.system.A.eigenvalues(), system.A.eigenvalues()), 1e-7);
                EXPECT_LT(markov_distance(result.system, system), 1e-7) << message_text(result.fit.full_message());
                EXPECT_GT(result.fit.fit_percent.minCoeff(), 100 - 1e-5);
                EXPECT_TRUE(result.fit.warnings.empty()) << message_text(result.fit.full_message());
            }
}

TEST(n4sid, transfer_functions_are_those_of_the_system) {  // oracle: the impulse response
    const StateSpace system = square_system(true);
    const auto result = n4sid(simulated_data(system, 500, 0, 3), 3, with(SubspaceWeighting::kMoesp, true));
    ASSERT_EQ(result.fit.models.size(), 4u);
    const Complex z = std::polar(1.0, 0.7);
    const Eigen::MatrixXcd inverse = (z * Eigen::MatrixXcd::Identity(3, 3) - system.A).inverse();
    const Eigen::MatrixXcd response = system.C * inverse * system.B + system.D;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto output = static_cast<Index>(i / 2), input = static_cast<Index>(i % 2);
        EXPECT_LT(std::abs(result.fit.models[i].at(z) - response(output, input)), 1e-6);
    }
}

// Oracle: the definition, with the projections written down as N x N matrices.
TEST(n4sid, singular_values_are_those_of_the_projected_future) {
    const StateSpace system = single(square_system(false));
    const IdData data = simulated_data(system, 150, 0.5, 7);
    const Index s = 6, N = 150 - 2 * s + 1;
    Matrix future_u(N, s), past(N, 2 * s), future_y(N, s);
    for (Index i = 0; i < s; ++i) {
        future_u.col(i) = data.experiments[0].u.col(0).segment(s + i, N);
        future_y.col(i) = data.experiments[0].y.col(0).segment(s + i, N);
        past.col(i) = data.experiments[0].u.col(0).segment(i, N);
        past.col(s + i) = data.experiments[0].y.col(0).segment(i, N);
    }
    const auto projection = [](const Matrix& M) { return Matrix(M * (M.transpose() * M).inverse() * M.transpose()); };
    const Matrix without_u = Matrix::Identity(N, N) - projection(future_u);
    const Matrix explained = projection(without_u * past) * future_y / future_y.cwiseAbs().maxCoeff();
    const Vector expected = Eigen::JacobiSVD<Matrix>(explained).singularValues();
    const auto result = n4sid(data, 3, with(SubspaceWeighting::kMoesp, false, static_cast<int>(s)));
    ASSERT_EQ(result.singular_values.size(), s);
    const double scale = data.experiments[0].y.cwiseAbs().maxCoeff() / future_y.cwiseAbs().maxCoeff();
    for (Index i = 0; i < s; ++i) EXPECT_NEAR(result.singular_values[i] * scale, expected[i], 1e-8 * expected[0]);

    // CVA: the canonical correlations of future outputs and past, both without the future inputs.
    const Matrix rest = without_u * future_y, of_past = without_u * past;
    const Eigen::HouseholderQR<Matrix> first(rest), second(of_past);
    const Matrix Q1 = first.householderQ() * Matrix::Identity(N, s),
                 Q2 = second.householderQ() * Matrix::Identity(N, 2 * s);
    const Vector correlations = Eigen::JacobiSVD<Matrix>(Q1.transpose() * Q2).singularValues();
    const auto cva = n4sid(data, 3, with(SubspaceWeighting::kCva, false, static_cast<int>(s)));
    for (Index i = 0; i < s; ++i) EXPECT_NEAR(cva.singular_values[i], correlations[i], 1e-8);
}

TEST(n4sid, inputs_enter_with_the_least_simulation_error) {  // oracle: the loss nearby
    const IdData data = simulated_data(square_system(true), 400, 0.5, 9);
    const auto result = n4sid(data, 3, with(SubspaceWeighting::kMoesp, true));
    const Experiment& experiment = data.experiments[0];
    const Vector weights = experiment.y.cwiseAbs().colwise().maxCoeff().cwiseInverse().transpose();
    const auto loss = [&](const Matrix& B, const Matrix& D, const Vector& x0) {
        const StateSpace other(result.system.A, B, result.system.C, D, 0.1);
        return ((experiment.y - simulated(other, experiment.u, x0)) * weights.asDiagonal()).squaredNorm();
    };
    const Matrix &B = result.system.B, &D = result.system.D, &x0 = result.initial_states;
    const double least = loss(B, D, x0.col(0));
    for (const double step : {1e-3, -1e-3}) {
        for (Index i = 0; i < B.size(); ++i) {
            Matrix moved = B;
            moved.data()[i] += step;
            EXPECT_GT(loss(moved, D, x0.col(0)), least);
        }
        for (Index i = 0; i < D.size(); ++i) {
            Matrix moved = D;
            moved.data()[i] += step;
            EXPECT_GT(loss(B, moved, x0.col(0)), least);
        }
        for (Index i = 0; i < 3; ++i) EXPECT_GT(loss(B, D, x0.col(0) + step * Vector::Unit(3, i)), least);
    }
}

TEST(n4sid, noise_averages_out) {  // oracle: consistency, error ~ 1/sqrt(N), fixed seeds
    const StateSpace system = single(square_system(false));
    for (const SubspaceWeighting weighting : kWeightings) {
        double shorter = 0, longer = 0;
        for (std::uint32_t seed = 1; seed <= 10; ++seed) {
            const auto error = [&](Index N) {
                const auto result = n4sid(simulated_data(system, N, 0.5, 10 * seed), 3, with(weighting, false));
                return std::pow(distance(result.system.A.eigenvalues(), system.A.eigenvalues()), 2);
            };
            shorter += error(1000);
            longer += error(16000);
        }
        EXPECT_LT(std::sqrt(longer / shorter), 0.5);  // 1/4 expected
        EXPECT_LT(std::sqrt(longer / 10), 0.05);
    }
}

TEST(n4sid, reports_more_states_than_the_data_show) {  // oracle: the simulated order
    const auto result = n4sid(simulated_data(square_system(false), 400, 0, 1), 6);
    EXPECT_THAT(message_text(result.fit.full_message()), HasSubstr("The data support only 3 states"));
}

TEST(n4sid, refuses_what_it_cannot_use) {  // oracle: definitions
    const IdData data = simulated_data(square_system(false), 400, 0.1, 1);
    const Matrix y = data.experiments[0].y, u = data.experiments[0].u;
    const auto refusal = [](const IdData& given, int order, SubspaceOptions options = {}) {
        return thrown_message([&] { n4sid(given, order, options); });
    };
    EXPECT_THAT(refusal(data, 0), HasSubstr("must be between 1 and 100"));
    EXPECT_THAT(refusal(data, 5, with(SubspaceWeighting::kMoesp, false, 5)), HasSubstr("greater than the order"));
    EXPECT_THAT(refusal(data, 5, with(SubspaceWeighting::kMoesp, false, -1)), HasSubstr("must be nonnegative"));
    EXPECT_THAT(refusal(data.range(1, 20), 3), HasSubstr("too few"));
    EXPECT_EQ(refusal(data.range(1, 45), 3), "");
    EXPECT_THAT(refusal(data, 3, with(SubspaceWeighting::kMoesp, false, 60)), HasSubstr("too few"));
    EXPECT_THAT(refusal(IdData(y, Matrix(400, 0), 1), 2), HasSubstr("needs an input"));
    EXPECT_THAT(refusal(IdData(y, Matrix::Ones(400, 1), 1), 2), HasSubstr("not persistently exciting for"));
    EXPECT_THAT(refusal(IdData(y, u, Vector::LinSpaced(400, 0, 1)), 2), HasSubstr("regularly"));
}

}  // namespace test_n4sid
