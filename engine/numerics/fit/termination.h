#pragma once
#include <cstddef>
#include <string>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Why an iteration ended. None of these is an error: the best point found is always returned.
enum class Termination {
    kConverged,       ///< the parameters changed by less than the tolerance
    kIterationLimit,  ///< the allowed iterations were used up before that
    kNoProgress,      ///< no step, however short, lowered the loss any more
    kDiverged,        ///< the loss grew without bound (a step size that is too large)
    kCancelled,       ///< the cancel callback asked to stop
};

struct FitIteration {
    Vector theta;       ///< after the iteration; empty where only the loss is kept
    double loss = 0;    ///< mean square of the errors there
    double change = 0;  ///< largest relative parameter change
};

/// "1 iteration", "2 iterations".
inline std::string iterations_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " iteration" : " iterations");
}

}  // namespace dynlab::inline numerics
