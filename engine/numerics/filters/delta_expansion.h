#pragma once
#include <Eigen/LU>
#include <array>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

// States of a sampled system as combinations of the columns of a delta chain; their number is known to the compiler.

template <int n>
using StateMatrix = Eigen::Matrix<double, n, n>;
template <int n>
using StateVector = Eigen::Matrix<double, n, 1>;

/// DeltaChain::alpha of det(delta I - E), by sums of principal minors: those of slow poles keep their digits beside
/// fast ones.
template <int n>
StateVector<n> delta_polynomial(const StateMatrix<n>& E) {
    StateVector<n> alpha;
    if constexpr (n == 1) {
        alpha << -E(0, 0);
    } else if constexpr (n == 2) {
        alpha << E.determinant(), -E.trace();
    } else {
        static_assert(n == 3 || n == 4);
        const auto minor = [&](int i, int j) { return E(i, i) * E(j, j) - E(i, j) * E(j, i); };
        double pairs = 0;
        for (int i = 0; i < n; ++i)
            for (int j = i + 1; j < n; ++j) pairs += minor(i, j);
        alpha[n - 1] = -E.trace();
        alpha[n - 2] = pairs;
        if constexpr (n == 3) {
            alpha[0] = -E.determinant();
        } else {
            double triples = 0;
            for (int left_out = 0; left_out < n; ++left_out) {
                Eigen::Matrix3d block;
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j) block(i, j) = E(i + (i >= left_out), j + (j >= left_out));
                triples += block.determinant();
            }
            alpha[1] = -triples;
            alpha[0] = E.determinant();
        }
    }
    return alpha;
}

/// alpha of the product of two such polynomials.
template <int n, int m>
StateVector<n + m> delta_product(const StateVector<n>& a, const StateVector<m>& b) {
    StateVector<n + m> product = StateVector<n + m>::Zero();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) product[i + j] += a[i] * b[j];
    product.template tail<m>() += b;
    for (int i = 0; i < n; ++i) product[m + i] += a[i];
    return product;
}

/// (delta I - E)^-1 = sum_j M_j delta^j/A (Faddeev).
template <int n>
std::array<StateMatrix<n>, n> resolvent(const StateMatrix<n>& E, const StateVector<n>& alpha) {
    std::array<StateMatrix<n>, n> M;
    M[n - 1].setIdentity();
    for (std::size_t j = n - 1; j > 0; --j)
        M[j - 1] = E.lazyProduct(M[j]) + alpha[static_cast<Index>(j)] * StateMatrix<n>::Identity();
    return M;
}

/// Sampled states as combinations of a chain's columns: (delta I - E)^-1 input = sum_j states.col(j) delta^j/A.
template <int n>
struct StateExpansion {
    StateVector<n> alpha;
    StateMatrix<n> states;
};
template <int n>
StateExpansion<n> expansion(const StateMatrix<n>& E, const StateVector<n>& input) {
    StateExpansion<n> x{delta_polynomial<n>(E), {}};
    const auto M = resolvent<n>(E, x.alpha);
    for (int j = 0; j < n; ++j) x.states.col(j) = M[static_cast<std::size_t>(j)].lazyProduct(input);
    return x;
}
/// For the cascade of two equal systems of n states each. Block by block, poles that are far apart cost no digits
/// twice.
template <int n>
StateExpansion<2 * n> cascade_expansion(const StateMatrix<2 * n>& E, const StateVector<2 * n>& input) {
    const StateMatrix<n> own = E.template topLeftCorner<n, n>(), between = E.template bottomLeftCorner<n, n>();
    const StateVector<n> alpha = delta_polynomial<n>(own);
    const auto M = resolvent<n>(own, alpha);
    StateExpansion<2 * n> x{delta_product<n, n>(alpha, alpha), StateMatrix<2 * n>::Zero()};
    for (int j = 0; j < n; ++j) {
        const StateMatrix<n>& Mj = M[static_cast<std::size_t>(j)];
        const StateVector<n> first = Mj.lazyProduct(input.template head<n>());
        const StateVector<n> second = Mj.lazyProduct(input.template tail<n>()), drive = between.lazyProduct(first);
        for (int i = 0; i <= n; ++i) {
            const double weight = i < n ? alpha[i] : 1;
            if (i + j < 2 * n) {
                x.states.col(i + j).template head<n>() += weight * first;
                x.states.col(i + j).template tail<n>() += weight * second;
            }
            if (i < n) x.states.col(i + j).template tail<n>() += M[static_cast<std::size_t>(i)].lazyProduct(drive);
        }
    }
    return x;
}

/// x of T x = b, where rows and columns of T may differ in size by many orders of magnitude.
template <int n>
StateVector<n> scaled_solution(StateMatrix<n> T, StateVector<n> b) {
    const auto inverse = [](double norm) { return norm > 0 ? 1 / norm : 1; };
    const StateVector<n> rows = T.rowwise().norm().unaryExpr(inverse);
    T = (rows.asDiagonal() * T).eval();
    const StateVector<n> columns = T.colwise().norm().transpose().unaryExpr(inverse);
    T = (T * columns.asDiagonal()).eval();
    return columns.cwiseProduct(T.partialPivLu().solve(rows.cwiseProduct(b)));
}

}  // namespace dynlab::inline numerics
