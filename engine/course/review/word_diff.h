#pragma once
#include <vector>

#include "course/review/report_words.h"

namespace dynlab::inline course {

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

}  // namespace dynlab::inline course
