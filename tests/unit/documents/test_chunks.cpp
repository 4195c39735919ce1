// Documents cut into chunks. Oracle: the text itself (chunks one after another), and what Markdown reads together.
#include "documents/chunks/chunks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "documents/text_lines.h"

namespace test_chunks {
using namespace dynlab;
using testing::ElementsAre;

MarkdownText markdown(const std::string& text) {
    MarkdownText result;
    result.append(text, "report.md", 1);
    return result;
}

std::vector<std::string> pieces(const std::string& text) {
    std::vector<std::string> found;
    for (const Chunk& chunk : chunks_of(markdown(text))) found.push_back(trimmed(chunk.markdown));
    return found;
}

TEST(chunks, begin_behind_empty_lines) {
    EXPECT_THAT(pieces("# A\n\none\ntwo\n\n\nthree\n"), ElementsAre("# A", "one\ntwo", "three"));
}

TEST(chunks, joined_are_the_text) {
    const std::string text = "\n# A\n\n- one\n\n- two\n\n::: {.note}\n\nin\n\n:::\n\nend\n\n\n";
    std::string joined;
    for (const Chunk& chunk : chunks_of(markdown(text))) joined += chunk.markdown;
    EXPECT_EQ(joined, text);
}

TEST(chunks, keep_lists_with_empty_lines_whole) {
    EXPECT_THAT(pieces("- one\n\n- two\n\n  of it\n\n3) three\n\nend\n"),
                ElementsAre("- one\n\n- two\n\n  of it\n\n3) three", "end"));
    EXPECT_THAT(pieces("word\n\n:   what it means\n\nend\n"), ElementsAre("word\n\n:   what it means", "end"));
}

TEST(chunks, keep_fences_whole) {
    EXPECT_THAT(pieces("````lua\na\n\n```\n\nb\n````\n\nend\n"), ElementsAre("````lua\na\n\n```\n\nb\n````", "end"));
    EXPECT_THAT(pieces("::: note\n\n:::: columns\n\na\n\n::::\n\nb\n\n:::\n\nend\n"),
                ElementsAre("::: note\n\n:::: columns\n\na\n\n::::\n\nb\n\n:::", "end"));
}

TEST(chunks, keep_comments_and_tables_whole) {
    EXPECT_THAT(pieces("<!-- a\n\nb -->\n\nend\n"), ElementsAre("<!-- a\n\nb -->", "end"));
    const std::string table = "-------------\n a     b\n----- -------\n 1     2\n\n 3     4\n-------------";
    EXPECT_THAT(pieces(table + "\n\n: What it says\n\nend\n"), ElementsAre(table + "\n\n: What it says", "end"));
    EXPECT_THAT(pieces("Table: What it says\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\nend\n"),
                ElementsAre("Table: What it says\n\n| a | b |\n|---|---|\n| 1 | 2 |", "end"));
}

TEST(chunks, know_where_they_come_from) {
    const std::vector<Chunk> chunks = chunks_of(markdown("# A\n\none\n\ntwo\n"));
    ASSERT_EQ(chunks.size(), 3u);
    EXPECT_EQ(chunks[2].origin.line, 5);
    EXPECT_EQ(chunks[2].origin.file, "report.md");
    EXPECT_EQ(chunks[1].first_line, 3);
    EXPECT_EQ(chunks[1].last_line, 4);
}

/// For any text: a line of any length is a chunk, and marks beside it keep their meaning.
TEST(chunks, take_lines_of_any_length) {
    for (const char filling : {'a', ' ', '-', '`', ':', '~', '.'}) {
        const std::string line = "x" + std::string(1'000'000, filling) + "x";
        EXPECT_EQ(pieces(line + "\n\nend\n").size(), 2u) << filling;
        EXPECT_EQ(pieces(std::string(1'000'000, filling) + "x\n").size(), 1u) << filling;
    }
}

}  // namespace test_chunks
