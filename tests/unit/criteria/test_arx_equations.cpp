#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/criteria/arx_equations.h"
#include "support/difference_equation.h"

namespace test_arx_equations {

using namespace dynlab;
using namespace dynlab::test;

const PolynomialOrders kOrders = PolynomialOrders::arx(2, {1, 2}, {1, 3});

/// Two experiments, the first longer than one block of rows, and one too short for any equation.
IdData simulated_data() {
    const auto part = [](Index N, std::uint32_t seed) {
        Matrix u(N, 2);
        u << RandomStream(seed).normal(N), RandomStream(seed + 1).normal(N);
        return IdData(Matrix(RandomStream(seed + 2).normal(N)), u, 0.1);
    };
    return IdData::merge({part(2500, 1), part(4, 11), part(300, 21)});
}

/// [Phi y] written down row by row from A y = B u + e.
Matrix by_hand(const IdData& data) {
    std::vector<Vector> rows;
    for (const Experiment& x : data.experiments)
        for (Index k = 4; k < x.y.rows(); ++k)
            rows.push_back(
                Vector{{-x.y(k - 1, 0), -x.y(k - 2, 0), x.u(k - 1, 0), x.u(k - 3, 1), x.u(k - 4, 1), x.y(k, 0)}});
    Matrix all(static_cast<Index>(rows.size()), 6);
    for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Index>(i)) = rows[i].transpose();
    return all;
}

TEST(arx_equations, sums_and_errors) {  // oracle: the equations written down, row by row
    const IdData data = simulated_data();
    const ArxEquations equations(data, kOrders);
    const Matrix all = by_hand(data), gram = all.transpose() * all;
    ASSERT_EQ(equations.count(), all.rows());
    EXPECT_LT((equations.gram() - gram).cwiseAbs().maxCoeff(), 1e-10 * gram.cwiseAbs().maxCoeff());
    const Matrix R = equations.triangular_factor();
    EXPECT_LT((R.transpose() * R - gram).cwiseAbs().maxCoeff(), 1e-10 * gram.cwiseAbs().maxCoeff());
    const Vector theta{{0.1, -0.2, 0.3, -0.4, 0.5}}, expected = all.col(5) - all.leftCols(5) * theta;
    const std::vector<Vector> errors = equations.errors(theta);
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_EQ(errors[1].size(), 0);
    Vector joined(errors[0].size() + errors[2].size());
    joined << errors[0], errors[2];
    EXPECT_LT((joined - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(arx_equations, least_squares) {  // oracle: second route, the QR decomposition of all equations
    const IdData data = simulated_data();
    const Matrix all = by_hand(data), Phi = all.leftCols(5);
    const ArxSolution solution = solve_arx(ArxEquations(data, kOrders));
    EXPECT_LT((solution.theta - Phi.householderQr().solve(all.col(5))).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((solution.inverse_gram * (Phi.transpose() * Phi) - Matrix::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(arx_equations, free_run_and_driven_part) {  // oracle: the difference equation, sample by sample
    const PolynomialModel model(kOrders, Vector{{-1.2, 0.5, 0.4, -0.1, 0.2}}, 0.1);
    const Matrix u = simulated_data().experiments[2].u;
    const Vector driven = driven_part(model, u), y = free_run(Vector{{-1.2, 0.5}}, driven, Vector::Zero(300), 0);
    EXPECT_LT((y - model_output(model, u, Vector::Zero(300))).cwiseAbs().maxCoeff(), 1e-12);
    const Vector known = free_run(Vector{{-1.2, 0.5}}, driven, Vector::Constant(300, 7.0), 2);
    EXPECT_EQ(known[1], 7);
    EXPECT_NEAR(known[2], driven[2] + 1.2 * 7 - 0.5 * 7, 1e-13);
}

}  // namespace test_arx_equations
