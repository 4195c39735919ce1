#pragma once
#include <type_traits>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// run(std::integral_constant<int, k>()) for that of kOrders which `order` is, or else with kOtherwise: loops whose
/// length the compiler knows.
template <int kOtherwise, int... kOrders, class Run>
void with_known_order(Index order, const Run& run) {
    const bool known = ((order == kOrders && (run(std::integral_constant<int, kOrders>()), true)) || ...);
    if (!known) run(std::integral_constant<int, kOtherwise>());
}

}  // namespace dynlab::inline numerics
