#include <gmock/gmock.h>
#include <unistd.h>

#include <map>
#include <regex>

#include "document_fixture.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "support/environment_variable.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_latex_documents {

using test::inspect_pdf;
using test::PdfContent;
using testing::HasSubstr;
using testing::Not;

/// Documents made as PDF, read back with poppler.
class latex_documents : public DocumentTest {
  protected:
    PdfContent pdf(const std::string& text) { return inspect_pdf(make(text, "out.pdf")); }

    /// Right edges of all words in points, by pdftotext's bounding boxes.
    double rightmost_word(const std::filesystem::path& path) const {
        ChildOptions child;
        child.command = {"pdftotext", "-bbox", path.string(), "-"};
        const std::string boxes = run_child(child, "poppler-utils").output;
        const std::regex edge("xMax=\"([0-9.]+)\"");
        double right = 0;
        for (auto it = std::sregex_iterator(boxes.begin(), boxes.end(), edge); it != std::sregex_iterator(); ++it)
            right = std::max(right, std::stod((*it)[1]));
        return right;
    }

    const double kPageWidth = 595.28, kMargin = 70.87;  // A4 and 25 mm in points
};

// Oracle: the text poppler reads back.
TEST_F(latex_documents, symbols_print_in_text_formulas_and_code) {
    const PdfContent content =
        pdf("Prose ω θ° m² µ ± × ≤ ≥ ≈ ∞ → − √ ∂ Δ ∑ ∫ … “q” ‘q’ – — é œ.\n\n$ω ≤ θ$\n\n```lua\nlocal x = \"ω ≥ 1\" -- "
            "θ°\n```\n");
    ASSERT_EQ(content.pages.size(), 1u);
    EXPECT_THAT(content.pages[0], HasSubstr("Prose ω θ"));
    EXPECT_THAT(content.pages[0], HasSubstr("local x"));
    EXPECT_THAT(content.pages[0], HasSubstr("≥"));
}

// Oracle: LaTeX itself prints every character that the check lets pass.
TEST_F(latex_documents, every_character_that_is_let_pass_prints) {
    const std::string latex = std::string(DYNLAB_SOURCE_DIR) + "/report_templates/latex/";
    const std::string table = read(latex + "characters.tex") + read(latex + "vietnamese.tex");
    std::string symbols;
    for (std::size_t at = table.find("} % "); at != std::string::npos; at = table.find("} % ", at + 1))
        symbols += table.substr(at + 4, table.find('\n', at) - at - 4) + " ";
    ASSERT_GT(symbols.size(), 400u);
    std::string letters;
    const auto add = [&](int from, int to) {
        for (int c = from; c <= to; ++c) {
            if (c == 0xAD) continue;  // the soft hyphen prints nothing
            if (c < 0x800)
                letters += {static_cast<char>(0xC0 | (c >> 6)), static_cast<char>(0x80 | (c & 0x3F)), ' '};
            else
                letters += {static_cast<char>(0xE0 | (c >> 12)), static_cast<char>(0x80 | ((c >> 6) & 0x3F)),
                            static_cast<char>(0x80 | (c & 0x3F)), ' '};
        }
    };
    for (const auto& [from, to] : {std::pair{0xA0, 0x125},
                                   {0x128, 0x130},
                                   {0x134, 0x137},
                                   {0x139, 0x13E},
                                   {0x141, 0x148},
                                   {0x14A, 0x165},
                                   {0x168, 0x17E},
                                   {0x218, 0x21B},
                                   {0x2012, 0x2016},
                                   {0x2018, 0x201A},
                                   {0x201C, 0x201E},
                                   {0x2020, 0x2022},
                                   {0x2030, 0x2030},
                                   {0x2039, 0x203A},
                                   {0x20AC, 0x20AC},
                                   {0xFB00, 0xFB04}})
        add(from, to);
    EXPECT_EQ(
        refusal(letters + "\n\n" + symbols + "\n\n*" + symbols + "*\n\n# " + symbols + "\n\n```lua\n-- " + symbols +
                    "\n-- " + letters + "\n```\n\n```\n" + symbols + letters + "\n```\n\n$" + symbols + "$\n",
                "out.pdf"),
        "");
    EXPECT_THAT(notes_, testing::IsEmpty()) << "pdflatex has them all";
}

