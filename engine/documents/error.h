#pragma once
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace dynlab::inline documents {

/// A script or document cannot be made. The message starts with "file:line: " where a line is known. Exit
/// code 1.
class DocumentError : public std::runtime_error {
  public:
    explicit DocumentError(std::string sentence) : std::runtime_error(without_zero_bytes(std::move(sentence))) {}

  private:
    /// A sentence may quote a line with a zero byte, at which what() would end.
    static std::string without_zero_bytes(std::string sentence) {
        std::replace(sentence.begin(), sentence.end(), '\0', '?');
        return sentence;
    }
};

}  // namespace dynlab::inline documents
