#pragma once
#include <algorithm>
#include <utility>

namespace dynlab::inline numerics {

// Vectors and square matrices of up to `capacity` states (2, 4 or 8), whose number n is known at run time only. What is
// beyond n is zero, so that loops over rows have a length that the compiler knows: machine vectors, without a template
// for every n.

template <int capacity>
struct StateVector {
    alignas(capacity * sizeof(double)) double at[capacity] = {};

    double operator[](int i) const { return at[i]; }
    double& operator[](int i) { return at[i]; }
    /// this += weight x
    void add(double weight, const StateVector& x) {
        for (int i = 0; i < capacity; ++i) at[i] += weight * x.at[i];
    }
    bool is_zero() const {
        return std::all_of(at, at + capacity, [](double x) { return x == 0; });
    }
};

template <int capacity>
struct StateMatrix {
    StateVector<capacity> column[capacity];

    double operator()(int i, int j) const { return column[j].at[i]; }
    double& operator()(int i, int j) { return column[j].at[i]; }
    /// this += weight X, whose columns n and beyond are zero
    void add(double weight, const StateMatrix& X, int n) {
        for (int j = 0; j < n; ++j) column[j].add(weight, X.column[j]);
    }
};

/// The identity of n states.
template <int capacity>
StateMatrix<capacity> state_identity(int n) {
    StateMatrix<capacity> I;
    for (int i = 0; i < n; ++i) I(i, i) = 1;
    return I;
}

/// A x of n states.
template <int capacity>
StateVector<capacity> product(const StateMatrix<capacity>& A, const StateVector<capacity>& x, int n) {
    StateVector<capacity> y;
    for (int j = 0; j < n; ++j) y.add(x[j], A.column[j]);
    return y;
}

/// A B of n states.
template <int capacity>
StateMatrix<capacity> product(const StateMatrix<capacity>& A, const StateMatrix<capacity>& B, int n) {
    StateMatrix<capacity> C;
    for (int j = 0; j < n; ++j) C.column[j] = product(A, B.column[j], n);
    return C;
}

}  // namespace dynlab::inline numerics
