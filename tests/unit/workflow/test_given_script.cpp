// The script that a word of the command line means. Oracle: the names of the files.
#include "workflow/given_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "documents/text_lines.h"
#include "workflow/lesson_catalog.h"
#include "workflow/make_report.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_given_script {
using testing::HasSubstr;

TEST(given_script, that_is_missing_is_looked_for_under_nearly_its_name) {
    const WorkFolder work;
    work.write("capital/Analysis.lua", "print(1)\n");
    work.write("second/analysis (2).lua", "print(1)\n");
    work.write("several/Analysis.lua", "print(1)\n");
    work.write("several/analysis (2).lua", "print(1)\n");
    work.write("text/analysis.lua", "print(1)\n");
    work.write("text/Report.md", "Text\n");
    work.write("whole/analysis.lua", "print(1)\n");
    EXPECT_EQ(meant_script(work.path("whole")), work.path("whole/analysis.lua"));
    EXPECT_THAT(error_of([&] { meant_script(work.path("capital")); }),
                HasSubstr("capital, but there is Analysis.lua: rename it to analysis.lua"));
    EXPECT_THAT(error_of([&] { meant_script(work.path("second")); }),
                HasSubstr("second, but there is analysis (2).lua: rename it"));
    EXPECT_THAT(error_of([&] { meant_script(work.path("several")); }),
                HasSubstr("there are Analysis.lua, analysis (2).lua: rename the correct file to analysis.lua"));
    EXPECT_THAT(error_of([&] { report_of(work.path("capital")); }),
                HasSubstr("capital has no analysis.lua, but there is Analysis.lua: rename it"));
    EXPECT_THAT(error_of([&] { report_of(work.path("text")); }),
                HasSubstr("text has no report.md, but there is Report.md: rename it to report.md"));
}

TEST(given_script, missing_file_suggests_the_nearest_script_or_folder) {
    const WorkFolder work;
    for (const char* script : {"mine.lua", "session.lua", "second (1).lua", "notes.txt", "crane/analysis.lua"})
        work.write(script, "print(1)\n");
    work.write("book.ipynb", "{}");
    const auto refusal = [&](const char* name) {
        const std::string message = error_of([&] { meant_script(work.path(name)); });
        return replaced(message, work.path("").string(), "");
    };
    EXPECT_EQ(refusal("mien.lua"), "file not found: mien.lua; did you mean mine.lua?");
    EXPECT_EQ(refusal("mine"), "file or folder not found: mine; did you mean mine.lua?");
    EXPECT_EQ(refusal("Session.lua"), "file not found: Session.lua; did you mean session.lua?");
    EXPECT_EQ(refusal("book.lua"), "file not found: book.lua; did you mean book.ipynb?");
    EXPECT_EQ(refusal("crnae"), "file or folder not found: crnae; did you mean crane?");
    EXPECT_EQ(refusal("second.lua"), "file not found: second.lua; did you mean 'second (1).lua'?");
    for (const char* far : {"a.lua", "note.lua", "none/mine.lua"})
        EXPECT_EQ(refusal(far), "file not found: " + std::string(far));
}

TEST(given_script, folders_without_a_lesson_list_what_is_missing) {
    const WorkFolder work;
    work.write("capital/Analysis.lua", "print(1)\n");
    work.write("own/analysis.lua", "print(1)\n");
    const auto refusal = [&](const char* folder) { return error_of([&] { find_lesson(work.path(folder)); }); };
    EXPECT_THAT(refusal("capital"), HasSubstr("capital' contains neither lesson.lua nor analysis.lua, but "
                                              "there is Analysis.lua: rename it to analysis.lua; the lessons are"));
    EXPECT_THAT(refusal(""), HasSubstr("' contains neither lesson.lua nor analysis.lua; the lessons are"));
    EXPECT_THAT(refusal("own"), HasSubstr("own' contains no lesson.lua; the lessons are"));
}

/// The name of a folder that is not there is no part of a lesson's name.
TEST(given_script, lessons_are_found_by_number_beginning_and_whole_word_only) {
    for (const auto& [name, slug] : {std::pair("03_c", "03_crane"), {"crane", "03_crane"}, {"4", "04_estimators"}}) {
        const std::string found = error_of([&] { EXPECT_EQ(find_lesson(name).slug, slug); });
        EXPECT_EQ(found, "") << name;
    }
    for (const char* part : {"work", "e", "least_sq", "ork"})
        EXPECT_THAT(error_of([&] { find_lesson(part); }), HasSubstr("unknown lesson or folder")) << part;
}

TEST(given_script, that_is_no_script_is_refused_with_the_command_to_type) {
    const WorkFolder work;
    work.write("mine/analysis.lua", "print(1)\n");
    work.write("mine/report.md", "Text\n");
    work.write("mine/report.pdf", "%PDF");
    work.write("data.csv", "t,y\n0,1\n");
    for (const std::string command : {"report", "run", "lint", "pack", "check"})
        EXPECT_EQ(message_text(why_no_script(work.path("mine/report.md"), command)),
                  "report.md is the report's text. Give the folder, for example: dynlab " + command + " " +
                      work.path("mine").string());
    EXPECT_THAT(message_text(why_no_script(work.path("mine/report.pdf"), "weave")),
                HasSubstr("report.pdf is the report's PDF. Give the folder, for example: dynlab weave "));
    EXPECT_EQ(message_text(why_no_script(work.path("data.csv"), "run")),
              "data.csv is a data table: give a script (.lua) or a notebook (.ipynb)");
    EXPECT_EQ(message_text(why_no_script(work.path("mine"), "run")), "");
    EXPECT_EQ(message_text(why_no_script(work.path("mine/analysis.lua"), "run")), "");
}

}  // namespace test_given_script
}  // namespace dynlab::test
