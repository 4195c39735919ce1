#pragma once
#include "platform/content_cache.h"

namespace dynlab::inline workflow {

/// What runs leave for later ones, besides whole runs: results of long calls and drawn figures.
struct Caches {
    ContentCache memoized_calls{"calls"};
    ContentCache figures{"figures", 64u << 20};
};

}  // namespace dynlab::inline workflow