TEST_F(latex_documents, control_characters_are_named_with_file_and_line) {
    EXPECT_THAT(refusal("A\n\nB \x1b c\n", "out.pdf"), HasSubstr("report.md:3: the control character U+001B"));
    record_.values["v"] = {std::nullopt, "\x1b"};
    EXPECT_THAT(refusal("A `v`{.value}\n", "out.pdf"), HasSubstr("report.md:1: in the reported value \"v\": "));
    EXPECT_THAT(refusal("---\ntitle: \x1b\n---\n", "out.pdf"), HasSubstr("in title: the control character"));
}

// Oracle: the definition of reproducible: two makings in different folders have the same bytes, which name nothing.
TEST_F(latex_documents, two_runs_give_the_same_bytes_without_a_trace_of_the_machine) {
    const std::string text =
        "---\ntitle: T ω\n---\n# A\n\n@fig:raw, `v`{.value}\n\n![](figure:raw){#fig:raw}\n\n```lua\nx = 1\n```\n";
    record_.values["v"] = {1.0, "1"};
    add_figure("raw", "Raw", DocumentFormat::kPdf);
    for (const char* folder : {"a", "b"}) std::filesystem::create_directory(file(folder));
    const std::string first = read(make(text, "a/out.pdf"));
    const std::string again = read(make(text, "a/out.pdf"));
    const std::string elsewhere = read(make(text, "b/other.pdf"));
    EXPECT_EQ(first, again);
    EXPECT_EQ(first, elsewhere);
    ChildOptions child;
    child.command = {"qpdf", "--qdf", "--object-streams=disable", file("a/out.pdf").string(), "-"};
    const std::string plain = run_child(child, "qpdf").output;
    ASSERT_GT(plain.size(), 1000u);
    for (const std::string& trace :
         {folder_.path().string(), std::string("/tmp"), std::string("/home"), std::string("/root"),
          std::string("/CreationDate"), std::string("/ModDate"), std::string("/PTEX"), std::string("dynlab-picture")})
        EXPECT_THAT(plain, Not(HasSubstr(trace)));
    for (const auto& [key, value] : inspect_pdf(file("a/out.pdf")).metadata)
        EXPECT_TRUE(key == "Creator" || key == "Producer" || key == "Title" || key == "Trapped" || value.empty())
            << key << value;
}

// Oracle: counting the passes in the timings.
TEST_F(latex_documents, an_edit_of_the_prose_needs_one_pass) {
    const std::string text = "# One {#sec:one}\n\nProse. @sec:one\n\n# Two\n\nMore.\n";
    make(text, "out.pdf");
    EXPECT_EQ(passes(), 2) << "the first run learns page count and bookmarks";
    make(text + "\nAn edit of the prose.\n", "out.pdf");
    EXPECT_EQ(passes(), 1);
    make(text + "\n# Three\n\nA new bookmark.\n", "out.pdf");
    EXPECT_EQ(passes(), 2);
}

std::size_t entries_of(const Cache& cache) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache.root()))
        count += entry.is_regular_file();
    return count;
}

