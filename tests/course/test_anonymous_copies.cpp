// Copies for anonymous readers: what careless authors leave in a PDF is not in its copy. Oracle: qpdf, pdfinfo,
// pdfdetach, pdffonts and pdftotext read the copy.
#include "course/anonymity/anonymous_copy.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>

#include "base/reader.h"
#include "course/anonymity/anonymity_issues.h"
#include "documents/pdf/distilled_pdf.h"
#include "leak_corpus.h"

namespace dynlab {
namespace test_anonymous_copies {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class anonymous_copies : public LeakCorpus {
  protected:
    AnonymousCopySetup setup(bool accept = false) const {
        AnonymousCopySetup setup;
        setup.names = *names_;
        setup.program = DYNLAB_PROGRAM;
        setup.accept = accept;
        return setup;
    }

    std::string output_of(const std::vector<std::string>& command) const {
        ChildOptions child;
        child.command = command;
        child.folder = folder_.path();
        const ChildResult result = run_child(child, command.front());
        return result.output + result.error_output;
    }

    /// All bytes of a PDF, with streams decoded.
    std::string laid_open(const std::string& pdf) {
        run({"qpdf", "--qdf", "--object-streams=disable", "--stream-data=uncompress", pdf, "open.pdf"});
        return read(file(pdf)) + read(file("open.pdf"));
    }

    /// A copy is made, no channel holds the name, and the text is there.
    void expect_clean(const std::filesystem::path& own, const std::string& channel) {
        EXPECT_THAT(laid_open(own.filename()) + output_of({"pdfdetach", "-list", own.filename()}),
                    testing::AnyOf(HasSubstr("randtner"), HasSubstr("72616e64"), HasSubstr("72616E64"),
                                   HasSubstr(wide("randtner"))))
            << channel << ": the test itself";
        const AnonymousCopy copy = anonymous_copy(own, file("copy.pdf"), setup());
        ASSERT_TRUE(copy.made) << channel << message_text(copy.error_reason)
                               << (copy.findings.empty() ? "" : message_text(copy.findings.front().what));
        const std::string bytes = laid_open("copy.pdf");
        for (const std::string& name :
             {std::string("randtner"), std::string("72616e64"), std::string("72616E64"), wide("randtner")})
            EXPECT_THAT(bytes, Not(HasSubstr(name))) << channel;
        EXPECT_THAT(bytes, AllOf(Not(HasSubstr("/Info")), Not(HasSubstr("/Metadata")), Not(HasSubstr("/JavaScript")),
                                 Not(HasSubstr("/OCProperties")), Not(HasSubstr("/EmbeddedFile"))))
            << channel;
        EXPECT_EQ(output_of({"pdfdetach", "-list", "copy.pdf"}), "0 embedded files\n") << channel;
        EXPECT_EQ(output_of({"pdfinfo", "-meta", "copy.pdf"}), "") << channel;
        EXPECT_EQ(output_of({"pdfinfo", "-js", "copy.pdf"}), "") << channel;
        EXPECT_THAT(text_of("copy.pdf"), HasSubstr("gain is known")) << channel;
    }

    static std::string wide(const std::string& ascii) {
        std::string units;
        for (const char c : ascii) units += {'\0', c};
        return units;
    }

