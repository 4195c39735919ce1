#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "course/review/report_text.h"

namespace dynlab::inline course {

struct SectionChange {
    std::optional<std::string> before, after;  ///< titles; one is missing of a section that is new or gone
    int words_before = 0, words_after = 0;
    double share = 0;  ///< of its words that changed, 0 to 1
    bool renamed() const { return before && after && *before != *after; }
};

/// Words in a row that both versions have, or one only.
struct MarkedWords {
    char mark = '=';  ///< '=', '-' or '+'
    std::string text;
};

/// A stretch of the text that changed, between two that did not.
struct Passage {
    std::vector<MarkedWords> pieces;
    std::string lead_in;  ///< the sentence before it, which stayed; may be empty
    std::string section;  ///< title with its number: of the final version; of what is gone, the first's
    std::vector<std::string> numbers_before;  ///< of the first version's sections that it touches
    std::string text_before;                  ///< the first version's sentences, with the captions of their tables
    int page_before = 0, page_after = 0;      ///< 0 where there are no pages
    std::string text_of(char mark) const;     ///< its pieces of one kind
};

struct TextChanges {
    std::vector<SectionChange> sections;  ///< in the order of the new version, those that are gone in their old place
    std::vector<Passage> passages;        ///< in the order of the text
    int words_before = 0, words_after = 0;
    double share = 0;  ///< of all words, old and new, that only one version has: 0 to 1
    int moved = 0;     ///< sentences that stand elsewhere now, otherwise unchanged
    std::vector<std::pair<std::string, std::string>> renumbered;  ///< "Figure 2" that is "Figure 3" now
};

/// What differs between two versions of a report: sentences that were added, removed or edited (these by words).
/// Sections belong together by their titles, else by the words that they share. Figures and tables belong together by
/// their captions: another number alone is no change, and neither is a sentence that moved.
TextChanges text_changes(const ReportText& before, const ReportText& after);

}  // namespace dynlab::inline course
