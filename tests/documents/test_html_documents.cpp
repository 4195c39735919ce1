#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sodium.h>

#include "document_fixture.h"
#include "platform/hash.h"

namespace dynlab {
namespace test_html_documents {

using html_documents = DocumentTest;
using testing::HasSubstr;
using testing::Not;

// Oracle of this file: RFC 4648 test vectors for the inlined pictures; HTML's own rules; the definition in document.h.

TEST_F(html_documents, the_file_needs_nothing_but_itself) {
    add_figure("raw", "Raw", DocumentFormat::kHtml);
    const std::string text = html("---\ntitle: A *b*\n---\n$x^2$\n\n![](figure:raw)\n\n[link](https://example.org)\n");
    EXPECT_THAT(text, HasSubstr("<math "));
    EXPECT_THAT(text, HasSubstr("<html lang=\"en\">"));
    EXPECT_THAT(text, HasSubstr("<style>\n:root {"));
    EXPECT_THAT(text, HasSubstr("<h1>A <em>b</em></h1>"));
    EXPECT_THAT(text, testing::Not(testing::ContainsRegex("url[(][^#]")));  // of the page itself: clips of a figure
    for (const char* outside : {"<script src", "<link", "src=\"http", "@import", "fetch(", "XMLHttpRequest"})
        EXPECT_THAT(text, Not(HasSubstr(outside)));
    EXPECT_THAT(text, Not(HasSubstr("dynlab-picture")));
    EXPECT_THAT(text, Not(HasSubstr(folder_.path().string())));
}

// Oracle: Content Security Policy Level 3, SHA-256 by platform/hash; a browser asked so runs the page's own script
// alone and asks no server.
TEST_F(html_documents, browsers_must_run_our_script_alone_and_load_nothing) {
    const std::string text = html("[a](https://example.org){.wide} <https://example.org> `script-src 'none'`\n");
    const std::string before =
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src '";
    const std::string after = "'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">";
    const std::size_t policy = text.find(before), end = text.find(after);
    ASSERT_NE(policy, std::string::npos);
    const std::string allowed = text.substr(policy + before.size(), end - policy - before.size());
    ASSERT_TRUE(allowed.starts_with("sha256-")) << allowed;
    const std::size_t script = text.find("<script>") + 8;
    std::string hash(32, '\0');
    ASSERT_EQ(sodium_base642bin(reinterpret_cast<unsigned char*>(hash.data()), hash.size(), allowed.c_str() + 7,
                                allowed.size() - 7, nullptr, nullptr, nullptr, sodium_base64_VARIANT_ORIGINAL),
              0);
    std::string hex;
    for (const char byte : hash) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    EXPECT_EQ(hex, sha256_of(text.substr(script, text.find("</script>", script) - script)));
    EXPECT_TRUE(text.find("<script", script) == std::string::npos) << "one script";
    const std::size_t head = text.find("<head>");
    EXPECT_EQ(policy, text.find("<meta", text.find("<meta", head) + 1)) << "only the encoding stands before it";
    EXPECT_THAT(text, HasSubstr("<a href=\"https://example.org\">a</a>"));
    EXPECT_NE(text.find("<code>script-src 'none'</code>"), std::string::npos);
}

TEST_F(html_documents, a_figure_of_the_run_brings_what_it_is_drawn_from) {
    add_figure("raw", "Raw", DocumentFormat::kHtml);
    record_.figures["raw"].plot = "{\"size\":[14,7]}";
    const std::string text = html("![](figure:raw)\n\nand again\n\n![](figure:raw)\n");
    const std::string element = "<script type=\"application/json\" class=\"plot-data\">{\"size\":[14,7]}</script>";
    const std::size_t first = text.find(element);
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(text[first - 1], '>') << "right behind its picture";
    EXPECT_NE(text.find(element, first + 1), std::string::npos);
}

TEST_F(html_documents, pictures_are_inlined_byte_for_byte) {
    for (const auto& [bytes, encoded] :
         {std::pair{"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}) {
        write("p.svg", bytes);
        EXPECT_THAT(html("text ![a](p.svg)\n"),
                    HasSubstr(std::string("src=\"data:image/svg+xml;base64,") + encoded + "\""));
    }
}

TEST_F(html_documents, a_formula_that_cannot_be_shown_is_an_error) {
    EXPECT_THAT(refusal("A\n\n$$ \\frac{1}{ $$\n"),
                HasSubstr("report.md:3: Pandoc reports: Could not convert TeX math"));
}

TEST_F(html_documents, markdown_output_has_slots_filled_and_pictures_beside_it) {
    add_figure("raw", "Raw data", DocumentFormat::kHtml);
    record_.values["fit"] = {93.2, "93.2"};
    record_.tables["t"] = {{"Model", "Fit"}, {{"P1", "-93.2"}}};
    const std::string text = read(make(
        "---\ntitle: T\n---\nFit `fit`{.value}, @fig:raw.\n\n![](figure:raw){#fig:raw}\n\n::: {.table name=t}\n:::\n",
        "x.md"));
    EXPECT_THAT(text, HasSubstr("# T\n"));
    EXPECT_THAT(text, HasSubstr("Fit 93.2, Figure"));
    EXPECT_THAT(text, HasSubstr("(x_files/picture-1.svg)"));
    EXPECT_THAT(text, HasSubstr("| P1    | -93.2 |"));
    EXPECT_EQ(read(file("x_files/picture-1.svg")), small_svg());
}

TEST_F(html_documents, numbers_in_tables_do_not_break) {
    record_.tables["t"] = {{"a", "b"}, {{"4.059 (0.284)", "a word"}, {"none", "-1.5 ± 0.2"}, {"no 2", "50 %"}}};
    const std::string text = html("::: {.table name=t}\n:::\n");
    for (const char* number : {"4.059 (0.284)", "50 %"})
        EXPECT_THAT(text, HasSubstr(std::string("<span class=\"number\">") + number + "</span>"));
    EXPECT_THAT(text, HasSubstr("1.5 ± 0.2</span>"));
    for (const char* words : {"a word", "none", "no 2"})
        EXPECT_THAT(text, HasSubstr(std::string(">") + words + "</td>"));
    EXPECT_THAT(text, HasSubstr("td .number"));
}

TEST_F(html_documents, tables_hold_formulas_that_the_text_may_hold) {
    record_.tables["t"] = {{"$a_1$", "cost $5 or $6", "$\\omega_0$ (rad/s)"},
                           {{"$\\input{x}$", "$}$", "$ b $"}, {"1", "2", "3"}}};
    const std::string text = html("::: {.table name=t}\n:::\n");
    EXPECT_THAT(text, HasSubstr("<msub><mi>a</mi><mn>1</mn></msub>"));
    EXPECT_THAT(text, HasSubstr("</math> (rad/s)</th>"));
    for (const char* verbatim : {"cost $5 or $6", "$\\input{x}$", "$}$", "$ b $"})
        EXPECT_THAT(text, HasSubstr(std::string(">") + verbatim + "<"));
}

TEST_F(html_documents, two_runs_give_the_same_bytes) {
    add_figure("raw", "Raw", DocumentFormat::kHtml);
    const std::string text = "# A\n\n![](figure:raw){#fig:raw}\n\n$x$ @fig:raw\n";
    EXPECT_EQ(html(text), html(text));
}

TEST_F(html_documents, the_extension_chooses_the_format) {
    EXPECT_EQ(document_format("a.pdf"), DocumentFormat::kPdf);
    EXPECT_EQ(document_format("a.html"), DocumentFormat::kHtml);
    EXPECT_EQ(document_format("a.md"), DocumentFormat::kMarkdown);
    EXPECT_THROW(document_format("a.docx"), DocumentError);
}

TEST_F(html_documents, the_content_of_screen_blocks_is_shown_by_pages_only_and_counts_nothing) {
    for (const char* name : {"first", "moving", "last"}) add_figure(name, "Shown", DocumentFormat::kHtml);
    const std::string text =
        "![](figure:first)\n\n::: screen\nMove it.\n\n![](figure:moving)\n:::\n\n![](figure:last){#fig:last}\n\nSee "
        "@fig:last.\n";
    const std::string page = html(text);
    EXPECT_THAT(page, HasSubstr("Move it."));
    EXPECT_THAT(page, HasSubstr("<figcaption>Shown</figcaption>"));
    EXPECT_THAT(page, HasSubstr("<strong>Figure 2.</strong>"));
    EXPECT_THAT(page, HasSubstr("<a href=\"#fig:last\">Figure 2</a>"));
    EXPECT_THAT(page, Not(HasSubstr("Figure 3")));
    const std::string paper = read(make(text, "out.md"));
    EXPECT_THAT(paper, Not(HasSubstr("Move it.")));
    EXPECT_THAT(paper, HasSubstr("Figure"));
    EXPECT_THAT(refusal("::: screen\n![](figure:moving){#fig:moving}\n:::\n\nSee @fig:moving.\n", "refused.html"),
                HasSubstr("fig:moving"));
}

TEST_F(html_documents, the_students_template_renders_without_its_guidance) {
    const std::string sheet = read(std::string(DYNLAB_SOURCE_DIR) + "/report_templates/exercise_sheet.md");
    cells_.append("# Answer\n", "analysis.lua", 2);
    const std::string text = html(sheet);
    EXPECT_THAT(text, HasSubstr("Answer"));
    EXPECT_THAT(text, Not(HasSubstr("readers must not know the authors")));
    EXPECT_THAT(text, Not(HasSubstr("The block below")));
}

}  // namespace test_html_documents
}  // namespace dynlab
