#include <gmock/gmock.h>

#include <iterator>
#include <set>

#include "document_fixture.h"
#include "documents/latex.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_hostile_documents {

using test::inspect_pdf;
using test::PdfContent;
using hostile_documents = DocumentTest;
using testing::HasSubstr;
using testing::Not;

// Oracle of this file: a file with a known secret, which must not turn up, and commands that must be refused by name.

TEST_F(hostile_documents, tex_commands_in_text_are_refused_and_printed_where_they_are_quoted) {
    write("secret.tex", "SECRETWORD");
    const std::string path = file("secret.tex").string();
    const std::string commands = "\\input{" + path + "} and \\write18{touch x}";
    EXPECT_THAT(refusal("Text " + commands + ".\n", "out.pdf"), HasSubstr("report.md:1: the LaTeX command \\input"));
    const PdfContent pdf = inspect_pdf(make("Text `" + commands + "`.\n", "out.pdf"));
    ASSERT_EQ(pdf.pages.size(), 1u);
    EXPECT_THAT(pdf.pages[0], HasSubstr("\\input{"));
    EXPECT_THAT(pdf.pages[0], Not(HasSubstr("SECRETWORD")));
    EXPECT_FALSE(std::filesystem::exists(file("x")));
}

TEST_F(hostile_documents, commands_that_reach_files_or_macros_are_refused_in_formulas) {
    for (const std::string command :
         {"\\input",     "\\include",         "\\openin",      "\\openout",    "\\read",       "\\write",
          "\\immediate", "\\special",         "\\def",         "\\let",        "\\newcommand", "\\catcode",
          "\\csname",    "\\includegraphics", "\\pdffiledump", "\\pdfobj",     "\\directlua",  "\\usepackage",
          "\\loop",      "\\label",           "\\href",        "\\scantokens", "\\@@input",    "\\lstinputlisting"}) {
        EXPECT_THAT(refusal("A\n\n$$ " + command + "{/etc/passwd} $$\n", "out.pdf"),
                    HasSubstr("report.md:3: the command " + command))
            << command;
        EXPECT_THAT(refusal("A $" + command + "{x}$ b\n", "out.html"), HasSubstr(command)) << command;
    }
    EXPECT_THAT(refusal("$$ ^^5cinput{/etc/passwd} $$\n", "out.pdf"), HasSubstr("^^"));
    EXPECT_THAT(refusal("$$ \\begin{filecontents}{x}y\\end{filecontents} $$\n", "out.pdf"), HasSubstr("filecontents"));
    EXPECT_THAT(refusal("$$ a \\] text \\[ b $$\n", "out.pdf"), HasSubstr("\\]"));
    EXPECT_THAT(refusal("$$ a \\end{document} $$\n", "out.pdf"), HasSubstr("\\end{document}"));
}

// Oracle: Pandoc takes minutes for each of these, and is not asked.
TEST_F(hostile_documents, text_that_keeps_pandoc_busy_is_refused_with_its_line) {
    std::string titles;
    for (int i = 0; i < 20; ++i) titles += "[a](b \"c) ";
    for (const std::string& text : {titles, "$a $ " + titles + "x$", std::string(20000, '`')})
        for (const char* output : {"out.pdf", "out.html"})
            EXPECT_THAT(refusal("A\n\n" + text + "\n", output),
                        HasSubstr("report.md:3: Pandoc would need minutes for this paragraph"));
    const std::string message = refusal("---\ntitle: A\nlang: en\n---\nA\n\n" + titles + "\n");
    EXPECT_EQ(message.find("Pandoc would"), message.rfind("Pandoc would")) << message;  // other texts are not to blame
}

// Oracle: with Pandoc's own citations and inline notes each of these takes minutes, or all memory.
TEST_F(hostile_documents, brackets_that_are_never_closed_are_text) {
    for (const char* part : {"a^[b", "[a", "[a][b ", "[0, 1[ ", "[@eq:x; ", "-@eq:x[b ", "^a [b", "[[a] "}) {
        std::string text = "$$ x $$ {#eq:x}\n\n";
        for (int i = 0; i < 60; ++i) text += part;
        EXPECT_THAT(html("A\n\n" + text + "x\n"), HasSubstr("x</p>")) << part;
    }
    EXPECT_THAT(html("A\n\n" + std::string(60, '[') + "a" + std::string(60, ']') + "\n"), HasSubstr("[[[a]]]"));
}

