#include <gtest/gtest.h>

#include <Eigen/LU>

#include "numerics/estimators/rivc.h"
#include "numerics/estimators/srivc.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "support/colored_noise.h"

namespace test_rivc_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kRuns = 60;
// The standard deviation from 60 runs has a relative error of 1/sqrt(118) = 9 %: this is 2.7 of them.
constexpr double kAllowed = 0.25;

const TransferStructure kStructure = TransferStructure::single(2, 0);

struct Runs {
    Matrix values;    // one run a row
    Vector reported;  // mean of the standard errors

    Vector spread() const {
        return ((values.rowwise() - values.colwise().mean()).colwise().squaredNorm() / (kRuns - 1))
            .cwiseSqrt()
            .transpose();
    }
};

Runs runs_of_rivc(const ColoredProblem& problem, const NoiseOrders& orders) {
    const Index nc = orders.nc, nd = orders.nd;
    Runs runs{Matrix(kRuns, 3 + nc + nd), Vector::Zero(3 + nc + nd)};
    for (int run = 0; run < kRuns; ++run) {
        const Fit result = rivc(problem.simulated_data(static_cast<std::uint32_t>(run + 1)), kStructure, orders,
                                FitOptions{}.from_rest());
        EXPECT_EQ(result.termination, Termination::kConverged) << run + 1;
        runs.values.row(run) << result.theta.transpose(), result.noise->C.tail(nc).transpose(),
            result.noise->D.tail(nd).transpose();
        Vector std(3 + nc + nd);
        std << result.std, result.noise->C_std.tail(nc), result.noise->D_std.tail(nd);
        runs.reported += std / kRuns;
    }
    return runs;
}

/// The sensitivities of the output at the truth.
Matrix true_sensitivities(const ColoredProblem& problem) {
    return transfer_sensitivities(values({2}), values({1, 4, 3}), 0, problem.u, 0.05, Hold::kZoh).middleCols(1, 3);
}

/// Of theta: sigma^2 (Psi'Psi)^-1 with Psi filtered by D/C.
Vector cramer_rao(const ColoredProblem& problem) {
    ArmaNoise noise = ArmaNoise::white(0, 0);
    noise.C = problem.C;
    noise.D = problem.D;
    const Matrix Psi = whitened(noise, true_sensitivities(problem));
    return problem.sigma() * (Psi.transpose() * Psi).inverse().diagonal().cwiseSqrt();
}

/// The standard deviations of the smallest sum of squares of the simulation error, which takes colored noise as white.
Vector unweighted(const ColoredProblem& problem) {
    const Matrix Psi = true_sensitivities(problem), inverse = (Psi.transpose() * Psi).inverse();
    Matrix back(Psi.rows(), Psi.cols());  // the transposed noise filter: the filter backwards in time
    for (Index i = 0; i < Psi.cols(); ++i)
        back.col(i) = arma_filtered(problem.C, problem.D, Psi.col(i).reverse()).reverse();
    return problem.sigma() * (inverse * (back.transpose() * back) * inverse).diagonal().cwiseSqrt();
}

// oracle: the scatter over seeds 1 to 60 on the classic problem, its truth, and the Cramer-Rao bound
TEST(rivc_statistics, reported_errors_are_the_scatter_and_reach_the_bound) {
    const ColoredProblem problem;
    const Runs runs = runs_of_rivc(problem, {1, 2});
    const Vector truth = values({4, 3, 2, 0.9, -1, 0.2}), spread = runs.spread(), bound = cramer_rao(problem);
    for (Index i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(runs.reported[i] / spread[i], 1, kAllowed) << i << ": " << runs.reported[i] << ", " << spread[i];
        EXPECT_NEAR(runs.values.col(i).mean(), truth[i], 5 * spread[i] / std::sqrt(kRuns)) << i;
    }
    for (Index i = 0; i < bound.size(); ++i) EXPECT_NEAR(spread[i] / bound[i], 1, kAllowed) << i;
}

// oracle: the theory of both estimates, for noise that drifts in the band of the system
TEST(rivc_statistics, a_noise_model_pays_where_theory_says) {
    ColoredProblem problem;
    problem.C = values({1});
    problem.D = values({1, -0.98});
    const Vector bound = cramer_rao(problem), of_srivc = unweighted(problem);
    const Runs runs = runs_of_rivc(problem, {0, 1});
    Runs plain{Matrix(kRuns, 3), {}};
    for (int run = 0; run < kRuns; ++run)
        plain.values.row(run) =
            srivc(problem.simulated_data(static_cast<std::uint32_t>(run + 1)), kStructure, FitOptions{}.from_rest())
                .theta.transpose();
    for (Index i = 0; i < 3; ++i) {
        EXPECT_LT(bound[i], 0.95 * of_srivc[i]) << i;
        EXPECT_NEAR(runs.spread()[i] / bound[i], 1, kAllowed) << i;
        EXPECT_NEAR(plain.spread()[i] / of_srivc[i], 1, kAllowed) << i;
    }
}

}  // namespace test_rivc_statistics
