#pragma once
#include "course/findings/document_text.h"
#include "course/intake/finding.h"
#include "documents/document_rules.h"

namespace dynlab::inline course {

/// section-missing, section-empty (rules), section-short (hint): every section the rules demand has a heading with most
/// words of its title, in either language, and text below it.
Findings section_findings(const DocumentText& text, const DocumentRules& rules, const std::string& language);

/// pages (rule): more pages than the rules allow; the appendix begins with a heading that says so, or that is an
/// optional section's. pages-few (hint): the text ends well before as many pages are filled as are asked for.
Findings page_findings(const DocumentText& text, int pages, const DocumentRules& rules);

}  // namespace dynlab::inline course
