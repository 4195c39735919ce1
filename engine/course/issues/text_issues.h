#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/intake/issue.h"
#include "course/issues/document_text.h"
#include "documents/document_rules.h"
#include "documents/pdf/pdf_layout.h"

namespace dynlab::inline course {

/// section-missing, section-empty (rules), section-short (hint): every section the rules demand has a heading with most
/// words of its title, in either language, and text below it.
Issues section_findings(const DocumentText& text, const DocumentRules& rules, const std::string& language);

/// pages (rule): more pages than the rules allow; the appendix begins with a heading that says so, or that is an
/// optional section's. pages-few (hint): the text ends well before as many pages are filled as are asked for.
Issues page_findings(const DocumentText& text, int pages, const DocumentRules& rules);

struct FigureFindings {
    std::size_t figures = 0;  ///< numbered captions found
    Issues findings;
};

/// figure-not-mentioned (of the given severity): a figure with a numbered caption ("Figure 3.", "Fig. 3 –") that the
/// text never mentions by that number. figure-not-there (hint): the text mentions a number that no caption has.
FigureFindings figure_findings(const DocumentText& text, Severity not_mentioned);

struct LanguageFindings {
    std::string language;  ///< "en" or "fr": that of most function words; empty if there are too few
    Issues findings;
};

/// Distinguishes English and French by their function words ("the", "which"; "les", "dans"). language-mixed (hint): a
/// passage in the other language. language-differs (hint): the document's language is not the `declared` one.
LanguageFindings language_findings(const DocumentText& text, const std::optional<std::string>& declared);

/// text-small (rule): the prose of a page has a median size below 9.5 pt (slides: as if they were 96 mm high). margins
/// (rule): five lines of a page or more come nearer than 15 mm to its sides, or three nearer than 12 mm to its top or
/// bottom; not for slides. text-overflow (hint): fewer lines do. text-cut-off (rule): text runs over the page's edge.
Issues layout_findings(const DocumentText& text, const PdfLayout& layout);

/// The sentences of a template's comments (<!-- ... -->) that are long enough to be known again.
std::vector<std::string> guidance_of(const std::string& markdown);

/// slot-unfilled ("{.value}", "figure:name", "@fig:name" in print), reference-unresolved ("??"), placeholder-left
/// ("TODO", "____"), guidance-left (a sentence of the template's guidance): all rules. Code is not looked at.
Issues leftover_findings(const DocumentText& text, const std::vector<std::string>& guidance);

}  // namespace dynlab::inline course
