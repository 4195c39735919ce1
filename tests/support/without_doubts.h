#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::test {

/// Options of a fit that is one of many: the estimate alone, as studies ask for it.
template <class Options = FitOptions>
Options without_doubts(Options options = {}) {
    options.doubts = false;
    return options;
}

}  // namespace dynlab::test
