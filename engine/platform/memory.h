#pragma once

namespace dynlab::inline platform {

/// Keeps freed memory for the next use instead of giving it back to the system at once: the system clears every page
/// that it hands out, which takes longer than most that is done with long records. Call it once, first.
void keep_freed_memory();
/// Gives it back where it is much: after something large that does not come again.
void return_freed_memory();

}  // namespace dynlab::inline platform
