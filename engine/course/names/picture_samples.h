#pragma once
#include <cstdint>

class QPDFObjectHandle;

namespace dynlab::inline course {

/// Bytes of a picture's samples, as its dictionary tells them (ISO 32000-1, 8.9.5): what stands behind them no viewer
/// shows. 0 where that cannot be told, or where a filter of pictures (CCITT, JBIG2, JPEG, JPX) stands between.
std::uint64_t bytes_of_samples(QPDFObjectHandle picture);

}  // namespace dynlab::inline course
