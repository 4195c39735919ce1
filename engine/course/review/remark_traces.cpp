#include "course/review/remark_traces.h"

#include <re2/re2.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr int kShown = 4, kPlace = 4, kPage = 2, kNewWord = 4, kChangedWord = 2, kNearWord = 1;
constexpr std::size_t kFewSentences = 2;  ///< a word in at most this many is uncommon, or in
constexpr double kFewOfAll = 0.08;        ///< this share of them
constexpr std::size_t kNone = std::string::npos;
constexpr std::size_t kShortestWord = 4, kMostWords = 6;

bool is_number(const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// A thing that a text names by its number.
struct Place {
    char kind = 'f';  ///< f figure, t table, e equation, s section, p page
    std::string number;
    auto operator<=>(const Place&) const = default;
};

std::string place_name(const Place& place) {
    switch (place.kind) {
        case 'f':
            return "Figure " + place.number;
        case 't':
            return "Table " + place.number;
        case 'e':
            return "Equation " + place.number;
        case 's':
            return "Section " + place.number;
        default:
            return "page " + place.number;
    }
}

/// "Figures 2 and 3", "fig. 2", "Table 1", "éq. (4)", "section 3.1", "p. 2" in a text of anybody's.
std::set<Place> places_in(const std::string& text) {
    // The next search begins right after the numbers: a match may hold one character more.
    static const RE2 named(
        R"(\b(figures?|figs?|tables?|tableaux?|tab|equations?|eqs?|sections?|sec|pages?|pp?)[.]?\s?[(]?(\d{1,3}(?:[.]\d{1,3}){0,3})[)]?)"
        R"((?:(?:,\s?|\s(?:and|et|or|ou|to|a)\s)[(]?(\d{1,3}(?:[.]\d{1,3}){0,3})[)]?(?:[^\d%]|$))?)",
        RE2::Latin1);
    std::set<Place> places;
    const std::string plain = folded(text);
    std::size_t at = 0;
    for (re2::StringPiece part[4]; named.Match(plain, at, plain.size(), RE2::UNANCHORED, part, 4);) {
        const char kind = part[1][0];
        for (const re2::StringPiece& number : {part[2], part[3]}) {
            if (number.empty()) continue;
            places.insert({kind, number.as_string()});
            at = static_cast<std::size_t>(number.end() - plain.data());
        }
    }
    return places;
}

std::set<std::string> words_of(const std::string& text) {
    std::set<std::string> words;
    for (std::string& word : plain_words(text)) words.insert(std::move(word));
    return words;
}

bool any_agrees(const std::set<std::string>& words, const std::string& word) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& other) { return words_agree(word, other); });
}

/// A section 3 was changed when its part 3.1 was.
bool touches_section(const Passage& passage, const std::string& named) {
    return std::any_of(passage.numbers_before.begin(), passage.numbers_before.end(),
                       [&](const std::string& number) { return number == named || number.starts_with(named + "."); });
}

}  // namespace

bool words_agree(const std::string& a, const std::string& b) {
    if (a == b) return true;
    if (is_number(a) || is_number(b)) return false;
    const std::size_t shorter = std::min(a.size(), b.size()), longer = std::max(a.size(), b.size());
    const std::string_view plural = a.size() > b.size() ? a : b;
    if (shorter > 0 && longer == shorter + 1 && plural.back() == 's' && plural.starts_with(a.size() > b.size() ? b : a))
        return true;
    const std::size_t common =
        static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    return common >= 5 && 5 * common >= 3 * longer;
}

RemarkMatcher::RemarkMatcher(const ReportText& first, const TextChanges& changes) : changes_(changes) {
    for (const ReportSentence& sentence : first.sentences) {
        if (sentence.heading) continue;
        ++sentences_;
        for (const std::string& word : words_of(sentence.text)) ++frequency_[word];
    }
}

bool RemarkMatcher::is_uncommon(const std::string& word) const {
    if (is_number(word) ? word.size() < 2 : word.size() < kShortestWord) return false;
    if (is_common_word(word)) return false;
    const auto found = frequency_.find(word);
    const auto few = std::max(kFewSentences, static_cast<std::size_t>(kFewOfAll * static_cast<double>(sentences_)));
    return found == frequency_.end() || found->second <= few;
}

std::vector<RemarkMatch> RemarkMatcher::traces(const Remark& remark, std::size_t most) const {
    const std::set<Place> named = places_in(remark.text);
    std::set<std::string> uncommon;
    for (const std::string& word : words_of(remark.text)) {
        const bool number_of_place =
            std::any_of(named.begin(), named.end(), [&](const Place& place) { return place.number == word; });
        if (is_uncommon(word) && !number_of_place) uncommon.insert(word);
    }
    std::vector<RemarkMatch> found;
    for (std::size_t i = 0; i < changes_.passages.size(); ++i) {
        const Passage& passage = changes_.passages[i];
        RemarkMatch trace{i, {}, {}, 0};
        const std::string &was = passage.text_before, text_added = passage.text_of('+');
        const std::set<Place> there = places_in(was);
        for (const Place& place : named) {
            const bool here = place.kind == 's'   ? touches_section(passage, place.number)
                              : place.kind == 'p' ? std::to_string(passage.page_before) == place.number
                              : place.kind == 'e' ? there.contains(place) || was.find("(" + place.number + ")") != kNone
                                                  : there.contains(place);
            if (!here) continue;
            trace.places.push_back(place_name(place));
            trace.points += place.kind == 'p' ? kPage : kPlace;
        }
        const std::set<std::string> added = words_of(text_added), removed = words_of(passage.text_of('-')),
                                    near = words_of(passage.text_of('=') + " " + passage.section);
        for (const std::string& word : uncommon) {
            const bool brings = any_agrees(added, word), takes = any_agrees(removed, word);
            const bool fresh = brings && !takes &&
                               std::none_of(frequency_.begin(), frequency_.end(),
                                            [&](const auto& entry) { return words_agree(entry.first, word); });
            const int points = fresh                    ? kNewWord
                               : brings || takes        ? kChangedWord
                               : any_agrees(near, word) ? kNearWord
                                                        : 0;
            trace.points += points;
            if (points > 0 && trace.words.size() < kMostWords) trace.words.push_back(word);
        }
        if (trace.points >= kShown) found.push_back(std::move(trace));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const RemarkMatch& a, const RemarkMatch& b) { return a.points > b.points; });
    if (found.size() > most) found.resize(most);
    return found;
}

}  // namespace dynlab::inline course
