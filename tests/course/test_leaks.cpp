// Documents with names in them, as careless authors leave them, and documents without. Oracle: how each was made.
#include <gmock/gmock.h>

#include "leak_corpus.h"

namespace dynlab {
namespace test_leaks {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

class leaks : public LeakCorpus {
  protected:
    /// Expects that the check finds a name in each text. Each text is on a separate page of one document.
    void expect_in_text(const std::vector<std::string>& texts, const std::string& preamble = "") {
        std::string body;
        std::vector<std::string> expected;
        for (const std::string& text : texts) {
            body += kProse + ("{" + text + "}\n\\newpage\n");
            expected.push_back("name-in-text " + std::to_string(expected.size() + 1));
        }
        EXPECT_THAT(found(latex(preamble, body)), testing::ElementsAreArray(expected));
    }
};

TEST_F(leaks, in_the_text_in_every_spelling) {
    expect_in_text({"A report by Zo\\'e Brandtner.", "A report by BRANDTNER, ZOE.", "Z. Brandtner wrote it.",
                    "zoe brandtner", "Zo\\'e M. Brandtner", "Jean-Pierre O'Marrec was there.",
                    "Muellhauser made the figures.", "Li Wu made the figures.",
                    "The authors are Park, May and others."});
}

TEST_F(leaks, in_hyphenated_words_ligatures_and_letters_set_apart) {
    expect_in_text({"\\parbox{12mm}{\\hspace{0pt}Brandt\\-ner}", "This is Griffistone's own work.", "B R A N D T N E R",
                    "\\texttt{author = zoe\\_brandtner}"});
}

TEST_F(leaks, in_composed_and_decomposed_accents) {
    expect_in_text({"This is M\\\"ullhauser's own work."});
    EXPECT_THAT(found(latex("", std::string(kProse) + "By M\\\"ullhauser.", "ot1", "")), ElementsAre("name-in-text 1"));
    EXPECT_THAT(names_->find("Mu\u0308llhauser", TextManner::kProse), testing::SizeIs(1));
    EXPECT_THAT(names_->find("МОДЕЛЬ: ПЕТРОВСКАЯ Ольга", TextManner::kProse), testing::SizeIs(1));
}

TEST_F(leaks, numbers_addresses_groups_and_home_folders_in_the_text) {
    expect_in_text({"Number 20214711.", "My account is e45678.", "Student ID: 1007.",
                    "\\parbox{3cm}{\\raggedright young@ uni.\\\\example}", "This is the report of group-07.",
                    "\\verb|/home/somebody/crane/analysis.lua|", "\\verb|C:\\Users\\somebody\\crane.lua|"});
}

TEST_F(leaks, in_invisible_and_turned_text) {
    expect_in_text({"\\pdfliteral{3 Tr}by Zo\\'e Brandtner\\pdfliteral{0 Tr}", "\\color{white}by Zo\\'e Brandtner",
                    "\\rotatebox{90}{Brandtner, position}", "\\rotatebox{25}{By Zo\\'e Brandtner}"},
                   "\\usepackage{color}\n"
                   "\\usepackage{graphicx}\n");
}

TEST_F(leaks, in_the_document_information) {
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Author (Brandtner Zoe)}")), ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Keywords (crane, zoe.brandtner@uni.example)}")),
                ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Title <FEFF004D00FC006C006C006800610075007300650072>}")),
                ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Source (file:///home/somebody/crane.tex)}")),
                ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Author (A Stranger)}")), ElementsAre("(author-named 0)"));
    EXPECT_THAT(found(prose_with("\\immediate\\pdfobj stream attr{/Type /Metadata /Subtype /XML}"
                                 "{<x:xmpmeta><dc:creator>Zoe Brandtner</dc:creator></x:xmpmeta>}"
                                 "\\pdfcatalog{/Metadata \\the\\pdflastobj\\space 0 R}")),
                ElementsAre("name-in-metadata 0"));
}

