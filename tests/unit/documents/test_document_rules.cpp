// Oracle: the definition in document_rules.h.
#include "documents/document_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "documents/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_document_rules {

using testing::HasSubstr;

DocumentRules rules_of(const std::string& header) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "report.md") << "---\n" + header + "---\n";
    return document_rules(read_template(folder.path() / "report.md"));
}

std::string refusal(const std::string& header) {
    try {
        rules_of(header);
    } catch (const DocumentError& error) {
        return error.what();
    }
    return "";
}

TEST(document_rules, name_sections_in_both_languages_and_count_pages) {
    const DocumentRules rules = rules_of(
        "sections: |\n  Process | Procédé\n\n  Appendix: control | Annexe : commande | optional\npages: 6\n"
        "appendix_pages: 1\n");
    ASSERT_EQ(rules.sections.size(), 2u);
    EXPECT_EQ(rules.sections[0].title("en"), "Process");
    EXPECT_EQ(rules.sections[0].title("fr"), "Procédé");
    EXPECT_FALSE(rules.sections[0].optional);
    EXPECT_EQ(rules.sections[1].title("fr"), "Annexe : commande");
    EXPECT_TRUE(rules.sections[1].optional);
    EXPECT_EQ(rules.pages, 6);
    EXPECT_EQ(rules.appendix_pages, 1);
}

TEST(document_rules, are_empty_where_the_template_asks_nothing) {
    const DocumentRules rules = rules_of("title: A\n");
    EXPECT_TRUE(rules.sections.empty());
    EXPECT_FALSE(rules.pages.has_value());
}

TEST(document_rules, that_cannot_be_read_are_refused_by_line) {
    EXPECT_THAT(refusal("title: A\nsections: |\n  Process\n"), HasSubstr("report.md:3: section \"Process\""));
    EXPECT_THAT(refusal("sections: |\n  A | B | perhaps\n"), HasSubstr("optional"));
    EXPECT_THAT(refusal("pages: six\n"), HasSubstr("report.md:2: pages must be a number"));
    EXPECT_THAT(refusal("appendix_pages: -1\n"), HasSubstr("appendix_pages"));
    EXPECT_EQ(refusal("appendix_pages: 0\n"), "") << "as if the line were not there";
}

TEST(document_rules, of_the_lab_report_are_its_headings_in_order) {
    const TemplateFile report = read_template(DYNLAB_SOURCE_DIR "/report_templates/lab_report.md");
    std::size_t from = 0;
    for (const SectionRule& section : document_rules(report).sections) {
        const std::size_t at = report.body.text.find("\n# " + section.english + " {#sec:", from);
        EXPECT_NE(at, std::string::npos) << section.english;
        from = at;
    }
}

}  // namespace test_document_rules
}  // namespace dynlab
