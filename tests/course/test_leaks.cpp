// Documents that name somebody: every way in which a PDF can hold a name, and documents that name nobody. Oracle: how
// each was made.
#include <gmock/gmock.h>

#include "base/reader.h"
#include "course/anonymity/anonymous_copy.h"
#include "leak_corpus.h"

namespace dynlab {
namespace test_leaks {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class leaks : public LeakCorpus {
  protected:
    /// Each text is a page of one document, and names somebody there.
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

TEST_F(leaks, in_text_that_no_reader_sees) {
    expect_in_text({"\\pdfliteral{3 Tr}by Zo\\'e Brandtner\\pdfliteral{0 Tr}", "\\color{white}by Zo\\'e Brandtner",
                    "\\rotatebox{90}{Brandtner, position}"},
                   "\\usepackage{color}\n"
                   "\\usepackage{graphicx}\n");
    EXPECT_THAT(found(prose_with("\\hspace{0pt}\\rlap{\\hspace{60cm}Zo\\'e Brandtner}")), ElementsAre("name-hidden 1"));
    EXPECT_THAT(
        found(prose_with("\\setbox0\\hbox{Zo\\'e Brandtner}\\immediate\\pdfxform0 "
                         "\\edef\\own{\\pdfpageresources{/XObject << /Unused \\the\\pdflastxform\\space 0 R >>}}"
                         "\\own")),
        ElementsAre("name-hidden 1"));
    EXPECT_THAT(found(prose_with("\\pdfliteral{/Span << /ActualText (Brandtner) >> BDC}x\\pdfliteral{EMC}")),
                ElementsAre("name-hidden 1"));
}

TEST_F(leaks, in_layers_that_are_off_and_their_names) {
    const auto layer = [this](const std::string& name, const std::string& text) {
        return prose_with("\\immediate\\pdfobj{<< /Type /OCG /Name (" + name +
                          ") >>}\\edef\\layer{\\the\\pdflastobj\\space 0 R}"
                          "\\pdfcatalog{/OCProperties << /OCGs [\\layer] /D << /OFF [\\layer] >> >>}"
                          "\\edef\\own{\\pdfpageresources{/Properties << /off \\layer\\space >>}}\\own"
                          "\\pdfliteral{/OC /off BDC}" +
                          text + "\\pdfliteral{EMC}");
    };
    EXPECT_THAT(found(layer("notes", "by Brandtner")), ElementsAre("name-hidden 1"));
    EXPECT_THAT(found(layer("layer of Brandtner", "notes")), ElementsAre("name-in-layer 1"));
}

TEST_F(leaks, in_the_metadata_of_the_document) {
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Author (Brandtner Zoe)}")), ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Keywords (crane, zoe.brandtner@uni.example)}")),
                ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Title <FEFF004D00FC006C006C0068006100750073006500720>}")),
                ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Source (file:///home/somebody/crane.tex)}")),
                ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Author (A Stranger)}")), ElementsAre("(author-named 0)"));
    EXPECT_THAT(found(prose_with("\\immediate\\pdfobj stream attr{/Type /Metadata /Subtype /XML}"
                                 "{<x:xmpmeta><dc:creator>Zo\\string&\\string#xE9; Brandtner</dc:creator></x:xmpmeta>}"
                                 "\\pdfcatalog{/Metadata \\the\\pdflastobj\\space 0 R}")),
                ElementsAre("name-in-metadata 0"));
}

TEST_F(leaks, in_embedded_files) {
    const std::string own = prose_with("").string();
    write("brandtner-notes.txt", "nothing");
    write("notes.txt", "made by Jürgen Müllhauser");
    write("word/document.xml", "<w:t>by Zo&#233; Brandtner</w:t>");
    run({"zip", "-q", "report.docx", "word/document.xml"});
    prose_with("by Brandtner", "inner");
    for (const char* embedded : {"brandtner-notes.txt", "notes.txt", "report.docx", "inner.pdf"}) {
        std::filesystem::remove(file("with.pdf"));
        run({"pdfattach", "own.pdf", embedded, "with.pdf"});
        EXPECT_THAT(found(file("with.pdf")), ElementsAre("name-in-attachment 0")) << embedded;
    }
}