    static constexpr const char* kHello = "BT /F1 12 Tf 72 700 Td (The gain is known) Tj ET\n";
    static constexpr const char* kForm = "/Type/XObject/Subtype/Form/BBox[0 0 9 9]";
};

TEST_F(anonymous_copies, document_information_and_private_data) {
    expect_clean(prose_with("The gain is known.\\pdfinfo{/Author (Brandtner) /Title (by Brandtner)}"), "information");
    expect_clean(page_with(kHello, "/Metadata 6 0 R", "",
                           {stream_of("<x:xmpmeta><dc:creator>Brandtner</dc:creator></x:xmpmeta>",
                                      "/Type/Metadata/Subtype/XML")}),
                 "XMP");
    expect_clean(page_with(kHello, "/PieceInfo<</Editor<</Private(Brandtner)>>>>", "/PieceInfo<</P(Brandtner)>>"),
                 "private data");
    expect_clean(page_with(kHello, "/PageLabels<</Nums[0<</P(Brandtner)>>]>>/Own(Brandtner)"), "labels");
    expect_clean(page_with(kHello, "/StructTreeRoot<</Type/StructTreeRoot/K<</S/Document/Alt(Brandtner)>>>>"), "tags");
}

TEST_F(anonymous_copies, attachments_and_annotations) {
    const auto embedded = [this](const char* name, const char* content) {
        prose_with("The gain is known.");
        write(name, content);
        run({"pdfattach", "own.pdf", name, "with.pdf"});
        std::filesystem::rename(file("with.pdf"), file("own.pdf"));
        return file("own.pdf");
    };
    expect_clean(embedded("brandtner.txt", "nothing"), "name of an attachment");
    expect_clean(embedded("notes.txt", "by Brandtner"), "attachment");
    for (const char* entries :
         {"/Subtype/Text/T(brandtner)/Contents(x)", "/Subtype/Text/Contents(ask Brandtner)",
          "/Subtype/FileAttachment/FS<</F(brandtner.txt)/UF(brandtner.txt)>>",
          "/Subtype/Highlight/QuadPoints[9 9 99 9 9 99 99 99]/T(Brandtner)", "/Subtype/Popup/Contents(Brandtner)",
          "/Subtype/Link/Border[0 0 0]/Contents(Brandtner)/NM(brandtner)/A<</S/URI/URI(https://example.org)>>"})
        expect_clean(page_with(kHello, "", std::string("/Annots[<</Type/Annot/Rect[9 9 99 99]") + entries + ">>]"),
                     entries);
}

TEST_F(anonymous_copies, scripts_and_actions) {
    const std::string script = "<</S/JavaScript/JS(app.alert\\('Brandtner'\\))>>";
    expect_clean(page_with(kHello, "/OpenAction" + script), "open action");
    expect_clean(page_with(kHello, "/AA<</WC" + script + ">>", "/AA<</O" + script + ">>"), "further actions");
    expect_clean(page_with(kHello, "/Names<</JavaScript<</Names[(brandtner)" + script + "]>>>>"), "names");
    for (const std::string& action : {script, std::string("<</S/Launch/F(/home/brandtner/a.m)>>"),
                                      std::string("<</S/GoToR/F(brandtner.pdf)/D[0/Fit]>>"),
                                      std::string("<</S/URI/URI(file:///home/brandtner/a.pdf)>>"),
                                      std::string("<</S/SubmitForm/F<</FS/URL/F(https://brandtner.example/)>>>>")})
        expect_clean(page_with(kHello, "", "/Annots[<</Type/Annot/Subtype/Link/Rect[9 9 99 99]/A" + action + ">>]"),
                     action);
}

TEST_F(anonymous_copies, layers_that_are_off_and_earlier_revisions) {
    const std::string off = "/OCProperties<</OCGs[6 0 R]/D<</OFF[6 0 R]/Order[6 0 R]>>>>";
    expect_clean(page_with(std::string(kHello) + "/OC /L BDC BT /F1 9 Tf 72 600 Td (by Brandtner) Tj ET EMC", off, "",
                           {"<</Type/OCG/Name(notes)>>"}),
                 "hidden layer");
    expect_clean(page_with(std::string(kHello) + "/OC /L BDC 0 0 m 9 9 l S EMC", off, "",
                           {"<</Type/OCG/Name(layer of Brandtner)>>"}),
                 "name of a layer");
    const std::string named = read(page_with(std::string(kHello) + "BT /F1 9 Tf 72 600 Td (by Brandtner) Tj ET"));
    write("own.pdf", updated(named, 4, stream_of(kHello)));
    const AnonymousCopy copy = anonymous_copy(file("own.pdf"), file("copy.pdf"), setup());
    ASSERT_TRUE(copy.made) << message_text(copy.error_reason);
    EXPECT_THAT(read(file("own.pdf")), HasSubstr("Brandtner"));
    EXPECT_THAT(laid_open("copy.pdf"), Not(HasSubstr("Brandtner")));
    const std::string plain = read(page_with(kHello));
    write("own.pdf", plain + "\nsaved by Zoe Brandtner\n%%EOF\n");
    ASSERT_TRUE(anonymous_copy(file("own.pdf"), file("copy.pdf"), setup()).made);
    EXPECT_THAT(laid_open("copy.pdf"), Not(HasSubstr("Brandtner")));
}

TEST_F(anonymous_copies, unseen_parts_of_pages) {
    expect_clean(page_with(std::string(kHello) + "% by Brandtner\n/Brandtner MP"), "comments in content");
    expect_clean(page_with(std::string(kHello) + "/Span<</ActualText(Brandtner)>>BDC 0 0 m 9 9 l S EMC"),
                 "actual text");
    expect_clean(page_with(kHello, "", "", {stream_of("BT /F1 9 Tf (by Brandtner) Tj ET", kForm)}), "unused form");
    expect_clean(
        page_with(std::string(kHello) + "q /X0 Do Q", "", "",
                  {stream_of("0 0 m 9 9 l S",
                             std::string(kForm) + "/PTEX.FileName(/home/brandtner/a.pdf)/LastModified(Brandtner)")}),
        "path of a figure's file");
}

// Oracle: ITU-T T.81, B.2.4 (segments), and what was put into them.
TEST_F(anonymous_copies, photographs_and_fonts) {
    run({"gnuplot", "-e", "set terminal jpeg size 400,300; set output 'plain.jpg'; plot x"});
    const std::string picture = read(file("plain.jpg"));
    const auto showing = [&](char marker, const std::string& text) {
        const std::size_t length = text.size() + 2;
        write("plain.jpg", picture.substr(0, 2) + "\xFF" + marker + static_cast<char>(length >> 8) +
                               static_cast<char>(length & 0xFF) + text + picture.substr(2));
        return latex("\\usepackage{graphicx}\n",
                     std::string("The gain is known. ") + kProse + "\\includegraphics[width=3cm]{plain.jpg}");
    };
    expect_clean(showing('\xFE', "photo by Brandtner"), "JPEG comment");
    expect_clean(showing('\xE1', std::string("Exif\0\0MM\0*\0\0\0\x08\0\0\0\0\0\0\0\0\0", 20) + wide("by Brandtner")),
                 "EXIF");

    // A Type 1 font, which becomes a compact one, and a TrueType font, both named after the author.
    std::string own = read(prose_with("The gain is known."));
    own = std::regex_replace(own, std::regex("LMRoman10-Regular"), "ZoeBrandtner-Hand");
    write("own.pdf", own);
    expect_clean(file("own.pdf"), "compact font");
    std::string font = read("/usr/share/fonts/truetype/dejavu/DejaVuSansMono-Bold.ttf");
    const std::string from = wide("DejaVu Sans Mono"), to = wide("Zoe Brandtner XY");
    for (std::size_t at = font.find(from); at != std::string::npos; at = font.find(from, at))
        font.replace(at, from.size(), to);
    std::string widths;
    for (int i = 32; i < 127; ++i) widths += "602 ";
    write(
        "own.pdf",
        pdf_of({"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
                "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 5 0 R>>>>>>",
                stream_of(kHello),
                "<</Type/Font/Subtype/TrueType/BaseFont/ZoeBrandtner/FirstChar 32/LastChar 126/Widths[" + widths +
                    "]/FontDescriptor 6 0 R/Encoding/WinAnsiEncoding>>",
                "<</Type/FontDescriptor/FontName/ZoeBrandtner/FontFamily(Brandtner)/Flags 33/FontBBox[0 -200 1000 800]"
                "/ItalicAngle 0/Ascent 800/Descent -200/CapHeight 700/StemV 80/FontFile2 7 0 R>>",
                stream_of(font, "/Length1 " + std::to_string(font.size()))}));
    expect_clean(file("own.pdf"), "TrueType font");
    EXPECT_THAT(output_of({"pdffonts", "copy.pdf"}), HasSubstr("AAAAAA+Font1"));
}

// Oracle: what the pages look like, what they say, and where their links lead.
TEST_F(anonymous_copies, pages_links_and_bookmarks_stay) {
    latex("\\usepackage{hyperref}\n",
          "\\section{The crane}" + std::string(kProse) +
              "See section~\\ref{model}, \\url{https://example.org/crane} and "
              "\\href{mailto:a@example.org}{mail}.\\newpage"
              "\\section{Model}\\label{model} The gain is $k = \\frac{1}{2}$. The fi and ffl of waffle.");
    run({"pdflatex", "-interaction=batchmode", "own.tex"});
    const AnonymousCopy copy = anonymous_copy(file("own.pdf"), file("copy.pdf"), setup());
    ASSERT_TRUE(copy.made) << message_text(copy.error_reason);
    EXPECT_FALSE(copy.rebuilt);
    EXPECT_THAT(copy.findings, IsEmpty());
    run({"qpdf", "--check", "copy.pdf"});
    const std::string bytes = laid_open("copy.pdf");
    EXPECT_THAT(bytes, AllOf(HasSubstr("(https://example.org/crane)"), HasSubstr("(mailto:a@example.org)"),
                             HasSubstr("/Title <feff004d006f00640065006c>"), HasSubstr("/Dest")));
    EXPECT_EQ(text_of("copy.pdf"), text_of("own.pdf"));
    for (const char* name : {"own", "copy"}) run({"pdftoppm", "-r", "40", "-gray", std::string(name) + ".pdf", name});
    const std::string before = read(file("own-1.pgm")), after = read(file("copy-1.pgm"));
    ASSERT_EQ(before.size(), after.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        differing += std::abs(static_cast<unsigned char>(before[i]) - static_cast<unsigned char>(after[i])) > 64;
    EXPECT_LT(differing, before.size() / 200);
}

TEST_F(anonymous_copies, equal_input_gives_equal_bytes) {
    run({"gnuplot", "-e", "set terminal jpeg size 400,300; set output 'plain.jpg'; plot x"});
    const auto own = latex("\\usepackage{graphicx,hyperref}\n",
                           "\\section{The crane}" + std::string(kProse) +
                               "\\includegraphics[width=3cm]{plain.jpg}\\url{https://example.org}");
    const AnonymousCopy copy = anonymous_copy(own, file("copy.pdf"), setup());
    const AnonymousCopy again = anonymous_copy(own, file("again.pdf"), setup());
    ASSERT_TRUE(copy.made) << message_text(copy.error_reason);
    EXPECT_EQ(copy.hash, again.hash);
    EXPECT_EQ(read(file("copy.pdf")), read(file("again.pdf")));
}

TEST_F(anonymous_copies, names_in_the_text_stop_a_copy_unless_accepted) {
    const auto own = latex("", std::string(kProse) + "by Brandtner");
    const AnonymousCopy stopped = anonymous_copy(own, file("stopped.pdf"), setup());
    EXPECT_FALSE(stopped.made);
    ASSERT_FALSE(stopped.findings.empty());
    EXPECT_EQ(stopped.findings.front().id, "name-in-text");
    EXPECT_EQ(stopped.findings.front().page, 1);
    EXPECT_FALSE(std::filesystem::exists(file("stopped.pdf")));
    const AnonymousCopy accepted = anonymous_copy(own, file("accepted.pdf"), setup(true));
    EXPECT_TRUE(accepted.made);
    EXPECT_EQ(accepted.findings.front().id, "name-in-text");
    EXPECT_THAT(text_of("accepted.pdf"), HasSubstr("by Brandtner"));
}

TEST_F(anonymous_copies, filled_form_fields_are_printed_and_searched) {
    const auto own = page_with(
        kHello, "/AcroForm<</Fields[6 0 R]/DA(/F1 10 Tf)/DR<</Font<</F1 5 0 R>>>>>>", "/Annots[6 0 R]",
        {"<</Type/Annot/Subtype/Widget/FT/Tx/T(who)/V(Zoe Brandtner)/Rect[99 99 299 120]/F 4/DA(/F1 10 Tf 0 g)"
         "/AP<</N 7 0 R>>>>",
         stream_of("BT /F1 10 Tf 2 5 Td (Zoe Brandtner) Tj ET",
                   "/Type/XObject/Subtype/Form/BBox[0 0 200 21]/Resources<</Font<</F1 5 0 R>>>>")});
    const AnonymousCopy copy = anonymous_copy(own, file("copy.pdf"), setup());
    EXPECT_FALSE(copy.made);
    ASSERT_FALSE(copy.findings.empty());
    EXPECT_EQ(copy.findings.front().id, "name-in-text");
}

TEST_F(anonymous_copies, unreadable_files_and_missing_or_slow_programs_are_reported) {
    write("broken.pdf", "%PDF-1.4\nnothing\n%%EOF\n");
    const AnonymousCopy broken = anonymous_copy(file("broken.pdf"), file("none.pdf"), setup());
    EXPECT_FALSE(broken.made);
    EXPECT_THAT(message_text(broken.error_reason), HasSubstr("damaged"));
    const auto own = page_with(kHello);
    try {
        distilled_pdf(own, {strongest_isolation(), {std::chrono::milliseconds(1)}, {}});
        ADD_FAILURE() << "a millisecond is enough";
    } catch (const PdfRefusal& refusal) {
        EXPECT_THAT(refusal.what(), HasSubstr("Ghostscript cannot print the file: printing takes longer than"));
    }
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", folder_.path().c_str(), 1);
    try {
        anonymous_copy(own, file("none.pdf"), setup());
        ADD_FAILURE() << "made without Ghostscript";
    } catch (const MissingProgram& error) {
        EXPECT_STREQ(error.what(), "gs is not installed. Install it with: sudo apt install ghostscript");
    }
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_FALSE(std::filesystem::exists(file("none.pdf")));
}

// Oracle: the report of a lesson names no student. Its PDF has objects such as "/Group 18 0 R", fonts and page trees.
TEST_F(anonymous_copies, of_a_lesson_in_a_course_of_99_groups_with_surnames_from_pdf_syntax) {
    AnonymousCopySetup setup;
    const std::vector<std::string> surnames = {"Null",     "Font",      "Sans",  "Latin", "Count", "Kids", "Catalog",
                                               "Contents", "Resources", "Prev",  "Lang",  "Page",  "Root", "Parent",
                                               "Link",     "Roman",     "True",  "Type",  "Group", "Name", "Filter",
                                               "Length",   "Title",     "Width", "Info"};
    for (int i = 1; i <= 99; ++i) {
        const std::string& surname = surnames[static_cast<std::size_t>(i) % surnames.size()];
        Student student;
        student.id = std::to_string(20210000 + i);
        student.name = (i % 2 == 0 ? surname + " " : "Ada ") + surname;
        student.group = (i < 10 ? "group-0" : "group-") + std::to_string(i);
        setup.names.add(student, i == 2);
    }
    run({DYNLAB_PROGRAM, "report", DYNLAB_SOURCE_DIR "/lessons/02_least_squares", "-o", file("lesson.pdf").string()});
    const AnonymousCopy copy = anonymous_copy(file("lesson.pdf"), file("copy.pdf"), setup);
    EXPECT_TRUE(copy.made);
    for (const Issue& issue : copy.findings) EXPECT_EQ(issue.id, "name-ordinary-word") << message_text(issue.what);
    EXPECT_LE(copy.findings.size(), 1u);
}

// Oracle: the report that dynlab makes of the same folder.
TEST_F(anonymous_copies, copies_are_made_again_from_the_source) {
    const AnonymousCopySetup setup = this->setup();
    write("work/analysis.lua", "-- ---\n-- title: Work\n-- ---\n\n-- %%\nreport.value(\"gain\", 2.5, \"%.1f\")\n");
    write("work/report.md", "---\ntitle: Work\n---\n\n# Result\n\nThe gain is `gain`{.value}.\n\n<!-- Brandtner -->\n");
    write("work/group.toml", "members = [\"Zoé Brandtner\"]\n");
    write("work/report.pdf", read(prose_with("by Brandtner")));
    const AnonymousCopy copy = anonymous_copy(file("work"), file("copy.pdf"), setup);
    ASSERT_TRUE(copy.made) << message_text(copy.error_reason)
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
    EXPECT_THAT(message_text(anonymous_copy(file("work"), file("other.pdf"), setup).error_reason),
                HasSubstr("cannot be created again"));
    write("work/analysis.lua", "x = 1\nprint(meen({1, 2}))\n");
    EXPECT_THAT(message_text(anonymous_copy(file("work"), file("other.pdf"), setup).error_reason),
                testing::AllOf(testing::StartsWith("The report cannot be created again: analysis.lua:2: "),
                               testing::EndsWith("did you mean 'mean'?")));
}

// Oracle: the submitted folder, which stays as it was, and the size of what a script writes.
/// Names in all scripts, as LuaLaTeX prints them. Oracle: the names that were written.
TEST_F(anonymous_copies, names_of_all_scripts_are_found_in_reports_that_are_made_again) {
    const char* const kNames[] = {"Σωκράτης Παπαδόπουλος", "Дмитрий Иванов", "王小明",      "김민준",
                                  "محمد الأحمد",           "דוד לויתן",      "क्षत्रिय शर्मा", "გიორგი მაისურაძე",
                                  "Հայկ Սարգսյան",         "Nguyễn Văn Tuấn"};
    AnonymousCopySetup named = setup();
    std::string text = "---\ntitle: A\n---\n\nThe gain is `x`{.value}.\n";
    for (const char* name : kNames) {
        Student student;
        student.name = name;
        named.names.add(student);
        text += std::string("\nIt was measured by ") + name + ".\n";
    }
    write("work/analysis.lua", "report.value('x', 1)\n");
    write("work/report.md", text);
    const AnonymousCopy copy = anonymous_copy(file("work"), file("copy.pdf"), named);
    EXPECT_TRUE(copy.rebuilt) << message_text(copy.not_rebuilt) << message_text(copy.error_reason);
    EXPECT_FALSE(copy.made);
    std::string reported;
    for (const Issue& issue : copy.findings)
        if (issue.severity == Severity::kRule) reported += message_text(issue.what) + "\n";
    for (const char* name : kNames) EXPECT_THAT(reported, HasSubstr(std::string("The name of ") + name));
}

/// Oracle: the mistake in the script.
TEST_F(anonymous_copies, why_a_report_was_not_made_again_is_reported) {
    write("work/analysis.lua", "local x = nothing + 1\n");
    write("work/report.md", "---\ntitle: A\n---\n\nText.\n");
    prose_with("The gain is known.");
    std::filesystem::rename(file("own.pdf"), file("work/report.pdf"));
    const AnonymousCopy copy = anonymous_copy(file("work"), file("copy.pdf"), setup());
    EXPECT_TRUE(copy.made);
    EXPECT_FALSE(copy.rebuilt);
    EXPECT_THAT(message_text(copy.not_rebuilt),
                AllOf(HasSubstr("The report cannot be created again: "), HasSubstr("analysis.lua:1")));
}

TEST_F(anonymous_copies, a_report_made_again_fills_no_disk) {
    const AnonymousCopySetup setup = this->setup();
    const std::string header = "-- ---\n-- title: Work\n-- ---\n\n-- %%\n";
    write("work/report.md", "---\ntitle: Work\n---\n\n# Result\n\nThe gain is known.\n");
    write("work/analysis.lua", header + "save_csv(\"small.csv\", {t = zeros(3)})\n");
    EXPECT_TRUE(anonymous_copy(file("work"), file("copy.pdf"), setup).made);
    write("work/analysis.lua", header +
                                   "local big = {}\nfor i = 1, 20 do big['c' .. i] = randn(200000) end\n"
                                   "save_csv(\"big.csv\", big, {digits = 17})\n");
    EXPECT_THAT(message_text(anonymous_copy(file("work"), file("none.pdf"), setup).error_reason),
                HasSubstr("a file larger than 64 MB"));
    if (setup.isolation != Isolation::kFull) return;
    write("work/analysis.lua", header + "save_csv(\"/box/submission/fill.csv\", {t = zeros(3)})\n");
    const AnonymousCopy copy = anonymous_copy(file("work"), file("none.pdf"), setup);
    EXPECT_FALSE(copy.made);
    EXPECT_THAT(message_text(copy.error_reason), HasSubstr("read-only file system (in /box/submission)"));
}

}  // namespace test_anonymous_copies
}  // namespace dynlab