// Oracle: TeX runs \NAME at \begin{NAME}; a category code makes ! begin commands that no list of words sees.
TEST_F(hostile_documents, environments_that_are_none_are_refused) {
    write("canary.tex", "SECRETWORD");
    const std::string stream =
        "!immediate!pdfobj stream file{" + file("canary.tex").string() + "}!pdfrefobj!pdflastobj";
    for (const std::string name : {"catcode", "input", "def", "let", "csname", "immediate", "pdfobj", "verbatim",
                                   "tabular", "minipage", "lrbox", "align**", " array", "array ", "\\input"}) {
        const std::string text = "A $$\\begin{" + name + "}`\\!=0 " + stream + "!relax\\end{" + name + "}$$\n";
        EXPECT_THAT(refusal(text, "out.pdf"), HasSubstr("the environment \\begin{" + name + "} is not allowed"));
        EXPECT_THAT(refusal("A $a\\end{" + name + "}$\n"), HasSubstr("the environment \\end{" + name + "} is not"));
    }
    EXPECT_THAT(refusal("$$ \\begin x $$\n", "out.pdf"), HasSubstr("the environment \\begin is not allowed"));
    EXPECT_THAT(refusal("$$ \\begin\\frac{catcode} $$\n", "out.pdf"), HasSubstr("the environment \\begin is not"));
}

TEST_F(hostile_documents, only_commands_that_set_mathematics_are_allowed) {
    for (const std::string command : {"\\string",
                                      "\\romannumeral",
                                      "\\expandafter",
                                      "\\number",
                                      "\\pdfximage",
                                      "\\typeout",
                                      "\\verb",
                                      "\\mathpalette",
                                      "\\color",
                                      "\\active",
                                      "\\endlinechar",
                                      "\\everymath",
                                      "\\char",
                                      "\\undefined",
                                      "\\mathcode",
                                      "\\ifeof",
                                      "\\@firstofone",
                                      "\\makeatletter",
                                      "\\dynlabneed",
                                      "\\(",
                                      "\\]"}) {
        EXPECT_THAT(refusal("A\n\n$$ a \\\\ \\text{if \\textbf{" + command + "12}} $$\n", "out.pdf"),
                    HasSubstr("report.md:3: the command " + command + " is not allowed in formulas"))
            << command;
    }
    EXPECT_THAT(refusal("$\\alhpa$\n"), HasSubstr("did you mean \\alpha?"));
    EXPECT_THAT(refusal("A\n\n$a\n+ b % c$ d\n"), HasSubstr("report.md:4: write a percent sign"));
    const std::string both = refusal("$\\write$\n\n$$\\begin{input}x\\end{input} \\jobname$$\n");
    for (const char* part : {"report.md:1: the command \\write", "report.md:3: the environment \\begin{input}",
                             "report.md:3: the command \\jobname"})
        EXPECT_THAT(both, HasSubstr(part));
}

/// The words of a list of the filter, "mathematics.NAME = [[...]]".
std::vector<std::string> listed(const std::string& filter, const std::string& name) {
    const std::string begin = "mathematics." + name + " = [[";
    const std::size_t at = filter.find(begin) + begin.size();
    std::istringstream words(filter.substr(at, filter.find("]]", at) - at));
    return {std::istream_iterator<std::string>(words), {}};
}

// Oracle: LaTeX sets each of them, alone.
TEST_F(hostile_documents, all_symbols_environments_and_control_characters_that_are_allowed_can_be_set) {
    const std::string filter =
        read(std::filesystem::path(DYNLAB_SOURCE_DIR) / "report_templates/filters/mathematics.lua");
    std::string text;
    for (const char* list : {"symbols", "operators"})
        for (const std::string& word : listed(filter, list))
            text += "$\\" + word + (word == "mod" || word == "pmod" || word == "pod" ? " 2" : "") + "{}$\n";
    const std::set<std::string> beside_others = {"align",   "align*",   "alignat", "alignat*", "equation", "equation*",
                                                 "flalign", "flalign*", "gather",  "gather*",  "multline", "multline*"};
    for (const std::string& name : listed(filter, "environments")) {
        if (beside_others.contains(name)) continue;
        const bool takes = name == "array" || name == "subarray" || name == "alignedat";
        const std::string argument = !takes ? "" : name == "alignedat" ? "{1}" : "{l}";
        text += "\n$$\\begin{" + name + "}" + argument + "a\\\\b\\end{" + name + "}$$\n";
    }
    text += "\n$\\,\\;\\:\\!\\ \\{\\}\\|\\_\\%\\&\\#\\$\\>\\/\\-\\text{\\'e\\`e\\^e\\~n\\=o\\.z\\\"u}$\n";
    EXPECT_GT(text.size(), 5000u);
    EXPECT_EQ(refusal(text, "out.pdf"), "");
}