TEST_F(leaks, in_comments_forms_links_and_bookmarks) {
    const auto annotation = [this](const std::string& entries) {
        return prose_with("\\pdfannot width 1cm height 1cm {" + entries + "}");
    };
    EXPECT_THAT(found(annotation("/Subtype /Text /T (brandtner) /Contents (check)")),
                ElementsAre("name-in-annotation 1"));
    EXPECT_THAT(found(annotation("/Subtype /Text /Contents (Ask M\\string\\374llhauser)")),
                ElementsAre("name-in-annotation 1"));
    EXPECT_THAT(found(annotation("/Subtype /Widget /FT /Tx /T (who) /V (Zoe Brandtner)")), Contains("name-in-form 1"));
    EXPECT_THAT(found(annotation("/Subtype /Link /A << /S /URI /URI (mailto:zoe.brandtner@uni.example) >>")),
                ElementsAre("name-in-link 1"));
    EXPECT_THAT(found(annotation("/Subtype /Link /A << /S /Launch /F (/home/somebody/a.m) >>")),
                ElementsAre("name-in-link 1"));
    EXPECT_THAT(found(prose_with("\\pdfoutline goto page 1 {/Fit}{Work of Brandtner}")),
                ElementsAre("name-in-bookmark 0"));
    EXPECT_THAT(found(prose_with("\\pdfoutline goto page 1 {/Fit}{\\string\\357\\string\\273\\string\\277"
                                 "\\string\\342\\string\\200\\string\\256rentdnarB}")),
                ElementsAre("name-in-bookmark 0"))
        << "turned round by U+202E";
}

TEST_F(leaks, in_figures_and_pictures) {
    prose_with("\\pdfinfo{/Author (Brandtner)}", "figure");
    std::filesystem::copy_file(file("figure.pdf"), file("brandtner-figure.pdf"));
    const auto showing = [this](const std::string& figure) {
        return latex("\\usepackage{graphicx}\n", std::string(kProse) + "\\includegraphics[width=3cm]{" + figure + "}");
    };
    EXPECT_THAT(found(showing("figure.pdf")), Contains("name-in-metadata 1"));
    EXPECT_THAT(found(showing("brandtner-figure.pdf")), Contains("name-in-figure-file 1"));
    run({"gnuplot", "-e", "set terminal jpeg size 80,60; set output 'plain.jpg'; plot x"});
    const std::string picture = read(file("plain.jpg"));
    EXPECT_THAT(found(showing("plain.jpg")), IsEmpty());
    const auto with_segment = [&](char marker, const std::string& text) {
        const std::size_t length = text.size() + 2;
        write("plain.jpg", picture.substr(0, 2) + "\xFF" + marker + static_cast<char>(length >> 8) +
                               static_cast<char>(length & 0xFF) + text + picture.substr(2));
        return found(showing("plain.jpg"));
    };
    EXPECT_THAT(with_segment('\xFE', "photo by Brandtner"), ElementsAre("name-in-image 1"));
    std::string wide;
    for (const char c : std::string("Zoe Brandtner")) wide += {c, '\0'};
    EXPECT_THAT(with_segment('\xE1', std::string("Exif\0\0II*\0\x08\0\0\0\0\0\0\0\0\0", 20) + wide),
                Contains("name-in-image 1"));
}

