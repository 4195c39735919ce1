#pragma once
#include <map>
#include <string>
#include <vector>

#include "course/review/remarks.h"
#include "course/review/text_changes.h"

namespace dynlab::inline course {

/// A change that may answer a remark, and why it is shown.
struct RemarkMatch {
    std::size_t passage = 0;          ///< of TextChanges::passages
    std::vector<std::string> places;  ///< that the remark names and that changed there: "Figure 2", "Section 3"
    std::vector<std::string> words;   ///< uncommon words that both have
    int points = 0;
};

/// Finds changes that plausibly answer remarks, by words alone: it knows nothing of their meaning. A change counts with
///   4 points  for each figure, table, equation or section that the remark names by the first version's number,
///   2 points  for a page of the first version that it names,
///   4 points  for an uncommon word of the remark that the first version does not have and the change brings,
///   2 points  for one among the words that were added or removed,
///   1 point   for one in the unchanged rest of an edited passage or in its section's title,
/// and is shown from 4 points on. Uncommon are words that stand in few sentences of the first version and are no
/// function words and not those that reviews are made of. Words agree when they begin alike.
class RemarkMatcher {
  public:
    RemarkMatcher(const ReportText& first, const TextChanges& changes);
    /// The best first, at most `most`.
    std::vector<RemarkMatch> traces(const Remark& remark, std::size_t most = 3) const;

  private:
    bool is_uncommon(const std::string& word) const;

    const TextChanges& changes_;
    std::size_t sentences_ = 0;
    std::map<std::string, std::size_t> frequency_;  ///< of a word: in how many sentences of the first version
};

/// Whether two folded words are forms of one: "validate" and "validation".
bool words_agree(const std::string& a, const std::string& b);

/// Words without meaning of their own, in English and French, and those that speak about a report; folded.
bool is_common_word(const std::string& folded);

}  // namespace dynlab::inline course
