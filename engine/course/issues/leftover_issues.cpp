#include "course/issues/text_issues.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

#include "platform/text/plain_words.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kWordsToKnow = 6;  ///< a shorter sentence may appear in a report by chance
constexpr std::size_t kMaxLeftovers = 10;

struct Sign {
    const char *text, *id;
    Message (*what)(const std::string& line);
    Message remedy;
};
const std::vector<Sign>& signs() {
    static const Message fill =
        Message("Report the value, table or figure in {} and create the PDF with dynlab report.", "analysis.lua");
    using Line = const std::string&;
    static const std::vector<Sign> all = {
        {"{.value}", "slot-unfilled",
         [](Line line) { return Message("A slot for a value was not filled: \"{}\".", line); }, fill},
        {"{.table", "slot-unfilled",
         [](Line line) { return Message("A slot for a table was not filled: \"{}\".", line); }, fill},
        {"{.text", "slot-unfilled", [](Line line) { return Message("A slot for text was not filled: \"{}\".", line); },
         fill},
        {"(figure:", "slot-unfilled",
         [](Line line) { return Message("A slot for a figure was not filled: \"{}\".", line); }, fill},
        {"{#fig:", "slot-unfilled",
         [](Line line) { return Message("The label of a figure is left in the text: \"{}\".", line); }, fill},
        {"{#tbl:", "slot-unfilled",
         [](Line line) { return Message("The label of a table is left in the text: \"{}\".", line); }, fill},
        {"{#eq:", "slot-unfilled",
         [](Line line) { return Message("The label of an equation is left in the text: \"{}\".", line); }, fill},
        {"@fig:", "slot-unfilled",
         [](Line line) { return Message("A reference to a figure was not resolved: \"{}\".", line); }, fill},
        {"@tbl:", "slot-unfilled",
         [](Line line) { return Message("A reference to a table was not resolved: \"{}\".", line); }, fill},
        {"@eq:", "slot-unfilled",
         [](Line line) { return Message("A reference to an equation was not resolved: \"{}\".", line); }, fill},
        {"<!--", "guidance-left", [](Line line) { return Message("A comment is left in the text: \"{}\".", line); },
         Message("Close the comment with --> or remove it.")},
        {"??", "reference-unresolved", [](Line line) { return Message("A reference was not resolved: \"{}\".", line); },
         Message("Define the label, or correct the reference.")},
        {"____", "placeholder-left", [](Line line) { return Message("A blank was not filled in: \"{}\".", line); },
         Message("Fill in the blank.")},
        {"lorem ipsum", "placeholder-left",
         [](Line line) { return Message("Placeholder text is left in the document: \"{}\".", line); },
         Message("Replace the placeholder text with your own text.")},
    };
    return all;
}

bool is_placeholder(const std::string& word) {
    static const std::set<std::string> placeholders = {"TODO", "FIXME", "TBD", "XXX"};
    std::string letters;
    for (const char c : word) {
        if (c >= 'A' && c <= 'z') letters += c;
    }
    return placeholders.contains(letters);
}

Issue leftover(const char* id, int page, const Message& what, const Message& remedy) {
    return {id, Severity::kRule, page, "", what, remedy};
}

void check_line(const TextLine& line, Issues& findings) {
    const std::string text = line.text();
    const std::string lower = in_small_letters(text);
    for (const Sign& sign : signs()) {
        if (lower.find(sign.text) == std::string::npos) continue;
        findings.push_back(leftover(sign.id, line.page, sign.what(printable(text, 60)), sign.remedy));
        return;
    }
    const auto found = std::find_if(line.words.begin(), line.words.end(), is_placeholder);
    if (found == line.words.end()) return;
    findings.push_back(leftover("placeholder-left", line.page,
                                Message("A note to yourself is left in the text: \"{}\".", printable(text, 60)),
                                Message("Resolve the note, then remove it.")));
}

std::string spaced(const std::vector<std::string>& words) {
    std::string text = " ";
    for (const std::string& word : words) text += word + " ";
    return text;
}

void check_guidance(const DocumentText& text, const std::vector<std::string>& guidance, Issues& findings) {
    std::string all = " ";
    std::vector<std::pair<std::ptrdiff_t, int>> page_starts;
    for (const TextWord& word : text.words) {
        if (page_starts.empty() || page_starts.back().second != word.page)
            page_starts.emplace_back(std::ssize(all), word.page);
        for (const std::string& plain : plain_words(word.text)) all += plain + " ";
    }
    for (const std::string& sentence : guidance) {
        const std::string words = spaced(plain_words(sentence));
        const auto found =
            std::search(all.begin(), all.end(), std::boyer_moore_horspool_searcher(words.begin(), words.end()));
        if (found == all.end()) continue;
        int page = 1;
        for (const auto& [start, number] : page_starts) page = start <= found - all.begin() + 1 ? number : page;
        findings.push_back(leftover("guidance-left", page,
                                    Message("Template guidance is left in the text: \"{}\".", printable(sentence, 60)),
                                    Message("Remove the guidance. Text between <!-- and --> is never printed.")));
    }
}

}  // namespace

std::vector<std::string> guidance_of(const std::string& markdown) {
    std::vector<std::string> sentences;
    for (std::size_t start = markdown.find("<!--"); start != std::string::npos;) {
        const std::size_t end = std::min(markdown.find("-->", start + 4), markdown.size());
        std::string sentence;
        for (const char c : markdown.substr(start + 4, end - start - 4) + ".") {
            sentence += c == '\n' ? ' ' : c;
            if (c != '.' && c != ':' && c != ';' && c != '?') continue;
            if (plain_words(sentence).size() >= kWordsToKnow)
                sentences.push_back(sentence.substr(std::min(sentence.find_first_not_of(' '), sentence.size())));
            sentence.clear();
        }
        start = markdown.find("<!--", end);
    }
    return sentences;
}

Issues leftover_findings(const DocumentText& text, const std::vector<std::string>& guidance) {
    Issues findings;
    for (const TextLine& line : text.lines) {
        if (!line.fixed_width && findings.size() < kMaxLeftovers) check_line(line, findings);
    }
    check_guidance(text, guidance, findings);
    if (findings.size() > kMaxLeftovers) findings.resize(kMaxLeftovers);
    return findings;
}

}  // namespace dynlab::inline course
