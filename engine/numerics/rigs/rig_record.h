#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// What a rig's experiment leaves: instants (s), inputs and measured outputs, N values each.
struct RigRecord {
    Vector t, u, y;
};

/// Instants 0, Ts, ... that cover `duration` (s), both ends included when it is a multiple of Ts.
Vector sampling_instants(double duration, double Ts);

/// Throws InvalidArgument "RIG: NAME must be positive (not negative), and is VALUE".
void require_positive(const char* rig, const char* name, double value);
void require_not_negative(const char* rig, const char* name, double value);

}  // namespace dynlab::inline numerics
