// The logo and the header of a university above documents. Oracle: the pictures and the text that poppler finds.
#include <gmock/gmock.h>

#include "document_fixture.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"
#include "support/environment_variable.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_letterheads {

using test::inspect_pdf;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// One grey pixel.
const char* const kPicture =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";

class letterheads : public DocumentTest {
  protected:
    /// The pages on which pictures are.
    static std::string pages_with_pictures(const std::filesystem::path& pdf) {
        ChildOptions child;
        child.command = {"pdfimages", "-list", pdf.string()};
        const std::vector<std::string> lines = lines_of(run_child(child, "poppler-utils").output);
        std::string pages;
        for (std::size_t i = 2; i < lines.size(); ++i) pages += trimmed(lines[i].substr(0, 4)) + " ";
        return pages;
    }

    void write_picture(const std::string& name) const { write(name, plain_bytes(kPicture)); }
    static std::string plain_bytes(const std::string& base64_text);
};

std::string letterheads::plain_bytes(const std::string& base64_text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : base64_text) {
        const std::size_t value = letters.find(c);
        if (value == std::string::npos) break;
        bits = (bits << 6) | static_cast<std::uint32_t>(value);
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes += static_cast<char>((bits >> count) & 0xFF);
    }
    return bytes;
}

const std::string kTwoPages = "# One\n\n::: pagebreak\n:::\n\nTwo\n";

TEST_F(letterheads, of_a_template_are_above_its_document) {
    write_picture("logo.png");
    const std::string text = "---\ntitle: A\nlogo: logo.png\nheader: Université de *Lorraine*\n---\n" + kTwoPages;
    const auto pdf = make(text, "out.pdf");
    EXPECT_EQ(pages_with_pictures(pdf), "1 ");
    const auto pages = inspect_pdf(pdf).pages;
    ASSERT_EQ(pages.size(), 2u);
    for (const std::string& page : pages) EXPECT_EQ(page.find("Université de Lorraine"), 0u) << page;
    EXPECT_THAT(html(text), AllOf(HasSubstr("<img src=\"data:image/png;base64," + std::string(kPicture)),
                                  HasSubstr("Université de <em>Lorraine</em>")));
    EXPECT_THAT(read(make(text, "out.md")), Not(HasSubstr("logo")));
    EXPECT_EQ(pages_with_pictures(make("---\ntitle: A\nlayout: slides\nlogo: logo.png\n---\n# One\n", "out.pdf")),
              "1 ");
}

TEST_F(letterheads, of_a_course_are_above_all_its_documents_but_those_with_their_own) {
    write_picture("course/report_templates/logo.png");
    write("course/report_templates/settings.yaml", "logo: logo.png\nheader: Lorraine\n");
    const test::EnvironmentVariable course("DYNLAB_COURSE", file("course").string());
    EXPECT_EQ(pages_with_pictures(make(kTwoPages, "out.pdf")), "1 ");
    EXPECT_THAT(inspect_pdf(file("out.pdf")).pages.at(0), HasSubstr("Lorraine"));
    EXPECT_THAT(inspect_pdf(make("---\nheader: Nancy\n---\nText\n", "out.pdf")).pages.at(0),
                AllOf(HasSubstr("Nancy"), Not(HasSubstr("Lorraine"))));
    write("course/report_templates/settings.yaml", "logo: other.png\n");
    EXPECT_THAT(
        refusal("Text\n", "other.pdf"),
        HasSubstr(
            "course/report_templates/settings.yaml: the picture \"other.png\" is not in the folder of this file"));
    write("course/report_templates/settings.yaml", "header: Nancy\ntitle: Mine\n");
    EXPECT_THAT(refusal("Text\n", "other.pdf"),
                HasSubstr("\"title\" is a template setting and not allowed here; the settings are logo, header"));
}

TEST_F(letterheads, latex_of_a_course_finds_the_pictures_beside_it_and_messages_name_its_templates) {
    const std::string layout = read(std::string(DYNLAB_SOURCE_DIR) + "/report_templates/latex/document.latex");
    write("course/report_templates/latex/document.latex",
          replaced(layout, "$body$", "\\includegraphics{mark.png}\n\n$body$"));
    write_picture("course/report_templates/latex/mark.png");
    write("course/report_templates/own.md", "---\ntitle: A\n---\n\nA formula $a + x^1^2$ here\n");
    const test::EnvironmentVariable course("DYNLAB_COURSE", file("course").string());
    EXPECT_EQ(pages_with_pictures(make("Text\n", "out.pdf")), "1 ");
    DocumentSource source;
    source.template_file = shared_folder() / "report_templates/own.md";
    source.record = &record_;
    try {
        DocumentMaker({}).make(source, file("other.pdf"), DocumentFormat::kPdf, nullptr);
        FAIL() << "it has an error";
    } catch (const DocumentError& error) {
        EXPECT_EQ(error.place().file, file("course/report_templates/own.md"));
        EXPECT_EQ(error.place().line, 5);
    }
}

TEST_F(letterheads, that_name_no_picture_beside_them_are_refused) {
    for (const char* name : {"../logo.png", "/etc/logo.png", "logo.gif", ".logo.png"})
        EXPECT_THAT(
            refusal(std::string("---\nlogo: ") + name + "\n---\nText\n", "out.pdf"),
            HasSubstr("report.md:2: \"logo\" must be the name of a .png, .jpg or .pdf file in the same folder"));
    EXPECT_THAT(refusal("---\nlogo: logo.png\n---\nText\n", "out.pdf"),
                HasSubstr("report.md: the picture \"logo.png\" is not in the folder of this file"));
}

}  // namespace test_letterheads
}  // namespace dynlab
