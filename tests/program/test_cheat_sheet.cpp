// The two pages of `dynlab help --sheet`. Oracle: the list of `dynlab help`, the phrase book's page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "support/program.h"

namespace dynlab::test {
namespace test_cheat_sheet {
using testing::HasSubstr;
using testing::Not;

TEST(cheat_sheet, holds_every_function_on_two_pages) {
    const Workbench bench;
    const ChildResult made = bench.dynlab({"help", "--sheet", "cheat.pdf"});
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_EQ(made.output, bench.path("cheat.pdf").string() + "\n");
    EXPECT_THAT(bench.shell("pdfinfo cheat.pdf").output, testing::ContainsRegex("Pages: +2\n"));
    const std::string sheet = bench.shell("pdftotext -raw cheat.pdf -").output;
    std::string list = bench.dynlab({"help"}).output;
    list.resize(list.find("\nguides\n"));
    static const std::regex kRow("\n  ([a-z][A-Za-z_0-9.]*) ");
    int functions = 0;
    for (std::sregex_iterator i(list.begin(), list.end(), kRow), end; i != end; ++i, ++functions)
        EXPECT_TRUE(std::regex_search(sheet, std::regex("[\n\f]" + (*i)[1].str() + "[({]"))) << (*i)[1];
    EXPECT_GT(functions, 120);
    for (const char* torn : {"\n=}", "\n=,", "`", "R_T", "\nu + ", "\nB/F"}) EXPECT_THAT(sheet, Not(HasSubstr(torn)));
    for (const char* phrase :
         {"zeros(N,1), ones(N,1), zeros(2,3), eye(2)", "A:times(B)", "-- comment", "gt(x, 2)", "a && b, a || b"})
        EXPECT_THAT(sheet, HasSubstr(phrase));
}

TEST(cheat_sheet, is_a_pdf) {
    const Workbench bench;
    const ChildResult refused = bench.dynlab({"help", "--sheet", "cheat.html"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, HasSubstr("give a file name such as cheat.pdf"));
    EXPECT_EQ(bench.dynlab({"help", "lsim", "--sheet", "cheat.pdf"}).exit_code, 2);
}

}  // namespace test_cheat_sheet
}  // namespace dynlab::test
