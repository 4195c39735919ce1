// Documents set chunk by chunk, again and again. Oracle: the whole document as DocumentMaker sets it at once.
#include "documents/chunks/chunk_setter.h"

#include <gmock/gmock.h>

#include <regex>

#include "documents/document_fixture.h"
#include "documents/weave.h"
#include "support/message_texts.h"

namespace test_chunk_setter {
using namespace dynlab;
using test::texts_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kText =
    "---\ntitle: A report\n---\n\n# First {#sec:first}\n\nSee @fig:one, @tbl:two and @eq:three in @sec:first.\n\n"
    "$$a = b$$ {#eq:three}\n\n![What is seen](figure:step){#fig:one}\n\nThe fit is `fit`{.value} %.\n\n"
    "::: {.table name=models}\nModels {#tbl:two}\n:::\n\n## Second\n\n- a\n\n- b\n\n"
    "A figure again: @fig:one.\n\n![Another](figure:bode){#fig:four}\n\nEnd, with @fig:four.\n";

/// What differs between a page in chunks and a page at once: the names of pictures, and of lines of code.
std::string without_names(const std::string& html) {
    std::string plain = std::regex_replace(html, std::regex("src=\"[^\"]*\""), "src");
    plain = std::regex_replace(plain, std::regex("(id|href)=\"#?cb[0-9-]*\""), "");
    return std::regex_replace(plain, std::regex("\\s+"), " ");
}

std::string joined(const SetDocument& document) {
    std::string html = document.head + "<main>";
    for (const SetChunk& chunk : document.chunks) html += " " + chunk.html;
    return html + document.notes + " </main>";
}

class chunk_setter : public DocumentTest {
  protected:
    chunk_setter() {
        record_.values["fit"] = {93.2, "93.2"};
        record_.tables["models"] = {{"model", "fit"}, {{"A", "1"}, {"B", "2"}}};
        add_figure("step", "", DocumentFormat::kHtml);
        add_figure("bode", "", DocumentFormat::kHtml);
    }

    SetDocument set(const std::string& text, bool unfinished = false) {
        write("report.md", text);
        DocumentSource source;
        source.template_file = file("report.md");
        source.record = &record_;
        source.cells = cells_;
        return setter_.set(source, unfinished);
    }

    std::string at_once(const std::string& text) {
        const std::string html = read(make(text, "page.html"));
        const std::size_t begin = html.find("<body>") + 6, end = html.find("</main>") + 7;
        return html.substr(begin, end - begin);
    }

    void expect_as_at_once(const std::string& text) {
        const std::string in_chunks = without_names(joined(set(text))), whole = without_names(at_once(text));
        EXPECT_EQ(std::regex_replace(in_chunks, std::regex(" "), ""), std::regex_replace(whole, std::regex(" "), ""));
    }

