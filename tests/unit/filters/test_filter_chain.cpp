#include "numerics/filters/filter_chain.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"

namespace test_filter_chain {

using namespace dynlab;

SampleView view(const Vector& x) {
    return {x.data(), x.size()};
}

// oracle: second route, the same instants given individually as for irregular sampling
TEST(filter_chain, regular_instants_give_the_same_however_they_are_given) {
    const Index N = 300;
    const Vector u = RandomStream(1).normal(N), y = RandomStream(2).normal(N),
                 t = Vector::LinSpaced(N, 0, 0.05 * static_cast<double>(N - 1));
    const Eigen::Vector3d A(1, 2, 5), E(1, 4, 4);
    for (const double delay : {0.0, 0.13}) {
        FilterChain of_x{view(u), derivatives_filter(E, 1), Hold::kFoh};
        of_x.front = FrontModel{transfer_system(Eigen::Vector2d(-1, 5), A), Hold::kZoh, delay};
        const std::vector<FilterChain> chains{{view(y), derivatives_filter(E, 2), Hold::kFoh},
                                              {view(u), derivatives_filter(A, 1), Hold::kZoh, delay},
                                              of_x};
        const std::vector<OutputSum> sums{{{{0, 1}, {5, -2}}}};
        const std::vector<Index> left{0, 3, 7}, right{1, 2, 4, 5, 6, 7};
        const Matrix regular = chain_products(chains, {0.05, {nullptr, 0}}, left, right, sums);
        const Matrix irregular = chain_products(chains, {0, view(t)}, left, right, sums);
        EXPECT_LT((regular - irregular).cwiseAbs().maxCoeff(), 1e-10 * regular.cwiseAbs().maxCoeff());
        // oracle: definition, the stored outputs multiplied
        Matrix outputs(N, 8);
        outputs << chain_outputs(chains[0], {0.05, {nullptr, 0}}), chain_outputs(chains[1], {0.05, {nullptr, 0}}),
            chain_outputs(chains[2], {0.05, {nullptr, 0}}), Vector::Zero(N);
        outputs.col(7) = outputs.col(0) - 2 * outputs.col(5);
        const Matrix expected = outputs(Eigen::all, left).transpose() * outputs(Eigen::all, right);
        EXPECT_LT((regular - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
    }
}

// oracle: analytic, the frequency response of each row
TEST(filter_chain, filters_are_what_their_polynomials_say) {
    const Vector A{{1, 2, 5}};
    const Complex s(0.3, 1.1), a = evaluate(A, s);
    const auto response = [&](const SingleInputSystem& system) {
        const Eigen::MatrixXcd resolvent = s * Eigen::MatrixXcd::Identity(2, 2) - system.A;
        return Eigen::VectorXcd(system.C.cast<Complex>() * resolvent.inverse() * system.B.cast<Complex>() +
                                system.D.cast<Complex>());
    };
    const Eigen::VectorXcd derivatives = response(derivatives_filter(A, 2));
    for (Index i = 0; i <= 2; ++i) EXPECT_LT(std::abs(derivatives[i] - std::pow(s, 2 - i) / a), 1e-15);
    for (const Vector& B : {Vector{{3.0}}, Vector{{2, 3.0}}, Vector{{1, 2, 3.0}}})
        EXPECT_LT(std::abs(response(transfer_system(B, A))[0] - evaluate(B, s) / a), 1e-14);
    EXPECT_EQ(no_filter().D[0], 1);
    EXPECT_EQ(no_filter().A.size(), 0);
}

}  // namespace test_filter_chain