TEST_F(leaks, in_links_bookmarks_and_file_names) {
    const auto link = [this](const std::string& target) {
        return prose_with("\\pdfannot width 1cm height 1cm {/Subtype /Link /A << /S /URI /URI (" + target + ") >>}");
    };
    EXPECT_THAT(found(link("mailto:zoe.brandtner@uni.example")), ElementsAre("name-in-link 1"));
    EXPECT_THAT(found(link("https://example.org/J\\%C3\\%BCrgen_M\\%C3\\%BCllhauser")), ElementsAre("name-in-link 1"));
    EXPECT_THAT(found(link("https://example.org/crane")), IsEmpty());
    EXPECT_THAT(found(prose_with("\\pdfoutline goto page 1 {/Fit}{Work of Brandtner}")),
                ElementsAre("name-in-bookmark 0"));
    EXPECT_THAT(found(prose_with("", "report_brandtner")), ElementsAre("(name-in-file-name 0)"));
}

// Oracle: where each page ends.
TEST_F(leaks, in_names_that_a_page_break_divides) {
    const std::string filler(kProse);
    EXPECT_THAT(
        found(latex(
            "",
            filler + "\\vfill\\noindent This is by Zo\\'e Brandt-\n\\newpage\\noindent ner, who did it.\n\n" + filler)),
        ElementsAre("name-in-text 2"));
    EXPECT_THAT(found(latex("\\pagestyle{headings}",
                            filler + "\\vfill\\noindent This is by Zo\\'e\n\\newpage\\noindent Brandt-\n\nner")),
                Contains("name-in-text 2"));
    EXPECT_THAT(found(latex("", filler + "\\vfill\\noindent A brandt-\n\\newpage\\noindent new page.\n\n" + filler)),
                IsEmpty());
}

TEST_F(leaks, pages_that_cannot_be_searched_are_hints) {
    run({"gnuplot", "-e", "set terminal png size 300,200; set output 'plain.png'; plot x"});
    EXPECT_THAT(found(latex("\\usepackage{graphicx}\n", std::string(kProse) + "\\newpage\\includegraphics{plain.png}")),
                ElementsAre("(not-searchable 2)"));
    EXPECT_THAT(found(latex("\\pagestyle{empty}",
                            std::string(kProse) + "\\newpage\\noindent" + "\\pdfliteral{" + std::string(60, ' ') +
                                "0 0 m 9 9 l 20 30 l 40 50 l 60 70 l 80 90 l S 0 0 m 9 9 l S 5 5 m 9 9 l S}\\null")),
                ElementsAre("(not-searchable 2)"));
}

// Oracle: the picture of the page, which shows the name; pdftotext does not give it.
TEST_F(leaks, pages_painted_by_a_pattern_of_words_are_hints) {
    const std::string hello =
        "BT /F1 12 Tf 72 700 Td (The gain is known, and the oscillation is damped.) Tj ET /X0 Do\n";
    const std::string form =
        stream_of("/Pattern cs /P scn 0 0 500 500 re f",
                  "/Type/XObject/Subtype/Form/BBox[0 0 500 500]/Resources<</Pattern<</P 7 0 R>>>>");
    const auto pattern = [](const std::string& content, const std::string& resources) {
        return stream_of(content,
                         "/Type/Pattern/PatternType 1/PaintType 1/TilingType 1/BBox[0 0 200 50]/XStep 200"
                         "/YStep 50/Resources<<" +
                             resources + ">>");
    };
    const std::string words = "BT /F1 12 Tf 2 10 Td (by Zoe Brandtner) Tj ET";
    EXPECT_THAT(found(page_with(hello, "", "", {form, pattern(words, "/Font<</F1 5 0 R>>")})),
                ElementsAre("(not-searchable 1)"));
    EXPECT_THAT(found(page_with(hello, "", "", {form, pattern("0 0 m 50 50 l S", "")})), IsEmpty());
}

// Oracle: the objects of the file: two bookmarks of which each is next to the other; a second page that is not counted.
TEST_F(leaks, damaged_outlines_and_page_trees_are_searched_to_their_end) {
    const std::string hello = std::string("BT /F1 12 Tf 72 700 Td (The gain is known, and the oscillation is damped ") +
                              "after a while.) Tj 0 -14 Td (Nothing else is shown here.) Tj ET\n";
    const std::string form = stream_of("", "/Type/XObject/Subtype/Form/BBox[0 0 9 9]");
    EXPECT_THAT(
        found(page_with(hello, "/Outlines 7 0 R", "",
                        {form, "<</First 8 0 R/Last 9 0 R/Count 2>>", "<</Title(Start)/Parent 7 0 R/Next 9 0 R>>",
                         "<</Title(by Brandtner)/Parent 7 0 R/Next 8 0 R/First 8 0 R>>"})),
        ElementsAre("name-in-bookmark 0"));
    const std::string own = read(page_with(
        hello, "", "",
        {form, "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 5 0 R>>>>>>"}));
    write("own.pdf", updated(own, 2, "<</Type/Pages/Kids[3 0 R 7 0 R]/Count 1>>"));
    EXPECT_THAT(found(file("own.pdf")), ElementsAre("(not-searchable 2)"));
}

