// Oracle: what a reader sees, in the HTML that Pandoc writes and in the text poppler reads back; lines counted by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "document_fixture.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_literature {

using test::inspect_pdf;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class literature : public DocumentTest {
  protected:
    literature() {
        write("books.bib",
              "@book{ljung1999, author={Ljung, Lennart}, title={System Identification}, publisher={Prentice Hall}, "
              "year={1999}}\n@book{young2011, author={Young, Peter C.}, title={Recursive Estimation}, year={2011}}\n");
    }
    const std::string header_ = "---\nlang: en\nbibliography: books.bib\n---\n";
};

TEST_F(literature, citations_name_authors_and_the_list_holds_what_is_cited) {
    const std::string page = html(header_ + "As in [@ljung1999, section 7.4].\n\n# End\n\nLast.\n");
    EXPECT_THAT(page, HasSubstr("Ljung 1999"));
    EXPECT_THAT(page, HasSubstr("System Identification"));
    EXPECT_THAT(page, Not(HasSubstr("Recursive Estimation")));
    EXPECT_LT(page.find("Last."), page.find("References"));
    EXPECT_LT(page.find("References"), page.find("Prentice Hall"));
}

// Oracle: what Pandoc's own reader of citations makes of the same text.
TEST_F(literature, citations_have_the_forms_that_pandoc_knows) {
    const auto content = inspect_pdf(
        make(header_ + "As in [see @ljung1999 p. 3; also -@young2011], @ljung1999 [p. 4], *[@young2011]* and [not "
                       "this; @young2011] in [0, 1[.[^1]\n\n-@ljung1999\n\n[^1]: A note, after [-@young2011].\n",
             "out.pdf"));
    std::string text = content.pages.at(0);
    std::replace(text.begin(), text.end(), '\n', ' ');
    EXPECT_THAT(text, HasSubstr("(see Ljung 1999, 3; also 2011), Ljung (1999, 4), (Young 2011) and"));
    EXPECT_THAT(text, HasSubstr("[not this; Young (2011)] in [0, 1["));
    EXPECT_THAT(text, HasSubstr("after (2011)"));
}

TEST_F(literature, the_list_is_where_the_author_puts_it) {
    const std::string page =
        html(header_ + "As @young2011 says.\n\n# Books\n\n::: references\n:::\n\n# Appendix\n\nLast.\n");
    EXPECT_LT(page.find("Recursive Estimation"), page.find("Appendix"));
    EXPECT_THAT(page, Not(HasSubstr("References")));
}

TEST_F(literature, csl_json_and_french_do_as_well) {
    write("books.json",
          R"([{"id": "garnier", "type": "book", "title": "Continuous-time models", "issued": {"date-parts": [[2008]]},
              "author": [{"family": "Garnier", "given": "Hugues"}, {"family": "Wang", "given": "Liuping"}]}])");
    const std::string page = html("---\nlang: fr\nbibliography: books.json\n---\nSelon @garnier.\n");
    EXPECT_THAT(page, HasSubstr("Garnier et Wang"));
    EXPECT_THAT(page, HasSubstr("Références"));
}

TEST_F(literature, the_pdf_lists_it_too) {
    const auto content =
        inspect_pdf(make(header_ + "As in [@ljung1999].\n\n# Next\n\nSee @sec:a.\n\n# A {#sec:a}\n", "out.pdf"));
    EXPECT_THAT(content.pages.at(0), HasSubstr("(Ljung 1999)"));
    EXPECT_THAT(content.pages.at(0), HasSubstr("Prentice Hall"));
}

TEST_F(literature, unknown_keys_are_errors_with_their_line) {
    const std::string message = refusal(header_ + "One.\n\nTwo [@ljung1998].\n");
    EXPECT_THAT(message, HasSubstr("report.md:7: "));
    EXPECT_THAT(message, HasSubstr("no entry \"ljung1998\"; did you mean \"ljung1999\"?"));
}

TEST_F(literature, citations_without_a_bibliography_are_errors) {
    EXPECT_THAT(refusal("One.\n\nAs in [@ljung1999].\n"), HasSubstr("report.md:3: @ljung1999 cites literature"));
    EXPECT_THAT(refusal("One @young2011 says.\n"), HasSubstr("report.md:1: @young2011 cites literature"));
    EXPECT_EQ(refusal("Write to ada@example.org or \\@home.\n"), "");
}

