#pragma once
#include <Eigen/Core>
#include <complex>
#include <limits>

#include "numerics/linalg/products.h"

namespace dynlab::inline numerics {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;
using Index = Eigen::Index;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Read-only arguments: bind to vectors and to memory owned by others (a Lua userdata) without a copy.
using VectorView = Eigen::Ref<const Vector>;
using MatrixView = Eigen::Ref<const Matrix>;

}  // namespace dynlab::inline numerics
