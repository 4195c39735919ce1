#include "numerics/criteria/output_error_model.h"

#include <algorithm>

namespace dynlab::inline numerics {

Vector OutputErrorModel::output_at(const Vector& theta) const {
    Vector output;
    simulate(theta, output, nullptr);
    return output;
}

OutputErrorProducts OutputErrorModel::products(const Vector& theta, const VectorView& y) const {
    constexpr Index kRowsTogether = 512;  // they stay in the processor's cache
    Vector errors;
    Matrix J;
    simulate(theta, errors, &J);
    errors = y - errors;
    OutputErrorProducts sums{errors.squaredNorm(), Matrix::Zero(J.cols(), J.cols()), Vector::Zero(J.cols())};
    for (Index row = 0; row < J.rows(); row += kRowsTogether) {
        const Index rows = std::min(kRowsTogether, J.rows() - row);
        const auto block = J.middleRows(row, rows);
        sums.gram.noalias() += block.transpose() * block;
        sums.descent.noalias() += block.transpose() * errors.segment(row, rows);
    }
    return sums;
}

}  // namespace dynlab::inline numerics
