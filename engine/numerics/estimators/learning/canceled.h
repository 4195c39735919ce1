#pragma once
#include <functional>
#include <string>

#include "numerics/error.h"

namespace dynlab::inline numerics {

/// Throws InvalidArgument when `cancel`, which may be empty, says so: for methods that have nothing to give before
/// their end.
inline void check_canceled(const std::string& method, const std::function<bool()>& cancel) {
    if (cancel && cancel()) throw InvalidArgument("{}: interrupted", method);
}

}  // namespace dynlab::inline numerics
