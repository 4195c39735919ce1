#include "numerics/criteria/function_library.h"

#include "numerics/criteria/monomials.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

FunctionLibrary polynomial_library(const std::vector<std::string>& states, const std::vector<std::string>& inputs,
                                   int degree) {
    std::vector<std::string> variables = states;
    variables.insert(variables.end(), inputs.begin(), inputs.end());
    const Monomials monomials("sindy", static_cast<Index>(variables.size()), degree);
    FunctionLibrary library;
    for (Index i = 0; i < monomials.count(); ++i) library.names.push_back(monomials.text(i, variables));
    library.values = [monomials](const Matrix& X, const Matrix& U) {
        Matrix Z(X.rows(), X.cols() + U.cols());
        Z << X, U;
        return monomials.values(Z);
    };
    return library;
}

Matrix library_values(const FunctionLibrary& library, const Matrix& X, const Matrix& U) {
    Matrix values = library.values(X, U);
    if (values.rows() != X.rows() || values.cols() != library.count())
        throw InvalidArgument("sindy: the library must return {} of {} each, but returned {} of {}",
                              plural(library.count(), "{} function", "{} functions"),
                              plural(X.rows(), "{} value", "{} values"), values.cols(), values.rows());
    if (values.allFinite()) return values;
    for (Index j = 0; j < values.cols(); ++j)
        for (Index k = 0; k < values.rows(); ++k) {
            if (std::isfinite(values(k, j))) continue;
            MessageList at;
            for (Index i = 0; i < X.cols(); ++i) at.items.push_back(Message("{}", X(k, i)));
            throw InvalidArgument(
                "sindy: the library function {} returned {} at sample {} (state values: {}). Use functions that are "
                "finite at all samples",
                library.names[static_cast<std::size_t>(j)], values(k, j), k + 1, at);
        }
    return values;
}

}  // namespace dynlab::inline numerics
