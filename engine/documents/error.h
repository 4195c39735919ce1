#pragma once
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "base/error.h"

namespace dynlab::inline documents {

/// A line of a file that a message is about; line 0 where the message is about the whole file.
struct Place {
    std::filesystem::path file;
    int line = 0;
};

/// "file:line: sentence", or "file: sentence".
Message placed(const Place& place, const Message& sentence);

/// A script or document cannot be made. The message of an error with a place begins with it, "file:line: ". Exit
/// code 1.
class DocumentError : public ErrorOf<std::runtime_error> {
  public:
    explicit DocumentError(const Message& message);
    DocumentError(Place place, const Message& sentence);

    const Place& place() const { return place_; }          ///< without file where no place is known
    const Message& sentence() const { return sentence_; }  ///< the message without its place

  private:
    Place place_;
    Message sentence_;
};

}  // namespace dynlab::inline documents