// Oracle: the titles as they are in the file.
TEST_F(literature, titles_with_signs_of_tex_print_in_full) {
    const std::pair<const char*, const char*> titles[] = {
        {"{Control of 50% overshoot in plants}", "Control of 50% Overshoot in Plants"},
        {"{Ends in 5%}", "Ends in 5%"},
        {"\"Quoted 5% of {C#} code\"", "Quoted 5% of C# Code"},
        {"{{C# and F#} in use}", "C# and F# in Use"},
        {"{The {$5} controller}", "The $5 Controller"},
        {"{From {$3} to {$4} a piece}", "From $3 to $4 a Piece"},
        {"{Research & development}", "Research & Development"},
        {"{Escaped 5\\% \\& {C\\#} and \\$6}", "Escaped 5% & C# and $6"},
        {"{{A 10% B #1 C $2 D & E}}", "A 10% B #1 C $2 D & E"},
        {"{Signs {a_b} in {x^y} and 1~m}", "Signs"},
        {"{Two lines 5%\n  and more}", "Two Lines 5% and More"},
        {"\"Joined 5% \" # \"of it\"", "Joined 5% of It"},
    };
    for (const auto& [written, printed] : titles) {
        write("books.bib",
              std::string("% a comment\n@string{acm = \"ACM\"}\n@comment{no, title={50% }}\n@book{x, author={A, B},\n"
                          "  % of the author\n  title = ") +
                  written + ",\n  url = {https://x.org/a%20b?c=1&d=2#e}, publisher = acm, year = 2000}\n");
        const std::string page = std::regex_replace(html(header_ + "As in [@x].\n"), std::regex("<[^>]+>|\n"), " ");
        const std::string list = std::regex_replace(replaced(page, "&amp;", "&"), std::regex(" +"), " ");
        EXPECT_THAT(list, HasSubstr(printed)) << written;
        EXPECT_THAT(list, AllOf(HasSubstr("ACM"), HasSubstr("https://x.org/a%20b?c=1&d=2#e"))) << written;
    }
    EXPECT_THAT(inspect_pdf(make(header_ + "As in [@x].\n", "out.pdf")).pages.at(0), HasSubstr("Joined 5% of It"));
    write("books.bib", "@book{m, author={A, B}, title={On $x^2$ and $\\alpha$ in 5%}, year={2000}}\n");
    EXPECT_THAT(html(header_ + "As in [@m].\n"), AllOf(HasSubstr("5%"), Not(HasSubstr("$x^2$"))));
}

TEST_F(literature, a_missing_citation_names_its_own_line_and_how_to_declare_a_bibliography) {
    const std::string text =
        "<!-- Cite as [@ljung1999] or @ljung1999. -->\n\nSee [@ljung1999b].\n\n```\n@ljung1999\n```\n\nAs in "
        "[@ljung1999].\n";
    const std::string message = refusal(text);
    EXPECT_THAT(message, HasSubstr("report.md:9: @ljung1999 cites literature"));
    EXPECT_THAT(message, HasSubstr("report.md:3: @ljung1999b cites literature"));
    EXPECT_THAT(message, AllOf(HasSubstr("\"bibliography: references.bib\" to the header"),
                               HasSubstr("-- bibliography: references.bib")));
    EXPECT_THAT(refusal(header_ + "<!-- @ljung1998 -->\n\nTwo [@ljung1998].\n"),
                HasSubstr("report.md:7: the bibliography"));
}

TEST_F(literature, keys_with_colons_are_literature_where_the_bibliography_has_them) {
    write("books.bib", "@book{DBLP:conf/x, author={Colon, C.}, title={Keys}, year={2003}}\n");
    EXPECT_THAT(html(header_ + "As in [@DBLP:conf/x].\n"), HasSubstr("Colon 2003"));
    EXPECT_THAT(refusal(header_ + "As in @DBLP:other.\n", "other.html"), HasSubstr("must be in the bibliography"));
}

TEST_F(literature, a_link_to_a_file_outside_the_folder_is_refused) {
    const TemporaryFolder elsewhere;
    std::ofstream(elsewhere.path() / "outside.bib") << "@book{secret2020, author={Outsider, O.}, year={2020}}\n";
    std::filesystem::create_symlink(elsewhere.path() / "outside.bib", file("link.bib"));
    EXPECT_THAT(refusal("---\nbibliography: link.bib\n---\nAs in [@secret2020].\n"),
                HasSubstr("link.bib: the bibliography is outside the folder of the document"));
    std::filesystem::create_symlink("books.bib", file("same.bib"));
    EXPECT_EQ(refusal("---\nbibliography: same.bib\n---\nAs in [@ljung1999].\n"), "");
}

