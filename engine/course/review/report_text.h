#pragma once
#include <string>
#include <vector>

#include "course/findings/document_text.h"

namespace dynlab::inline course {

struct ReportSection {
    std::string title;   ///< without its number; empty: what stands before the first heading
    std::string number;  ///< "2.1"; empty where there is none
    int words = 0;
};

struct ReportSentence {
    std::string text;
    std::size_t section = 0;  ///< of ReportText::sections
    int page = 0;             ///< 1-based; 0 where there are no pages
    bool heading = false;     ///< the section's title
    std::string part_of;      ///< of a table's row: the table's caption, where it is known
};

/// A report as a sequence of sentences: of its prose, captions, rows of tables, formulas.
struct ReportText {
    std::vector<ReportSection> sections;
    std::vector<ReportSentence> sentences;
    int words() const;
};

/// From the Markdown that `dynlab report` makes of a report with all slots filled (documents/document.h).
ReportText report_text_of_markdown(const std::string& markdown);
/// From a PDF. Lines that hold nothing but numbers and signs, such as the scales of figures, are left out.
ReportText report_text_of_pdf(const DocumentText& text);

/// The sentences of a paragraph. Formulas between dollar signs are kept whole, abbreviations end nothing.
std::vector<std::string> sentences_of(const std::string& paragraph);

}  // namespace dynlab::inline course
