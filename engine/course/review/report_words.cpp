#include "course/review/report_words.h"

#include <re2/re2.h>

#include <algorithm>
#include <set>

#include "documents/text_lines.h"

namespace dynlab::inline course {

std::vector<ReportWord> words_of_markdown(const std::string& markdown) {
    static const RE2 escape(R"(\\([[:punct:]]))", RE2::Latin1);
    std::vector<ReportWord> words;
    std::string section;
    FencedCode code;
    for (std::string line : lines_of(markdown)) {
        const bool prose = !code.holds(line);
        if (prose) RE2::GlobalReplace(&line, escape, R"(\1)");
        if (prose && line.starts_with('#'))
            section = trimmed(line.substr(std::min(line.find_first_not_of('#'), line.size())));
        for (std::string& word : words_between_spaces(line))
            if (word.find_first_not_of("|:+=-#") != std::string::npos && words.size() < kMaxReportWords)
                words.push_back({std::move(word), section, 0});
    }
    return words;
}

std::vector<ReportWord> words_of_pdf(const DocumentText& text) {
    std::vector<ReportWord> words;
    std::string section;
    auto heading = text.headings.begin();
    for (const TextWord& word : text.words) {
        for (; heading != text.headings.end() && heading->first_line <= word.line; ++heading) section = heading->text;
        if (words.size() < kMaxReportWords) words.push_back({word.text, section, word.page});
    }
    return words;
}

std::vector<ReviewBlock> blocks_of_review(const DocumentText& review) {
    constexpr double kParagraphGap = 0.6;  // of a line's size
    static const std::set<std::string> bullets = {"•", "–", "-", "*", "◦", "·"};
    std::set<std::size_t> heading_lines;
    for (const Heading& heading : review.headings)
        for (std::size_t i = heading.first_line; i <= heading.last_line; ++i) heading_lines.insert(i);
    std::vector<ReviewBlock> blocks;
    for (std::size_t i = 0; i < review.lines.size(); ++i) {
        const TextLine& line = review.lines[i];
        const bool heading = heading_lines.contains(i);
        const bool new_block = blocks.empty() || blocks.back().heading != heading || bullets.contains(line.words[0]) ||
                               (line.page == review.lines[i - 1].page &&
                                (line.top - review.lines[i - 1].bottom > kParagraphGap * line.size ||
                                 line.bottom < review.lines[i - 1].top));
        if (new_block) blocks.push_back({{}, heading});
        blocks.back().text += (blocks.back().text.empty() ? "" : " ") + line.text();
    }
    return blocks;
}

}  // namespace dynlab::inline course
