#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What is known before a search.
struct SearchAids {
    /// theta where the search begins, with the delays where they are free; found unless given.
    Vector start = {};
    std::vector<double> delays = {};      ///< s, of each channel: where the search for free ones begins
    std::vector<const Fit*> poorer = {};  ///< of poorer structures under the same options; they are not fitted again
};

}  // namespace dynlab::inline numerics
