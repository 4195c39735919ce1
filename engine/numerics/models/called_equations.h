#pragma once
#include <functional>
#include <memory>

#include "numerics/models/grey_model.h"

namespace dynlab::inline numerics {

/// Functions that are called for each evaluation, for equations without known expressions. t is in the time unit of the
/// data, usually s.
struct CalledFunctions {
    using Function = std::function<Vector(double t, const Vector& x, const Vector& u, const Vector& p)>;
    Function rates, outputs;                               ///< n and ny values
    std::function<Vector(const Vector& p)> initial_state;  ///< n values
    Index states = 0, inputs = 0, outputs_count = 0;
};

/// Their equations. Derivatives are central differences, with steps of 6e-6 (the cube root of the rounding) times the
/// largest value that the variable has had. For one thread only.
std::shared_ptr<const GreyEquations> called_equations(CalledFunctions functions);

}  // namespace dynlab::inline numerics
