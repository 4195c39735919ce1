#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <string>

namespace dynlab::test {

/// What `action` does while standard error is the far end of `fd`.
template <class Action>
void with_standard_error(int fd, Action action) {
    const int before = dup(STDERR_FILENO);
    dup2(fd, STDERR_FILENO);
    action();
    dup2(before, STDERR_FILENO);
    close(before);
}

/// What was written and not yet read.
inline std::string waiting_in(int fd) {
    pollfd ready{fd, POLLIN, 0};
    char text[4096];
    std::string all;
    while (poll(&ready, 1, 50) == 1 && (ready.revents & POLLIN)) {
        const ssize_t count = read(fd, text, sizeof text);
        if (count <= 0) break;
        all.append(text, static_cast<std::size_t>(count));
    }
    return all;
}

/// What `action` writes to standard error where that is a pipe, or a terminal.
template <class Action>
std::string written_to_a_pipe(Action action) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    with_standard_error(ends[1], action);
    const std::string text = waiting_in(ends[0]);
    close(ends[0]), close(ends[1]);
    return text;
}

template <class Action>
std::string written_to_a_terminal(Action action) {
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    EXPECT_TRUE(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
    const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
    EXPECT_GE(terminal, 0);
    with_standard_error(terminal, action);
    const std::string text = waiting_in(master);
    close(terminal), close(master);
    return text;
}

}  // namespace dynlab::test
