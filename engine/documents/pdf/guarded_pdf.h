#pragma once
#include <functional>
#include <string>

#include "documents/pdf/pdf_refusal.h"
#include "platform/guarded_call.h"

namespace dynlab::inline documents {

/// Does work on a PDF from somebody else in a forked copy of this process with limits (run_guarded), so that a hostile
/// one can neither crash nor hang the caller, and returns its answer. A PdfRefusal that `work` throws is thrown here;
/// what takes too long or too much memory, or crashes, is refused, too.
std::string run_guarded_on_pdf(const std::function<std::string()>& work, const GuardLimits& limits);

}  // namespace dynlab::inline documents
