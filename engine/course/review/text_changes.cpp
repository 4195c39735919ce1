#include "course/review/text_changes.h"

#include <algorithm>
#include <map>

#include "course/review/caption_numbers.h"
#include "course/review/edit_script.h"
#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

constexpr double kEditedShare = 0.5;  ///< share of the shorter side's words; a passage that keeps more is an edited one
constexpr std::size_t kShortestMoved = 4;  ///< words of a sentence that is known again elsewhere
constexpr std::size_t kShortestKept = 2;   ///< words: fewer between two changes are read as changed

using Words = std::vector<std::string>;

std::string sentence_of(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string title_of(const ReportSection& section) {
    return section.number.empty() ? section.title : section.number + " " + section.title;
}

/// A heading is set off from what follows it.
Words shown_words(const ReportSentence& sentence) {
    Words words = words_between_spaces(sentence.text);
    if (sentence.heading) words.push_back("—");
    return words;
}

/// Runs of words, each with its mark.
struct Run {
    char mark;
    Words words;
};

std::vector<Run> runs_of(const std::string& script, const Words& before, const Words& after) {
    std::vector<Run> runs;
    std::size_t b = 0, a = 0;
    for (const char step : script) {
        if (runs.empty() || runs.back().mark != step) runs.push_back({step, {}});
        runs.back().words.push_back(step == '-' ? before[b] : after[a]);
        b += step != '+';
        a += step != '-';
    }
    return runs;
}

std::size_t kept_words(const std::vector<Run>& runs) {
    std::size_t kept = 0;
    for (const Run& run : runs) kept += run.mark == '=' ? run.words.size() : 0;
    return kept;
}

/// Lone words between two changes are counted as changed, so that what is removed and what is added can be read.
std::vector<MarkedWords> readable(const std::vector<Run>& runs) {
    std::vector<MarkedWords> pieces;
    Words removed, added;
    const auto flush = [&] {
        if (!removed.empty()) pieces.push_back({'-', sentence_of(removed)});
        if (!added.empty()) pieces.push_back({'+', sentence_of(added)});
        removed.clear(), added.clear();
    };
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Run& run = runs[i];
        const bool lone = run.mark == '=' && run.words.size() < kShortestKept && i > 0 && i + 1 < runs.size();
        if (run.mark == '=' && !lone) {
            flush();
            pieces.push_back({'=', sentence_of(run.words)});
            continue;
        }
        if (run.mark != '+') removed.insert(removed.end(), run.words.begin(), run.words.end());
        if (run.mark != '-') added.insert(added.end(), run.words.begin(), run.words.end());
    }
    flush();
    return pieces;
}

class Comparison {
  public:
    Comparison(const ReportText& before, const ReportText& after)
        : before_(before), after_(after), numbers_(before, after) {
        changes_.renumbered = numbers_.changed();
    }

    TextChanges run() {
        std::vector<std::string> old_keys = keys_of(before_), new_keys = keys_of(after_);
        for (std::string& key : old_keys) key = numbers_.renumbered(key);
        const std::string script = with_moves(edit_script(old_keys, new_keys), old_keys, new_keys);
        changed_before_.resize(before_.sections.size());
        changed_after_.resize(after_.sections.size());
        for (std::size_t i = 0; i < script.size();) {
            if (script[i] == '-' || script[i] == '+') {
                i = add_passage(script, i);
                continue;
            }
            if (script[i] != '=') {  // moved
                ++(script[i] == '<' ? b_ : a_), ++i;
                continue;
            }
            shared_[{before_.sentences[b_].section, after_.sentences[a_].section}] +=
                static_cast<int>(words_between_spaces(after_.sentences[a_].text).size());
            ++b_, ++a_, ++i;
        }
        pair_sections();
        changes_.words_before = before_.words(), changes_.words_after = after_.words();
        const int all = changes_.words_before + changes_.words_after;
        int changed = 0;
        for (const int words : changed_before_) changed += words;
        for (const int words : changed_after_) changed += words;
        changes_.share = all > 0 ? std::min(1.0, static_cast<double>(changed) / all) : 0;
        return std::move(changes_);
    }

  private:
    static std::vector<std::string> keys_of(const ReportText& text) {
        std::vector<std::string> keys;
        for (const ReportSentence& sentence : text.sentences)
            keys.push_back((sentence.heading ? "# " : "") + sentence.text);
        return keys;
    }