TEST_F(literature, a_bibliography_that_cannot_be_read_is_reported) {
    EXPECT_THAT(refusal("---\nbibliography: none.bib\n---\nText\n"),
                HasSubstr("none.bib: the bibliography file is missing"));
    EXPECT_THAT(refusal("---\nbibliography: ../books.bib\n---\nText\n"),
                HasSubstr("report.md:2: \"bibliography\" must be"));
    EXPECT_THAT(refusal("---\nbibliography: /etc/passwd\n---\nText\n"),
                HasSubstr("report.md:2: \"bibliography\" must be"));
    write("books.bib", "@book{ljung1999, title={never closed\n");
    EXPECT_THAT(refusal(header_ + "As in [@ljung1999].\n"), HasSubstr("the bibliography cannot be read: (line"));
}

// A title is Pandoc's own to read: whatever it makes of TeX, nothing of it is run.
TEST_F(literature, what_a_bibliography_holds_reaches_no_file_and_no_script) {
    write("secret.txt", "SECRETWORD");
    write("books.bib",
          "@book{a, author={A, B}, title={One $\\input{secret.txt}$ \\input{secret.txt} and more}, year={2000},\n"
          "url={javascript:alert(1)}, note={\\href{javascript:alert(2)}{here} \\includegraphics{secret.txt}}}\n");
    const std::string page = html(header_ + "As in [@a].\n");
    EXPECT_THAT(page, Not(HasSubstr("SECRETWORD")));
    EXPECT_THAT(page, Not(HasSubstr("href=\"javascript")));
    EXPECT_THAT(inspect_pdf(make(header_ + "As in [@a].\n", "out.pdf")).pages.at(0), Not(HasSubstr("SECRETWORD")));
}

TEST_F(literature, latex_that_would_be_printed_is_an_error_with_its_line) {
    for (const auto& [written, reported] : {std::pair("\\newpage", "\\newpage"),
                                            {"\\begin{align} a &= b \\end{align}", "\\begin"},
                                            {"as in \\ref{fig:x}", "\\ref"},
                                            {"an angle \\alpha here", "\\alpha"},
                                            {"\\(x\\) is", "\\(...\\)"},
                                            {"\\[x\\]", "\\[...\\]"},
                                            {"\\[\nx\n\\]", "\\[...\\]"},
                                            {"so \\(y = a x\\)", "\\(...\\)"}}) {
        const std::string message = refusal("One.\n\n" + std::string(written) + "\n");
        EXPECT_THAT(message, HasSubstr("report.md:3: ")) << written;
        EXPECT_THAT(message, HasSubstr(reported)) << written;
    }
    EXPECT_EQ(refusal("\\\\input{x} \\[a\\](b) \\[see below\\] \\(or not\\)\n"), "");
    EXPECT_EQ(refusal("`\\newpage`, $\\alpha$, C:\\temp, \\\\, 5\\ m, \\(a, \\[1\\.\n\n```\n\\begin{x} \\(x\\)\n```\n"),
              "");
}

TEST_F(literature, measures_are_shown_by_name) {
    write("report.md", "::: measures\nfit, YIC\n:::\n");
    DocumentSource source;
    source.template_file = file("report.md");
    source.measures = {{"fit", "**Fit**\n\n$$ a $$\n"}, {"yic", "**Young**\n"}, {"bic", "**Schwarz**\n"}};
    DocumentMaker({}).make(source, file("out.html"), DocumentFormat::kHtml, nullptr);
    const std::string page = read(file("out.html"));
    EXPECT_LT(page.find("Fit"), page.find("Young"));
    EXPECT_THAT(page, Not(HasSubstr("Schwarz")));
    write("report.md", "One.\n\n::: measures\nYCI\n:::\n");
    try {
        DocumentMaker({}).make(source, file("other.html"), DocumentFormat::kHtml, nullptr);
        FAIL();
    } catch (const DocumentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("report.md:4: unknown measure \"YCI\""));
    }
}

}  // namespace test_literature
}  // namespace dynlab