// Words that are names as well, numbers that are no students', cited authors, names of the field.
TEST_F(leaks, ten_clean_documents_raise_no_alarm) {
    const std::string words =
        "It may park there. The young crane may mark long runs; see group 7 of the gains, and number "
        "20214712. "
        "The value is 120214711 or 20214711.5 or 1007 samples. Li and Wu are variables. In May, Park's method and "
        "Young's filter, the Laplace transform and Bode's law hold. The grand petit moulin. A brand is not a brandt.";
    EXPECT_THAT(found(latex("", kProse + words)), ElementsAre("(name-ordinary-word 1)"));
    EXPECT_THAT(found(make(english_report(words), "report.pdf")), ElementsAre("(name-ordinary-word 1)"));
    EXPECT_THAT(found(make("---\nlang: fr\n---\n" + french_report() + "Le jeune mai, le parc et le long pont.\n",
                           "rapport.pdf")),
                IsEmpty());
    EXPECT_THAT(found(latex("\\usepackage{hyperref}\n",
                            "\\section{The young model}" + std::string(kProse) +
                                "\\href{https://example.org/users/guide}{a link} \\url{file:///usr/share/doc}")),
                IsEmpty());
    EXPECT_THAT(
        found(latex("", std::string(kProse) + "P. Young and L. Wu, \\emph{Refined methods}, 2008. Park et al.")),
        IsEmpty());
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Title (The young crane) /Keywords (mark, may, park)}")), IsEmpty());
    run({"qpdf", "--linearize", "own.pdf", "line.pdf"});
    EXPECT_THAT(found(file("line.pdf")), IsEmpty());
    run({"qpdf", "--encrypt", "", "owner", "256", "--", "own.pdf", "locked.pdf"});
    EXPECT_THAT(found(file("locked.pdf")), IsEmpty());
    EXPECT_THAT(found(latex("", "\\verb|x = [20214712 1007 0x20214711]|" + std::string(kProse))), IsEmpty());
}

// Oracle: the definition of a hint in identity_matcher.h.
TEST_F(leaks, cited_authors_and_given_names_are_hints) {
    EXPECT_THAT(found(latex("", std::string(kProse) + "See Brandtner et al.")), ElementsAre("(name-in-text 1)"));
    EXPECT_THAT(found(latex("", std::string(kProse) + "See P. Brandtner, 2008.")), ElementsAre("(name-in-text 1)"));
    Student own;
    own.name = "Clotilde Brandtner";
    names_->add(own, true);
    EXPECT_THAT(found(latex("", std::string(kProse) + "Clotilde measured it.")), ElementsAre("(name-in-text 1)"));
}

/// "Quandtlaaasen (1999), ..." for so many classmates, whom it adds to those looked for.
std::string citations(IdentityMatcher& names, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        Student classmate;
        classmate.name = "Vera Quandtla" + std::string(1, static_cast<char>('a' + i % 26)) +
                         std::string(1, static_cast<char>('a' + i / 26)) + "sen";
        names.add(classmate);
        text += classmate.name.substr(5) + " (1999), ";
    }
    return text;
}

// Oracle: how many are cited, and who is named once.
TEST_F(leaks, hints_hide_no_name_however_many_they_are) {
    const std::string many = kProse + citations(*names_, 45) + " by Brandtner";
    const std::vector<std::string> ids = found(prose_with(many));
    ASSERT_EQ(ids.size(), 41u);
    EXPECT_EQ(std::ranges::count(ids, "name-in-text 1"), 1);
    EXPECT_EQ(std::ranges::count(ids, "(name-in-text 1)"), 39);
    EXPECT_EQ(std::ranges::count(ids, "names-not-listed 0"), 1);
}

}  // namespace test_leaks
}  // namespace dynlab
