// What is typed on the page of `dynlab preview --edit` and not saved when its tab is closed. Oracle: what the test
// typed, and the file afterwards.
#include <gmock/gmock.h>

#include <memory>

#include "platform/atomic_file.h"
#include "support/environment_variable.h"
#include "support/preview.h"

namespace test_preview_drafts {
using namespace dynlab;
using namespace dynlab::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

const std::string kOffered = "!document.getElementById('draft').hidden",
                  kConflict = "!document.getElementById('conflict').hidden";

/// The tests click by script, because a page that a user has touched asks before it closes.
class preview_drafts : public preview_page {
  protected:
    preview_drafts() { write(kHead + kFirst); }
    void begin() { preview = std::make_unique<Preview>(file(), true, std::vector<std::string>{"--edit"}); }
    /// As after a crash: the earlier tab is closed.
    void open() {
        browser.open(preview->address());
        ASSERT_TRUE(editor_has("local x = 20"));
    }
    void press(const std::string& id) { browser.evaluate("document.getElementById('" + id + "').click()"); }
    /// Appends text to the content of the editor.
    void type(const std::string& text) {
        browser.evaluate("const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue() + `" +
                         text + "`)");
    }
    static std::string has(const std::string& text) {
        return "document.querySelector('.CodeMirror')?.CodeMirror.getValue().includes(`" + text + "`)";
    }
    bool editor_has(const std::string& text) { return browser.becomes_true(has(text)); }
    bool is_true(const std::string& expression) { return browser.evaluate("return " + expression) == "true"; }
    bool kept(int count) {
        return browser.becomes_true(
            "(fetch('notes').then((reply) => reply.json()).then((notes) => "
            "window.notes_kept = Object.keys(notes).filter((key) => "
            "key.startsWith('dynlab-draft')).length), window.notes_kept === " +
            std::to_string(count) + ")");
    }
    std::string text_of_file() const { return read_text(file()); }

