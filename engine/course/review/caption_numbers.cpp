#include "course/review/caption_numbers.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "course/review/edit_script.h"
#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

struct Caption {
    std::string label, number;
};

bool is_label(const std::string& word) {
    return word == "Figure" || word == "Table" || word == "Tableau";
}

std::string digits_of(const std::string& word) {
    const auto from = std::find_if(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
    const auto to = std::find_if(from, word.end(), [](unsigned char c) { return !std::isdigit(c); });
    return {from, to};
}

/// Captions by their label and text.
std::map<std::string, Caption> captions_of(const ReportText& text) {
    std::map<std::string, Caption> captions;
    std::set<std::string> doubles;
    for (const ReportSentence& sentence : text.sentences) {
        const std::vector<std::string> words = words_between_spaces(sentence.text);
        if (words.size() < 3 || !is_label(words[0])) continue;
        const std::string number = digits_of(words[1]);
        if (number.empty() || words[1] != number + ".") continue;
        const std::size_t at = sentence.text.find(words[1]) + words[1].size();
        const std::string key = words[0] + comparison_key(sentence.text.substr(at));
        if (!captions.emplace(key, Caption{words[0], number}).second) doubles.insert(key);
    }
    for (const std::string& key : doubles) captions.erase(key);
    return captions;
}

}  // namespace

CaptionNumbers::CaptionNumbers(const ReportText& before, const ReportText& after) {
    const std::map<std::string, Caption> now = captions_of(after);
    for (const auto& [key, caption] : captions_of(before)) {
        const auto found = now.find(key);
        if (found != now.end() && found->second.number != caption.number)
            numbers_[{caption.label, caption.number}] = found->second.number;
    }
}

std::vector<std::pair<std::string, std::string>> CaptionNumbers::changed() const {
    std::vector<std::pair<std::string, std::string>> changed;
    for (const auto& [was, now] : numbers_) changed.emplace_back(was.first + " " + was.second, was.first + " " + now);
    return changed;
}

std::string CaptionNumbers::renumbered(const std::string& text) const {
    if (numbers_.empty()) return text;
    std::string result, label;
    for (std::string word : words_between_spaces(text)) {
        const std::string number = digits_of(word);
        const auto found = numbers_.find({label, number});
        if (found != numbers_.end()) word.replace(word.find(number), number.size(), found->second);
        label = word;
        while (label.starts_with('(')) label.erase(0, 1);
        result += (result.empty() ? "" : " ") + word;
    }
    return result;
}

}  // namespace dynlab::inline course
