// The description of a data file before the user writes a script. Oracle: the content of the files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "figures/figure.h"
#include "workflow/data_summary.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_data_summary {
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

TEST(data_summary, shows_columns_units_sampling_gaps_and_first_rows) {
    const WorkFolder work;
    std::string text = "time (ms);u [V];label;y\n";
    for (int i = 0; i < 40; ++i)
        if (i != 20)
            text += std::to_string(10 * i) + ";" + std::to_string(i % 2) + ";a;" + (i == 5 ? "" : "0,5") + "\n";
    work.write("record.csv", text);
    const DataSummary look = summarize_data(work.path("record.csv"), {});
    EXPECT_THAT(look.text, HasSubstr("record.csv: a table of 4 columns and 39 rows\n- units from the headers: time in "
                                     "ms, u in V\n- missing numbers were replaced"));
    EXPECT_THAT(look.text, ContainsRegex("time +ms +39 numbers +0 +390 +"));
    EXPECT_THAT(look.text, ContainsRegex("label +39 strings\n"));
    EXPECT_THAT(look.text, ContainsRegex("y +39 numbers +1 +0.5 +0.5 +0.5\n"));
    EXPECT_THAT(look.text,
                AllOf(HasSubstr("column time, from 0 s to 0.39 s"), HasSubstr("irregular, median step 0.01 s"),
                      HasSubstr("gaps: 1 (0.02 s after 0.19 s)\n"),
                      ContainsRegex("first rows:\n +time +u +label +y\n +0 +0 +a +0.5\n")));
    ASSERT_TRUE(look.figure);
    ASSERT_EQ(look.figure->panels.size(), 2u) << "u and y";
    EXPECT_EQ(message_text(look.figure->panels[0].y_label), "u (V)");
    EXPECT_EQ(message_text(look.figure->panels[1].x_label), "time (s)");
}

TEST(data_summary, shows_the_variables_of_a_matlab_file_and_of_a_data_set) {
    const WorkFolder work;
    ASSERT_FALSE(work.run("save_mat(\"a.mat\", {y = vector{1, 2, 3}, A = eye(3), Ts = 0.5, run = {u = vector{1, 2}}})")
                     .record.error);
    EXPECT_THAT(summarize_data(work.path("a.mat"), {}).text,
                AllOf(HasSubstr("a.mat: 4 variables\n"), HasSubstr("3 x 3 numbers"),
                      ContainsRegex("run +a structure\n +run.u +2 numbers +1 +2 +1.5\n"),
                      HasSubstr("sampling time: 0.5 s, as specified in the file")));
    EXPECT_THAT(summarize_data("crane", {}).text, HasSubstr("steps.theta"));
}

TEST(data_summary, of_a_file_that_cannot_be_read_names_the_place) {
    const WorkFolder work;
    work.write("bad.csv", "t,y\n0,1\n1,2\n2,three\n");
    EXPECT_THAT(error_of([&] { summarize_data(work.path("bad.csv"), {}); }),
                HasSubstr("line 4, column y: expected a number, got \"three\""));
    EXPECT_THAT(error_of([&] { summarize_data(work.path("none.csv"), {}); }), HasSubstr("none.csv"));
}

}  // namespace test_data_summary
}  // namespace dynlab::test
