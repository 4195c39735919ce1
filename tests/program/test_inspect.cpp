// The command that describes a data file. Oracle: what is asked for. The description itself:
// tests/unit/workflow/test_data_summary.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace dynlab::test {
namespace test_inspect {
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(inspect, prints_the_description_and_draws_what_is_asked_for) {
    const Workbench bench;
    bench.write("record.csv", "time (ms);u [V];y\n0;0;0,5\n10;1;0,25\n20;0;0,125\n");
    const ChildResult result = bench.dynlab({"inspect", "record.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    EXPECT_THAT(result.output, AllOf(StartsWith("record.csv: a table of 3 columns and 3 rows\n"),
                                     EndsWith("\npicture: record_inspect.pdf\n")));
    EXPECT_THAT(bench.shell("pdftotext record_inspect.pdf -").output, AllOf(HasSubstr("u (V)"), HasSubstr("time (s)")));
    EXPECT_EQ(bench.dynlab({"inspect", "record.csv", "-o", "a.svg"}).exit_code, 0);
    EXPECT_THAT(bench.read("a.svg"), HasSubstr("<svg"));
    ASSERT_TRUE(std::filesystem::remove(bench.path("record_inspect.pdf")));
    EXPECT_EQ(bench.dynlab({"inspect", "record.csv", "--no-picture"}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(bench.path("record_inspect.pdf")));
    EXPECT_EQ(bench.dynlab({"inspect", "none.csv"}).exit_code, 1);
    EXPECT_EQ(bench.dynlab({"inspect"}).exit_code, 2);
}

}  // namespace test_inspect
}  // namespace dynlab::test
