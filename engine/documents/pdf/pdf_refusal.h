#pragma once
#include <string>

#include "platform/error.h"

namespace dynlab::inline documents {

/// Why a file cannot be looked at.
enum class PdfFault { kNotThere, kNotPdf, kEncrypted, kDamaged, kTooLarge };

/// Its sentence does not name the file.
class PdfRefusal : public EnvironmentError {
  public:
    PdfRefusal(PdfFault fault, const std::string& sentence) : EnvironmentError(sentence), fault_(fault) {}
    PdfFault fault() const { return fault_; }

  private:
    PdfFault fault_;
};

}  // namespace dynlab::inline documents
