// What a data file holds, before a script is written. Oracle: what stands in the files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace dynlab::test {
namespace test_look {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class look : public testing::Test {
  protected:
    void SetUp() override {
        std::string text = "time (ms);u [V];label;y\n";
        for (int i = 0; i < 40; ++i)
            if (i != 20)
                text += std::to_string(10 * i) + ";" + std::to_string(i % 2) + ";a;" + (i == 5 ? "" : "0,5") + "\n";
        bench_.write("record.csv", text);
    }
    Workbench bench_;
};

TEST_F(look, shows_columns_units_sampling_gaps_and_first_rows) {
    const ChildResult result = bench_.dynlab({"look", "record.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    EXPECT_THAT(result.output,
                StartsWith("record.csv: a table of 4 columns and 39 rows\n- units from the headers: time in "
                           "ms, u in V\n- numbers are missing"));
    EXPECT_THAT(result.output, testing::ContainsRegex("time +ms +39 numbers +0 +390 +"));
    EXPECT_THAT(result.output, testing::ContainsRegex("label +39 texts\n"));
    EXPECT_THAT(result.output, testing::ContainsRegex("y +39 numbers +1 +0.5 +0.5 +0.5\n"));
    EXPECT_THAT(result.output,
                AllOf(HasSubstr("column time, from 0 s to 0.39 s"), HasSubstr("in uneven steps, median 0.01 s"),
                      HasSubstr("gaps: 1, 0.02 s after 0.19 s\n"),
                      testing::ContainsRegex("first rows:\n +time +u +label +y\n +0 +0 +a +0.5\n"),
                      testing::EndsWith("picture: record_look.pdf\n")));
    EXPECT_THAT(bench_.shell("pdftotext record_look.pdf -").output, AllOf(HasSubstr("u (V)"), HasSubstr("time (s)")));
}

TEST_F(look, draws_what_is_asked_for) {
    EXPECT_EQ(bench_.dynlab({"look", "record.csv", "-o", "a.svg"}).exit_code, 0);
    EXPECT_THAT(bench_.read("a.svg"), HasSubstr("<svg"));
    EXPECT_EQ(bench_.dynlab({"look", "record.csv", "--no-picture"}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(bench_.path("record_look.pdf")));
    EXPECT_EQ(bench_.dynlab({"look", "record.csv", "-o", "a.gif"}).exit_code, 2);
}

TEST_F(look, shows_the_variables_of_a_matlab_file_and_of_a_data_set) {
    bench_.write("make.lua",
                 "save_mat(\"a.mat\", {y = vector{1, 2, 3}, A = eye(3), Ts = 0.5, run = {u = vector{1, 2}}})");
    ASSERT_EQ(bench_.dynlab({"run", "make.lua"}).exit_code, 0);
    const ChildResult result = bench_.dynlab({"look", "a.mat", "--no-picture"});
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    EXPECT_THAT(result.output, AllOf(StartsWith("a.mat: 4 variables\n"), HasSubstr("3 x 3 numbers"),
                                     testing::ContainsRegex("run +a struct\n +run.u +2 numbers +1 +2 +1.5\n"),
                                     HasSubstr("sampling time: 0.5 s, as the file states it")));
    EXPECT_THAT(bench_.dynlab({"look", "crane", "--no-picture"}).output, HasSubstr("steps.theta"));
}

TEST_F(look, what_cannot_be_read_fails) {
    bench_.write("bad.csv", "t,y\n0,1\n1,2\n2,three\n");
    const ChildResult bad = bench_.dynlab({"look", "bad.csv"});
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(bad.error_output, HasSubstr("line 4, column y: wanted a number, given \"three\""));
    EXPECT_EQ(bench_.dynlab({"look", "none.csv"}).exit_code, 1);
    EXPECT_EQ(bench_.dynlab({"look"}).exit_code, 2);
    EXPECT_EQ(bench_.dynlab({"look", "bad.csv", "--delimiter", "ab"}).exit_code, 2);
}

}  // namespace test_look
}  // namespace dynlab::test