TEST_F(leaks, in_what_remains_of_earlier_states) {
    const std::string plain = read(prose_with(""));
    write("behind.pdf", plain + "\nsaved by Zoe Brandtner\n%%EOF\n");
    EXPECT_THAT(found(file("behind.pdf")), ElementsAre("name-in-remains 0"));
    const std::size_t object = plain.find(" 0 obj");
    const std::size_t line = plain.rfind('\n', object) + 1;
    write("between.pdf", plain.substr(0, line) + "% by Zoe Brandtner\n" + plain.substr(line));
    EXPECT_THAT(found(file("between.pdf")), ElementsAre("name-in-remains 0"));
    EXPECT_THAT(found(prose_with("\\immediate\\pdfobj{(left by Zoe Brandtner)}")), ElementsAre("name-inside 0"));
    const std::string signed_once = read(prose_with("\\pdfinfo{/Author (Brandtner)}"));
    const std::string info = reference(signed_once, "/Info");
    write("changed.pdf", updated(signed_once, std::stoi(info), "<< /Producer (pdfTeX) >>"));
    EXPECT_THAT(found(file("changed.pdf")), ElementsAre("name-in-remains 0"));
    run({"qpdf", "--object-streams=generate", "--encrypt", "", "owner", "256", "--", "own.pdf", "locked.pdf"});
    EXPECT_THAT(found(file("locked.pdf")), ElementsAre("name-in-metadata 0"));
    EXPECT_THAT(found(prose_with("\\pdfcatalog{/PieceInfo << /Editor << /Private (Brandtner) >> >>}")),
                ElementsAre("name-in-metadata 0"));
}

// Words that are names as well, numbers that are no students', cited authors, names of the field.
TEST_F(leaks, ten_clean_documents_raise_no_alarm) {
    const std::string words =
        "It may park there. The young crane may mark long runs; see group 7 of the gains, and number "
        "20214712. "
        "The value is 120214711 or 20214711.5 or 1007 samples. Li and Wu are variables. In May, Park's method and "
        "Young's filter, the Laplace transform and Bode's law hold. The grand petit moulin. A brand is not a brandt.";
    EXPECT_THAT(found(latex("", kProse + words)), IsEmpty());
    EXPECT_THAT(found(make(english_report(words), "report.pdf")), IsEmpty());
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
    run({"gnuplot", "-e", "set terminal png size 300,200; set output 'plain.png'; plot x"});
    EXPECT_THAT(found(latex("\\usepackage{graphicx}\n", std::string(kProse) + "\\includegraphics{plain.png}")),
                IsEmpty());
    EXPECT_THAT(found(prose_with("\\pdfinfo{/Title (The young crane) /Keywords (mark, may, park)}")), IsEmpty());
    run({"qpdf", "--linearize", "own.pdf", "line.pdf"});
    EXPECT_THAT(found(file("line.pdf")), IsEmpty());
    run({"qpdf", "--encrypt", "", "owner", "256", "--", "own.pdf", "locked.pdf"});
    EXPECT_THAT(found(file("locked.pdf")), IsEmpty());
    EXPECT_THAT(found(latex("", "\\verb|x = [20214712 1007 0x20214711]|" + std::string(kProse))), IsEmpty());
}

// Oracle: the definition of a hint in sought_names.h.
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
    const std::string many = kProse + citations(*names_, 45);
    const auto hidden = prose_with(many + "\\pdfliteral{/Span << /ActualText (Brandtner) >> BDC}x\\pdfliteral{EMC}");
    const std::vector<std::string> ids = found(hidden);
    ASSERT_EQ(ids.size(), 40u);
    EXPECT_EQ(std::count(ids.begin(), ids.end(), "name-hidden 1"), 1);
    EXPECT_EQ(std::count(ids.begin(), ids.end(), "(name-in-text 1)"), 39);

    AnonymousCopySetup setup;
    setup.names = *names_;
    const AnonymousCopy copy = anonymous_copy(prose_with(many), file("copy.pdf"), setup);
    EXPECT_FALSE(copy.made) << "not all that was found can be looked at";
    ASSERT_EQ(copy.findings.size(), 41u);
    EXPECT_EQ(copy.findings.back().id, "names-not-listed");
    EXPECT_THAT(message_text(copy.findings.back().what), HasSubstr("5 further places"));
    EXPECT_FALSE(std::filesystem::exists(file("copy.pdf")));
    EXPECT_TRUE(anonymous_copy(prose_with(kProse + citations(*names_, 40)), file("copy.pdf"), setup).made);
}

