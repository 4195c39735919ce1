#pragma once
#include "platform/content_memory.h"

namespace dynlab::inline workflow {

/// What runs leave for later ones, besides whole runs: results of long calls and drawn figures.
struct Memories {
    ContentMemory long_calls{"calls"};
    ContentMemory figures{"figures", 64u << 20};
};

}  // namespace dynlab::inline workflow
