#include "numerics/simulation/separate_modes.h"

#include <algorithm>
#include <cmath>

#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kPolesApart = 0.5;  // of the larger of two poles, by which they differ
constexpr Index kMaxModes = 4;       // the more there are, the more digits their sums lose

bool are_apart(const Vector& poles) {
    for (Index i = 0; i < poles.size(); ++i)
        for (Index j = 0; j < i; ++j)
            if (!(std::abs(poles[i] - poles[j]) > kPolesApart * std::max(std::abs(poles[i]), std::abs(poles[j]))))
                return false;
    return true;
}

/// Eigenvalues are exact to rounding of the largest alone: by Newton's method.
void polish(Vector& roots, const Vector& p) {
    const Index n = roots.size();
    Vector slope(n);
    for (Index i = 0; i < n; ++i) slope[i] = static_cast<double>(n - i) * p[i];
    for (int step = 0; step < 2; ++step)
        for (double& root : roots) root -= evaluate(p, root) / evaluate(slope, root);
}

std::optional<Vector> separate_poles(const Matrix& companion_matrix) {
    if (companion_matrix.rows() > kMaxModes || !companion_matrix.row(0).allFinite()) return std::nullopt;
    const Vector p = monic(-companion_matrix.row(0).transpose());
    const ComplexVector found = roots(p);
    if ((found.imag().array() != 0).any()) return std::nullopt;
    Vector poles = found.real();
    if (!are_apart(poles)) return std::nullopt;
    if (poles.size() > 2) polish(poles, p);
    return poles;
}

}  // namespace

std::optional<SeparateModes> separate_modes(const CompanionPair& pair) {
    const std::optional<Vector> poles = separate_poles(pair.one);
    if (!poles) return std::nullopt;
    const Index n = poles->size(), states = (pair.twice ? 2 : 1) * n;
    SeparateModes modes{*poles, Matrix::Zero(states, states)};
    for (Index i = 0; i < n; ++i) {
        // Partial fractions: A(p) = (p - pole) Q(p), and the logarithmic slope of Q at the pole.
        const double pole = (*poles)[i];
        double Q = 1, slope = 0;
        for (Index j = 0; j < n; ++j) {
            if (j == i) continue;
            Q *= pole - (*poles)[j];
            slope += 1 / (pole - (*poles)[j]);
        }
        for (Index row = 0; row < n; ++row) modes.states(row, i) = std::pow(pole, n - 1 - row) / Q;
        if (!pair.twice) continue;
        // The second system's states are drive p^power/A^2 u.
        for (Index row = 0; row < n; ++row) {
            const Index power = 2 * (n - 1) - pair.driving - row;
            const double twofold = pair.drive / (Q * Q);
            modes.states(n + row, n + i) = twofold * std::pow(pole, power);
            const double rise = power > 0 ? static_cast<double>(power) * std::pow(pole, power - 1) : 0;
            modes.states(n + row, i) = twofold * (rise - 2 * slope * std::pow(pole, power));
        }
    }
    return modes;
}

}  // namespace dynlab::inline numerics
