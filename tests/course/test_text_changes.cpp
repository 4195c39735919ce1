#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "course/review/edit_script.h"
#include "course/review/text_changes.h"
#include "course/review/value_changes.h"

namespace dynlab::test {
namespace test_text_changes {
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Words = std::vector<std::string>;

constexpr char kFirst[] =
    "# A report\n\n*subtitle*\n\n## 1\u2002Design\n\nThe input is a PRBS of 2 V. The sampling time is\n0.05 s. It is "
    "short.\n\n"
    "$$ G(s) = \\frac{K}{1+Ts}. Then $$ (1)\n\n![Raw](x/p.svg)\n\n**Figure 1.** Raw data\n\n## 2\u2002Validation\n\n"
    "| model | fit |\n|:---|---:|\n| ARX | 81 |\n| SRIVC | 93 |\n\n: **Table 1.** Fits.\n\n"
    "The fit is 93 %. The model is good.\n\n## 3\u2002Old things\n\nThis section goes away.\n";
constexpr char kFinal[] =
    "# A report\n\n*subtitle*\n\n## 1\u2002Design\n\nThe input is a PRBS of 2 V. The sampling time is\n0.01 s. It is "
    "short.\n\n"
    "$$ G(s) = \\frac{K}{1+Ts}. Then $$ (1)\n\n![Raw](x/p.svg)\n\n**Figure 1.** Raw data\n\n## 2\u2002Validation and "
    "residuals\n\n"
    "| model | fit |\n|:---|---:|\n| ARX | 81 |\n| SRIVC | 94 |\n\n: **Table 1.** Fits.\n\n"
    "The fit is 93 %. The residuals are white.\n\n## 3\u2002New things\n\nAltogether other words stand here instead.\n";

Words texts_of(const ReportText& text) {
    Words texts;
    for (const ReportSentence& sentence : text.sentences) texts.push_back(sentence.text);
    return texts;
}

std::string replaced_once(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The length of the longest common subsequence, by its definition.
std::size_t longest_common(const Words& a, const Words& b) {
    std::vector<std::vector<std::size_t>> length(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t k = 1; k <= b.size(); ++k)
            length[i][k] =
                a[i - 1] == b[k - 1] ? length[i - 1][k - 1] + 1 : std::max(length[i - 1][k], length[i][k - 1]);
    return length[a.size()][b.size()];
}

/// How many elements the edit script keeps, which must lead from one list to the other: its definition.
std::size_t kept_by_edit_script(const Words& before, const Words& after) {
    std::size_t b = 0, a = 0, kept = 0;
    for (const char step : edit_script(before, after)) {
        if (step == '=') {
            EXPECT_EQ(before.at(b), after.at(a));
            ++kept;
        }
        b += step != '+', a += step != '-';
    }
    EXPECT_EQ(b, before.size());
    EXPECT_EQ(a, after.size());
    return kept;
}

// oracle: the definition of an edit script, and the longest common subsequence for its being the shortest
// oracle: what a reader sees of it
TEST(text_changes, signs_of_a_heading_without_words_are_none) {
    const ReportText text = report_text_of_markdown("#\n\n## \n\nIt moves.\n\n###\n");
    ASSERT_EQ(text.sentences.size(), 1u);
    EXPECT_EQ(text.sentences.front().text, "It moves.");
}

TEST(text_changes, edit_scripts_lead_from_one_list_to_the_other) {
    std::mt19937 random(7);
    for (int round = 0; round < 40; ++round) {
        Words before, after;
        for (Words* list : {&before, &after})
            for (std::size_t i = random() % 30; i > 0; --i)
                list->push_back(std::string(1, static_cast<char>('a' + random() % 4)));
        EXPECT_EQ(kept_by_edit_script(before, after), longest_common(before, after));
    }
}

// oracle: the definition of an edit script; two lists that differ in more than is searched for at once
TEST(text_changes, edit_scripts_of_long_lists_lead_from_one_to_the_other) {
    Words before, after;
    for (int i = 0; i < 9000; ++i) {
        before.push_back((i % 3 == 0 ? "both " : "old ") + std::to_string(i));
        after.push_back((i % 3 == 0 ? "both " : "new ") + std::to_string(i));
    }
    EXPECT_EQ(kept_by_edit_script(before, after), 3000u);
    EXPECT_EQ(edit_script({}, {"a", "b"}), "++");
    EXPECT_EQ(edit_script({"a", "b"}, {"b"}), "-=");
    EXPECT_EQ(edit_script({}, {}), "");
}

// oracle: what a reader takes for the same
TEST(text_changes, what_a_line_break_does_is_no_change) {
    EXPECT_EQ(comparison_key("pre-processing of data"), comparison_key("preprocessing  of\u00A0data"));
    EXPECT_EQ(comparison_key("the plant’s “gain”"), comparison_key("the plant's \"gain\""));
    EXPECT_EQ(comparison_key("e\uFB03cient"), comparison_key("efficient"));
    EXPECT_NE(comparison_key("K = -2.0"), comparison_key("K = 2.0"));
    EXPECT_NE(comparison_key("0.05 s"), comparison_key("0.5 s"));
    EXPECT_EQ(comparison_key("a\nb").find('\n'), std::string::npos);
}

// oracle: read by a person
TEST(text_changes, splits_paragraphs_into_sentences) {
    EXPECT_THAT(
        sentences_of("See Fig. 3, i.e. the step. It takes 0.05 s. The gain is 2 V. So K. Smith says. Is it? Yes!"),
        ElementsAre("See Fig. 3, i.e. the step.", "It takes 0.05 s.", "The gain is 2 V.", "So K. Smith says.", "Is it?",
                    "Yes!"));
    EXPECT_THAT(sentences_of("We use $x = 1. Then y$ here. End"), ElementsAre("We use $x = 1. Then y$ here.", "End"));
    EXPECT_THAT(sentences_of("1. First. Second"), ElementsAre("1. First.", "Second"));
    EXPECT_THAT(sentences_of("Figure 2. The caption"), ElementsAre("Figure 2. The caption"));
    EXPECT_THAT(sentences_of("Costs 5 $ today. Really"), ElementsAre("Costs 5 $ today.", "Really"));
    EXPECT_THAT(sentences_of("Il vaut 3. Été comme hiver"), ElementsAre("Il vaut 3.", "Été comme hiver"));
    EXPECT_THAT(sentences_of(""), IsEmpty());
}

// oracle: the Markdown above, read by a person
TEST(text_changes, reads_the_markdown_of_reports) {
    const ReportText text = report_text_of_markdown(kFirst);
    ASSERT_EQ(text.sections.size(), 4u);
    EXPECT_EQ(text.sections[1].number, "1");
    EXPECT_EQ(text.sections[1].title, "Design");
    EXPECT_THAT(texts_of(text),
                ElementsAre("subtitle", "Design", "The input is a PRBS of 2 V.", "The sampling time is 0.05 s.",
                            "It is short.", "$$ G(s) = \\frac{K}{1+Ts}. Then $$ (1)", "Figure 1. Raw data",
                            "Validation", "| model | fit |", "| ARX | 81 |", "| SRIVC | 93 |", "Table 1. Fits.",
                            "The fit is 93 %.", "The model is good.", "Old things", "This section goes away."));
    EXPECT_EQ(text.sentences[10].part_of, "Table 1. Fits.");
    EXPECT_EQ(text.sentences[12].part_of, "");
}

// oracle: the differences of the two texts above, by hand
TEST(text_changes, finds_known_differences) {
    const TextChanges changes = text_changes(report_text_of_markdown(kFirst), report_text_of_markdown(kFinal));
    ASSERT_EQ(changes.passages.size(), 4u);
    const Passage& edited = changes.passages[0];
    EXPECT_EQ(edited.text_of('-'), "0.05");
    EXPECT_EQ(edited.text_of('+'), "0.01");
    EXPECT_EQ(edited.text_of('='), "The sampling time is s.");
    EXPECT_EQ(edited.section, "1 Design");
    EXPECT_THAT(edited.numbers_before, ElementsAre("1"));
    EXPECT_EQ(edited.lead_in, "The input is a PRBS of 2 V.");
    EXPECT_EQ(changes.passages[1].text_of('+'), "and residuals");
    EXPECT_EQ(changes.passages[2].text_before, "| SRIVC | 93 | Table 1. Fits.");
    EXPECT_THAT(changes.passages[3].numbers_before, ElementsAre("2", "3"));
    ASSERT_EQ(changes.sections.size(), 5u);
    EXPECT_FALSE(changes.sections[1].renamed());
    // Words of Design: 8 + 6 + 3 + 7 + 4 in both; one went, one came.
    EXPECT_EQ(changes.sections[1].words_before, 28);
    EXPECT_DOUBLE_EQ(changes.sections[1].share, 2.0 / 56);
    EXPECT_TRUE(changes.sections[2].renamed());
    EXPECT_EQ(*changes.sections[2].before, "2 Validation");
    EXPECT_EQ(*changes.sections[2].after, "2 Validation and residuals");
    EXPECT_EQ(*changes.sections[3].after, "3 New things");
    EXPECT_FALSE(changes.sections[3].before);
    EXPECT_EQ(*changes.sections[4].before, "3 Old things");
    EXPECT_FALSE(changes.sections[4].after);
}

// oracle: only the new figure and the new sentence are new
TEST(text_changes, another_number_or_place_is_no_change) {
    const std::string head = "# R\n\n## A\n\n", rest = " shows the data very well. See (Figure 2), too.\n\n";
    const std::string first = head + "**Figure 1.** The data\n\nFigure 1" + rest +
                              "**Figure 2.** The fit\n\nThis sentence wanders about. So.\n";
    const std::string final =
        head + "This sentence wanders about.\n\n**Figure 1.** All new\n\n**Figure 2.** The data\n\nFigure 2" +
        " shows the data very well. See (Figure 3), too.\n\n" + "**Figure 3.** The fit\n\nSo. Quite new.\n";
    const TextChanges changes = text_changes(report_text_of_markdown(first), report_text_of_markdown(final));
    Words added;
    for (const Passage& passage : changes.passages) {
        added.push_back(passage.text_of('+'));
        EXPECT_EQ(passage.text_of('-'), "");
    }
    EXPECT_THAT(added, ElementsAre("Figure 1. All new", "Quite new."));
    EXPECT_EQ(changes.moved, 1);
    EXPECT_THAT(changes.renumbered, ElementsAre(std::pair<std::string, std::string>("Figure 1", "Figure 2"),
                                                std::pair<std::string, std::string>("Figure 2", "Figure 3")));
    const std::string wrong = replaced_once(final, "See (Figure 3)", "See (Figure 1)");
    EXPECT_EQ(text_changes(report_text_of_markdown(first), report_text_of_markdown(wrong)).passages.size(), 3u);
}

// oracle: the definition
TEST(text_changes, equal_texts_have_none_and_strange_ones_all) {
    const ReportText first = report_text_of_markdown(kFirst);
    const TextChanges none = text_changes(first, first);
    EXPECT_THAT(none.passages, IsEmpty());
    EXPECT_EQ(none.share, 0);
    EXPECT_EQ(text_changes(ReportText{{{}}, {}}, first).share, 1);
    EXPECT_EQ(text_changes(first, report_text_of_markdown("")).share, 1);
    EXPECT_EQ(text_changes(report_text_of_markdown(""), report_text_of_markdown("")).share, 0);
}

// oracle: by hand
TEST(text_changes, compares_the_values_of_run_records) {
    const auto before = shown_record(
        R"({"values": {"fit": {"text": "80.0", "number": 80}, "old": {"text": "a"}, "same": {"text": "1.00", "number": 1},
                       "zero": {"text": "0", "number": 0}, "word": {"text": "good"}},
            "tables": {"m": {"header": ["model", "fit"], "rows": [["ARX", "81.0"], ["OE", "90"]]}}})");
    const auto after = shown_record(
        R"({"values": {"fit": {"text": "90.0", "number": 90}, "same": {"text": "1.00", "number": 1.0000001},
                       "zero": {"text": "2", "number": 2}, "word": {"text": "bad"}, "young": {"text": "7", "number": 7}},
            "tables": {"m": {"header": ["model", "fit"], "rows": [["OE", "45"], ["ARX", "81.0"]]}}})");
    const ValueChanges changes = value_changes(before.value(), after.value());
    EXPECT_EQ(changes.compared, 8);
    Words shown;
    for (const ValueChange& c : changes.changed)
        shown.push_back(c.name + "|" + c.before + "|" + c.after + "|" + c.change);
    EXPECT_THAT(shown, ElementsAre("fit|80.0|90.0|+12.5 %", "m: OE, fit|90|45|-50 %", "old|a||gone",
                                   "word|good|bad|other text", "zero|0|2|from zero", "young||7|new"));
    for (const char* strange :
         {"[]", "3", R"({"values": 3, "tables": [1]})", R"({"tables": {"m": {"header": {}, "rows": {}}}})",
          R"({"values": {"a": []}, "tables": {"m": {"rows": [[], 3, [1, null]]}}})"})
        EXPECT_THAT(value_changes(shown_record(strange).value_or(ShownRecord()), ShownRecord()).changed.size(),
                    ::testing::Le(1u));
}

}  // namespace test_text_changes
}  // namespace dynlab::test
