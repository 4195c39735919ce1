// The prompt from outside: through a pipe, and on a pseudo-terminal as a student types. Oracles: Lua's arithmetic, the
// README's promises, the terminal's own modes before and after.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "support/program.h"

namespace dynlab::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char *kControlC = "\x03", *kControlD = "\x04", *kUp = "\x1b[A";

/// The program on a terminal of its own.
class Terminal {
  public:
    explicit Terminal(const Workbench& bench) {
        winsize size{40, 100, 0, 0};
        child_ = forkpty(&terminal_, nullptr, nullptr, &size);
        if (child_ == 0) {
            const std::string state = bench.path("state").string(), home = bench.path().string();
            setenv("XDG_STATE_HOME", state.c_str(), 1);
            setenv("HOME", home.c_str(), 1);
            setenv("TERM", "xterm", 1);
            setenv("NO_COLOR", "1", 1);
            setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
            if (chdir(bench.path().c_str()) == 0) execl(DYNLAB_PROGRAM, "dynlab", nullptr);
            _exit(127);
        }
        tcgetattr(terminal_, &modes_before_);
    }
    ~Terminal() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
        close(terminal_);
    }

    void type(const std::string& text) const {
        ASSERT_EQ(write(terminal_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    void enter(const std::string& line) const { type(line + "\r"); }

    /// Reads until `wanted` appears; what came before it and it are returned and forgotten.
    std::string until(const std::string& wanted) {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        std::size_t found;
        while ((found = seen_.find(wanted)) == std::string::npos) {
            if (std::chrono::steady_clock::now() > deadline || !read_more()) {
                ADD_FAILURE() << "the terminal never showed '" << wanted << "' but: " << seen_;
                return std::exchange(seen_, {});
            }
        }
        const std::string text = seen_.substr(0, found + wanted.size());
        seen_.erase(0, found + wanted.size());
        return text;
    }
    std::string until_prompt() { return until("dynlab> "); }

    bool modes_are_as_before() const {
        termios now{};
        tcgetattr(terminal_, &now);
        return now.c_lflag == modes_before_.c_lflag && now.c_iflag == modes_before_.c_iflag &&
               now.c_oflag == modes_before_.c_oflag && std::memcmp(now.c_cc, modes_before_.c_cc, sizeof now.c_cc) == 0;
    }
    /// Exit code, 128 + signal.
    int wait_for_end() {
        while (read_more()) {
        }
        pollfd terminal{terminal_, 0, 0};
        if (poll(&terminal, 1, 0) <= 0 || (terminal.revents & POLLHUP) == 0) {
            ADD_FAILURE() << "the program does not end";
            kill(child_, SIGKILL);
        }
        int status = 0;
        waitpid(std::exchange(child_, -1), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    pid_t child() const { return child_; }

  private:
    /// False at the end, or when nothing came for long.
    bool read_more() {
        pollfd ready{terminal_, POLLIN, 0};
        if (poll(&ready, 1, 30'000) <= 0) return false;
        char buffer[4096];
        const ssize_t count = read(terminal_, buffer, sizeof buffer);
        if (count > 0) seen_.append(buffer, static_cast<std::size_t>(count));
        return count > 0;
    }

    int terminal_ = -1;
    pid_t child_ = -1;
    termios modes_before_{};
    std::string seen_;
};

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
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\nthere is no function or variable 'nosuch'\r\n"));
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
          "print('star' .. 'ted') gradient_descent(randn(100000, 1), randn(100000), {MaxIter = 1e8, Tol = 0})"}) {
        terminal.enter(endless);
        terminal.until("started\r\n");
        terminal.type(kControlC);
        EXPECT_THAT(terminal.until_prompt(), HasSubstr("interrupted\r\n")) << endless;
        terminal.enter("kept");
        EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n17\r\n"));
    }
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
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("given up"));
    terminal.enter("1 + 1");
    EXPECT_THAT(terminal.until_prompt(), HasSubstr("\n2\r\n"));
}

TEST(prompt, a_pasted_function_may_have_blank_lines_and_tabs) {
    const Workbench bench;
    Terminal terminal(bench);
    terminal.until_prompt();
    terminal.type("local function f(a)\r\r\tlocal b = a + 1\r\r\treturn b\rend\rf(1)\r");
    EXPECT_THAT(terminal.until("\n2\r\n"), Not(HasSubstr("given up")));
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

}  // namespace
}  // namespace dynlab::test