TEST_F(latex_documents, a_format_that_is_begun_is_taken_or_leaves_nothing) {
    const test::EnvironmentVariable of_this_test("XDG_CACHE_HOME", folder_.path() / "cache");
    const Cache cache;
    write("report.md", "---\nlang: fr\n---\nUn.\n");
    DocumentSource source;
    source.template_file = file("report.md");
    const LatexLayout layout = latex_layout(source);
    EXPECT_EQ(layout.language, "fr");
    LatexLayout other = layout;
    other.shared_templates = folder_.path() / "templates";
    std::filesystem::copy(layout.shared_templates, other.shared_templates, std::filesystem::copy_options::recursive);
    std::ofstream(other.shared_templates / "latex/preamble.tex", std::ios::app) << "% of this test\n";
    const std::size_t before = entries_of(cache);
    { const CachedLatexFormat abandoned(other); }
    EXPECT_EQ(entries_of(cache), before);
    CachedLatexFormat begun(other);
    const std::filesystem::path made = begun.folder();
    std::ifstream format(made / "dynlab.fmt", std::ios::binary);
    ASSERT_TRUE(format);
    EXPECT_NE(format.get(), 0x1f) << "packed by gzip: TeX unpacks it with every document";
    EXPECT_EQ(CachedLatexFormat(other).folder(), made);
    DocumentMaker::Options options;
    options.begun_format = &begun;
    DocumentMaker(options).make(source, file("out.pdf"), DocumentFormat::kPdf, nullptr);
    EXPECT_EQ(inspect_pdf(file("out.pdf")).pages.size(), 1u);
}

TEST_F(latex_documents, the_title_is_in_the_metadata) {
    std::map<std::string, std::string> metadata;
    for (const auto& [key, value] : pdf("---\ntitle: A *step* of ω\n---\nText\n").metadata) metadata[key] = value;
    EXPECT_EQ(metadata["Title"], "A step of ω");
    EXPECT_EQ(metadata["Author"], "");
}

TEST_F(latex_documents, pages_say_how_many_there_are) {
    const PdfContent content = pdf("One\n\n::: pagebreak\n:::\n\nTwo\n");
    ASSERT_EQ(content.pages.size(), 2u);
    EXPECT_THAT(content.pages[0], HasSubstr("1/2"));
    EXPECT_THAT(content.pages[1], HasSubstr("2/2"));
}

// Oracle: the page on which poppler finds the first and the last line, wherever on the page the block begins.
TEST_F(latex_documents, short_blocks_stay_on_one_page) {
    std::string output = "```{.output}\nFIRST\n";
    for (int i = 0; i < 4; ++i) output += "1.23\n";
    std::string table = "::: {.table name=short}\nS {#tbl:s}\n:::\n";
    record_.tables["short"] = {{"k", "y"},
                               {{"FIRST", "1"}, {"2", "2"}, {"3", "3"}, {"4", "4"}, {"5", "5"}, {"LAST", "6"}}};
    const std::string code = "```{.lua}\nFIRST = 1\nb = 2\nc = 3\nd = 4\ne = 5\nLAST = 6\n```\n";
    for (const std::string& block :
         {output + "LAST\n```\n", table, code, std::string("# FIRST\n\n## LAST\n\nProse.\n")}) {
        int begun_on_the_second = 0;
        for (int paragraphs = 22; paragraphs <= 40; paragraphs += 3) {
            std::string text;
            for (int i = 0; i < paragraphs; ++i) text += "Prose.\n\n";
            const PdfContent content = pdf(text + block);
            for (const std::string& page : content.pages)
                EXPECT_EQ(page.find("FIRST") == page.npos, page.find("LAST") == page.npos) << paragraphs << block;
            begun_on_the_second += content.pages.size() == 2 && content.pages[1].find("FIRST") != std::string::npos;
        }
        EXPECT_GT(begun_on_the_second, 0) << block;
        EXPECT_LT(begun_on_the_second, 7) << block;
    }
}

// Oracle: as above. A page of code has no white to spread, so that every place where it may end is taken.
TEST_F(latex_documents, headings_that_follow_each_other_stay_on_one_page) {
    std::string headings = "\n# FIRST\n\n## LAST\n\n";
    for (int i = 0; i < 40; ++i) headings += "prose ";
    int documents = 0, begun_on_the_second = 0;
    for (int lines = 42; lines <= 52; ++lines) {
        std::string code = "```{.lua}\n";
        for (int i = 0; i < lines; ++i) code += "x = 1\n";
        const PdfContent content = pdf(code + "```\n" + headings + "\n");
        for (const std::string& page : content.pages)
            EXPECT_EQ(page.find("FIRST") == page.npos, page.find("LAST") == page.npos) << lines;
        ++documents;
        begun_on_the_second += content.pages.size() == 2 && content.pages[1].find("FIRST") != std::string::npos;
    }
    EXPECT_GT(begun_on_the_second, 0);
    EXPECT_LT(begun_on_the_second, documents);
}

