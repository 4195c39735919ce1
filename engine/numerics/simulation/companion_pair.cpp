#include "numerics/simulation/companion_pair.h"

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

bool is_companion(const MatrixView& A) {
    Matrix below = A.bottomRows(A.rows() - 1);
    below.diagonal().array() -= 1;
    return below.isZero(0);
}

/// Whether the second half of the states is the same system, driven by one state of the first.
bool are_two(const Matrix& A) {
    const Index n = A.rows() / 2;
    return A.rows() % 2 == 0 && A.topRightCorner(n, n).isZero(0) &&
           A.topLeftCorner(n, n) == A.bottomRightCorner(n, n) && A.bottomLeftCorner(n - 1, n).isZero(0) &&
           (A.block(n, 0, 1, n).array() != 0).count() <= 1;
}

}  // namespace

CompanionPair companion_pair(const Matrix& A) {
    CompanionPair pair;
    if (A.rows() == 0) return pair;
    pair.twice = are_two(A);
    const Index n = pair.twice ? A.rows() / 2 : A.rows();
    pair.one = A.topLeftCorner(n, n);
    if (!is_companion(pair.one)) throw InvalidArgument("Irregular sampling needs companion matrices");
    if (!pair.twice) return pair;
    while (pair.driving + 1 < n && A(n, pair.driving) == 0) ++pair.driving;
    pair.drive = A(n, pair.driving);
    return pair;
}

}  // namespace dynlab::inline numerics
