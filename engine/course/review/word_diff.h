#pragma once
#include <string>
#include <vector>

#include "course/issues/document_text.h"
#include "documents/run_record.h"

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

/// Successive words of both versions ('='), or of only the first ('-') or the second ('+').
struct MarkedWords {
    char mark = '=';
    std::vector<ReportWord> words;
};

/// The differences of two versions of a text, word by word.
struct WordDiff {
    std::vector<MarkedWords> pieces;  ///< in the order of the text; deleted words before those inserted in their place
    std::size_t before = 0, after = 0;      ///< words of each version
    std::size_t deleted = 0, inserted = 0;  ///< words of only one version
    double share() const;                   ///< (deleted + inserted) / (before + after), 0 to 1
};

/// Method: S. Wu, U. Manber, G. Myers, W. Miller, An O(NP) sequence comparison algorithm, Information Processing
/// Letters 35 (1990), as the library dtl has it. Its memory is bounded; a very long script of edits may then not be the
/// shortest.
WordDiff word_diff(const std::vector<ReportWord>& before, const std::vector<ReportWord>& after);

/// A value, an answer or the cell of a table that differs between two runs.
struct ValueChange {
    std::string name;           ///< "fit", or of a table "models: SRIVC, fit (%)"
    std::string before, after;  ///< as documents show them; empty where there is none
};

struct ValueChanges {
    std::vector<ValueChange> changed;
    std::size_t compared = 0;  ///< entries of both runs together
};

/// Rows of tables belong together by their first cell.
ValueChanges value_changes(const RunRecord& before, const RunRecord& after);

}  // namespace dynlab::inline course
