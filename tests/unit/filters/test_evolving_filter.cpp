#include <gtest/gtest.h>

#include <cmath>

#include "numerics/filters/evolving_filter.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"

namespace test_evolving_filter {

using namespace dynlab;

EvolvingModel model_of(const Vector& A, const Vector& B) {
    EvolvingModel model;
    model.n = static_cast<int>(A.size()) - 1;
    model.m = static_cast<int>(B.size()) - 1;
    Vector theta(model.n + B.size());
    theta << A.tail(model.n), B;
    model.set(theta.data());
    return model;
}

Vector states(const EvolvingState& state, int n) {
    return Vector::Map(state.data(), n);
}

// oracle: matrix exponentials (exact_step), from slow to stiff filters and long steps
TEST(evolving_filter, steps_are_exact) {
    const Vector B{{2, 1}};
    for (const Vector& A : {Vector{{1, 3}}, Vector{{1, 0.2, 100}}, Vector{{1, 12, 36}}, Vector{{1, 6, 11, 6}},
                            Vector{{1, 5, 408, 416, 1600}}, Vector{{1, 0, 0}}, Vector{{1, 2000, 1e6}}})
        for (const double h : {1e-3, 0.05, 0.7}) {
            const int n = static_cast<int>(A.size()) - 1;
            const EvolvingModel model = model_of(A, B);
            EvolvingState state{};
            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) state[i] = 1 / (1.0 + double(i));
            const Vector start = states(state, n);
            const StepMatrices step = exact_step(companion(A), Vector::Unit(n, 0), h);
            const int pieces = pieces_of_step(model, h, 1 << 14);
            for (int i = 0; i < pieces; ++i)
                advance_filter<Eigen::Dynamic>(model, state, 0.3 + 0.4 * i / pieces, 0.3 + 0.4 * (i + 1) / pieces,
                                               h / pieces);
            const Vector expected = step.F * start + step.H0.col(0) * 0.3 + step.H1.col(0) * 0.7;
            const Vector scale = (step.F.cwiseAbs() * start.cwiseAbs()).array() + step.H0.col(0).array().abs() +
                                 step.H1.col(0).array().abs();
            EXPECT_LT(((states(state, n) - expected).array() / scale.array()).abs().maxCoeff(), 3e-13)
                << A.transpose() << ", " << h;
        }
}

// oracle: the joint system of both filters, by matrix exponentials
TEST(evolving_filter, cascades_are_exact) {
    for (const Vector& B : {Vector{{2}}, Vector{{-1, 2}}, Vector{{0.5, -1, 2}}}) {
        const Vector A{{1, 4, 3}};
        const EvolvingModel model = model_of(A, B);
        Matrix joint = Matrix::Zero(4, 4);
        joint.topLeftCorner(2, 2) = joint.bottomRightCorner(2, 2) = companion(A);
        Vector direct = Vector::Zero(4);
        direct[0] = 1;
        for (Index j = 0; j < B.size(); ++j) {
            const Index derivative = B.size() - 1 - j;
            if (derivative < 2) {
                joint(2, 1 - derivative) += B[j];
            } else {
                joint.row(2).head(2) -= B[j] * A.tail(2).transpose();
                direct[2] = B[j];
            }
        }
        const StepMatrices step = exact_step(joint, direct, 0.2);
        EvolvingState alone{-0.4, 1}, first{0.3, -1}, second{2, 0.7};
        advance_cascade<2>(model, alone, {0.6, 0.8}, first, second, {1.5, -0.5}, 0.2);
        const Vector expected = step.F * Vector{{0.3, -1, 2, 0.7}} + step.H0.col(0) * 1.5 + step.H1.col(0) * -0.5;
        const Vector found{{first[0], first[1], second[0], second[1]}};
        EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-14) << B.transpose();
        const StepMatrices single = exact_step(companion(A), Vector::Unit(2, 0), 0.2);
        const Vector of_alone = single.F * Vector{{-0.4, 1}} + single.H0.col(0) * 0.6 + single.H1.col(0) * 0.8;
        EXPECT_LT((Vector::Map(alone.data(), 2) - of_alone).cwiseAbs().maxCoeff(), 1e-14) << B.transpose();
    }
}

}  // namespace test_evolving_filter
