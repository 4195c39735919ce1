#pragma once
#include <stdexcept>

namespace dynlab::inline numerics {

/// Misuse of a function: a size, order, option or value that cannot be worked with. The message names the
/// argument, what was wanted and what was given, in one sentence without a trailing newline; callers add file
/// and line.
class InvalidArgument : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

}  // namespace dynlab::inline numerics
