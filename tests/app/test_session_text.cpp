// A session's text, its file and its history. Oracle: the file, and the texts that were put.
#include "app/workbench/session_text.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace test_session_text {
using namespace dynlab;

class session_text : public testing::Test {
  protected:
    TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "s.lua";
    std::string on_disk() const { return read_file(file); }
    static ScriptOrder line_one(std::size_t revision, const std::string& text, bool goes_on = false,
                                bool unsaved = false) {
        return {revision, {{1, 1, text}}, false, "", goes_on, unsaved};
    }
};

TEST_F(session_text, every_step_is_on_disk_and_can_be_taken_back) {
    SessionText text(file);
    text.put("a = 1\n");
    EXPECT_EQ(on_disk(), "a = 1\n");
    ASSERT_TRUE(text.obey(line_one(text.revision(), "a = 2")));
    EXPECT_EQ(on_disk(), "a = 2\n");
    text.undo();
    EXPECT_EQ(on_disk(), "a = 1\n");
    EXPECT_TRUE(text.can_redo());
    text.redo();
    EXPECT_EQ(on_disk(), "a = 2\n");
    EXPECT_FALSE(text.can_redo());
    text.undo();
    text.undo();
    EXPECT_EQ(on_disk(), "");
    EXPECT_FALSE(text.can_undo());
}

TEST_F(session_text, an_order_of_another_revision_changes_nothing) {
    SessionText text(file);
    text.put("a = 1\n");
    EXPECT_FALSE(text.obey(line_one(text.revision() + 1, "a = 2")));
    EXPECT_FALSE(text.obey(line_one(text.revision() - 1, "a = 2")));
    EXPECT_EQ(on_disk(), "a = 1\n");
}

TEST_F(session_text, a_slider_that_is_held_is_one_step_and_is_saved_when_it_is_let_go) {
    SessionText text(file);
    text.put("a = 1\n");
    text.obey(line_one(text.revision(), "a = 2", false, true));
    for (int k = 3; k < 9; ++k) text.obey(line_one(text.revision(), "a = " + std::to_string(k), true, true));
    EXPECT_EQ(on_disk(), "a = 1\n");
    text.obey(line_one(text.revision(), "a = 9", true, false));
    EXPECT_EQ(on_disk(), "a = 9\n");
    text.undo();
    EXPECT_EQ(text.text(), "a = 1\n");
}

TEST_F(session_text, takes_what_another_program_wrote_but_not_its_own) {
    SessionText text(file);
    text.put("a = 1\n");
    EXPECT_FALSE(text.read_changed_file());
    std::ofstream(file) << "b = 7\n";
    EXPECT_TRUE(text.read_changed_file());
    EXPECT_EQ(text.text(), "b = 7\n");
    EXPECT_FALSE(text.read_changed_file());
    std::ofstream(file).flush();  // as an editor that writes in place begins
    EXPECT_FALSE(text.read_changed_file());
    EXPECT_EQ(text.text(), "b = 7\n");
    text.undo();
    EXPECT_EQ(on_disk(), "a = 1\n");
    std::filesystem::remove(file);
    EXPECT_FALSE(text.read_changed_file());
}

/// The file system reports no change, as on a network drive to which another machine writes.
TEST_F(session_text, an_order_is_not_written_over_what_another_program_wrote) {
    SessionText text(file);
    text.put("a = 1\n");
    std::ofstream(file) << "b = 7\n";
    EXPECT_FALSE(text.obey(line_one(text.revision(), "a = 2")));
    EXPECT_EQ(on_disk(), "b = 7\n");
    ASSERT_TRUE(text.obey({text.revision(), {{2, 1, "a = 2"}}, false, "", false, false}));
    EXPECT_EQ(on_disk(), "b = 7\na = 2\n");
    text.undo();
    EXPECT_EQ(on_disk(), "b = 7\n");
    text.undo();
    EXPECT_EQ(on_disk(), "a = 1\n");
}

TEST_F(session_text, an_editor_that_writes_in_place_loses_nothing_to_an_order_between) {
    SessionText text(file);
    text.put("a = 1\n");
    std::ofstream editor(file, std::ios::trunc);  // emptied, and not written yet
    std::thread writes([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        editor << "b = 2\n" << std::flush;
    });
    EXPECT_FALSE(text.obey(line_one(text.revision(), "a = 3")));
    writes.join();
    EXPECT_EQ(on_disk(), "b = 2\n");
    EXPECT_EQ(text.text(), "b = 2\n");
}

TEST_F(session_text, what_another_program_wrote_before_an_undo_can_be_had_again) {
    SessionText text(file);
    text.put("a = 1\n");
    text.put("a = 2\n");
    std::ofstream(file) << "b = 7\n";
    text.undo();
    EXPECT_EQ(on_disk(), "a = 2\n");
    text.redo();
    EXPECT_EQ(on_disk(), "b = 7\n");
}

TEST_F(session_text, history_of_an_earlier_session_can_be_undone) {
    SessionText first(file);
    first.put("a = 1\n");
    first.put("a = 2\n");
    SessionText second(file, first.past());
    second.undo();
    EXPECT_EQ(on_disk(), "a = 1\n");
    second.undo();
    EXPECT_FALSE(second.can_undo());
}

}  // namespace test_session_text
