#pragma once

namespace dynlab::inline numerics {

/// What this code was compiled for, by the x86-64 psABI's levels: "x86-64-v4" (AVX-512), "x86-64-v3" (AVX2 and fused
/// multiplications), "x86-64-v2" or "x86-64"; of a portable build, the variant that the loader has taken.
const char* processor_level();

}  // namespace dynlab::inline numerics
