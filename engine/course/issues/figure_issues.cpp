#include "course/issues/text_issues.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr int kHighestNumber = 999;

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// "Figure", "(Figs." and the like.
bool names_figure(const std::string& word) {
    const std::vector<std::string> plain = plain_words(word);
    if (plain.empty()) return false;
    const std::string& last = plain.back();
    return last == "figure" || last == "figures" || last == "fig" || last == "figs";
}

/// A number at the start of a word, and what follows it in the word: "3.", "(3)", "2b,", "1-3".
struct NumberWord {
    int number = 0;
    std::string rest;
};
std::optional<NumberWord> number_word(const std::string& word) {
    std::string text = folded(word);
    text.erase(0, text.find_first_not_of("(["));
    const std::size_t digits = static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
    if (digits == 0 || digits > 3) return std::nullopt;
    NumberWord result{std::stoi(text.substr(0, digits)), text.substr(digits)};
    if (!result.rest.empty() && std::isalpha(static_cast<unsigned char>(result.rest[0]))) result.rest.erase(0, 1);
    return result;
}

bool is_range_sign(const std::string& word) {
    return word == "-" || word == "--" || word == "to" || word == "a";  // "a" is a folded "à"
}

bool is_list_sign(const std::string& word) {
    return word == "," || word == "and" || word == "et" || word == "&" || word == "or" || word == "ou";
}

/// All numbers that are named after "Figures" at word `i`: "2, 3 and 5", "1–3".
std::set<int> numbers_after(const std::vector<TextWord>& words, std::size_t i) {
    std::set<int> numbers;
    int previous = 0;
    bool range = false, listed = true;
    for (++i; i < words.size(); ++i) {
        const std::string sign = folded(words[i].text);
        const auto found = number_word(words[i].text);
        if (!found) {
            if (numbers.empty() || (!is_range_sign(sign) && !is_list_sign(sign))) break;
            range = is_range_sign(sign);
            listed = true;
            continue;
        }
        if (!listed) break;
        for (int k = range ? previous : found->number; k <= found->number; ++k) numbers.insert(k);
        previous = found->number;
        range = false;
        std::string rest = found->rest;
        if (rest.size() > 1 && rest[0] == '-' && is_digit(rest[1])) {  // "1-3" in one word
            const auto last = number_word(rest.substr(1));
            for (int k = previous; last && k <= std::min(last->number, kHighestNumber); ++k) numbers.insert(k);
            if (last) rest = last->rest;
        }
        listed = rest == ",";
        if (!rest.empty() && rest != "," && rest != ")") break;
    }
    return numbers;
}

bool ends_label(const std::string& rest) {
    return rest.starts_with('.') || rest.starts_with(':') || rest.starts_with('-');
}

/// Whether "Figure" at word `i`, which starts a line, is the label of a caption and no sentence that begins there.
bool is_caption(const DocumentText& text, std::size_t i) {
    if (!text.words[i].starts_line || i + 1 >= text.words.size()) return false;
    const auto number = number_word(text.words[i + 1].text);
    if (!number) return false;
    const TextLine& line = text.lines[text.words[i].line];
    const bool alone = i + 2 >= text.words.size() || text.words[i + 2].line != text.words[i].line;
    const std::string next = i + 2 < text.words.size() ? folded(text.words[i + 2].text) : "";
    const bool signed_off = ends_label(number->rest) || next == ":" || next == "-" || next == "--" || next == ".";
    if (!signed_off && !(alone && number->rest.empty())) return false;
    if (text.words[i].line == 0) return true;
    const TextLine& above = text.lines[text.words[i].line - 1];
    const bool apart = above.page != line.page || line.top - above.bottom > 0.35 * line.size || above.top > line.top;
    return apart || std::abs(line.size - text.body_size) > 0.3;
}

}  // namespace

FigureFindings figure_findings(const DocumentText& text, Severity not_mentioned) {
    std::map<int, int> captions, mentions;  // number -> page
    for (std::size_t i = 0; i < text.words.size(); ++i) {
        if (!names_figure(text.words[i].text)) continue;
        if (is_caption(text, i) &&
            captions.emplace(number_word(text.words[i + 1].text)->number, text.words[i].page).second)
            continue;
        for (const int number : numbers_after(text.words, i)) mentions.emplace(number, text.words[i].page);
    }
    FigureFindings result{captions.size(), {}};
    for (const auto& [number, page] : captions) {
        if (mentions.contains(number)) continue;
        result.findings.push_back({"figure-not-mentioned", not_mentioned, page, "",
                                   Message("The text does not mention figure {}.", number),
                                   Message("Name the figure with report.figure(\"name\", fig, \"caption\") and refer "
                                           "to the figure with @fig:name in the text, or remove the figure.")});
    }
    for (const auto& [number, page] : mentions) {
        if (captions.empty() || captions.contains(number)) continue;
        result.findings.push_back({"figure-not-there", Severity::kHint, page, "",
                                   Message("The text mentions figure {}, but no figure has this number.", number),
                                   Message("Correct the number, or give the figure a caption.")});
    }
    return result;
}

}  // namespace dynlab::inline course
