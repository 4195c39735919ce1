#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "platform/error.h"

namespace dynlab::inline data_io {

/// What reading a value may cost. Bytes count what they are stored in; memory what is made of them, which is checked
/// before it is taken.
struct ValueLimits {
    static constexpr std::size_t kMax = std::min<std::uint64_t>(std::uint64_t{4} << 30, SIZE_MAX);

    std::size_t bytes = kMax;               ///< of the text or the CBOR that is read
    std::size_t memory = kMax;              ///< of the value, and of intermediate data
    std::size_t depth = 200;                ///< of members in members
    std::ptrdiff_t coefficients = 1 << 20;  ///< of one polynomial of a model
    bool only_utf8 = false;                 ///< what is not UTF-8 in a text is replaced
    bool checked = true;  ///< what was read is held against what its type promises; not needed for our own caches

    /// Limits for data that this program itself wrote, at a place where no one else writes.
    static ValueLimits own() {
        ValueLimits limits;
        limits.checked = false;
        return limits;
    }
};

/// A value that is not what was wanted. The message begins with its location: "experiments[2].y: ...".
class ValueError : public EnvironmentError {
  public:
    using EnvironmentError::EnvironmentError;
};

}  // namespace dynlab::inline data_io
