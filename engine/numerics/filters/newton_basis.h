#pragma once
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

// The Newton basis of the poles of a system with n = 2 or 4 states, in which one step takes the fewest multiplications.
// In pairs, (z - centre)^2 - square being the characteristic polynomial of a pair,
//     p[k+1] = centre p[k] + square q[k] + v[k],   q[k+1] = centre q[k] + p[k],
// and q drives the next pair. Then x[k] = to_state [p; q; p; q] + a multiple of v[k]. With
// N(i) = (F - centre_i I)^2 - square_i I, the columns of to_state are g, (F - centre) g, and the same of N g; the
// remainder, N N g, is zero by the Cayley-Hamilton theorem.

struct PolePair {
    double centre = 0, square = 0;
};

/// The pair of a 2 x 2 block, without cancellation where its poles are close; equal poles are so exactly.
inline PolePair pair_of(const Eigen::Matrix2d& F) {
    constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
    const double half = 0.5 * (F(0, 0) - F(1, 1)), square = half * half + F(0, 1) * F(1, 0);
    return {0.5 * (F(0, 0) + F(1, 1)), std::abs(square) <= kRounding * half * half ? 0 : square};
}

/// The solution of A x = b for a matrix whose rows and columns may differ in size by many orders of magnitude.
template <int n>
Eigen::Matrix<double, n, 1> solve_scaled(Eigen::Matrix<double, n, n> A, Eigen::Matrix<double, n, 1> b) {
    const auto inverse = [](double norm) { return norm > 0 ? 1 / norm : 1; };
    const Eigen::Matrix<double, n, 1> rows = A.rowwise().norm().unaryExpr(inverse);
    A = rows.asDiagonal() * A;
    const Eigen::Matrix<double, n, 1> columns = A.colwise().norm().transpose().unaryExpr(inverse);
    A = A * columns.asDiagonal();
    b = rows.cwiseProduct(b);
    return columns.cwiseProduct(A.fullPivLu().solve(b));
}

/// to_state for x[k+1] = F x[k] + g v[k]. `in_order`: the pairs are those of the blocks of F, one after
/// the other.
template <int n>
Eigen::Matrix<double, n, n> newton_columns(const Eigen::Matrix<double, n, n>& F, Eigen::Matrix<double, n, 1> g,
                                           const PolePair* pairs, bool in_order) {
    Eigen::Matrix<double, n, n> to_state;
    for (Index i = 0; i < n; i += 2) {
        const auto [centre, square] = pairs[i / 2];
        const Eigen::Matrix<double, n, 1> second = F.lazyProduct(g) - centre * g;
        to_state.col(i) = g;
        if (i + 1 < n) to_state.col(i + 1) = second;
        g = (F.lazyProduct(second) - centre * second - square * g).eval();
        // The poles of what comes before are done with, but for rounding.
        if (in_order) g.head(std::min<Index>(n, i + 2)).setZero();
    }
    return to_state;
}

}  // namespace dynlab::inline numerics
