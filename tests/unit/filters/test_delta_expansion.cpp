// Oracles: determinants and resolvents evaluated at single values of delta, and solutions, in 80 bits.
#include "numerics/filters/delta_expansion.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "numerics/linalg/types.h"

namespace test_delta_expansion {

using namespace dynlab;

using Long = long double;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

constexpr Long kPlaces[] = {0.3L, -0.7L, 1.1L, 2.5L};

/// A full matrix whose eigenvalues lie near -0.1, -0.2, ...
template <int capacity>
StateMatrix<capacity> sample_matrix(int n) {
    StateMatrix<capacity> E;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) E(i, j) = i == j ? -0.1 * (i + 1) : 0.01 * (1 + ((3 * i + 5 * j) % 7));
    return E;
}

template <int capacity>
LongMatrix long_matrix(const StateMatrix<capacity>& E, int n) {
    LongMatrix L(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) L(i, j) = E(i, j);
    return L;
}

template <int capacity>
StateVector<capacity> sample_vector(int n) {
    StateVector<capacity> b;
    for (int i = 0; i < n; ++i) b[i] = 1 - 0.3 * i;
    return b;
}

/// delta^n + alpha_(n-1) delta^(n-1) + ... + alpha_0
template <int capacity>
Long value_at(const StateVector<capacity>& alpha, int n, Long delta) {
    Long value = 1;
    for (int i = n - 1; i >= 0; --i) value = value * delta + alpha[i];
    return value;
}

template <int capacity>
void expect_resolvent(const StateExpansion<capacity>& found, const LongMatrix& E, const StateVector<capacity>& input,
                      int n) {
    LongVector b(n);
    for (int i = 0; i < n; ++i) b[i] = input[i];
    for (const Long delta : kPlaces) {
        const LongVector expected = (delta * LongMatrix::Identity(n, n) - E).fullPivLu().solve(b);
        for (int i = 0; i < n; ++i) {
            Long sum = 0;
            for (int j = n - 1; j >= 0; --j) sum = sum * delta + found.states(j, i);
            EXPECT_NEAR(static_cast<double>(sum / value_at(found.alpha, n, delta)), static_cast<double>(expected[i]),
                        1e-13 * static_cast<double>(expected.cwiseAbs().maxCoeff()))
                << n << " states";
        }
    }
}

TEST(delta_expansion, polynomial_is_the_determinant) {
    for (int n = 1; n <= 4; ++n) {
        const StateMatrix<4> E = sample_matrix<4>(n);
        for (const Long delta : kPlaces) {
            const Long expected = (delta * LongMatrix::Identity(n, n) - long_matrix(E, n)).determinant();
            EXPECT_NEAR(static_cast<double>(value_at(delta_polynomial(E, n), n, delta) / expected), 1, 1e-14) << n;
        }
    }
}

TEST(delta_expansion, product_is_the_product_of_the_values) {
    for (int n = 1; n <= 4; ++n) {
        const StateVector<4> a = delta_polynomial(sample_matrix<4>(n), n), b = sample_vector<4>(n);
        for (const Long delta : kPlaces) {
            const Long expected = value_at(a, n, delta) * value_at(b, n, delta);
            EXPECT_NEAR(static_cast<double>(value_at(delta_product(a, b, n), 2 * n, delta) / expected), 1, 1e-13) << n;
        }
    }
}

TEST(delta_expansion, states_are_the_resolvent_times_the_input) {
    for (int n = 1; n <= 4; ++n) {
        const StateMatrix<4> E = sample_matrix<4>(n);
        expect_resolvent(expansion(E, sample_vector<4>(n), n), long_matrix(E, n), sample_vector<4>(n), n);
    }
}

TEST(delta_expansion, states_of_a_cascade_are_the_resolvent_times_the_input) {
    for (int n = 1; n <= 4; ++n) {
        StateMatrix<8> E;
        const StateMatrix<4> own = sample_matrix<4>(n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                E(i, j) = E(n + i, n + j) = own(i, j);
                E(n + i, j) = 0.02 * (i + 2 * j + 1);
            }
        expect_resolvent(cascade_expansion(E, sample_vector<8>(2 * n), n), long_matrix(E, 2 * n),
                         sample_vector<8>(2 * n), 2 * n);
    }
}

TEST(delta_expansion, solution_of_badly_scaled_equations_keeps_its_digits) {
    for (int n = 1; n <= 4; ++n) {
        StateMatrix<4> T = sample_matrix<4>(n);
        LongVector expected(n);
        for (int j = 0; j < n; ++j) expected[j] = std::pow(10.0L, 3 * j) * (1 + j);
        StateVector<4> b;
        for (int i = 0; i < n; ++i) {
            Long sum = 0;
            for (int j = 0; j < n; ++j) {
                T(i, j) = std::ldexp(T(i, j), 20 * i - 10 * j);  // exact
                sum += static_cast<Long>(T(i, j)) * expected[j];
            }
            b[i] = static_cast<double>(sum);
        }
        const StateVector<4> found = scaled_solution(T, b, n);
        for (int j = 0; j < n; ++j) EXPECT_NEAR(found[j] / static_cast<double>(expected[j]), 1, 1e-12) << n;
    }
}

}  // namespace test_delta_expansion
