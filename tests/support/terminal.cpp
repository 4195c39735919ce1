#include "support/terminal.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utmp.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace dynlab::test {

Terminal::Terminal(const Workbench& bench, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), "dynlab");
    std::vector<char*> command;
    for (std::string& word : words) command.push_back(word.data());
    command.push_back(nullptr);
    winsize size{40, 100, 0, 0};
    int program_side = -1;
    if (openpty(&terminal_, &program_side, nullptr, nullptr, &size) != 0) {
        ADD_FAILURE() << "there is no terminal";
        return;
    }
    tcgetattr(terminal_, &modes_before_);  // a program that has started may have changed them
    child_ = fork();
    if (child_ == 0) {
        close(terminal_);
        if (login_tty(program_side) != 0) _exit(127);
        const std::string state = bench.path("state").string(), home = bench.path().string();
        setenv("XDG_STATE_HOME", state.c_str(), 1);
        setenv("HOME", home.c_str(), 1);
        setenv("TERM", "xterm", 1);
        setenv("NO_COLOR", "1", 1);
        setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        if (chdir(bench.path().c_str()) == 0) execv(DYNLAB_PROGRAM, command.data());
        _exit(127);
    }
    close(program_side);
}

Terminal::~Terminal() {
    if (child_ > 0) {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
    close(terminal_);
}

void Terminal::type(const std::string& text) const {
    ASSERT_EQ(write(terminal_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

std::string Terminal::until(const std::string& expected) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    std::size_t found;
    while ((found = seen_.find(expected)) == std::string::npos) {
        if (std::chrono::steady_clock::now() > deadline || !read_more()) {
            ADD_FAILURE() << "the terminal never showed '" << expected << "' but: " << seen_;
            return std::exchange(seen_, {});
        }
    }
    const std::string text = seen_.substr(0, found + expected.size());
    seen_.erase(0, found + expected.size());
    return text;
}

bool Terminal::modes_are_as_before() const {
    termios now{};
    tcgetattr(terminal_, &now);
    return now.c_lflag == modes_before_.c_lflag && now.c_iflag == modes_before_.c_iflag &&
           now.c_oflag == modes_before_.c_oflag && std::memcmp(now.c_cc, modes_before_.c_cc, sizeof now.c_cc) == 0;
}

int Terminal::wait_for_end() {
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

bool Terminal::read_more() {
    pollfd ready{terminal_, POLLIN, 0};
    if (poll(&ready, 1, 30'000) <= 0) return false;
    char buffer[4096];
    const ssize_t count = read(terminal_, buffer, sizeof buffer);
    if (count > 0) seen_.append(buffer, static_cast<std::size_t>(count));
    return count > 0;
}

}  // namespace dynlab::test
