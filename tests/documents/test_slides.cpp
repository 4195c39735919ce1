// Slides, read back with poppler. Oracles: the layout's own measures, and what the same source says as a page.
#include <gmock/gmock.h>

#include "document_fixture.h"
#include "platform/child_process.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_slides {

using test::inspect_pdf;
using test::PdfContent;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class slides : public DocumentTest {
  protected:
    static std::string header(const std::string& more = "") { return "---\nlayout: slides\n" + more + "---\n\n"; }
    PdfContent pdf(const std::string& text) { return inspect_pdf(make(header() + text, "out.pdf")); }
    std::string complaint(const std::string& text) { return refusal(header() + text, "out.pdf"); }

    std::string information() const {
        ChildOptions child;
        child.command = {"pdfinfo", file("out.pdf").string()};
        return run_child(child, "poppler-utils").output;
    }
};

TEST_F(slides, begin_at_headings_of_the_first_level) {
    const PdfContent content =
        pdf("# Process\n\n<!-- never seen -->\n\nA pump.\n\n## Its motor\n\nSmall.\n\n# Validation\n\nGood.\n");
    ASSERT_EQ(content.pages.size(), 2u);
    EXPECT_THAT(content.pages[0], AllOf(HasSubstr("Process"), HasSubstr("Its motor"), HasSubstr("1/2")));
    EXPECT_THAT(content.pages[0], Not(HasSubstr("never seen")));
    EXPECT_THAT(content.pages[1], AllOf(HasSubstr("Validation"), HasSubstr("Good.")));
    EXPECT_THAT(information(), HasSubstr("453.543 x 255.118 pts"));  // 160 mm by 90 mm
    EXPECT_THAT(information(), AllOf(HasSubstr("dynlab"), Not(HasSubstr("Beamer"))));
}

TEST_F(slides, have_a_title_of_their_own_and_the_headings_of_the_language) {
    const std::string sections = "lang: fr\nsections: |\n  Raw data | Données brutes\n";
    const PdfContent content = inspect_pdf(
        make(header("title: A pump\nsubtitle: And its motor\n" + sections) + "# Raw data\n\nVoilà.\n", "out.pdf"));
    ASSERT_EQ(content.pages.size(), 2u);
    EXPECT_THAT(content.pages[0], AllOf(HasSubstr("A pump"), HasSubstr("And its motor")));
    EXPECT_THAT(content.pages[1], AllOf(HasSubstr("Données brutes"), HasSubstr("A pump"), HasSubstr("2/2")));
}

TEST_F(slides, show_figures_tables_and_code_side_by_side) {
    add_figure("raw", "Raw data", DocumentFormat::kPdf);
    record_.tables["models"] = {{"model", "fit (%)"}, {{"linear", "-70.1"}, {"bent & better", "89.7"}}};
    const PdfContent content = pdf(
        "# Both\n\n::: columns\n::: {.column width=50%}\n![](figure:raw)\n:::\n::: {.column width=48%}\n::: {.table "
        "name=models}\n:::\n:::\n:::\n\n```lua\nlocal x = 1\n```\n\n```{.output}\nprinted {here}\n```\n");
    ASSERT_EQ(content.pages.size(), 1u);
    EXPECT_THAT(content.pages[0], AllOf(HasSubstr("bent & better"), HasSubstr("−70.1"), HasSubstr("local x = 1"),
                                        HasSubstr("printed {here}")));
    EXPECT_THAT(content.pages[0], Not(HasSubstr("Figure"))) << "what has no label has no number";
}

TEST_F(slides, number_what_has_a_label) {
    add_figure("raw", "Raw data", DocumentFormat::kPdf);
    EXPECT_THAT(pdf("# One\n\nSee @fig:raw.\n\n![The data](figure:raw){#fig:raw}\n").pages[0],
                AllOf(HasSubstr("See Figure 1."), HasSubstr("Figure 1. The data")));
}

TEST_F(slides, without_room_are_refused_by_number_and_title) {
    std::string lines;
    for (int i = 0; i < 30; ++i) lines += "- one more line\n";
    const std::string message = complaint("# Process\n\nFine.\n\n# Too much\n\n" + lines);
    EXPECT_THAT(message, AllOf(HasSubstr("Too much"), HasSubstr("slide 2 is "), HasSubstr(" mm")));
    record_.tables["wide"] = {std::vector<std::string>(14, "a wide column"), {}};
    EXPECT_THAT(complaint("# A table\n\n::: {.table name=wide}\n:::\n"),
                HasSubstr("too wide for its place on the slide"));
}

TEST_F(slides, say_what_a_column_wants) {
    EXPECT_THAT(complaint("# One\n\n::: columns\n::: column\ntext\n:::\n:::\n"),
                HasSubstr("a column needs a width in percent"));
    EXPECT_THAT(complaint("# One\n\n::: columns\n::: {.column width=5cm}\ntext\n:::\n:::\n"), HasSubstr("not \"5cm\""));
    EXPECT_THAT(refusal("---\nlayout: poster\n---\n\ntext\n"),
                HasSubstr("\"layout\" must be \"pages\" or \"slides\", not \"poster\""));
}

TEST_F(slides, want_columns_in_their_place) {
    for (const char* text : {"::: columns\ntext\n:::\n", "::: {.column width=40%}\ntext\n:::\n"})
        EXPECT_THAT(complaint(std::string("# One\n\n") + text), HasSubstr("a block ::: columns may contain only"));
}

TEST_F(slides, are_pages_of_text_in_html) {
    const std::string text =
        html(header() +
             "# One\n\n::: columns\n::: {.column width=50%}\nleft\n:::\n::: {.column width=50%}\nright\n:::\n:::\n");
    EXPECT_THAT(text, AllOf(HasSubstr("left"), HasSubstr("right"), HasSubstr("class=\"column\"")));
}

TEST_F(slides, of_a_script_that_stopped_begin_with_the_error) {
    record_.error = RecordedError{Message("no such thing"), "analysis.lua", 3};
    const PdfContent content = pdf("# Process\n\n`fit`{.value}\n");
    ASSERT_EQ(content.pages.size(), 2u);
    EXPECT_THAT(content.pages[0], HasSubstr("no such thing"));
    EXPECT_THAT(content.pages[1], HasSubstr("[fit]"));
}

}  // namespace test_slides
}  // namespace dynlab
