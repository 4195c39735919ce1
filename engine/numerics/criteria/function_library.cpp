#include "numerics/criteria/function_library.h"

#include "base/number_text.h"
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
        throw InvalidArgument("sindy: the library must give " + counted(library.count(), "function") + " of " +
                              counted(X.rows(), "value") + " each, and gave " + std::to_string(values.cols()) + " of " +
                              std::to_string(values.rows()));
    if (values.allFinite()) return values;
    for (Index j = 0; j < values.cols(); ++j)
        for (Index k = 0; k < values.rows(); ++k) {
            if (std::isfinite(values(k, j))) continue;
            std::string at;
            for (Index i = 0; i < X.cols(); ++i) at += (i > 0 ? ", " : "") + number_text(X(k, i));
            throw InvalidArgument("sindy: the function " + library.names[static_cast<std::size_t>(j)] +
                                  " of the library is " + number_text(values(k, j)) + " at sample " +
                                  std::to_string(k + 1) + ", where the states are " + at);
        }
    return values;
}

}  // namespace dynlab::inline numerics
