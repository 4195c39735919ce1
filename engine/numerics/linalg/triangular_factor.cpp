#include "numerics/linalg/triangular_factor.h"

#include <Eigen/Dense>
#include <algorithm>

namespace dynlab {

namespace {

constexpr Index kBlock = 1024;  // rows worked on together

}  // namespace

TriangularFactor::TriangularFactor(Index columns)
    : R_(Matrix::Zero(columns, columns)), stack_(columns + kBlock, columns) {}

void TriangularFactor::add(const MatrixView& rows) {
    const Index d = R_.cols();
    for (Index first = 0; first < rows.rows(); first += kBlock) {
        const Index count = std::min(kBlock, rows.rows() - first);
        stack_.topRows(d) = R_;
        stack_.middleRows(d, count) = rows.middleRows(first, count);
        const Eigen::HouseholderQR<Matrix> qr(stack_.topRows(d + count));
        R_ = qr.matrixQR().topRows(d).triangularView<Eigen::Upper>();
    }
}

}  // namespace dynlab
