#include "course/review/word_diff.h"

#include <dtl/dtl.hpp>
#include <map>

namespace dynlab::inline course {

double WordDiff::share() const {
    const std::size_t all = before + after;
    return all == 0 ? 0 : static_cast<double>(deleted + inserted) / static_cast<double>(all);
}

WordDiff word_diff(const std::vector<ReportWord>& before, const std::vector<ReportWord>& after) {
    using Numbers = std::vector<std::size_t>;
    std::map<std::string, std::size_t> known;  // equal words have equal numbers, which are compared more quickly
    const auto numbered = [&known](const std::vector<ReportWord>& words) {
        Numbers numbers;
        for (const ReportWord& word : words)
            numbers.push_back(known.try_emplace(word.text, known.size()).first->second);
        return numbers;
    };
    dtl::Diff<std::size_t, Numbers> edits(numbered(before), numbered(after));
    edits.compose();
    WordDiff diff;
    diff.before = before.size(), diff.after = after.size();
    MarkedWords deleted{'-', {}}, inserted{'+', {}};
    const auto finish_change = [&] {
        diff.deleted += deleted.words.size(), diff.inserted += inserted.words.size();
        for (MarkedWords* piece : {&deleted, &inserted}) {
            if (!piece->words.empty()) diff.pieces.push_back(*piece);
            piece->words.clear();
        }
    };
    std::size_t old_word = 0, new_word = 0;
    for (const auto& [number, edit] : edits.getSes().getSequence()) {
        if (edit.type == dtl::SES_DELETE) {
            deleted.words.push_back(before[old_word++]);
        } else if (edit.type == dtl::SES_ADD) {
            inserted.words.push_back(after[new_word++]);
        } else {
            finish_change();
            if (diff.pieces.empty() || diff.pieces.back().mark != '=') diff.pieces.push_back({});
            diff.pieces.back().words.push_back(after[new_word++]);
            ++old_word;
        }
    }
    finish_change();
    return diff;
}

}  // namespace dynlab::inline course
