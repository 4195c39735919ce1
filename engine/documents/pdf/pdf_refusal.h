#pragma once
#include "platform/error.h"

namespace dynlab::inline documents {

/// Why a file cannot be looked at.
enum class PdfFault { kNotThere, kNotPdf, kEncrypted, kDamaged, kTooLarge };

/// Its sentence does not name the file.
class PdfRefusal : public EnvironmentError {
  public:
    PdfRefusal(PdfFault fault, const Message& message) : EnvironmentError(message), fault_(fault) {}
    PdfFault fault() const { return fault_; }

  private:
    PdfFault fault_;
};

}  // namespace dynlab::inline documents
