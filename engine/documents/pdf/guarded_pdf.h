#pragma once
#include <functional>
#include <string>

#include "documents/pdf/pdf_refusal.h"
#include "platform/guarded_call.h"

namespace dynlab::inline documents {

/// Does work on an untrusted PDF in a forked copy of this process with limits (run_guarded), so that a hostile file can
/// neither crash nor hang the caller, and returns the work's answer. A PdfRefusal that `work` throws is thrown here;
/// work that takes too long or too much memory, or crashes, is refused, too.
std::string run_guarded_on_pdf(const std::function<std::string()>& work, const GuardLimits& limits);

}  // namespace dynlab::inline documents
