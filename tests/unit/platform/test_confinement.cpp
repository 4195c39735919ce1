#include "platform/confinement.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <thread>

#include "platform/guarded_call.h"

namespace dynlab::test {
namespace {

/// What `work` says in a confined copy of this process; -1 when it crashed.
int confined(const std::function<int()>& work, const ProcessLimits& limits = {}) {
    const pid_t child = ::fork();
    if (child == 0) {
        confine_process(limits);
        ::_exit(work());
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int refused(long result) {
    return result == -1 && errno == EPERM ? 0 : 1;
}

// oracle: the kernel's answers
TEST(confinement, refuses_processes_network_and_signals) {
    EXPECT_EQ(confined([] { return refused(::fork()); }), 0);
    EXPECT_EQ(confined([] { return refused(::execl("/bin/true", "true", nullptr)); }), 0);
    EXPECT_EQ(confined([] { return refused(::socket(AF_INET, SOCK_STREAM, 0)); }), 0);
    EXPECT_EQ(confined([] { return refused(::kill(::getppid(), SIGTERM)); }), 0);
    EXPECT_EQ(confined([] { return refused(::chroot("/")); }), 0);
    EXPECT_EQ(confined([] { return refused(::symlink("/etc/passwd", "/tmp/never")); }), 0);
}

TEST(confinement, leaves_threads_and_ordinary_work) {
    EXPECT_EQ(confined([] {
                  int sum = 0;
                  std::thread([&sum] { sum = 7; }).join();
                  return sum;
              }),
              7);
    EXPECT_EQ(confined([] { return is_confined() ? 3 : 4; }), 3);
    EXPECT_FALSE(is_confined());
}

TEST(confinement, limits_memory_and_files) {
    ProcessLimits limits;
#ifndef __SANITIZE_ADDRESS__
    limits.memory_bytes = 1ull << 30;
    EXPECT_EQ(confined([] { return ::malloc(std::size_t{2} << 30) == nullptr ? 0 : 1; }, limits), 0);
#endif
    limits.open_files = 16;
    EXPECT_EQ(confined(
                  [] {
                      for (int i = 0; i < 20; ++i)
                          if (::dup(0) < 0) return 0;
                      return 1;
                  },
                  limits),
              0);
}

// oracle: definition; a confined process cannot fork, and does the work itself
TEST(confinement, guarded_work_is_done_in_place) {
    EXPECT_EQ(confined([] {
                  const ChildResult done = run_guarded([] { return std::string("done"); }, {});
                  const ChildResult failed = run_guarded([]() -> std::string { throw std::runtime_error("no"); }, {});
                  return done.output == "done" && done.exit_code == 0 && failed.exit_code == 1 &&
                                 failed.error_output == "no"
                             ? 0
                             : 1;
              }),
              0);
}

}  // namespace
}  // namespace dynlab::test
