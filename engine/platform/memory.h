#pragma once

namespace dynlab::inline platform {

/// Keeps freed memory for the next use and does not return it to the system at once: the system clears every page that
/// it provides, which takes longer than most operations on long data. Call it once, at the start.
void keep_freed_memory();
/// Gives it back where it is much: after something large that does not come again.
void return_freed_memory();

}  // namespace dynlab::inline platform
