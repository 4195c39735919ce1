#pragma once
#include "workflow/make_report.h"

namespace dynlab::inline cli {

/// Makes a report, with its steps shown on a terminal, and says where it is. Returns the exit code.
int make_document(ReportRequest request, bool show_timings);

}  // namespace dynlab::inline cli
