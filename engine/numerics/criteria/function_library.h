#pragma once
#include <functional>
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Functions of states and inputs of which a rate of change is combined.
struct FunctionLibrary {
    std::vector<std::string> names;  ///< of the functions, as equations write them
    /// Their values (N x count) at the rows of X (N x states) and U (N x inputs).
    std::function<Matrix(const Matrix& X, const Matrix& U)> values;

    Index count() const { return static_cast<Index>(names.size()); }
};

/// All monomials of states and inputs up to a degree. Throws InvalidArgument as Monomials does.
FunctionLibrary polynomial_library(const std::vector<std::string>& states, const std::vector<std::string>& inputs,
                                   int degree);

/// The values of the library, N x count. Throws InvalidArgument that names the function and the row (1-based, with the
/// states there) for values of another size, or that are NaN or infinite.
Matrix library_values(const FunctionLibrary& library, const Matrix& X, const Matrix& U);

}  // namespace dynlab::inline numerics
