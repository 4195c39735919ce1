#include "numerics/filters/delta_expansion.h"

#include <cmath>

namespace dynlab::inline numerics {

namespace {

/// (delta I - E)^-1 = sum_j M_j delta^j/A (Faddeev).
struct Resolvent {
    StateMatrix<4> M[4];

    Resolvent(const StateMatrix<4>& E, const StateVector<4>& alpha, int n) {
        M[n - 1] = state_identity<4>(n);
        for (int j = n - 1; j > 0; --j) {
            M[j - 1] = product(E, M[j], n);
            for (int i = 0; i < n; ++i) M[j - 1](i, i) += alpha[j];
        }
    }
};

/// The factor that brings a norm to one.
double unit_factor(double square) {
    return square > 0 ? 1 / std::sqrt(square) : 1;
}

}  // namespace

StateVector<4> delta_polynomial(const StateMatrix<4>& E, int n) {
    const auto two = [&](int i, int j, int k, int l) { return E(i, k) * E(j, l) - E(i, l) * E(j, k); };
    const auto three = [&](int i, int j, int k) {
        return E(i, i) * two(j, k, j, k) - E(i, j) * two(j, k, i, k) + E(i, k) * two(j, k, i, j);
    };
    StateVector<4> alpha;
    for (int i = 0; i < n; ++i) {
        alpha[n - 1] -= E(i, i);
        for (int j = i + 1; j < n; ++j) {
            alpha[n - 2] += two(i, j, i, j);
            for (int k = j + 1; k < n; ++k) alpha[n - 3] -= three(i, j, k);
        }
    }
    if (n < 4) return alpha;
    alpha[0] = two(0, 1, 0, 1) * two(2, 3, 2, 3) - two(0, 1, 0, 2) * two(2, 3, 1, 3) +
               two(0, 1, 0, 3) * two(2, 3, 1, 2) + two(0, 1, 1, 2) * two(2, 3, 0, 3) -
               two(0, 1, 1, 3) * two(2, 3, 0, 2) + two(0, 1, 2, 3) * two(2, 3, 0, 1);
    return alpha;
}

StateVector<8> delta_product(const StateVector<4>& a, const StateVector<4>& b, int n) {
    StateVector<8> product;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) product[i + j] += a[i] * b[j];
        product[n + i] += a[i] + b[i];
    }
    return product;
}

StateExpansion<4> expansion(const StateMatrix<4>& E, const StateVector<4>& input, int n) {
    StateExpansion<4> x{delta_polynomial(E, n), {}};
    const Resolvent resolvent(E, x.alpha, n);
    for (int j = 0; j < n; ++j) {
        const StateVector<4> weights = product(resolvent.M[j], input, n);
        for (int k = 0; k < n; ++k) x.states(j, k) = weights[k];
    }
    return x;
}

template <int capacity>
StateExpansion<capacity> cascade_expansion(const StateMatrix<capacity>& E, const StateVector<capacity>& input, int n) {
    StateMatrix<4> own, between;
    StateVector<4> to_first, to_second;
    for (int j = 0; j < n; ++j) {
        to_first[j] = input[j];
        to_second[j] = input[n + j];
        for (int i = 0; i < n; ++i) {
            own(i, j) = E(i, j);
            between(i, j) = E(n + i, j);
        }
    }
    const StateVector<4> alpha = delta_polynomial(own, n);
    const Resolvent resolvent(own, alpha, n);
    StateExpansion<capacity> x;
    std::copy_n(delta_product(alpha, alpha, n).at, 2 * n, x.alpha.at);
    for (int j = 0; j < n; ++j) {
        const StateVector<4> first = product(resolvent.M[j], to_first, n),
                             second = product(resolvent.M[j], to_second, n), drive = product(between, first, n);
        for (int i = 0; i <= n; ++i) {
            if (i + j == 2 * n) continue;
            const double weight = i < n ? alpha[i] : 1;
            StateVector<4> through;
            if (i < n) through = product(resolvent.M[i], drive, n);
            for (int k = 0; k < n; ++k) {
                x.states(i + j, k) += weight * first[k];
                x.states(i + j, n + k) += weight * second[k] + through[k];
            }
        }
    }
    return x;
}

/// Gauss's elimination with row pivots, rows and columns first scaled to the norm one.
template <int capacity>
StateVector<capacity> scaled_solution(StateMatrix<capacity> T, StateVector<capacity> b, int n) {
    StateVector<capacity> rows;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) rows[i] += T(i, j) * T(i, j);
    for (int i = 0; i < n; ++i) {
        const double factor = unit_factor(rows[i]);
        b[i] *= factor;
        for (int j = 0; j < n; ++j) T(i, j) *= factor;
    }
    StateVector<capacity> columns;
    for (int j = 0; j < n; ++j) {
        double square = 0;
        for (int i = 0; i < n; ++i) square += T(i, j) * T(i, j);
        columns[j] = unit_factor(square);
        for (int i = 0; i < n; ++i) T(i, j) *= columns[j];
    }
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (std::abs(T(i, k)) > std::abs(T(pivot, k))) pivot = i;
        std::swap(b[k], b[pivot]);
        for (int j = k; j < n; ++j) std::swap(T(k, j), T(pivot, j));
        for (int i = k + 1; i < n; ++i) {
            const double factor = T(i, k) / T(k, k);
            b[i] -= factor * b[k];
            for (int j = k + 1; j < n; ++j) T(i, j) -= factor * T(k, j);
        }
    }
    for (int k = n - 1; k >= 0; --k) {
        for (int j = k + 1; j < n; ++j) b[k] -= T(k, j) * b[j];
        b[k] /= T(k, k);
    }
    for (int k = 0; k < n; ++k) b[k] *= columns[k];
    return b;
}

template StateExpansion<4> cascade_expansion(const StateMatrix<4>&, const StateVector<4>&, int);
template StateExpansion<8> cascade_expansion(const StateMatrix<8>&, const StateVector<8>&, int);
template StateVector<4> scaled_solution(StateMatrix<4>, StateVector<4>, int);
template StateVector<8> scaled_solution(StateMatrix<8>, StateVector<8>, int);

}  // namespace dynlab::inline numerics
