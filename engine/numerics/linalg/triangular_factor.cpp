#include "numerics/linalg/triangular_factor.h"

#include <algorithm>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kRowsAtOnce = 1024;  // rows worked on together

}  // namespace

TriangularFactor::TriangularFactor(Index columns)
    : R_(Matrix::Zero(columns, columns)), stack_(columns + kRowsAtOnce, columns) {}

void TriangularFactor::add(const MatrixView& rows) {
    const Index d = R_.cols();
    for (Index first = 0; first < rows.rows(); first += kRowsAtOnce) {
        const Index count = std::min(kRowsAtOnce, rows.rows() - first);
        stack_.topRows(d) = R_;
        stack_.middleRows(d, count) = rows.middleRows(first, count);
        R_ = triangular_part(stack_.topRows(d + count));
    }
}

}  // namespace dynlab::inline numerics