// Oracle: a bold line before a list or a paragraph, at sixty places of a page's height, never ends the page's text.
TEST_F(latex_documents, a_bold_line_stays_with_what_it_heads) {
    std::string text;
    for (int i = 0; i < 60; ++i) {
        for (int line = 0; line < 3 + i % 11; ++line) text += "A line of text.\n\n";
        text += i % 2 == 0 ? "**Heads**\n\n- an entry\n- another\n\n" : "**Heads**\n\nA paragraph.\n\n";
    }
    const PdfContent content = pdf(text);
    EXPECT_GT(content.pages.size(), 8u);
    for (std::size_t page = 0; page < content.pages.size(); ++page) {
        const std::string& words = content.pages[page];
        const std::size_t last = words.rfind("Heads");
        if (last == std::string::npos) continue;
        EXPECT_TRUE(words.find("entry", last) != std::string::npos ||
                    words.find("paragraph", last) != std::string::npos)
            << "page " << page + 1;
    }
}

// Oracle: bounding boxes of the words against the margins of A4.
TEST_F(latex_documents, long_code_and_output_lines_stay_inside_the_text) {
    std::string spaces, solid;
    for (int i = 0; i < 30; ++i) spaces += "word, ";
    for (int i = 0; i < 130; ++i) solid += static_cast<char>('a' + i % 26);
    const auto path =
        make("```{.lua .cell}\nlocal x = " + spaces + "\nlocal y = \"" + solid + "\"\n```\n\n```{.output}\n" + solid +
                 "\n" + spaces + "\n```\n\n```\n" + solid + "\n```\n\n`" + solid + "`\n",
             "out.pdf");
    EXPECT_LT(rightmost_word(path), kPageWidth - kMargin + 2);
    std::string text = inspect_pdf(path).pages.at(0);
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    EXPECT_THAT(text, HasSubstr(solid)) << "nothing may be cut off";
}

TEST_F(latex_documents, wide_and_long_tables_stay_inside_the_page) {
    const std::string sentence =
        "a remark of some length that cannot stand on one line beside the other columns of the table, so wraps";
    record_.tables["wide"] = {{"Model", "Remark", "Second remark"}, {{"P1", sentence, sentence}}};
    record_.tables["numbers"] = {std::vector<std::string>(10, "value"), {std::vector<std::string>(10, "-1.234")}};
    record_.tables["long"] = {{"k", "y"}, {}};
    for (int i = 0; i < 120; ++i) record_.tables["long"].rows.push_back({std::to_string(i), "1.5"});
    const auto path = make(
        "::: {.table name=wide}\nW {#tbl:w}\n:::\n\n::: {.table name=numbers}\nN {#tbl:n}\n:::\n\n"
        "::: {.table name=long}\nL {#tbl:l}\n:::\n",
        "out.pdf");
    EXPECT_LT(rightmost_word(path), kPageWidth - kMargin + 2);
    const PdfContent content = inspect_pdf(path);
    EXPECT_GE(content.pages.size(), 3u);
    EXPECT_THAT(content.pages.back(), HasSubstr("119"));
    record_.tables["wide"] = {std::vector<std::string>(14, "column"), {std::vector<std::string>(14, "-1.2345e-05")}};
    EXPECT_THAT(refusal("::: {.table name=wide}\n:::\n", "other.pdf"),
                HasSubstr("report.md:1: the table \"wide\" with 14 columns is too wide"));
}

// Oracle: the page on which poppler finds the rows, wherever on the page the table is written.
TEST_F(latex_documents, a_table_that_an_author_writes_is_not_broken) {
    const std::string table = "| a | b |\n|---|---|\n| FIRST | 1 |\n| LAST | 2 |\n\n";
    for (const std::string& caption : {std::string(), std::string(": Two rows {#tbl:two}\n\n")}) {
        for (int paragraphs = 24; paragraphs <= 36; ++paragraphs) {
            std::string text;
            for (int i = 0; i < paragraphs; ++i) text += "Prose.\n\n";
            for (const std::string& page : pdf(text + table + caption + "END\n").pages)
                EXPECT_EQ(page.find("FIRST") == page.npos, page.find("LAST") == page.npos) << paragraphs << caption;
        }
    }
}

