// Reports that cannot be made, or not in full. Oracle: the lines of the files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message_texts.h"
#include "workflow/lesson_catalog.h"
#include "workflow/make_report.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_report_errors {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder as `dynlab new` makes it, with this analysis and this text.
WorkFolder& with_report(WorkFolder& work, const std::string& analysis, const std::string& text) {
    work.write("mine/analysis.lua", analysis);
    work.write("mine/report.md", "---\ntitle: A report\n---\n\n" + text);
    return work;
}

ReportResult report_in(const WorkFolder& work) {
    return make_report(report_of(work.path("mine"), work.path("report.md")));
}

TEST(report_errors, a_slot_without_an_entry_leaves_a_draft_and_names_slot_file_and_line) {
    WorkFolder work;
    with_report(work, "report.value('fit', 93.2, '%.1f')\n", "The fit is `fti`{.value} %.\n\nAs @fig:step shows.\n");
    for (int repeat = 0; repeat < 2; ++repeat) {
        const ReportResult draft = report_in(work);
        EXPECT_FALSE(draft.up_to_date) << "a draft is never up to date";
        EXPECT_THAT(texts_of(draft.gaps),
                    ElementsAre(AllOf(HasSubstr("report.md:5"), HasSubstr("fti"), HasSubstr("fit")),
                                AllOf(HasSubstr("report.md:7"), HasSubstr("@fig:step has no target"))));
        ASSERT_EQ(draft.unplaced.size(), 1u);
        EXPECT_THAT(message_text(draft.unplaced.front().message()), HasSubstr("write `fit`{.value}"));
    }
    EXPECT_THAT(work.read("report.md"), HasSubstr("The fit is **??** %."));
    with_report(work, "report.value('fit', 93.2, '%.1f')\n", "The fit is `fit`{.value} %.\n");
    const ReportResult complete = report_in(work);
    EXPECT_TRUE(complete.gaps.empty());
    EXPECT_TRUE(complete.unplaced.empty());
    EXPECT_TRUE(report_in(work).up_to_date);
}

TEST(report_errors, missing_figures_and_pictures_are_named) {
    WorkFolder work;
    with_report(work, "print(1)\n", "![A](figure:raw){#fig:raw}\n\n![B](picture.png)\n");
    const std::string refusal = error_of([&] { report_in(work); });
    EXPECT_THAT(refusal, AllOf(HasSubstr("raw"), HasSubstr("picture.png")));
    EXPECT_FALSE(std::filesystem::exists(work.path("report.md")));
}

TEST(report_errors, the_report_contains_the_error_and_everything_before_it) {
    WorkFolder work;
    with_report(work, "-- %%\nprint('before')\n-- %%\nerror('on purpose')\n-- %%\nprint('after')\n",
                "::: {.cells}\n:::\n");
    for (int repeat = 0; repeat < 2; ++repeat)
        EXPECT_THAT(message_text(report_in(work).error.value_or(Message("(none)"))),
                    HasSubstr("analysis.lua:4: on purpose"))
            << repeat;
    EXPECT_THAT(work.read("report.md"),
                testing::ContainsRegex("\nbefore\n(.|\n)*on purpose(.|\n)*the cells below were not run(.|\n)*print"));
}

TEST(report_errors, of_the_group_file_name_the_file_and_its_line) {
    WorkFolder work;
    with_report(work, "print(1)\n", "Text.\n").write("mine/group.toml", "seed = -3\n");
    EXPECT_THAT(error_of([&] { report_in(work); }), HasSubstr("group.toml"));
    work.write("mine/group.toml", "\nseed = = 3\n");
    EXPECT_THAT(error_of([&] { report_in(work); }), HasSubstr("group.toml:2"));
}

TEST(report_errors, an_unknown_lesson_lists_the_lessons) {
    EXPECT_THAT(error_of([] { report_of("77"); }), HasSubstr("02_least_squares"));
}

}  // namespace test_report_errors
}  // namespace dynlab::test
