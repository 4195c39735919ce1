// The prompt from outside: through a pipe, and on a pseudo-terminal as a student types. Oracles: Lua's arithmetic, the
// README's promises, the terminal's own modes before and after.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_prompt {
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kUp = "\x1b[A";

TEST(prompt, runs_statements_from_a_pipe_in_silence) {
    const Workbench bench;
    const ChildResult result =
        bench.shell("printf 'local x = 20\\nfunction f(a)\\n\\n  return a + 1\\nend\\nf(x)\\n' | \"$DYNLAB\"");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.output, "21\n");
    EXPECT_THAT(result.error_output, IsEmpty());
    EXPECT_THAT(bench.files(), IsEmpty());
}

TEST(prompt, a_failed_statement_of_a_pipe_names_its_line_and_lets_the_next_run) {
    const Workbench bench;
    bench.write("input", "print(1)\n\nboom\nnosuch(2)\nerror('no')\nx = [1 2]\nprint(2)\nprint((3\n");
    const ChildResult result = bench.shell("\"$DYNLAB\" < input");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.output, "1\n2\n");
    for (const char* place :
         {"dynlab: standard input:3: ", "dynlab: standard input:4: ", "dynlab: standard input:5: no\n",
          "dynlab: standard input:6: ", "dynlab: standard input:"})
        EXPECT_THAT(result.error_output, HasSubstr(place));
    EXPECT_THAT(result.error_output, HasSubstr("')' is missing"));
    EXPECT_EQ(bench.shell("printf 'boom\\nquit\\nprint(1)\\n' | \"$DYNLAB\"").output, "");
    EXPECT_EQ(bench.shell("\"$DYNLAB\" < /dev/null").exit_code, 0);
}

TEST(prompt, saves_figures_without_overwriting_earlier_ones) {
    const Workbench bench;
    const std::string code = "printf 'plot({1, 2}, {3, 4})\\nf = plot({1, 2}, {3, 4})\\n' | \"$DYNLAB\"";
    EXPECT_EQ(bench.shell(code).output, "figure: dynlab_out/figure-1.pdf\nfigure: dynlab_out/figure-2.pdf\n");
    EXPECT_EQ(bench.shell(code).output, "figure: dynlab_out/figure-3.pdf\nfigure: dynlab_out/figure-4.pdf\n");
    EXPECT_THAT(bench.read("dynlab_out/figure-4.pdf"), testing::StartsWith("%PDF"));
}

TEST(prompt, takes_any_bytes_from_a_pipe) {
    const Workbench bench;
    std::string bytes;
    for (int i = 0; i < 50'000; ++i) bytes += static_cast<char>((i * 7919 + i / 256) % 256);
    bench.write("input", bytes + "\n" + std::string(1 << 20, '(') + "\n");
    EXPECT_EQ(bench.shell("\"$DYNLAB\" < input > /dev/null 2>&1").exit_code, 1);
}

TEST(prompt, statement_error_function_and_end_on_a_terminal) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.enter("local x = 6*7");
    terminal.until_prompt();
    terminal.enter("x");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n42\r\n"));
    terminal.enter("nosuch(1)");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\nunknown function or variable 'nosuch'\r\n"));
    terminal.enter("function f(a)");
    terminal.until("...> ");
    terminal.enter("return a + 1");
    terminal.until("...> ");
    terminal.enter("end");
    terminal.until_prompt();
    terminal.enter("f(x)");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n43\r\n"));
    terminal.type(kControlD);
    EXPECT_EQ(terminal.wait_for_end(), 0);
    EXPECT_TRUE(terminal.modes_are_as_before());
    EXPECT_THAT(bench.read("state/dynlab/history"), HasSubstr("local x = 6*7\nx\nnosuch(1)\n"));
}

TEST(prompt, tab_completes_and_lists) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.enter("speed_of_motor = 99");
    terminal.until_prompt();
    terminal.type("speed_o\t");  // what follows at once would be taken for pasted text
    terminal.until("f_motor");
    terminal.enter(" + 1");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n100\r\n"));
    terminal.enter("G = tf(1, {1, 1})");
    terminal.until_prompt();
    terminal.type("G.\t");
    const std::string list = terminal.until_prompt();
    EXPECT_THAT(list, HasSubstr("IODelay"));
    EXPECT_THAT(list, HasSubstr("num"));
    terminal.until("G.");
    terminal.type("nu\t");
    terminal.until("m");
    terminal.type("\r");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n[1]\r\n"));
}