    /// The script with '<' and '>' in place of '-' and '+' where a sentence of some length only stands elsewhere now.
    std::string with_moves(std::string script, const std::vector<std::string>& old_keys,
                           const std::vector<std::string>& new_keys) {
        std::map<std::string, std::vector<std::size_t>> gone;  ///< places in the script, by what went
        std::size_t b = 0, a = 0;
        for (std::size_t i = 0; i < script.size(); ++i) {
            if (script[i] == '-') gone[comparison_key(old_keys[b])].push_back(i);
            b += script[i] != '+';
        }
        for (std::size_t i = 0; i < script.size(); ++i) {
            const bool may_have_moved = script[i] == '+' && words_between_spaces(new_keys[a]).size() >= kShortestMoved;
            const auto found = may_have_moved ? gone.find(comparison_key(new_keys[a])) : gone.end();
            a += script[i] != '-' && script[i] != '<';
            if (found == gone.end() || found->second.empty()) continue;
            script[found->second.front()] = '<', script[i] = '>';
            found->second.erase(found->second.begin());
            ++changes_.moved;
        }
        return script;
    }

    /// Takes the changed sentences from `i` on; returns where the next unchanged one stands.
    std::size_t add_passage(const std::string& script, std::size_t i) {
        const std::size_t b = b_, a = a_;
        for (; i < script.size() && (script[i] == '-' || script[i] == '+'); ++i) ++(script[i] == '-' ? b_ : a_);
        Passage passage;
        const bool begins_section = (b < b_ && before_.sentences[b].heading) || (a < a_ && after_.sentences[a].heading);
        if (b > 0 && !before_.sentences[b - 1].heading && !begins_section)
            passage.lead_in = before_.sentences[b - 1].text;
        locate(passage, b, a);
        const Words old_words = words_of(before_, b, b_), new_words = words_of(after_, a, a_);
        std::vector<Run> runs;
        if (!old_words.empty() && !new_words.empty()) {
            runs = runs_of(edit_script(words_between_spaces(numbers_.renumbered(sentence_of(old_words))), new_words),
                           old_words, new_words);
            const auto shorter = static_cast<double>(std::min(old_words.size(), new_words.size()));
            if (static_cast<double>(kept_words(runs)) < kEditedShare * shorter) runs.clear();
        }
        if (runs.empty()) runs = {{'-', old_words}, {'+', new_words}};
        count(runs, b, a);
        passage.pieces = readable(runs);
        changes_.passages.push_back(std::move(passage));
        return i;
    }

    /// The changed sentences are those from b and a up to b_ and a_.
    void locate(Passage& passage, std::size_t b, std::size_t a) const {
        if (a < a_) {
            passage.section = title_of(after_.sections[after_.sentences[a].section]);
            passage.page_after = after_.sentences[a].page;
        } else {
            passage.section = title_of(before_.sections[before_.sentences[b].section]);
        }
        if (b < b_) passage.page_before = before_.sentences[b].page;
        std::vector<std::string> captions;
        for (std::size_t i = b; i < b_; ++i) {
            const ReportSentence& sentence = before_.sentences[i];
            add_once(passage.numbers_before, before_.sections[sentence.section].number);
            passage.text_before += (passage.text_before.empty() ? "" : " ") + sentence.text;
            add_once(captions, sentence.part_of);
        }
        for (const std::string& caption : captions) passage.text_before += " " + caption;
        if (b == b_) add_once(passage.numbers_before, number_around(b, a));
    }

    /// Of the first version's section to which sentences were added: that of the neighbour which is in their section
    /// now.
    std::string number_around(std::size_t b, std::size_t a) const {
        const std::size_t section = after_.sentences[a].section;
        if (a > 0 && b > 0 && after_.sentences[a - 1].section == section)
            return before_.sections[before_.sentences[b - 1].section].number;
        if (a_ < after_.sentences.size() && b < before_.sentences.size() && after_.sentences[a_].section == section)
            return before_.sections[before_.sentences[b].section].number;
        return {};
    }