    ChunkSetter setter_;
};

std::string changed(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST_F(chunk_setter, sets_what_a_document_is_at_once) {
    expect_as_at_once(kText);
    EXPECT_EQ(setter_.chunks_set(), 11u);
}

TEST_F(chunk_setter, sets_again_only_what_has_changed) {
    set(kText);
    expect_as_at_once(kText);
    EXPECT_EQ(setter_.chunks_set(), 0u);
    expect_as_at_once(changed(kText, "A figure again", "The figure again"));
    EXPECT_EQ(setter_.chunks_set(), 1u);
    expect_as_at_once(changed(kText, "What is seen", "What one sees"));
    EXPECT_EQ(setter_.chunks_set(), 2u);  // and the one that was changed before
}

TEST_F(chunk_setter, numbers_stay_right_when_figures_come_and_go) {
    set(kText);
    const std::string one_more = changed(kText, "## Second", "![New](figure:bode){#fig:new}\n\n## Second");
    expect_as_at_once(one_more);
    EXPECT_THAT(joined(set(one_more)), HasSubstr("Figure\u00A03"));
    expect_as_at_once(kText);
    expect_as_at_once(changed(kText, "![What is seen](figure:step){#fig:one}\n\n",
                              "![What is seen](figure:step){#fig:one}\n\n![](figure:bode)\n\n"));
}

TEST_F(chunk_setter, equations_of_solutions_are_counted_as_in_the_whole) {
    const std::string text =
        "# One\n\n$$ a $$ {#eq:solution-a}\n\n# Two\n\n$$ b $$ {#eq:b}\n\n# Three\n\n"
        "$$ c $$ {#eq:solution-c}\n\n@eq:solution-c follows @eq:b.\n";
    expect_as_at_once(text);
    expect_as_at_once(changed(text, "follows", "stands behind"));
    EXPECT_LT(setter_.chunks_set(), 3u);
    EXPECT_THAT(joined(set(text)), HasSubstr("(S2)"));
}

TEST_F(chunk_setter, references_follow_labels) {
    set(kText);
    const std::string renamed = changed(kText, "{#eq:three}", "{#eq:other}");
    EXPECT_THAT(texts_of(set(renamed).complaints),
                ElementsAre(HasSubstr("report.md:7: the cross-reference @eq:three has no target")));
    EXPECT_THAT(set(kText).complaints, IsEmpty());
    expect_as_at_once(kText);
}

TEST_F(chunk_setter, shows_new_values_where_they_stand) {
    set(kText);
    record_.values["fit"] = {95.1, "95.1"};
    EXPECT_THAT(joined(set(kText)), HasSubstr("The fit is 95.1"));
    EXPECT_EQ(setter_.chunks_set(), 1u);
    record_.tables["models"].rows[0][1] = "7";
    expect_as_at_once(kText);
    EXPECT_EQ(setter_.chunks_set(), 1u);
}

TEST_F(chunk_setter, says_what_is_not_there_yet) {
    record_.values.clear();
    EXPECT_THAT(set(kText, true).complaints, IsEmpty());
    const SetDocument finished = set(kText, false);
    EXPECT_THAT(texts_of(finished.complaints), ElementsAre(HasSubstr("the script reported no value \"fit\"")));
    EXPECT_THAT(joined(finished), HasSubstr("A figure again"));  // all else is shown
    record_.values["fit"] = {1.0, "1"};
    expect_as_at_once(kText);
}

TEST_F(chunk_setter, footnotes_are_those_of_the_whole_document) {
    const std::string noted = changed(kText, "A figure again", "A figure[^1] again") + "\n[^1]: a note\n";
    set(noted);
    expect_as_at_once(noted);
    expect_as_at_once(changed(noted, "a note", "another note"));
}

TEST_F(chunk_setter, literature_is_behind_the_last_chunk) {
    write("references.bib",
          "@book{ljung1999, author = {Ljung, Lennart}, title = {System Identification}, year = {1999}}\n");
    const std::string cited =
        changed(changed(kText, "title: A report", "title: A report\nbibliography: references.bib"), "A figure again",
                "A figure [@ljung1999] again");
    set(cited);
    expect_as_at_once(cited);
    expect_as_at_once(changed(cited, "End, with", "The end, with"));
    EXPECT_EQ(setter_.chunks_set(), 1u);
    expect_as_at_once(changed(cited, " [@ljung1999]", ""));
}

TEST_F(chunk_setter, literature_is_where_its_author_puts_it) {
    write("references.bib",
          "@book{ljung1999, author = {Ljung, Lennart}, title = {System Identification}, year = 1999}\n");
    const std::string text = changed(changed(kText, "title: A report", "title: A report\nbibliography: references.bib"),
                                     "## Second", "Read @ljung1999.\n\n::: references\n:::\n\n## Second");
    expect_as_at_once(text);
    expect_as_at_once(text + "\n::: note\nThe last word.\n:::\n");
    const SetDocument document = set(text);
    EXPECT_THAT(document.notes, IsEmpty());
    for (const SetChunk& chunk : document.chunks) EXPECT_THAT(chunk.html, testing::Not(HasSubstr("id=\"chunk-")));
}

TEST_F(chunk_setter, numbered_sections_keep_their_numbers) {
    const std::string numbered = changed(kText, "title: A report", "title: A report\nnumbersections: true");
    set(numbered);
    expect_as_at_once(changed(numbered, "## Second", "## The second"));
    EXPECT_EQ(setter_.chunks_set(), 1u);
    expect_as_at_once(changed(numbered, "## Second", "## Before\n\n## Second"));
}

TEST_F(chunk_setter, text_of_the_page_cannot_end_a_chunk) {
    expect_as_at_once("a `<div id=\"chunk-1\">` b\n\n`</main>` c\n\nd\n");
    expect_as_at_once("::::::: {.note}\n\nin\n\n:::::::\n\nend\n");
}

}  // namespace test_chunk_setter
