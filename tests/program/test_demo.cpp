// The command that shows guided demonstrations. Oracle: its promises. Texts and claims: tests/unit/workflow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_demo {
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(demo, list_names_each_demonstration_in_order) {
    const Workbench bench;
    const ChildResult result = bench.dynlab({"demo", "--list"});
    EXPECT_EQ(result.exit_code, 0);
    std::vector<std::string> names;
    for (const std::string& line : lines_of(result.output)) names.push_back(line.substr(0, line.find(' ')));
    EXPECT_THAT(names, testing::ElementsAre("getting_started", "delays", "order_selection", "irregular_sampling",
                                            "inside_srivc", "monte_carlo", "robot_arm", "frequency", "recursive"));
    EXPECT_THAT(result.output, HasSubstr("A dead time that is not a whole number of samples\n"));
    EXPECT_EQ(bench.dynlab({"demo"}).output, result.output);
}

TEST(demo, is_printed_in_one_go_without_a_terminal_and_saves_its_figures) {
    const Workbench bench(Workbench::Memory::kShared);
    const ChildResult result = bench.dynlab({"demo", "getting_started"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.error_output, IsEmpty());
    EXPECT_THAT(result.output, AllOf(HasSubstr("> local G = "), HasSubstr("idplot")));
    int figures = 0;
    for (const std::string& line : lines_of(result.output)) {
        if (!line.starts_with("figure: ")) continue;
        EXPECT_THAT(line, HasSubstr("getting_started_out/0" + std::to_string(++figures) + "-"));
        EXPECT_THAT(bench.read(line.substr(8)), StartsWith("%PDF"));
    }
    EXPECT_GE(figures, 2);
}

TEST(demo, wrong_names_and_options_are_reported) {
    const Workbench bench;
    const ChildResult unknown = bench.dynlab({"demo", "delay"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.error_output, HasSubstr("did you mean 'delays'?"));
    EXPECT_THAT(bench.dynlab({"demo", "zzzzzzzzzz"}).error_output, HasSubstr("getting_started, delays"));
    EXPECT_EQ(bench.dynlab({"demo", "--list", "delays"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"demo", "--wrong"}).exit_code, 2);
    EXPECT_THAT(bench.files(), IsEmpty());
}

TEST(demo, a_terminal_gets_a_menu_and_pages_that_wait) {
    const Workbench bench;
    Terminal terminal(bench, {"demo"});
    EXPECT_THAT(terminal.until("q to quit: "), AllOf(HasSubstr("1  getting_started"), HasSubstr("2  delays")));
    terminal.enter("99");
    EXPECT_THAT(terminal.until("q to quit: "), HasSubstr("Unknown demonstration '99'"));
    terminal.enter("1");
    EXPECT_THAT(terminal.until("q to quit -- "), AllOf(HasSubstr("-- 1 of "), Not(HasSubstr("idplot"))));
    terminal.enter("");
    EXPECT_THAT(terminal.until("q to quit -- "), AllOf(HasSubstr("-- 2 of "), HasSubstr("idplot")));
    terminal.enter("q");
    terminal.until("q to quit: ");
    terminal.enter("inside_srivc");
    terminal.until("q to quit -- ");
    terminal.enter("q");
    terminal.until("q to quit: ");
    terminal.enter("q");
    EXPECT_EQ(terminal.wait_for_end(), 0);
}

TEST(demo, control_d_and_control_c_leave_the_menu) {
    const Workbench bench;
    Terminal closed(bench, {"demo"});
    closed.until("q to quit: ");
    closed.type(kControlD);
    EXPECT_EQ(closed.wait_for_end(), 0);
    Terminal interrupted(bench, {"demo", "delays"});
    interrupted.until("q to quit -- ");
    interrupted.type(kControlC);
    EXPECT_EQ(interrupted.wait_for_end(), 130);
}

}  // namespace test_demo
}  // namespace dynlab::test