/// How LaTeX refuses a body that no filter has seen.
std::string refusal_of_body(const std::string& body) {
    const TemporaryFolder folder;
    LatexJob job;
    job.body = "\\begin{document}\n" + body + "\n\\end{document}\n";
    job.layout.shared_templates = std::filesystem::path(DYNLAB_SOURCE_DIR) / "report_templates";
    job.work_folder = folder.path();
    try {
        run_latex(job);
    } catch (const LatexRefusal& refusal) {
        return refusal.what();
    }
    return "";
}

// What holds should a command ever slip through.
TEST_F(hostile_documents, latex_itself_knows_no_raw_objects_and_fills_no_disk) {
    write("canary.tex", "SECRETWORD");
    EXPECT_EQ(refusal_of_body("plain"), "");
    EXPECT_THAT(refusal_of_body("\\immediate\\pdfobj stream file{" + file("canary.tex").string() + "}"),
                HasSubstr("Undefined control sequence"));
    EXPECT_EQ(refusal_of_body("\\ifcsname tex_pdfobj:D\\endcsname\\errmessage{known}\\fi"), "");
    EXPECT_THAT(refusal_of_body("\\immediate\\openout5=big.tex \\def\\x{aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa}"
                                "\\edef\\x{\\x\\x\\x\\x\\x\\x\\x\\x}\\edef\\x{\\x\\x\\x\\x\\x\\x\\x\\x}"
                                "\\loop\\immediate\\write5{\\x\\x\\x}\\iftrue\\repeat"),
                HasSubstr("a file larger than 64 MB"));
}

TEST_F(hostile_documents, formulas_of_the_course_are_not_refused) {
    EXPECT_NE(
        html("$$ z = \\sqrt{\\frac{(\\ln D_1)^2}{(\\ln D_1)^2 + \\pi^2}}, \\quad \\begin{bmatrix} a & b \\\\ c & d "
             "\\end{bmatrix} \\left[ \\hat{\\theta} \\right]^{\\mathrm{T}} \\underbrace{x}_{y} \\text{if } x \\le 3 "
             "$$\n"),
        "");
}

TEST_F(hostile_documents, raw_output_html_and_metadata_are_refused) {
    EXPECT_THAT(refusal("A\n\n`\\input{x}`{=latex}\n"), HasSubstr("report.md:3: raw output marked {=latex}"));
    EXPECT_THAT(refusal("```{=latex}\n\\input{x}\n```\n"), testing::Ne(""));
    EXPECT_THAT(refusal("A <script>alert(1)</script>\n"), HasSubstr("report.md:1: HTML such as <script>"));
    EXPECT_THAT(refusal("<div onclick=\"x\">a</div>\n"), HasSubstr("HTML such as <div"));
    EXPECT_THAT(refusal("---\nheader-includes: |\n  \\input{x}\n---\n"),
                HasSubstr("report.md:2: metadata key \"header-includes\""));
    EXPECT_THAT(refusal("# A {onclick=\"x\"}\n"), HasSubstr("\"onclick\""));
    EXPECT_THAT(refusal("[a](javascript:alert(1))\n"), HasSubstr("javascript:"));
    EXPECT_THAT(refusal("[a](file:///etc/passwd)\n"), HasSubstr("file:///etc/passwd"));
}

