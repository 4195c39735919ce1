#include "platform/memory.h"

namespace dynlab::inline platform {

void keep_freed_memory() {}
void return_freed_memory() {}

}  // namespace dynlab::inline platform
