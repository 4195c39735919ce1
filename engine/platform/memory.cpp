#include "platform/memory.h"

#include <malloc.h>

namespace dynlab::inline platform {

void keep_freed_memory() {
    constexpr int kMaxValue = 1 << 30;  // of a piece, and of what is kept
    mallopt(M_MMAP_THRESHOLD, kMaxValue);
    mallopt(M_TRIM_THRESHOLD, kMaxValue);
}

void return_freed_memory() {
    constexpr std::size_t kWorthIt = 8 << 20;
    if (mallinfo2().fordblks > kWorthIt) malloc_trim(0);
}

}  // namespace dynlab::inline platform
