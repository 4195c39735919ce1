#pragma once
#include <optional>

#include "numerics/simulation/companion_pair.h"

namespace dynlab::inline numerics {

/// A companion system or a pair of them (companion_pair.h), taken apart into its poles: dz_i/dt = poles[i] z_i + u, and
/// for the second system dw_i/dt = poles[i] w_i + z_i.
struct SeparateModes {
    Vector poles;   ///< n, 1/s
    Matrix states;  ///< of the system from z, and from z and w: n x n or 2n x 2n
};

/// Where all poles are real and so far apart that the sums over them keep their digits; nothing for other systems.
std::optional<SeparateModes> separate_modes(const CompanionPair& pair);

}  // namespace dynlab::inline numerics