    static void add_once(std::vector<std::string>& list, const std::string& item) {
        if (!item.empty() && std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
    }

    static Words words_of(const ReportText& text, std::size_t from, std::size_t to) {
        Words words;
        for (std::size_t i = from; i < to; ++i)
            for (std::string& word : shown_words(text.sentences[i])) words.push_back(std::move(word));
        return words;
    }

    /// Changed words of each section; titles are no words of theirs.
    void count(const std::vector<Run>& runs, std::size_t b, std::size_t a) {
        std::vector<std::size_t> old_sections = sections_of_words(before_, b, b_),
                                 new_sections = sections_of_words(after_, a, a_);
        std::size_t old_word = 0, new_word = 0;
        for (const Run& run : runs) {
            for (std::size_t k = 0; k < run.words.size(); ++k) {
                if (run.mark == '-' && old_sections[old_word] != kTitle) ++changed_before_[old_sections[old_word]];
                if (run.mark == '+' && new_sections[new_word] != kTitle) ++changed_after_[new_sections[new_word]];
                if (run.mark == '=' && old_sections[old_word] != kTitle && new_sections[new_word] != kTitle)
                    ++shared_[{old_sections[old_word], new_sections[new_word]}];
                old_word += run.mark != '+';
                new_word += run.mark != '-';
            }
        }
    }

    static std::vector<std::size_t> sections_of_words(const ReportText& text, std::size_t from, std::size_t to) {
        std::vector<std::size_t> sections;
        for (std::size_t i = from; i < to; ++i)
            sections.insert(sections.end(), shown_words(text.sentences[i]).size(),
                            text.sentences[i].heading ? kTitle : text.sentences[i].section);
        return sections;
    }

    void pair_sections() {
        std::vector<std::optional<std::size_t>> partner(before_.sections.size());
        std::vector<bool> taken(after_.sections.size());
        const auto pair = [&](std::size_t b, std::size_t a) { partner[b] = a, taken[a] = true; };
        for (std::size_t b = 0; b < partner.size(); ++b)
            for (std::size_t a = 0; a < taken.size() && !partner[b]; ++a)
                if (!taken[a] && comparison_key(before_.sections[b].title) == comparison_key(after_.sections[a].title))
                    pair(b, a);
        std::vector<std::pair<int, std::pair<std::size_t, std::size_t>>> common;
        for (const auto& [sections, words] : shared_) common.push_back({-words, sections});
        std::sort(common.begin(), common.end());
        for (const auto& [words, sections] : common)
            if (!partner[sections.first] && !taken[sections.second]) pair(sections.first, sections.second);
        list_sections(partner, taken);
    }

    void list_sections(const std::vector<std::optional<std::size_t>>& partner, const std::vector<bool>& taken) {
        std::size_t next_gone = 0;
        const auto list_gone = [&](std::size_t before) {
            for (; next_gone < before; ++next_gone) {
                if (partner[next_gone]) continue;
                const ReportSection& section = before_.sections[next_gone];
                changes_.sections.push_back({title_of(section), std::nullopt, section.words, 0, 1});
            }
        };
        for (std::size_t a = 0; a < taken.size(); ++a) {
            const ReportSection& now = after_.sections[a];
            const auto found = std::find(partner.begin(), partner.end(), std::optional(a));
            if (found == partner.end()) {
                changes_.sections.push_back({std::nullopt, title_of(now), 0, now.words, 1});
                continue;
            }
            const auto b = static_cast<std::size_t>(found - partner.begin());
            list_gone(b);
            const ReportSection& was = before_.sections[b];
            const int all = was.words + now.words, changed = changed_before_[b] + changed_after_[a];
            changes_.sections.push_back({was.title == now.title ? title_of(now) : title_of(was), title_of(now),
                                         was.words, now.words,
                                         all > 0 ? std::min(1.0, static_cast<double>(changed) / all) : 0});
        }
        list_gone(partner.size());
    }

    static constexpr std::size_t kTitle = static_cast<std::size_t>(-1);
    const ReportText &before_, &after_;
    CaptionNumbers numbers_;
    std::size_t b_ = 0, a_ = 0;
    std::vector<int> changed_before_, changed_after_;
    std::map<std::pair<std::size_t, std::size_t>, int> shared_;  ///< words that two sections share
    TextChanges changes_;
};

}  // namespace

std::string Passage::text_of(char mark) const {
    std::string text;
    for (const MarkedWords& piece : pieces)
        if (piece.mark == mark) text += (text.empty() ? "" : " ") + piece.text;
    return text;
}

TextChanges text_changes(const ReportText& before, const ReportText& after) {
    return Comparison(before, after).run();
}

}  // namespace dynlab::inline course