// Oracle: the words' bounding boxes; all digits of the font are equally wide.
TEST_F(latex_documents, numbers_in_a_column_stand_at_their_points) {
    record_.tables["points"] = {
        {"plain", "error", "share"},
        {{"7", "454 ± 3", "7 %"}, {"11.571", "17.57 ± 0.13", "11.5 %"}, {"-28.1", "1.053 ± 0.006", "100 %"}}};
    const auto path = make("::: {.table name=points}\nP {#tbl:p}\n:::\n", "out.pdf");
    ChildOptions child;
    child.command = {"pdftotext", "-bbox", path.string(), "-"};
    const std::string boxes = run_child(child, "poppler-utils").output;
    const auto edges = [&boxes](const std::string& word) {
        const std::regex box("xMin=\"([0-9.]+)\"[^>]*xMax=\"([0-9.]+)\"[^>]*>" + word + "<");
        std::smatch found;
        EXPECT_TRUE(std::regex_search(boxes, found, box)) << word << "\n" << boxes;
        return found.empty() ? std::pair(0.0, 0.0) : std::pair(std::stod(found[1]), std::stod(found[2]));
    };
    const double digit = (edges("454").second - edges("454").first) / 3, near = 0.3;
    EXPECT_NEAR(edges("7").second, edges("11.571").first + 2 * digit, near);
    EXPECT_NEAR(edges("−28.1").first + digit, edges("11.571").first, 3 * digit) << "a minus sign before the digits";
    EXPECT_NEAR(edges("−28.1").second + 2 * digit, edges("11.571").second, near);
    EXPECT_NEAR(edges("454").second, edges("17.57").first + 2 * digit, near);
    EXPECT_NEAR(edges("1.053").first, edges("17.57").first + digit, near);
    EXPECT_NEAR(edges("3").first, edges("0.13").first, near) << "the errors' points";
    EXPECT_NEAR(edges("100").second, edges("11.5").first + 2 * digit, near);
}

// Oracle: the order in the text poppler reads; the page on which it finds what comes after.
TEST_F(latex_documents, a_figure_that_finds_no_room_floats_and_text_fills_its_page) {
    add_figure("raw", "The caption", DocumentFormat::kPdf);
    std::string text;
    for (int i = 0; i < 33; ++i) text += "Prose.\n\n";
    const PdfContent numbered = pdf(text + "![](figure:raw){#fig:raw}\n\nAFTER\n\n" + text);
    ASSERT_GE(numbered.pages.size(), 2u);
    EXPECT_THAT(numbered.pages[0], HasSubstr("AFTER"));
    EXPECT_THAT(numbered.pages[1], HasSubstr("The caption"));
}

TEST_F(latex_documents, figures_stay_where_they_were_placed) {
    add_figure("raw", "The caption", DocumentFormat::kPdf);
    std::string text = "BEFORE\n\n![](figure:raw){#fig:raw}\n\nAFTER\n";
    const std::string page = pdf(text).pages.at(0);
    EXPECT_LT(page.find("BEFORE"), page.find("The caption"));
    EXPECT_LT(page.find("The caption"), page.find("AFTER"));
    EXPECT_THAT(page, HasSubstr("Figure 1."));
}

TEST_F(latex_documents, a_failure_names_line_section_and_the_first_real_error) {
    const std::string message = refusal("# Start\n\nText.\n\n# The middle\n\nA formula $a + x^1^2$ here.\n", "out.pdf");
    EXPECT_THAT(message, HasSubstr("report.md:7: "));
    EXPECT_THAT(message, HasSubstr("section \"The middle\""));
    EXPECT_THAT(message, HasSubstr("Double superscript"));
    EXPECT_THAT(message, HasSubstr("x^1"));
    EXPECT_LT(message.size(), 400u);
    EXPECT_THAT(refusal("$$ \\frac{1}{2 $$\n", "out.pdf"), HasSubstr("LaTeX cannot typeset this document"));
}

