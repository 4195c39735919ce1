#include "numerics/linalg/balance.h"

#include <cmath>

namespace dynlab::inline numerics {

namespace {

/// The power of two that brings a column norm nearest to its row norm.
double balancing_factor(double column_norm, double row_norm) {
    const double exponent = std::round(0.5 * std::log2(row_norm / column_norm));
    return std::exp2(exponent);
}

}  // namespace

Vector balance(Eigen::Ref<Matrix> A) {
    constexpr double kWorthwhile = 0.95;  // a smaller reduction of the norms is not worth another sweep
    const Index n = A.rows();
    Vector scale = Vector::Ones(n);
    for (bool changed = true; changed;) {
        changed = false;
        for (Index i = 0; i < n; ++i) {
            const double diagonal = std::abs(A(i, i));
            const double column_norm = A.col(i).lpNorm<1>() - diagonal;
            const double row_norm = A.row(i).lpNorm<1>() - diagonal;
            if (!(column_norm > 0) || !(row_norm > 0)) continue;
            if (row_norm < 2 * column_norm && column_norm < 2 * row_norm) continue;  // the factor would be one
            const double factor = balancing_factor(column_norm, row_norm);
            if (column_norm * factor + row_norm / factor >= kWorthwhile * (column_norm + row_norm)) continue;
            A.col(i) *= factor;
            A.row(i) /= factor;
            scale(i) *= factor;
            changed = true;
        }
    }
    return scale;
}

}  // namespace dynlab::inline numerics
