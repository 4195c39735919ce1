#pragma once
#include <string>
#include <vector>

#include "documents/run_record.h"

namespace dynlab::inline documents {

/// What a script reported by name and no slot of the document shows, a sentence each with the line to write.
/// `markdown`: all text of the document, template and text cells.
std::vector<std::string> unplaced_entries(const RunRecord& record, const std::string& markdown);

}  // namespace dynlab::inline documents
