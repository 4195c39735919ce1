// Documents about students, made in sandboxes. Oracle: the text that poppler reads from them.
#include <gmock/gmock.h>

#include "base/reader.h"
#include "course/sandbox_jobs/sandboxed_document.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"
#include "support/pdf_inspection.h"

namespace dynlab::test {
namespace test_sandboxed_documents {

using testing::HasSubstr;

class sandboxed_documents : public testing::Test {
  protected:
    /// The first page of feedback to `name`.
    std::string feedback_to(const std::string& name) {
        RunRecord record;
        record.texts["result"] = {"Élise Lefèvre, Björn Åström: 3 of 4 – good."};
        for (const char* text : {"trouble", "checks", "closing"}) record.texts[text] = {"..."};
        documents_.make("feedback.md", record, folder_.path() / "feedback.pdf", {{"title", name}, {"lang", "en"}});
        return inspect_pdf(folder_.path() / "feedback.pdf").pages.at(0);
    }

    const EnvironmentVariable home_{"DYNLAB_HOME", DYNLAB_SOURCE_DIR};
    const TemporaryFolder folder_;
    const SandboxedDocuments documents_{strongest_isolation(), DYNLAB_PROGRAM};
};

TEST_F(sandboxed_documents, print_names_in_all_scripts_and_say_so_once) {
    for (const char* name : {"Nguyễn Đặng", "İpek Oğuz"}) EXPECT_THAT(feedback_to(name), HasSubstr(name));
    EXPECT_TRUE(documents_.notes().empty());
    for (const char* name : {"Дмитрий", "გიორგი"}) {
        const std::string page = feedback_to(name);
        EXPECT_THAT(page, HasSubstr(name));
        EXPECT_THAT(page, HasSubstr("Élise Lefèvre, Björn Åström: 3 of 4 – good."));
    }
    ASSERT_EQ(documents_.notes().size(), 1u);
    EXPECT_THAT(
        message_text(documents_.notes().front()),
        HasSubstr("Because pdflatex cannot print \"Д\" (U+0414), LuaLaTeX creates this PDF, which takes longer"));
}

// The fonts of all scripts of a class are read at once, which takes more memory than those of one document.
TEST_F(sandboxed_documents, print_a_class_of_many_scripts) {
    const std::string page = feedback_to("Nguyễn, Дмитрий, 王小明, 김민준, محمد, გიორგი");
    for (const char* name : {"Nguyễn", "Дмитрий", "王小明", "김민준", "გიორგი"}) EXPECT_THAT(page, HasSubstr(name));
}

TEST_F(sandboxed_documents, replace_only_the_letter_that_no_font_has) {
    const std::string page = feedback_to("Дмитрий \uE000");
    EXPECT_THAT(page, HasSubstr("Дмитрий ?"));
    EXPECT_THAT(page, HasSubstr("Élise Lefèvre, Björn Åström: 3 of 4 – good."));
    ASSERT_EQ(documents_.notes().size(), 2u);
    EXPECT_THAT(message_text(documents_.notes().back()), HasSubstr("no installed font has the following letters"));
}

}  // namespace test_sandboxed_documents
}  // namespace dynlab::test