TEST(prompt, control_c_ends_the_statement_only) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.enter("kept = 17");
    terminal.until_prompt();
    for (const char* endless :
         {"print('star' .. 'ted') while true do end", "print('star' .. 'ted') for i = 1, 1e15 do end",
          "print('star' .. 'ted') while true do pcall(function() while true do end end) end",
          "print('star' .. 'ted') while true do sum(randn(1000000)) end",
          "print('star' .. 'ted') gradient_descent(randn(100000, 1), randn(100000), {MaxIter = 1e8, step = 1e-9, Tol = "
          "0})"}) {
        terminal.enter(endless);
        terminal.until("started\r\n");
        terminal.type(kControlC);
        EXPECT_THAT(terminal.until_prompt(), HasSubstr("interrupted\r\n")) << endless;
        terminal.enter("kept");
        EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n17\r\n"));
    }
}

TEST(prompt, long_studies_show_their_progress_and_obey_control_c) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.enter("G = tf({2}, {1, 4, 3}) u = prbs(4, 100)");
    terminal.until_prompt();
    for (const char* estimator : {"srivc = {{1, 2, 0}}", "own = function(d) return lssvf(d, {2, 1, 0}, 3) end"}) {
        terminal.enter("montecarlo{system = G, input = u, Ts = 0.01, sigma = 0.2, runs = 1000000, estimators = {" +
                       std::string(estimator) + "}}");
        terminal.until("Monte Carlo  [");
        terminal.until("/1000000");
        terminal.type(kControlC);
        EXPECT_THAT(terminal.until_prompt(), HasSubstr("interrupted\r\n")) << estimator;
    }
    terminal.enter("#u");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n1500\r\n"));
}

TEST(prompt, control_c_and_an_empty_line_give_up_what_is_not_complete) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.type("nosuch(1");
    terminal.until("nosuch(1");
    terminal.type(kControlC);
    terminal.until_prompt();
    terminal.enter("x = (1 +");
    terminal.until("...> ");
    terminal.type(kControlC);
    terminal.until_prompt();
    terminal.enter("x = (1 +");
    terminal.until("...> ");
    terminal.enter("");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("(discarded: the statement"));
    terminal.enter("1 + 1");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n2\r\n"));
}

TEST(prompt, a_pasted_function_may_have_blank_lines_and_tabs) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.type("local function f(a)\r\r\tlocal b = a + 1\r\r\treturn b\rend\rf(1)\r");
    EXPECT_THAT(terminal.until("\n2\r\n"), Not(HasSubstr("(discarded: the statement")));
}

TEST(prompt, recalls_lines_of_the_last_session_whatever_the_file_holds) {
    const Workbench bench;
    bench.write("state/dynlab/history",
                std::string("\x1b[2J\xff\xfe\0x\n", 9) + std::string(100'000, 'y') + "\n40 + 2\n");
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.type(std::string(kUp) + "\r");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n42\r\n"));
    terminal.enter("quit");
    EXPECT_EQ(terminal.wait_for_end(), 0);
    EXPECT_TRUE(terminal.modes_are_as_before());
}

TEST(prompt, takes_characters_of_all_kinds) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.enter("#'h\xc3\xa9'");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n3\r\n")) << "two bytes for the accented letter";
    terminal.enter("x = '\xff\xc3('");
    terminal.until_prompt();
    terminal.enter("-- " + std::string(3000, 'z'));
    terminal.until_prompt();
    terminal.enter("1 + 1");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n2\r\n"));
}

TEST(prompt, gives_the_terminal_back_when_a_signal_ends_it) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    kill(terminal.child(), SIGTERM);
    EXPECT_EQ(terminal.wait_for_end(), 128 + SIGTERM);
    EXPECT_TRUE(terminal.modes_are_as_before());
}

}  // namespace test_prompt
}  // namespace dynlab::test
