#pragma once
#include "course/findings/document_text.h"
#include "course/intake/finding.h"

namespace dynlab::inline course {

struct FigureFindings {
    std::size_t figures = 0;  ///< numbered captions found
    Findings findings;
};

/// figure-not-mentioned (of the given severity): a figure with a numbered caption ("Figure 3.", "Fig. 3 –") that the
/// text never mentions by that number. figure-not-there (hint): the text mentions a number that no caption has.
FigureFindings figure_findings(const DocumentText& text, Severity not_mentioned);

}  // namespace dynlab::inline course
