#include "numerics/linalg/short_step.h"

#include <cmath>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

/// The 1-norm; infinity where an entry is not a number.
template <int capacity>
double norm_of(const StateMatrix<capacity>& Z, int n) {
    double largest = 0;
    for (int j = 0; j < n; ++j) {
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += std::abs(Z(i, j));
        if (!(sum < kInfinity)) return kInfinity;
        largest = std::max(largest, sum);
    }
    return largest;
}

template <int capacity>
void scale(StateMatrix<capacity>& Z, double factor, int n) {
    for (int j = 0; j < n; ++j)
        for (double& entry : Z.column[j].at) entry *= factor;
}

}  // namespace

template <int capacity>
std::optional<ShortStep<capacity>> short_step(const StateMatrix<capacity>& A, int states, double h) {
    constexpr double kMaxLength = 0.5, kNegligible = 1e-18;
    constexpr int kMaxDoublings = 3;
    using Square = StateMatrix<capacity>;
    // Loops of a known length are quicker than few steps.
    const int n = capacity <= 4 ? capacity : states;
    const Square identity = state_identity<capacity>(states);
    Square Z = A;
    scale(Z, h, n);
    using Columns = Eigen::Map<Matrix, 0, Eigen::OuterStride<capacity>>;
    const Vector balancing = balance(Columns(Z.column[0].at, n, n));
    double size = norm_of(Z, n);
    int doublings = 0;
    for (; size > kMaxLength && doublings < kMaxDoublings; ++doublings) size /= 2;
    if (!(size <= kMaxLength)) return {};
    if (doublings > 0) scale(Z, 1.0 / (1 << doublings), n);
    int terms = 1;
    for (double term = size / 3; term > kNegligible; term *= size / (terms + 2)) ++terms;
    Square phi2 = identity;
    for (int k = terms; k > 0; --k) {
        const double weight = 1.0 / (k + 2);
        for (int j = 0; j < n; ++j) {
            StateVector<capacity> column = identity.column[j];
            for (int i = 0; i < n; ++i) column.add(weight * phi2(i, j), Z.column[i]);
            phi2.column[j] = column;
        }
    }
    scale(phi2, 0.5, n);
    Square phi1 = product(Z, phi2, n);
    phi1.add(1, identity, n);
    Square E = product(Z, phi1, n);
    for (; doublings > 0; --doublings) {
        scale(phi2, 0.5, n);
        phi2.add(0.25, product(phi1, phi1, n), n);
        E.add(2, identity, n);
        phi1 = product(phi1, E, n);
        scale(phi1, 0.5, n);
        scale(Z, 2, n);
        E = product(Z, phi1, n);
    }
    ShortStep<capacity> step;
    StateVector<capacity> rows;
    for (int i = 0; i < n; ++i) rows[i] = balancing[i];
    for (int j = 0; j < n; ++j) {
        const double back = 1 / balancing[j];  // powers of two
        for (int i = 0; i < capacity; ++i) {
            const double factor = back * rows[i];
            step.E(i, j) = factor * E(i, j);
            step.W(i, j) = h * (factor * phi1(i, j));
            step.R(i, j) = h * (factor * phi2(i, j));
        }
    }
    return step;
}

template std::optional<ShortStep<2>> short_step(const StateMatrix<2>&, int, double);
template std::optional<ShortStep<4>> short_step(const StateMatrix<4>&, int, double);
template std::optional<ShortStep<8>> short_step(const StateMatrix<8>&, int, double);

}  // namespace dynlab::inline numerics