    EnvironmentVariable state{"XDG_STATE_HOME", (folder.path() / "state").string()};
    std::unique_ptr<Preview> preview;
    Browser browser;
};

/// What was typed and not saved outlives its tab, and the program.
TEST_F(preview_drafts, what_was_not_saved_is_kept_and_offered) {
    begin();
    open();
    EXPECT_EQ(browser.evaluate("return " + kOffered), "false");
    type("\\n-- typed\\n");
    ASSERT_TRUE(kept(1));
    open();
    EXPECT_TRUE(browser.becomes_true(kOffered));
    EXPECT_TRUE(browser.becomes_true(
        "/^A draft of .*\\d\\d:\\d\\d was not saved\\.$/.test(document.getElementById('draft-text').innerText)"));
    EXPECT_EQ(browser.evaluate("return " + has("-- typed")), "false");
    press("take-draft");
    EXPECT_EQ(
        browser.evaluate("return [" + has("-- typed") + ", " + kOffered +
                         ", document.getElementById('conflict').hidden, document.getElementById('save').disabled]"),
        "[true,false,true,false]");
    press("save");
    EXPECT_TRUE(kept(0));
    EXPECT_THAT(text_of_file(), HasSubstr("-- typed"));
    open();
    EXPECT_EQ(browser.evaluate("return " + kOffered), "false") << "the file has it";

    type("\\n-- more\\n");
    ASSERT_TRUE(kept(1));
    preview.reset();
    write(kHead + kFirst + "-- theirs\n");
    begin();
    open();
    EXPECT_TRUE(browser.becomes_true(kOffered));
    press("take-draft");
    EXPECT_TRUE(editor_has("-- more"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('theirs').innerText.includes('-- theirs')"))
        << "it was made from another text";
    EXPECT_THAT(text_of_file(), testing::EndsWith("-- theirs\n"));
    press("take-theirs");
    EXPECT_TRUE(kept(0));

    type("\\n-- third\\n");
    ASSERT_TRUE(kept(1));
    open();
    EXPECT_TRUE(browser.becomes_true(kOffered));
    press("drop-draft");
    EXPECT_TRUE(kept(0));
    EXPECT_EQ(browser.evaluate("return " + kOffered), "false");
    EXPECT_THAT(text_of_file(), testing::EndsWith("-- theirs\n"));
}

/// Who goes on typing while a draft is offered loses neither, whatever happens to the tab.
TEST_F(preview_drafts, what_is_typed_beside_an_offered_draft_is_kept_apart) {
    begin();
    open();
    type("-- first\\n");
    ASSERT_TRUE(kept(1));
    open();
    ASSERT_TRUE(browser.becomes_true(kOffered));
    type("-- second\\n");
    ASSERT_TRUE(kept(2));
    open();
    ASSERT_TRUE(browser.becomes_true(kOffered));
    EXPECT_FALSE(is_true(has("-- first")) || is_true(has("-- second")));
    press("take-draft");
    EXPECT_TRUE(is_true(has("-- second"))) << "the newest is offered first";
    EXPECT_FALSE(is_true(has("-- first")));
    EXPECT_TRUE(is_true(kOffered)) << "then the one before it";
    type("-- third\\n");
    press("take-draft");
    EXPECT_TRUE(is_true(has("-- first")));
    EXPECT_FALSE(is_true(has("-- second")));
    EXPECT_TRUE(is_true(kOffered)) << "what stood in the editor";
    EXPECT_TRUE(kept(2));
    press("take-draft");
    EXPECT_TRUE(is_true(has("-- second\\n-- third"))) << "also what was typed into it last";
    EXPECT_FALSE(is_true(kConflict));
    press("save");
    EXPECT_TRUE(kept(1));
    EXPECT_THAT(text_of_file(), AllOf(HasSubstr("-- second\n-- third\n"), Not(HasSubstr("-- first"))));
    EXPECT_TRUE(is_true(kOffered));
    press("drop-draft");
    EXPECT_TRUE(kept(0));
    EXPECT_FALSE(is_true(kOffered));
    EXPECT_TRUE(is_true(has("-- third")));
    open();
    EXPECT_FALSE(is_true(kOffered));
}

/// A draft knows from which text it was made, however often it is put aside.
TEST_F(preview_drafts, go_with_the_text_they_were_made_from) {
    begin();
    open();
    type("-- old\\n");
    ASSERT_TRUE(kept(1));
    preview.reset();
    write(kHead + kFirst + "-- theirs\n");
    begin();
    open();
    ASSERT_TRUE(editor_has("-- theirs"));
    type("-- new\\n");
    press("take-draft");
    EXPECT_TRUE(is_true(has("-- old")));
    EXPECT_TRUE(is_true(kConflict)) << "the file has changed since";
    press("take-draft");
    EXPECT_TRUE(is_true(has("-- theirs\\n-- new")));
    EXPECT_FALSE(is_true(kConflict));
    press("save");
    EXPECT_TRUE(kept(1));
    EXPECT_THAT(text_of_file(), testing::EndsWith("-- theirs\n-- new\n"));
}

/// Oracle: the file that holds them, and its rights.
TEST_F(preview_drafts, are_kept_where_no_other_user_reads_them) {
    begin();
    open();
    type("-- typed\\n");
    ASSERT_TRUE(kept(1));
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder.path() / "state/dynlab/pages")) {
        ++files;
        EXPECT_THAT(read_text(entry.path()), HasSubstr("-- typed"));
        EXPECT_EQ(fs::status(entry.path().parent_path()).permissions(), fs::perms::owner_all);
    }
    EXPECT_EQ(files, 1);
    write_file_atomically(fs::directory_iterator(folder.path() / "state/dynlab/pages")->path(), "{broken");
    open();
    EXPECT_FALSE(is_true(kOffered));
    type("-- more\\n");
    EXPECT_TRUE(kept(1));
}

}  // namespace test_preview_drafts
