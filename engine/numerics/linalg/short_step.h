#pragma once
#include <optional>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

/// StepMatrices (matrix_exponential.h) of n states and m inputs, sizes that the compiler knows.
template <int n, int m>
struct SizedStep {
    Eigen::Matrix<double, n, n> F;
    Eigen::Matrix<double, n, m> G, H0, H1;
    Eigen::Matrix<double, n, n> E;  ///< F - I, with all digits however short the step
};

/// A short step of n states by Taylor's series of phi_2(Z) = sum_k Z^k/(k+2)!, Z = hA (Higham 2008, section 10.7.4):
///     phi_1 = I + Z phi_2,   F = I + Z phi_1,   G = h phi_1 B,   H1 = h phi_2 B,
/// up to eight times as long by doubling (Skaflestad and Wright 2009, eq. 11):
///     phi_2(2Z) = (phi_1^2 + 2 phi_2)/4,   phi_1(2Z) = phi_1 (2I + Z phi_1)/2.
/// Nothing when the step is too long for that.
template <int n, int m>
std::optional<SizedStep<n, m>> short_step(const Eigen::Matrix<double, n, n>& A, const Eigen::Matrix<double, n, m>& B,
                                          double h) {
    constexpr double kLongest = 0.5, kNegligible = 1e-18;
    constexpr int kMostDoublings = 3;
    using Square = Eigen::Matrix<double, n, n>;
    Square Z = h * A;
    const Eigen::Matrix<double, n, 1> scale = balance(Z);
    double size = Z.cwiseAbs().colwise().sum().maxCoeff();
    int doublings = 0;
    for (; size > kLongest && doublings < kMostDoublings; ++doublings) size /= 2;
    if (!(size <= kLongest)) return {};
    if (doublings > 0) Z /= 1 << doublings;
    int terms = 1;
    for (double term = size / 3; term > kNegligible; term *= size / (terms + 2)) ++terms;
    const Square identity = Square::Identity();
    Square phi2 = identity;
    for (int k = terms; k > 0; --k) phi2 = (identity + (1.0 / (k + 2) * Z).lazyProduct(phi2)).eval();
    phi2 /= 2;
    Square phi1 = identity + Z.lazyProduct(phi2), E = Z.lazyProduct(phi1);
    for (; doublings > 0; --doublings) {
        phi2 = ((phi1.lazyProduct(phi1) + 2 * phi2) / 4).eval();
        phi1 = (phi1.lazyProduct(2 * identity + E) / 2).eval();
        Z *= 2;
        E = Z.lazyProduct(phi1);
    }
    const Eigen::Matrix<double, n, m> input = scale.cwiseInverse().asDiagonal() * (h * B);
    SizedStep<n, m> step;
    step.E = scale.asDiagonal() * E * scale.cwiseInverse().asDiagonal();
    step.F = step.E + identity;
    step.G = scale.asDiagonal() * phi1.lazyProduct(input);
    step.H1 = scale.asDiagonal() * phi2.lazyProduct(input);
    step.H0 = step.G - step.H1;
    return step;
}

}  // namespace dynlab::inline numerics
