#pragma once
#include <cstdint>

namespace dynlab::inline documents {

/// A script or template has at most so many bytes: what is larger is something else.
inline constexpr std::uintmax_t kMostSourceBytes = std::uintmax_t{4} << 20;

}  // namespace dynlab::inline documents
