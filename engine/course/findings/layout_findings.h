#pragma once
#include "course/findings/document_text.h"
#include "course/intake/finding.h"
#include "documents/pdf/pdf_layout.h"

namespace dynlab::inline course {

/// text-small (rule): the prose of a page has a median size below 9.5 pt (slides: as if they were 96 mm high). margins
/// (rule): five lines of a page or more come nearer than 15 mm to its sides, or three nearer than 12 mm to its top or
/// bottom; not for slides. text-overflow (hint): fewer lines do. text-cut-off (rule): text runs over the page's edge.
Findings layout_findings(const DocumentText& text, const PdfLayout& layout);

}  // namespace dynlab::inline course
