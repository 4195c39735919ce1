#pragma once
#include <optional>
#include <vector>

#include "numerics/filters/tapped_system.h"

namespace dynlab::inline numerics {

/// Another state for a TappedSystem of order n = 0, 1, 2 or 4, for which one step takes the fewest multiplications: the
/// Newton basis of its poles. In pairs, (z - centre)^2 - square being the characteristic polynomial of a pair,
///     p[k+1] = centre p[k] + square q[k] + v[k],   q[k+1] = centre q[k] + p[k],
/// and q drives the next pair; a single pole only has p, and square = 0. v[k] is the sample u[k-d], or the one before
/// where the system sees only that. Then
///     x[k] = to_state [p; q; p; q] + tap v[k],   y[k] = outputs [p; q; p; q; v].
/// With N(i) = (F - centre_i I)^2 - square_i I, the columns of to_state are g, (F - centre) g, and the same of N g; the
/// remainder, N N g, is zero by the Cayley-Hamilton theorem.
struct CascadeBasis {
    struct Pair {
        double centre = 0, square = 0;
    };

    Index order = 0;
    Index delay = 0;  ///< v[k] = u[k - delay]
    std::vector<Pair> pairs;
    Matrix to_state;  ///< n x n
    Vector tap;       ///< n
    Matrix outputs;   ///< p x (n+1)

    bool sees_tap() const { return !outputs.col(order).isZero(0); }
    /// The cascade's state where the system's state is x and the sample v.
    Vector from_state(const Vector& x, double v) const;
};

/// Nothing where there is no such basis: other orders, four poles that are not two pairs in series, and systems that
/// see both samples.
std::optional<CascadeBasis> cascade_basis(const TappedSystem& system);

/// One basis for two systems that the same samples drive, `longer` being another system in series with a filter that
/// has the poles of `shorter`: its first pair are these, the second the other system's. Outputs are those of `shorter`,
/// then those of `longer`; the state is that of `longer`. Nothing where it is not so, or orders are not two and four.
std::optional<CascadeBasis> joint_basis(const TappedSystem& shorter, const TappedSystem& longer);

}  // namespace dynlab::inline numerics
