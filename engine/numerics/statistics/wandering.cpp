#include "numerics/statistics/wandering.h"

namespace dynlab::inline numerics {

bool wanders(const VectorView& x) {
    constexpr Index kParts = 60;
    constexpr double kPersistence = 14;
    const Index length = x.size() / kParts;
    if (length < 4 || !x.allFinite()) return false;
    Vector means = x.head(kParts * length).reshaped(length, kParts).colwise().mean().transpose();
    means.array() -= means.mean();
    const double squares = means.squaredNorm(), neighbors = means.head(kParts - 1).dot(means.tail(kParts - 1));
    return kParts * (squares - neighbors) < kPersistence * squares;
}

}  // namespace dynlab::inline numerics
