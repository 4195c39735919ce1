#include "course/review/word_diff.h"

#include <fmt/format.h>
#include <re2/re2.h>
#include <algorithm>
#include <dtl/dtl.hpp>
#include <map>
#include <set>

#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

/// A value, an answer and a cell may have one name.
enum class Kind { kValue, kAnswer, kCell };
using Entries = std::map<std::pair<std::string, Kind>, std::pair<std::string, std::string>>;  ///< before and after

void add_entries(const RunRecord& record, std::string std::pair<std::string, std::string>::*side, Entries& entries) {
    for (const auto& [name, value] : record.values) entries[{name, Kind::kValue}].*side = value.text;
    for (const auto& [name, answer] : record.answers) entries[{name, Kind::kAnswer}].*side = answer.json;
    for (const auto& [name, table] : record.tables) {
        std::map<std::string, int> seen;  // rows of the same first cell, and columns of the same header
        for (const std::vector<std::string>& row : table.rows)
            for (std::size_t c = 1; c < row.size(); ++c) {
                const std::string column = c < table.header.size() ? table.header[c] : std::to_string(c + 1);
                std::string entry = fmt::format("{}: {}, {}", name, row[0], column);
                if (const int number = ++seen[entry]; number > 1) entry += fmt::format(" ({})", number);
                entries[{entry, Kind::kCell}].*side = row[c];
            }
    }
}

}  // namespace

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

ValueChanges value_changes(const RunRecord& before, const RunRecord& after) {
    Entries entries;
    add_entries(before, &Entries::mapped_type::first, entries);
    add_entries(after, &Entries::mapped_type::second, entries);
    ValueChanges changes{{}, entries.size()};
    for (const auto& [key, texts] : entries)
        if (texts.first != texts.second) changes.changed.push_back({key.first, texts.first, texts.second});
    return changes;
}

}  // namespace dynlab::inline course