TEST_F(latex_documents, an_accent_that_a_formula_would_lose_is_an_error) {
    EXPECT_THAT(refusal("$é = 1$\n", "out.pdf"), HasSubstr("invalid in math mode"));
}

TEST_F(latex_documents, without_cache_the_document_reads_the_same) {
    const std::string text = "# One\n\nProse ω.\n\n```lua\nx = 1\n```\n";
    const PdfContent cached = pdf(text);
    DocumentSource source;
    source.template_file = file("report.md");
    source.record = &record_;
    DocumentMaker::Options options;
    options.use_cache = false;
    DocumentMaker(options).make(source, file("plain.pdf"), DocumentFormat::kPdf, nullptr);
    EXPECT_EQ(inspect_pdf(file("plain.pdf")).pages, cached.pages);
}

TEST_F(latex_documents, french_documents_need_the_french_language_of_latex) {
    ChildOptions look;
    look.command = {"kpsewhich", "french.ldf"};
    const bool installed = run_child(look, "texlive-binaries").exit_code == 0;
    const std::string text = "---\nlang: fr\n---\nVoir @eq:m.\n\n$$ x $$ {#eq:m}\n";
    try {
        EXPECT_THAT(pdf(text).pages.at(0), HasSubstr("Voir équation 1"));
        EXPECT_TRUE(installed);
    } catch (const MissingProgram& missing) {
        EXPECT_FALSE(installed) << missing.what();
        EXPECT_THAT(missing.what(), HasSubstr("apt install texlive-lang-french"));
    }
}

TEST_F(latex_documents, a_missing_program_is_named_with_its_package) {
    const auto missing = [&](const std::string& search_path) -> std::string {
        const test::EnvironmentVariable path("PATH", search_path);
        try {
            make("Text\n", "out.pdf");
        } catch (const MissingProgram& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(missing("/nowhere"), HasSubstr("apt install pandoc"));
    std::filesystem::create_symlink(*find_program("pandoc"), file("pandoc"));
    EXPECT_THAT(missing(folder_.path().string()), HasSubstr("apt install texlive-latex-base"));
    EXPECT_FALSE(std::filesystem::exists(file("out.pdf")));
}

// Oracle: the old file's bytes.
TEST_F(latex_documents, a_document_that_fails_leaves_the_old_file_as_it_was) {
    const std::string before = read(make("Good.\n", "out.pdf"));
    write("report.md", "");
    EXPECT_THROW(make("`nothing`{.value}\n", "out.pdf"), DocumentError);
    EXPECT_THROW(make("$x^1^2$\n", "out.pdf"), DocumentError);
    EXPECT_EQ(read(file("out.pdf")), before);
    EXPECT_THROW(make("Good.\n", "no/such/folder/out.pdf"), EnvironmentError);
}

TEST_F(latex_documents, figures_are_awaited_between_pandoc_and_latex) {
    write("report.md", "![](figure:late)\n");
    record_.figures["late"].caption = "Late";
    DocumentSource source;
    source.template_file = file("report.md");
    source.record = &record_;
    DocumentMaker({}).make(source, file("out.pdf"), DocumentFormat::kPdf,
                           [&] { add_figure("late", "Late", DocumentFormat::kPdf); });
    EXPECT_THAT(inspect_pdf(file("out.pdf")).pages.at(0), HasSubstr("Late"));
}

TEST_F(latex_documents, damaged_and_missing_pdfs_are_refused_when_inspected) {
    write("bad.pdf", "%PDF-1.5\nnothing\n");
    EXPECT_THROW(inspect_pdf(file("bad.pdf")), EnvironmentError);
    EXPECT_THROW(inspect_pdf(file("none.pdf")), EnvironmentError);
}

}  // namespace test_latex_documents
}  // namespace dynlab
