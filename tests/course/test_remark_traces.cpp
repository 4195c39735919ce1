#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/review/remark_traces.h"
#include "course/review/text_blocks.h"
#include "documents/document_rules.h"

namespace dynlab::test {
namespace test_remark_traces {
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Texts = std::vector<std::string>;

/// Lines on a page as a reader sees them; a line in capitals "# ..." is a heading, "" leaves a gap.
DocumentText page_of(const Texts& lines) {
    DocumentText text;
    text.width = 595, text.height = 842, text.body_size = 11;
    double top = 70;
    for (const std::string& words : lines) {
        if (words.empty()) {
            top += 10;
            continue;
        }
        TextLine line;
        const bool heading = words.starts_with("# ");
        line.size = heading ? 14 : 11;
        line.left = 72, line.top = top, line.bottom = top + line.size, top += line.size + 2;
        for (std::size_t from = heading ? 2 : 0; from < words.size();) {
            const std::size_t end = std::min(words.find(' ', from), words.size());
            line.words.push_back(words.substr(from, end - from));
            from = end + 1;
        }
        line.right = 72 + 5.5 * static_cast<double>(words.size());
        if (heading) text.headings.push_back({1, line.size, line.text(), text.lines.size(), text.lines.size()});
        text.lines.push_back(std::move(line));
    }
    return text;
}

const char kFirst[] =
    "# R\n\n## 1 Process\n\nThe trolley moves along a rail. A motor drives it by a belt. The pendulum hangs below "
    "it.\n\n"
    "## 2 Design\n\nThe sampling time is 0.05 s. The record lasts one minute.\n\n"
    "**Figure 1.** Position of the trolley\n\n## 3 Validation\n\nThe model is good.\n";

Texts traced(const std::string& final_text, const std::string& remark) {
    const ReportText first = report_text_of_markdown(kFirst);
    const TextChanges changes = text_changes(first, report_text_of_markdown(final_text));
    Texts found;
    for (const RemarkMatch& trace : RemarkMatcher(first, changes).traces({"", remark, 1, true})) {
        std::string why = changes.passages[trace.passage].text_of('+') + " <";
        for (const std::string& place : trace.places) why += " " + place;
        for (const std::string& word : trace.words) why += " " + word;
        found.push_back(why);
    }
    return found;
}

std::string replaced_once(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
}

// oracle: the sentence, read aloud; a caption stands behind a whole sentence or in another size
TEST(remark_traces, a_sentence_goes_on_in_a_line_that_begins_with_a_figure_s_number) {
    const auto blocks = [](const DocumentText& text) {
        Texts texts;
        for (const TextBlock& block : text_blocks(text)) texts.push_back(block.text);
        return texts;
    };
    const std::string first = "It would help the reader much to plot the angle beside the position in",
                      second = "Figure 1. Then both would be seen.";
    EXPECT_THAT(blocks(page_of({first, second})), ElementsAre(first + " " + second));
    EXPECT_THAT(blocks(page_of({"It helps the reader much to see the position of it all.", "Figure 1. Position."})),
                ElementsAre("It helps the reader much to see the position of it all.", "Figure 1. Position."));
    DocumentText smaller = page_of({"time (s)", "Figure 1. Position."});
    smaller.lines[0].size = 8;
    EXPECT_THAT(blocks(smaller), ElementsAre("time (s)", "Figure 1. Position."));
}

// oracle: forms of one word, and words that only begin alike
TEST(remark_traces, knows_forms_of_a_word) {
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{{"validate", "validation"},
                                                                               {"sampling", "sampled"},
                                                                               {"residual", "residuals"},
                                                                               {"pole", "poles"},
                                                                               {"estimate", "estimation"},
                                                                               {"noise", "noise"}})
        EXPECT_TRUE(words_agree(a, b) && words_agree(b, a)) << a << " " << b;
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
             {"constant", "constraint"}, {"model", "mode"}, {"12", "120"}, {"position", "possible"}, {"", "s"}})
        EXPECT_FALSE(words_agree(a, b) || words_agree(b, a)) << a << " " << b;
}

// oracle: a sentence that answers the remark came, and one that does not
TEST(remark_traces, finds_the_change_that_shares_uncommon_words) {
    const std::string justified =
        replaced_once(kFirst, "0.05 s.", "0.05 s, twenty times below the fastest time constant.");
    EXPECT_THAT(traced(justified,
                       "The choice of the sampling time is not justified: how does it compare with the time "
                       "constants?"),
                SizeIs(1));
    EXPECT_THAT(traced(justified, "How is the belt tensioned?"), IsEmpty());
    EXPECT_THAT(traced(justified, "It would be better to describe everything in more detail, please."), IsEmpty());
    const std::string white = replaced_once(kFirst, "The model is good.", "Residuals are white.");
    EXPECT_THAT(traced(white, "Nobody looked at a residual."), ElementsAre("Residuals are white. < residual"));
}

