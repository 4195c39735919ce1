#pragma once
#include <memory>
#include <vector>

#include "numerics/models/expression.h"
#include "numerics/models/grey_model.h"

namespace dynlab::inline numerics {

/// The functions of a model as expressions of one tape.
struct TracedFunctions {
    ExpressionTape tape;
    std::vector<ExpressionTape::Node> rates;    ///< n
    std::vector<ExpressionTape::Node> outputs;  ///< ny
    std::vector<ExpressionTape::Node> initial;  ///< n, of parameters alone
    Index inputs = 0;
};

/// Their equations with exact derivatives: written into the tape by forward differentiation, so that what functions and
/// derivatives have in common is computed once.
std::shared_ptr<const GreyEquations> traced_equations(TracedFunctions functions);

}  // namespace dynlab::inline numerics
