#include <gmock/gmock.h>

#include "document_fixture.h"

namespace dynlab {
namespace test_cross_references {

using cross_references = DocumentTest;
using testing::HasSubstr;
using testing::Not;

// Oracle of this file: counting by hand.

TEST_F(cross_references, figures_tables_and_equations_are_counted_each_for_itself) {
    add_figure("a", "A", DocumentFormat::kHtml);
    add_figure("b", "B", DocumentFormat::kHtml);
    const std::string text = html(
        "See @fig:b, @eq:two and [@tbl:t; @fig:a]; -@eq:one is -@eq:two.\n\n![](figure:a){#fig:a}\n\n$$ x $$ "
        "{#eq:one}\n\n"
        "$$ unnumbered $$\n\n![](figure:b){#fig:b}\n\nIn $$ y $$ {#eq:two} text.\n\n| a |\n|---|\n| 1 |\n\n: T "
        "{#tbl:t}\n");
    EXPECT_THAT(text, HasSubstr("<a href=\"#fig:b\">Figure 2</a>, <a href=\"#eq:two\">Equation 2</a> and "
                                "<a href=\"#tbl:t\">Table 1</a>, <a href=\"#fig:a\">Figure 1</a>"));
    EXPECT_THAT(text, HasSubstr("<span class=\"number\">(2)</span>"));
    EXPECT_THAT(text, Not(HasSubstr("<span class=\"number\">(3)</span>")));
    EXPECT_THAT(text, HasSubstr("id=\"eq:two\""));
}

TEST_F(cross_references, equations_of_a_solution_are_counted_by_themselves) {
    const std::string text = html(
        "$$ a $$ {#eq:one}\n\n$$ b $$ {#eq:solution-two}\n\n$$ c $$ {#eq:three}\n\n$$ d $$ {#eq:solution-four}\n\n"
        "@eq:solution-two, @eq:three, @eq:solution-four\n");
    EXPECT_THAT(text, HasSubstr(">Equation S1</a>, <a href=\"#eq:three\">Equation 2</a>, "));
    EXPECT_THAT(text, HasSubstr(">Equation S2</a>"));
    EXPECT_THAT(text, HasSubstr("<span class=\"number\">(S2)</span>"));
}

TEST_F(cross_references, french_documents_use_french_words) {
    add_figure("a", "A", DocumentFormat::kHtml);
    const std::string text = html(
        "---\nlang: fr\n---\nVoir @fig:a, @tbl:t, @eq:e.\n\n![](figure:a){#fig:a}\n\n$$ x $$ {#eq:e}\n\n"
        "| a |\n|---|\n| 1 |\n\n: T {#tbl:t}\n\n::: note\nOui.\n:::\n");
    EXPECT_THAT(text, HasSubstr("<html lang=\"fr\">"));
    EXPECT_THAT(text, HasSubstr(">figure 1</a>, ")) << "small, as behind an article";
    EXPECT_THAT(text, HasSubstr(">tableau 1</a>, "));
    EXPECT_THAT(text, HasSubstr(">équation 1</a>"));
    EXPECT_THAT(text, HasSubstr("Figure 1.")) << "a caption begins with a capital";
    EXPECT_THAT(text, HasSubstr("Tableau 1."));
    EXPECT_THAT(text, HasSubstr("Remarque"));
}

TEST_F(cross_references, section_titles_of_the_template_come_in_the_document_s_language) {
    const std::string rules = "sections: |\n  Process | Procédé\n  Raw data | Données brutes\n";
    const std::string body = "---\n# Process {#sec:a}\n\n# Données brutes\n\n# Mine\n\n@sec:a\n";
    const std::string french = html("---\nlang: fr\n" + rules + body);
    EXPECT_THAT(french, HasSubstr(">Procédé</h"));
    EXPECT_THAT(french, HasSubstr(">Données brutes</h"));
    EXPECT_THAT(french, HasSubstr(">Mine</h"));
    EXPECT_THAT(french, HasSubstr("“Procédé”"));
    const std::string english = html("---\nlang: en\n" + rules + body);
    EXPECT_THAT(english, HasSubstr(">Process</h"));
    EXPECT_THAT(english, HasSubstr(">Raw data</h"));
}

TEST_F(cross_references, sections_are_referred_to_by_number_or_title) {
    EXPECT_THAT(html("# First {#sec:a}\n\n@sec:a\n"), HasSubstr("<a href=\"#sec:a\">“First”</a>"));
    const std::string text = html(
        "---\nnumbersections: true\n---\n# One\n\n## Two {#sec:two}\n\n## Three {#sec:three}\n\n# Four\n\n"
        "## Five {#sec:five}\n\n@sec:three, @sec:five\n");
    EXPECT_THAT(text, HasSubstr("<a href=\"#sec:three\">Section 1.2</a>, <a href=\"#sec:five\">Section 2.1</a>"));
}

TEST_F(cross_references, a_dangling_reference_is_an_error_with_line_and_suggestion) {
    EXPECT_THAT(refusal("$$ x $$ {#eq:model}\n\nSee @eq:modle.\n"),
                HasSubstr("report.md:3: the cross-reference @eq:modle has no target: {#eq:modle} is missing; did you "
                          "mean \"eq:model\"?"));
    EXPECT_THAT(refusal("See @figure:raw.\n"), HasSubstr("must start with @fig:, @tbl:, @eq: or @sec:"));
}

TEST_F(cross_references, a_draft_shows_question_marks_where_something_is_missing) {
    record_.values["fit"] = {93.2, "93.2"};
    const std::string text =
        "See @fig:raw and `fti`{.value}, after [@ljung].\n\n![](figure:raw){#fig:new}\n\n::: {.table "
        "name=models}\n:::\n";
    const std::string gap = "<strong>?\?</strong>";
    const auto [gaps, page] = draft(text);
    EXPECT_THAT(gaps, HasSubstr("report.md:1: the cross-reference @fig:raw has no target"));
    EXPECT_THAT(gaps, HasSubstr("report.md:1: the script reported no value \"fti\"; did you mean \"fit\"?"));
    EXPECT_THAT(gaps, HasSubstr("report.md:1: @ljung cites literature"));
    EXPECT_THAT(gaps, HasSubstr("report.md:3: the script reported no figure \"raw\""));
    EXPECT_THAT(gaps, HasSubstr("report.md:5: the script reported no table \"models\""));
    EXPECT_THAT(page, HasSubstr("See " + gap + " and " + gap + ", after " + gap + "."));
    EXPECT_THAT(page, HasSubstr("<p><strong>?? [raw]</strong></p>"));
    EXPECT_THAT(page, HasSubstr("<p><strong>?? [models]</strong></p>"));
    EXPECT_THAT(refusal(text), HasSubstr("has no target")) << "no draft was asked for";
    EXPECT_THROW(draft("See @fig:raw and $ \\inputt $.\n"), DocumentError) << "what cannot be set";
    const std::string missing = draft("See @fig:raw.\n\n![](figure:raw){#fig:raw}\n").first;
    EXPECT_THAT(missing, HasSubstr("report.md:1: the cross-reference @fig:raw has no target: the label {#fig:raw} does "
                                   "not belong to an element that is shown"));
    const auto [none, whole] = draft("The fit is `fit`{.value}.\n");
    EXPECT_EQ(none, "");
    EXPECT_THAT(whole, Not(HasSubstr(gap)));
}

TEST_F(cross_references, a_label_used_twice_is_an_error_at_the_second_place) {
    EXPECT_THAT(refusal("$$ x $$ {#eq:m}\n\n$$ y $$ {#eq:m}\n"),
                HasSubstr("report.md:3: the label \"eq:m\" is used twice"));
    EXPECT_THAT(refusal("# A {#sec:a}\n\n# B {#sec:a}\n"), HasSubstr("report.md:3: "));
}

TEST_F(cross_references, a_label_of_the_wrong_kind_is_an_error) {
    EXPECT_THAT(refusal("$$ x $$ {#fig:m}\n"), HasSubstr("report.md:1: the label \"fig:m\" must start with \"eq:\""));
}

TEST_F(cross_references, what_is_no_reference_stays_as_it_was_written) {
    EXPECT_THAT(html("Write to me@example.org or \\@someone.\n"), HasSubstr("@someone."));
}

}  // namespace test_cross_references
}  // namespace dynlab