// Oracle: HTML's attributes of events, which run scripts, and which no Markdown needs.
TEST_F(hostile_documents, attributes_are_refused_wherever_markdown_knows_them) {
    const std::pair<const char*, const char*> elements[] = {
        {"[x](https://example.org){onfocus=\"f()\"}", "a link"},
        {"<https://example.org>{onfocus=\"f()\"}", "a link"},
        {"`c`{.lua onfocus=\"f()\"}", "code"},
        {"`v`{.value onfocus=\"f()\"}", "code"},
        {"``` {.lua onfocus=\"f()\"}\nx\n```", "a code block"},
        {"[x]{onfocus=\"f()\"}", "a span"},
        {"![p](p.svg){onfocus=\"f()\"}", "a picture"},
        {"# H {onfocus=\"f()\"}", "a heading"},
        {"::: {.note onfocus=\"f()\"}\nx\n:::", "a block of class note"}};
    write("p.svg", small_svg());
    record_.values["v"] = {1.0, "1"};
    for (const auto& [text, element] : elements)
        for (const char* output : {"out.html", "out.pdf", "out.md"})
            EXPECT_THAT(refusal("A\n\n" + std::string(text) + "\n", output),
                        HasSubstr(std::string("report.md:3: the attribute \"onfocus\" is not supported on ") + element))
                << text << " " << output;
    record_.texts["end"] = {"[x](https://example.org){onfocus=\"f()\"}"};
    EXPECT_THAT(refusal("::: {.text name=end}\n:::\n"), HasSubstr("\"onfocus\" is not supported on a link"));
}

TEST_F(hostile_documents, metadata_in_the_middle_of_the_text_is_text) {
    const std::string text = html("A\n\n---\ntitle: SECRETTITLE\nheader-includes: x\n---\n\nB\n");
    EXPECT_THAT(text, Not(HasSubstr("<title>SECRETTITLE")));
}

TEST_F(hostile_documents, what_a_script_reported_passes_the_same_checks) {
    record_.texts["end"] = {"$$ \\input{/etc/passwd} $$"};
    EXPECT_THAT(refusal("::: {.text name=end}\n:::\n", "out.pdf"), HasSubstr("the command \\input"));
    record_.texts["end"] = {"`\\input{x}`{=latex}"};
    EXPECT_THAT(refusal("::: {.text name=end}\n:::\n", "out.pdf"), HasSubstr("{=latex}"));
    record_.texts["end"] = {"::: {.text name=end}\n:::\n"};
    EXPECT_THAT(refusal("::: {.text name=end}\n:::\n"), HasSubstr("is not supported in text from a script"));
    add_figure("raw", "$\\write18{x}$", DocumentFormat::kPdf);
    EXPECT_THAT(refusal("![](figure:raw)\n", "out.pdf"), HasSubstr("\\write"));
    record_.figures.clear();
    write("report.md", "");
    record_.values["v"] = {std::nullopt, "\\input{/etc/passwd}"};
    EXPECT_THAT(inspect_pdf(make("`v`{.value}\n", "out.pdf")).pages.at(0), HasSubstr("\\input{/etc/passwd}"));
}

TEST_F(hostile_documents, the_title_passes_the_same_checks) {
    EXPECT_THAT(refusal("---\ntitle: $\\input{x}$\n---\n", "out.pdf"), HasSubstr("\\input"));
    EXPECT_THAT(refusal("---\ntitle: A <b>b</b>\n---\n"), HasSubstr("<b>"));
}

TEST_F(hostile_documents, pictures_stay_inside_the_folder) {
    write("inside/picture.svg", small_svg());
    write("secret.svg", small_svg());
    std::filesystem::create_symlink("/etc/hostname", file("link.svg"));
    EXPECT_THAT(refusal("![a](missing.png)\n"),
                HasSubstr("report.md:1: the picture \"missing.png\" is not in the folder of this file"));
    EXPECT_THAT(refusal("![a](../secret.svg)\n"), HasSubstr("outside the folder"));
    EXPECT_THAT(refusal("![a](/etc/passwd)\n"), HasSubstr("outside the folder"));
    EXPECT_THAT(refusal("![a](https://example.org/x.png)\n"), HasSubstr("not an address"));
    EXPECT_THAT(refusal("text ![a](link.svg)\n"), HasSubstr("outside the folder"));
    EXPECT_THAT(refusal("![a](inside/picture.svg)\n", "out.pdf"), HasSubstr("use .pdf, .png or .jpg"));
    EXPECT_THAT(html("![a](inside/picture.svg)\n"), HasSubstr("data:image/svg+xml"));
}

}  // namespace test_hostile_documents
}  // namespace dynlab
