#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "numerics/models/called_equations.h"
#include "numerics/models/traced_equations.h"
#include "scripting/arguments/script_function.h"

namespace dynlab::inline scripting {

/// Where the initial value of a state comes from.
struct InitialEntry {
    double value = 0;
    Index parameter = -1;  ///< its place, or -1 for the value
};

/// What idgrey was given: f(t, x, u, p), or A, B, C, D of a function of p, and h(t, x, u, p).
struct ScriptEquations {
    std::vector<std::string> parameters, states;
    std::shared_ptr<ScriptFunction> rates, outputs, initial;
    bool of_matrices = false;
    std::vector<InitialEntry> initial_entries;  ///< unless `initial` is given
    Index inputs = -1;                          ///< -1 if not given
    bool inputs_indexed = false;                ///< u is given as a table though there is one
    Index output_count = 0;                     ///< of h, once it was called
};

/// The functions as expressions; nothing, and the reason, where they cannot be followed.
std::optional<TracedFunctions> trace_functions(ScriptEquations& equations, Message& reason);
/// As functions that are called, and throw the script's own errors as InvalidArgument: here where they do not work with
/// the numbers `p`.
CalledFunctions call_functions(ScriptEquations& equations, const Vector& p);
/// Whether the expressions have the values that the functions have at some places about the start.
bool agree(const TracedFunctions& traced, const CalledFunctions& called, const Vector& p);

}  // namespace dynlab::inline scripting
