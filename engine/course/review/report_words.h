#pragma once
#include <string>
#include <vector>

#include "course/findings/document_text.h"

namespace dynlab::inline course {

/// A word of a report, and where it is.
struct ReportWord {
    std::string text;
    std::string section;  ///< the title of its section; empty before the first heading
    int page = 0;         ///< 1-based; 0 in Markdown
};

/// At most so many words of a report are compared.
inline constexpr std::size_t kMaxReportWords = 20'000;

/// Of the Markdown that `dynlab report` makes. Rules of tables are not words.
std::vector<ReportWord> words_of_markdown(const std::string& markdown);
/// Words that are hyphenated at the end of a line are complete.
std::vector<ReportWord> words_of_pdf(const DocumentText& text);

/// A heading, a paragraph or an item of a list.
struct ReviewBlock {
    std::string text;
    bool heading = false;
};
/// A review as it was written, by its headings and the distances between its lines.
std::vector<ReviewBlock> blocks_of_review(const DocumentText& review);

}  // namespace dynlab::inline course
