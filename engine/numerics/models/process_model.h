#pragma once
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// Structure of a process model, written as in the course: P, number of poles, then D (delay), I
/// (integrator), Z (zero), U (under-damped pair): "P1", "P2U", "P1D", "P2DU", ... Letters after the digit in
/// any order.
struct ProcessStructure {
    int poles = 1;
    bool underdamped = false, delay = false, integrator = false, zero = false;

    /// Throws InvalidArgument that says which letters exist.
    static ProcessStructure parse(const std::string& text);
    std::string text() const;  ///< canonical spelling, e.g. "P2DU"
    std::vector<std::string> parameter_names()
        const;  ///< of {Kp, Tp1, Tp2, Tp3, Tw, Zeta, Tz, Td} those present, in this order
};

/// K exp(-Td s) (1 + Tz s) / ((1 + Tp1 s)(1 + Tp2 s)(1 + Tp3 s) s) or with U
/// K exp(-Td s) (1 + Tz s) / ((1 + 2 Zeta Tw s + Tw^2 s^2) ...). Times in seconds.
struct ProcessModel {
    ProcessStructure structure;
    Vector parameters;  ///< one for each of structure.parameter_names()

    ProcessModel(ProcessStructure structure, Vector parameters);
    double parameter(const std::string& name) const;  ///< throws when the structure has no such parameter
    TransferFunction transfer_function() const;
};

}  // namespace dynlab::inline numerics
