#pragma once
#include <string>
#include <vector>

#include "course/findings/document_text.h"
#include "course/intake/finding.h"

namespace dynlab::inline course {

/// The sentences of a template's comments (<!-- ... -->) that are long enough to be known again.
std::vector<std::string> guidance_of(const std::string& markdown);

/// slot-unfilled ("{.value}", "figure:name", "@fig:name" in print), reference-unresolved ("??"), placeholder-left
/// ("TODO", "____"), guidance-left (a sentence of the template's guidance): all rules. Code is not looked at.
Findings leftover_findings(const DocumentText& text, const std::vector<std::string>& guidance);

}  // namespace dynlab::inline course
