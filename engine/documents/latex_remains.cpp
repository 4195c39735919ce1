#include "documents/latex_remains.h"

#include <regex>

#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

/// The line without code between backticks, formulas between dollar signs and escaped backslashes.
std::string prose_of(const std::string& line) {
    static const std::regex not_prose(R"(`[^`]*`|\$\$[^$]*\$\$|\$[^$]*\$|\\\\)");
    return std::regex_replace(line, not_prose, " ");
}

}  // namespace

void find_latex_brackets(const MarkdownText& markdown, Complaints& complaints) {
    static const std::regex round(R"(\\\(.*\\\))"), square(R"(\\\[.*\\\]|^\s*\\[\[\]]\s*$)");
    FencedCode fence;
    int number = 0;
    for (const std::string& line : lines_of(markdown.text)) {
        ++number;
        if (fence.holds(line)) continue;
        const std::string prose = prose_of(line);
        if (std::regex_search(prose, round))
            complaints.add(markdown.origin_of(number),
                           "\\(...\\) is LaTeX and would be printed as plain text; write a formula as $...$");
        if (std::regex_search(prose, square))
            complaints.add(markdown.origin_of(number),
                           "\\[...\\] is LaTeX and would be printed as plain text; write a formula on lines of its own "
                           "as $$...$$");
    }
}

}  // namespace dynlab::inline documents