// Oracle: how many PDFs are embedded, of which only some are searched.
TEST_F(leaks, embedded_documents_that_are_not_searched_are_told) {
    const std::vector<std::string> blank = {"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
                                            "<</Type/Page/Parent 2 0 R/MediaBox[0 0 99 99]>>"};
    write("own.pdf", pdf_of(blank));
    for (int i = 1; i <= 6; ++i) {
        const std::string name = "part" + std::to_string(i) + ".pdf";
        write(name, pdf_of(blank) + "\n% " + name + "\n");
        run({"pdfattach", "own.pdf", name, "with.pdf"});
        std::filesystem::rename(file("with.pdf"), file("own.pdf"));
        if (i == 5) {
            EXPECT_THAT(found(file("own.pdf")), IsEmpty());
        }
    }
    EXPECT_THAT(found(file("own.pdf")), ElementsAre("not-searched 0"));
}

// Oracle: qpdf and pdftotext read the copy; the search finds nothing in it.
TEST_F(leaks, copies_are_cleaned_and_what_cannot_be_cleaned_stops_them) {
    AnonymousCopySetup setup;
    setup.names = *names_;
    setup.program = DYNLAB_PROGRAM;
    run({"gnuplot", "-e", "set terminal jpeg size 80,60; set output 'plain.jpg'; plot x"});
    const std::string picture = read(file("plain.jpg")), comment = "by Zoe Brandtner";
    write("plain.jpg", picture.substr(0, 2) + std::string("\xFF\xFE\0", 3) + static_cast<char>(comment.size() + 2) +
                           comment + picture.substr(2));
    const auto pdf = latex("\\usepackage{graphicx}\n",
                           std::string(kProse) +
                               "\\includegraphics[width=3cm]{plain.jpg}\\pdfinfo{/Author (Brandtner)}"
                               "\\pdfannot width 1cm height 1cm {/Subtype /Text /T (brandtner) /Contents (x)}"
                               "\\immediate\\pdfobj{(left by Brandtner)}\\pdfcatalog{/PieceInfo << /P (Brandtner) >>}");
    write("notes.txt", "by Brandtner");
    run({"pdfattach", "own.pdf", "notes.txt", "with.pdf"});
    const AnonymousCopy copy = anonymous_copy(file("with.pdf"), file("copy.pdf"), setup);
    ASSERT_TRUE(copy.made) << message_text(copy.trouble);
    EXPECT_FALSE(copy.rebuilt);
    EXPECT_THAT(found(file("copy.pdf")), IsEmpty());
    run({"qpdf", "--check", "copy.pdf"});
    run({"qpdf", "--qdf", "--object-streams=disable", "copy.pdf", "plain.pdf"});
    EXPECT_THAT(read(file("plain.pdf")), AllOf(Not(HasSubstr("randtner")), Not(HasSubstr("/Info"))));
    EXPECT_EQ(text_of("copy.pdf"), text_of("own.pdf"));
    EXPECT_EQ(anonymous_copy(file("with.pdf"), file("again.pdf"), setup).hash, copy.hash);
    EXPECT_EQ(read(file("again.pdf")), read(file("copy.pdf")));

    const AnonymousCopy stopped =
        anonymous_copy(latex("", std::string(kProse) + "by Brandtner"), file("stopped.pdf"), setup);
    EXPECT_FALSE(stopped.made);
    EXPECT_EQ(stopped.findings.front().id, "name-in-text");
    EXPECT_EQ(stopped.findings.front().page, 1);
    EXPECT_FALSE(std::filesystem::exists(file("stopped.pdf")));
    write("broken.pdf", "%PDF-1.4\nnothing\n%%EOF\n");
    const AnonymousCopy broken = anonymous_copy(file("broken.pdf"), file("none.pdf"), setup);
    EXPECT_FALSE(broken.made);
    EXPECT_THAT(message_text(broken.trouble), HasSubstr("damaged"));
}

