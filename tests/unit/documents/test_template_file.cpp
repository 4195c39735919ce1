#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "documents/error.h"
#include "documents/template_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_template_file {

using testing::HasSubstr;

TemplateFile read(const std::string& content) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "report.md") << content;
    return read_template(folder.path() / "report.md");
}

std::string refusal(const std::string& content) {
    try {
        read(content);
    } catch (const DocumentError& error) {
        return error.what();
    }
    return "";
}

// Oracle of this file: the definition in template_file.h.

TEST(template_file, reads_header_and_body_with_lines) {
    const TemplateFile file = read(
        "---\ntitle: \"A: b\"\n# a comment\nlang: fr # French\nabstract: |\n  one\n\n  two\ntoc: true\n---\nText\n");
    EXPECT_EQ(file.metadata.at("title"), "A: b");
    EXPECT_EQ(file.metadata.at("lang"), "fr");
    EXPECT_EQ(file.metadata.at("abstract"), "one\n\ntwo\n");
    EXPECT_EQ(file.metadata.at("toc"), "true");
    EXPECT_EQ(file.body.text, "Text\n");
    EXPECT_EQ(file.body.origin_of(1).line, 11);
}

TEST(template_file, other_metadata_is_refused_by_name_and_line) {
    EXPECT_THAT(refusal("---\ntitle: A\nheader-includes: x\n---\n"),
                HasSubstr("report.md:3: metadata key \"header-includes\""));
    EXPECT_THAT(refusal("---\ntitel: A\n---\n"), HasSubstr("did you mean \"title\"?"));
    EXPECT_THAT(refusal("---\nauthor: Me\n---\n"), HasSubstr("anonymously"));
    EXPECT_THAT(refusal("---\nlang: de\n---\n"), HasSubstr("en or fr"));
    EXPECT_THAT(refusal("---\ntoc: maybe\n---\n"), HasSubstr("true or false"));
    EXPECT_THAT(refusal("---\ntitle: [a, b]\n---\n"), HasSubstr("plain text"));
    EXPECT_THAT(refusal("---\ntitle: A\n - b\n---\n"), HasSubstr("report.md:3: "));
    EXPECT_THAT(refusal("---\ntitle: A\ntitle: B\n---\n"), HasSubstr("twice"));
    EXPECT_THAT(refusal("---\ntitle: A\n"), HasSubstr("not closed"));
    EXPECT_THAT(refusal("---\ntitle: \"A\n---\n"), HasSubstr("not closed"));
}

TEST(template_file, cells_take_the_place_of_their_block) {
    MarkdownText cells;
    cells.append("woven\n", "lesson.lua", 7);
    const TemplateFile file = read("before\n\n::: {.cells}\n:::\n\n```\n::: {.cells}\n:::\n```\n");
    const MarkdownText text = with_cells(file, cells);
    EXPECT_EQ(text.text, "before\n\n\nwoven\n\n\n```\n::: {.cells}\n:::\n```\n");
    EXPECT_EQ(text.origin_of(4).file, "lesson.lua");
    EXPECT_EQ(text.origin_of(4).line, 7);
    EXPECT_EQ(text.origin_of(7).line, 6);
    EXPECT_THROW(with_cells(read("::: {.cells}\ntext\n:::\n"), cells), DocumentError);
    EXPECT_THROW(with_cells(read("::: cells\n:::\n\n::: cells\n:::\n"), cells), DocumentError);
}

}  // namespace test_template_file
}  // namespace dynlab
