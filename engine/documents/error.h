#pragma once
#include <stdexcept>

namespace dynlab::inline documents {

/// A script or document cannot be made. The message starts with "file:line: " where a line is known. Exit
/// code 1.
class DocumentError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace dynlab::inline documents