// Oracle: the report that dynlab makes of the same folder.
TEST_F(leaks, copies_are_made_again_from_the_source) {
    AnonymousCopySetup setup;
    setup.names = *names_;
    setup.program = DYNLAB_PROGRAM;
    write("work/analysis.lua", "-- ---\n-- title: Work\n-- ---\n\n-- %%\nreport.value(\"gain\", 2.5, \"%.1f\")\n");
    write("work/report.md", "---\ntitle: Work\n---\n\n# Result\n\nThe gain is `gain`{.value}.\n\n<!-- Brandtner -->\n");
    write("work/group.toml", "members = [\"Zoé Brandtner\"]\n");
    write("work/report.pdf", read(prose_with("by Brandtner")));
    const AnonymousCopy copy = anonymous_copy(file("work"), file("copy.pdf"), setup);
    ASSERT_TRUE(copy.made) << message_text(copy.trouble)
                           << (copy.findings.empty() ? "" : message_text(copy.findings.front().what));
    EXPECT_TRUE(copy.rebuilt);
    EXPECT_THAT(text_of("copy.pdf"), HasSubstr("The gain is 2.5."));
    EXPECT_EQ(anonymous_copy(file("work"), file("again.pdf"), setup).hash, copy.hash);
    write("work/analysis.lua", "error(\"no\")");
    const AnonymousCopy fallen_back = anonymous_copy(file("work"), file("other.pdf"), setup);
    EXPECT_FALSE(fallen_back.made);
    EXPECT_FALSE(fallen_back.rebuilt);
    EXPECT_EQ(fallen_back.findings.front().id, "name-in-text");
    std::filesystem::remove(file("work/report.pdf"));
    EXPECT_THAT(message_text(anonymous_copy(file("work"), file("other.pdf"), setup).trouble),
                HasSubstr("cannot be made again"));
    write("work/analysis.lua", "x = 1\nprint(meen({1, 2}))\n");
    EXPECT_THAT(message_text(anonymous_copy(file("work"), file("other.pdf"), setup).trouble),
                testing::AllOf(testing::StartsWith("The report cannot be made again: analysis.lua:2: "),
                               testing::EndsWith("did you mean 'mean'?")));
}

// Oracle: the folder that was handed in, which stays as it was, and the size of what a script writes.
TEST_F(leaks, a_report_made_again_fills_no_disk) {
    AnonymousCopySetup setup;
    setup.names = *names_;
    setup.program = DYNLAB_PROGRAM;
    const std::string header = "-- ---\n-- title: Work\n-- ---\n\n-- %%\n";
    write("work/report.md", "---\ntitle: Work\n---\n\n# Result\n\nThe gain is known.\n");
    write("work/analysis.lua", header + "save_csv(\"small.csv\", {t = zeros(3)})\n");
    EXPECT_TRUE(anonymous_copy(file("work"), file("copy.pdf"), setup).made);
    write("work/analysis.lua", header +
                                   "local big = {}\nfor i = 1, 20 do big['c' .. i] = randn(200000) end\n"
                                   "save_csv(\"big.csv\", big, {digits = 17})\n");
    EXPECT_THAT(message_text(anonymous_copy(file("work"), file("none.pdf"), setup).trouble),
                HasSubstr("a file of more than 64 MB"));
    if (setup.isolation != Isolation::kFull) return;
    write("work/analysis.lua", header + "save_csv(\"/box/submission/fill.csv\", {t = zeros(3)})\n");
    const AnonymousCopy copy = anonymous_copy(file("work"), file("none.pdf"), setup);
    EXPECT_FALSE(copy.made);
    EXPECT_THAT(message_text(copy.trouble), HasSubstr("read-only file system (in /box/submission)"));
}

}  // namespace test_leaks
}  // namespace dynlab
