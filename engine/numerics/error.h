#pragma once
#include <stdexcept>

#include "base/error.h"

namespace dynlab::inline numerics {

/// Misuse of a function: a size, order, option or value that cannot be worked with. The message names the
/// argument, what was expected and what was given, in one sentence without a trailing newline; callers add file
/// and line.
class InvalidArgument : public ErrorOf<std::invalid_argument> {
  public:
    using ErrorOf::ErrorOf;
};

}  // namespace dynlab::inline numerics
