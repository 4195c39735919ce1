#include "documents/latex_remains.h"

#include <re2/re2.h>

#include <algorithm>

#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

/// The line without code between backticks, formulas between dollar signs and escaped backslashes.
std::string prose_of(std::string line) {
    static const RE2 not_prose(R"(`[^`]*`|\$\$[^$]*\$\$|\$[^$]*\$|\\\\)", RE2::Latin1);
    RE2::GlobalReplace(&line, not_prose, " ");
    return line;
}

}  // namespace

std::set<std::string> escaped_commands(const MarkdownText& markdown) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const std::string& text = markdown.text;
    std::set<std::string> words;
    for (std::size_t at = text.find("\\\\"); at != std::string::npos; at = text.find("\\\\", at)) {
        at += 2;
        const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
        words.emplace(begin, std::find_if_not(begin, text.end(), is_letter));
    }
    return words;
}

std::set<std::string> escaped_citations(const std::string& text) {
    static const RE2 escaped(R"(\\(@[\pL\pN_]+(?:[:.#$%&\-+?<>~/][\pL\pN_]+)*))");
    std::set<std::string> keys;
    std::string key;
    for (re2::StringPiece rest = text; RE2::FindAndConsume(&rest, escaped, &key);) keys.insert(key);
    return keys;
}

void find_latex_brackets(const MarkdownText& markdown, Complaints& complaints) {
    // What looks like a formula: with its signs, or a symbol of few letters.
    static const RE2 round(R"(\\\(([^()]*[=^_\\{}<>][^()]*|\s*\w{1,3}\s*)\\\))", RE2::Latin1),
        square(R"(\\\[([^\[\]]*[=^_\\{}<>][^\[\]]*|\s*\w{1,3}\s*)\\\]([^(]|$)|^\s*\\[\[\]]\s*$)", RE2::Latin1);
    FencedCode fence;
    int number = 0;
    for (const std::string& line : lines_of(markdown.text)) {
        ++number;
        if (fence.holds(line)) continue;
        const std::string prose = prose_of(line);
        if (RE2::PartialMatch(prose, round))
            complaints.add(markdown.origin_of(number),
                           Message("\\(...\\) is LaTeX and would be printed as plain text; write a formula as $...$"));
        if (RE2::PartialMatch(prose, square))
            complaints.add(markdown.origin_of(number),
                           Message("\\[...\\] is LaTeX and would be printed as plain text; write a displayed formula "
                                   "as $$...$$ on separate lines"));
    }
}

}  // namespace dynlab::inline documents
