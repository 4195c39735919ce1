#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "course/review/word_diff.h"

namespace dynlab::test {
namespace test_word_diff {
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Texts = std::vector<std::string>;

std::string joined(const std::vector<ReportWord>& words) {
    std::string text;
    for (const ReportWord& word : words) text += (text.empty() ? "" : " ") + word.text;
    return text;
}

/// "=a b", "-c", "+d e".
Texts pieces_of(const std::string& before, const std::string& after) {
    Texts pieces;
    for (const MarkedWords& piece : word_diff(words_of_markdown(before), words_of_markdown(after)).pieces)
        pieces.push_back(piece.mark + joined(piece.words));
    return pieces;
}

/// A page of lines; "# ..." is a heading, "" leaves a gap.
DocumentText page_of(const Texts& lines) {
    DocumentText text;
    double top = 70;
    for (std::string words : lines) {
        if (words.empty()) top += 10;
        if (words.empty()) continue;
        const bool heading = words.starts_with("# ");
        if (heading) words.erase(0, 2);
        TextLine line;
        line.size = heading ? 14 : 11;
        line.top = top, line.bottom = top + line.size, top += line.size + 2;
        for (const ReportWord& word : words_of_markdown(words)) {
            line.words.push_back(word.text);
            text.words.push_back({word.text, 1, text.lines.size(), line.words.size() == 1});
        }
        if (heading) text.headings.push_back({1, line.size, line.text(), text.lines.size(), text.lines.size()});
        text.lines.push_back(std::move(line));
    }
    return text;
}

// oracle: the two sentences, read by a person
TEST(word_diff, marks_deleted_and_inserted_words) {
    EXPECT_THAT(
        pieces_of("The sampling time is 0.05 s. It is short.", "The sampling time is 0.01 s. It is very short."),
        ElementsAre("=The sampling time is", "-0.05", "+0.01", "=s. It is", "+very", "=short."));
    EXPECT_THAT(pieces_of("a b", "a b"), ElementsAre("=a b"));
    EXPECT_THAT(pieces_of("a b", ""), ElementsAre("-a b"));
    EXPECT_THAT(pieces_of("", ""), IsEmpty());
}

// oracle: the counts by hand
TEST(word_diff, share_counts_the_words_of_only_one_version) {
    const WordDiff diff = word_diff(words_of_markdown("a b c d"), words_of_markdown("a x c d e f"));
    EXPECT_EQ(diff.before, 4u);
    EXPECT_EQ(diff.after, 6u);
    EXPECT_EQ(diff.deleted, 1u);
    EXPECT_EQ(diff.inserted, 3u);
    EXPECT_DOUBLE_EQ(diff.share(), 0.4);
    EXPECT_EQ(word_diff({}, {}).share(), 0);
    EXPECT_EQ(word_diff({}, words_of_markdown("a")).share(), 1);
}

// oracle: the definition: pieces without '+' are the first text, pieces without '-' the second
TEST(word_diff, leads_from_the_first_text_to_the_second) {
    std::mt19937 random(7);
    for (int repeat = 0; repeat < 300; ++repeat) {
        const auto some_words = [&] {
            std::vector<ReportWord> words(random() % 40);
            for (ReportWord& word : words) word.text = std::string(1, static_cast<char>('a' + random() % 4));
            return words;
        };
        const std::vector<ReportWord> before = some_words(), after = some_words();
        std::vector<ReportWord> first, second;
        for (const MarkedWords& piece : word_diff(before, after).pieces) {
            if (piece.mark != '+') first.insert(first.end(), piece.words.begin(), piece.words.end());
            if (piece.mark != '-') second.insert(second.end(), piece.words.begin(), piece.words.end());
        }
        ASSERT_EQ(joined(first), joined(before));
        ASSERT_EQ(joined(second), joined(after));
    }
}

// oracle: texts without a word in common, as long as texts may be
TEST(word_diff, ends_for_long_unrelated_texts) {
    std::vector<ReportWord> before(kMaxReportWords), after(kMaxReportWords);
    for (std::size_t i = 0; i < kMaxReportWords; ++i)
        before[i].text = "a" + std::to_string(i), after[i].text = "b" + std::to_string(i);
    EXPECT_EQ(word_diff(before, after).share(), 1);
}

// oracle: the Markdown, read by a person
TEST(word_diff, words_of_markdown_know_their_section) {
    const std::vector<ReportWord> words = words_of_markdown(
        "start\n\n# 1 Data\\_1\n\nA *word*.\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n```\n# code\n```\nend\n");
    Texts texts;
    for (const ReportWord& word : words) texts.push_back(word.section + "/" + word.text);
    EXPECT_THAT(texts, ElementsAre("/start", "1 Data_1/1", "1 Data_1/Data_1", "1 Data_1/A", "1 Data_1/*word*.",
                                   "1 Data_1/a", "1 Data_1/b", "1 Data_1/1", "1 Data_1/2", "1 Data_1/```",
                                   "1 Data_1/code", "1 Data_1/```", "1 Data_1/end"));
    EXPECT_EQ(words_of_markdown("#").size(), 0u);
}

// oracle: the page, read by a person
TEST(word_diff, words_of_pages_know_section_and_page) {
    const std::vector<ReportWord> words = words_of_pdf(page_of({"before it", "# Validation", "the fit"}));
    ASSERT_EQ(words.size(), 5u);
    EXPECT_EQ(words[1].section, "");
    EXPECT_EQ(words[4].section, "Validation");
    EXPECT_EQ(words[4].page, 1);
}

// oracle: the page, read by a person
TEST(word_diff, reviews_are_split_into_headings_paragraphs_and_items) {
    Texts blocks;
    for (const ReviewBlock& block : blocks_of_review(page_of({"# Data", "One paragraph", "goes on.", "", "Another.",
                                                              "• first", "goes on", "• second", "# Scores", "3"})))
        blocks.push_back((block.heading ? "# " : "") + block.text);
    EXPECT_THAT(blocks, ElementsAre("# Data", "One paragraph goes on.", "Another.", "• first goes on", "• second",
                                    "# Scores", "3"));
    EXPECT_THAT(blocks_of_review({}), IsEmpty());
}

// oracle: the two runs, compared by hand
TEST(word_diff, values_answers_and_cells_are_compared_by_name) {
    RunRecord before, after;
    before.values = {{"fit", {80, "80.0"}}, {"kept", {2, "2"}}, {"old", {{}, "text"}}};
    after.values = {{"fit", {90, "90.0"}}, {"kept", {2, "2"}}};
    before.answers["K"] = {"number", "8.5"}, after.answers["K"] = {"number", "8.6"};
    before.tables["models"] = {{"model", "fit"}, {{"ARX", "81"}, {"ARX", "82"}}};
    after.tables["models"] = {{"model", "fit"}, {{"ARX", "81"}, {"ARX", "93"}, {"SRIVC", "95"}}};
    const ValueChanges changes = value_changes(before, after);
    Texts texts;
    for (const ValueChange& change : changes.changed)
        texts.push_back(change.name + ": " + change.before + " -> " + change.after);
    EXPECT_THAT(texts, ElementsAre("K: 8.5 -> 8.6", "fit: 80.0 -> 90.0", "models: ARX, fit (2): 82 -> 93",
                                   "models: SRIVC, fit:  -> 95", "old: text -> "));
    EXPECT_EQ(changes.compared, 7u);
}

// oracle: the two runs: nothing differs but the answer, the second row, which moved down, and the second column
TEST(word_diff, entries_of_the_same_name_are_compared_each_with_its_own) {
    RunRecord before, after;
    before.values = {{"K", {8, "8"}}, {"t: A, fit", {1, "1"}}};
    after.values = before.values;
    before.answers["K"] = {"number", "8"}, after.answers["K"] = {"number", "9"};
    before.tables["t"] = {{"model", "fit", "fit"}, {{"A", "", "2"}, {"A", "3", "4"}}};
    after.tables["t"] = {{"model", "fit", "fit"}, {{"B", "0", "0"}, {"A", "", "2"}, {"A", "3", "5"}}};
    Texts texts;
    for (const ValueChange& change : value_changes(before, after).changed)
        texts.push_back(change.name + ": " + change.before + " -> " + change.after);
    EXPECT_THAT(texts, ElementsAre("K: 8 -> 9", "t: A, fit (4): 4 -> 5", "t: B, fit:  -> 0", "t: B, fit (2):  -> 0"));
}

}  // namespace test_word_diff
}  // namespace dynlab::test