// oracle: the numbers that the remark names
TEST(remark_traces, finds_the_change_at_a_named_place) {
    const std::string caption = replaced_once(kFirst, "Position of the trolley", "Position and angle");
    EXPECT_THAT(traced(caption, "In fig. 1 something is odd."), ElementsAre("and angle < Figure 1"));
    EXPECT_THAT(traced(caption, "La figure 1 est petite."), SizeIs(1));
    EXPECT_THAT(traced(caption, "In Figure 12 something is odd."), IsEmpty());
    EXPECT_THAT(traced(caption, "In Table 1 something is odd."), IsEmpty());
    EXPECT_THAT(traced(caption, "The trolley is heavy."), IsEmpty());  // one word in common is chance
    const std::string grown = replaced_once(kFirst, "one minute.", "one minute. Nothing else was tried out.");
    EXPECT_THAT(traced(grown, "Section 2 is thin."), SizeIs(1));
    EXPECT_THAT(traced(grown, "Section 3 is thin."), IsEmpty());
    EXPECT_THAT(traced(std::string(kFirst) + "\n## 4 Appendix\n\nA lead compensator.\n", "Section 3 is thin."),
                IsEmpty());
}

// oracle: the page, read by a person
TEST(remark_traces, splits_reviews_into_remarks) {
    const DocumentText page =
        page_of({"# Data and experiments", "The experiments can be repeated by anybody who reads the whole of sec-",
                 "tion two of it.", "", "The input is not described.", "",
                 "Please mend:", "• the units of all the figures that are shown", "• 2 axes", "# 4. Greatest strength",
                 "The physics.", "# Scores", "Data 4", "# Suggestions", "1. Shorten it.", "2. Add poles."});
    Texts found;
    for (const Remark& remark : remarks_in(page, review_form()))
        found.push_back(remark.question + ": " + remark.text + (remark.wants_answer ? "" : " (praise)"));
    EXPECT_THAT(found,
                ElementsAre("Data and experiments: The experiments can be repeated by anybody who reads the whole "
                            "of section two of it.",
                            "Data and experiments: The input is not described.",
                            "Data and experiments: Please mend: the units of all the figures that are shown",
                            "Data and experiments: 2 axes", "4. Greatest strength: The physics. (praise)",
                            "Suggestions: 1. Shorten it.", "Suggestions: 2. Add poles."));
    EXPECT_THAT(remarks_in(DocumentText(), review_form()), IsEmpty());
}

// oracle: the page, read by a person
TEST(remark_traces, leaves_the_scales_of_figures_out) {
    const ReportText text =
        report_text_of_pdf(page_of({"# 2 Raw data", "0 5 10 15 20 25 30 time (s)", "Figure 3. What was measured", "",
                                    "It moves. G = 2/3", "", "SRIVC 93.2 3", "", "\u22127.4 \u22128.8"}));
    Texts sentences;
    for (const ReportSentence& sentence : text.sentences) sentences.push_back(sentence.text);
    EXPECT_THAT(sentences,
                ElementsAre("Raw data", "Figure 3. What was measured", "It moves.", "G = 2/3", "SRIVC 93.2 3"));
    EXPECT_EQ(text.sections.back().number, "2");
}

// oracle: the form that students get
TEST(remark_traces, knows_the_headings_of_the_form) {
    const DocumentRules rules =
        document_rules(read_template(std::string(DYNLAB_SOURCE_DIR) + "/report_templates/peer_review.md"));
    const auto holds = [&](const Texts& titles) {
        return std::any_of(rules.sections.begin(), rules.sections.end(), [&](const SectionRule& rule) {
            return titles == Texts{rule.english, rule.french};
        });
    };
    EXPECT_TRUE(holds(review_form().praise));
    EXPECT_TRUE(holds(review_form().scores));
}

// oracle: it comes to an end; the numbers are long and the texts are nonsense
TEST(remark_traces, bears_hostile_texts) {
    const std::string digits(200'000, '7'), dots(200'000, '.');
    std::string dotted;
    for (int i = 0; i < 50'000; ++i) dotted += "1.";
    for (const std::string& text :
         {"Figure " + digits, "Section " + dotted, dots, std::string("\xFF\xFE \xF0\x9F"), std::string(300'000, '$')}) {
        EXPECT_THAT(traced(std::string(kFirst) + "\n" + text + "\n", text), SizeIs(::testing::Le(3u)));
        report_text_of_markdown("## " + text + "\n" + text + "\n| " + text + " |\n");
    }
}

}  // namespace test_remark_traces
}  // namespace dynlab::test
