#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dynlab::inline numerics {

// A few equations, solved at every sample: the leading d x d of arrays of fixed size.

template <std::size_t kMax>
using SmallRow = std::array<double, kMax>;
template <std::size_t kMax>
using SmallMatrix = std::array<SmallRow<kMax>, kMax>;

/// A Givens rotation of two entries.
inline void rotate(double cosine, double sine, double& kept, double& left) {
    const double before = kept;
    kept = cosine * before + sine * left;
    left = cosine * left - sine * before;
}

/// A pivot against the size of its column, below which the equations count as singular.
inline constexpr double kSmallRank = 1e-9;

/// U x = b with U upper triangular; x stays, and false is returned, where U is singular.
template <std::size_t kMax>
bool solve_triangular(const SmallMatrix<kMax>& U, SmallRow<kMax> b, std::size_t d, SmallRow<kMax>& x) {
    for (std::size_t j = 0; j < d; ++j) {
        double size = 0;
        for (std::size_t i = 0; i <= j; ++i) size += std::abs(U[i][j]);
        if (!(std::abs(U[j][j]) > kSmallRank * size)) return false;
    }
    for (std::size_t i = d; i-- > 0;) {
        for (std::size_t j = i + 1; j < d; ++j) b[i] -= U[i][j] * x[j];
        x[i] = b[i] / U[i][i];
    }
    return true;
}

/// A x = b by elimination with row pivots; x stays, and false is returned, where A is singular.
template <std::size_t kMax>
bool solve_small(SmallMatrix<kMax> A, SmallRow<kMax> b, std::size_t d, SmallRow<kMax>& x) {
    SmallRow<kMax> sizes{}, reciprocals;
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j) sizes[j] += std::abs(A[i][j]);
    for (std::size_t j = 0; j < d; ++j) {
        std::size_t pivot = j;
        for (std::size_t i = j + 1; i < d; ++i)
            if (std::abs(A[i][j]) > std::abs(A[pivot][j])) pivot = i;
        if (!(std::abs(A[pivot][j]) > kSmallRank * sizes[j])) return false;
        if (pivot != j) {
            std::swap(A[pivot], A[j]);
            std::swap(b[pivot], b[j]);
        }
        reciprocals[j] = 1 / A[j][j];
        for (std::size_t i = j + 1; i < d; ++i) {
            const double factor = A[i][j] * reciprocals[j];
            for (std::size_t l = j + 1; l < d; ++l) A[i][l] -= factor * A[j][l];
            b[i] -= factor * b[j];
        }
    }
    for (std::size_t i = d; i-- > 0;) {
        for (std::size_t j = i + 1; j < d; ++j) b[i] -= A[i][j] * x[j];
        x[i] = b[i] * reciprocals[i];
    }
    return true;
}

/// Replaces the upper triangle of a symmetric positive definite matrix A by its upper triangular root, U U' = A.
template <std::size_t kMax>
void upper_root(SmallMatrix<kMax>& U, std::size_t d) {
    for (std::size_t j = d; j-- > 0;) {
        U[j][j] = std::sqrt(U[j][j]);
        for (std::size_t i = 0; i < j; ++i) U[i][j] /= U[j][j];
        for (std::size_t i = 0; i < j; ++i)
            for (std::size_t l = 0; l <= i; ++l) U[l][i] -= U[l][j] * U[i][j];
    }
}

/// The inverse of A by Gauss-Jordan elimination with row pivots; false, and no meaning, where A is singular.
template <std::size_t kMax>
bool invert_small(SmallMatrix<kMax> A, std::size_t d, SmallMatrix<kMax>& inverse) {
    SmallRow<kMax> sizes{};
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j) {
            sizes[j] += std::abs(A[i][j]);
            inverse[i][j] = i == j ? 1 : 0;
        }
    for (std::size_t j = 0; j < d; ++j) {
        std::size_t pivot = j;
        for (std::size_t i = j + 1; i < d; ++i)
            if (std::abs(A[i][j]) > std::abs(A[pivot][j])) pivot = i;
        if (!(std::abs(A[pivot][j]) > kSmallRank * sizes[j])) return false;
        std::swap(A[pivot], A[j]);
        std::swap(inverse[pivot], inverse[j]);
        const double reciprocal = 1 / A[j][j];
        for (std::size_t l = 0; l < d; ++l) {
            A[j][l] *= reciprocal;
            inverse[j][l] *= reciprocal;
        }
        for (std::size_t i = 0; i < d; ++i) {
            const double factor = A[i][j];
            if (i == j || factor == 0) continue;
            for (std::size_t l = 0; l < d; ++l) {
                A[i][l] -= factor * A[j][l];
                inverse[i][l] -= factor * inverse[j][l];
            }
        }
    }
    return true;
}

}  // namespace dynlab::inline numerics
