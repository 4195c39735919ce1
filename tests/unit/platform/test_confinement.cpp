#include "platform/confinement.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "platform/guarded_call.h"

namespace dynlab::test {
namespace test_confinement {
/// What `work` says in a confined copy of this process; 1 when it throws, -1 when it crashed.
int confined_by(const std::function<void()>& confine, const std::function<int()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        confine();
        try {
            ::_exit(work());
        } catch (const std::runtime_error&) {
            ::_exit(1);
        }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int confined(const std::function<int()>& work, const ProcessLimits& limits = {}) {
    return confined_by([&] { confine_process(limits); }, work);
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

// oracle: the kernel's answers; without the filter each of these calls ends otherwise, at least for root
TEST(confinement, refuses_mounts_rights_of_others_and_what_outlives_the_process) {
    const std::pair<const char*, std::function<long()>> calls[] = {
        {"fsopen", [] { return ::syscall(SYS_fsopen, "tmpfs", 0); }},
        {"fsconfig", [] { return ::syscall(SYS_fsconfig, -1, 0, nullptr, nullptr, 0); }},
        {"fsmount", [] { return ::syscall(SYS_fsmount, -1, 0, 0); }},
        {"fspick", [] { return ::syscall(SYS_fspick, AT_FDCWD, "/", 0); }},
        {"move_mount", [] { return ::syscall(SYS_move_mount, -1, "", -1, "", 0); }},
        {"open_tree", [] { return ::syscall(SYS_open_tree, AT_FDCWD, "/", 0); }},
        {"mount_setattr", [] { return ::syscall(SYS_mount_setattr, -1, "", 0, nullptr, 0); }},
        {"chown", [] { return ::chown("/nowhere", 0, 0); }},
        {"lchown", [] { return ::lchown("/nowhere", 0, 0); }},
        {"fchown", [] { return ::fchown(-1, 0, 0); }},
        {"fchownat", [] { return ::fchownat(AT_FDCWD, "/nowhere", 0, 0, 0); }},
        {"setfsuid", [] { return ::syscall(SYS_setfsuid, -1); }},
        {"setfsgid", [] { return ::syscall(SYS_setfsgid, -1); }},
        {"setresgid", [] { return ::syscall(SYS_setresgid, -1, -1, -1); }},
        {"setregid", [] { return ::syscall(SYS_setregid, -1, -1); }},
        {"capset", [] { return ::syscall(SYS_capset, nullptr, nullptr); }},
        {"kcmp", [] { return ::syscall(SYS_kcmp, ::getpid(), ::getpid(), 0, 0, 0); }},
        {"shmget", [] { return ::syscall(SYS_shmget, 1, 0, 0); }},
        {"semget", [] { return ::syscall(SYS_semget, 1, 0, 0); }},
        {"msgget", [] { return ::syscall(SYS_msgget, 1, 0); }},
        {"mq_open", [] { return ::syscall(SYS_mq_open, "nowhere", 0, 0, nullptr); }},
        {"personality", [] { return ::syscall(SYS_personality, 0xffffffff); }},
        {"ioprio_set", [] { return ::syscall(SYS_ioprio_set, 1, 0, 0); }},
#ifdef SYS_modify_ldt
        {"modify_ldt", [] { return ::syscall(SYS_modify_ldt, 0, nullptr, 0); }},
#endif
    };
    for (const auto& [name, call] : calls) EXPECT_EQ(confined([&call = call] { return refused(call()); }), 0) << name;
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

// oracle: the kernel's answers
TEST(confinement, to_memory_leaves_computing_and_open_files) {
    const int code = confined_by(confine_to_memory, [] {
        const bool all_refused =
            refused(::open("/etc/passwd", O_RDONLY)) + refused(::fork()) + refused(::unlink("/tmp/never")) +
                refused(::socket(AF_UNIX, SOCK_STREAM, 0)) + refused(::kill(::getpid(), SIGTERM)) +
                refused(::execl("/bin/true", "true", nullptr)) + refused(::chdir("/")) + refused(::dup(1)) ==
            0;
        const std::vector<int> many(50'000'000, 1);
        return all_refused && is_confined() && many.back() == 1 && ::write(STDOUT_FILENO, "", 0) == 0 ? 0 : 1;
    });
    EXPECT_EQ(code, 0);
    EXPECT_EQ(confined_by(confine_to_memory, []() -> int { throw std::runtime_error("no"); }), 1);
    EXPECT_EQ(confined_by(confine_to_memory, []() -> int { std::abort(); }), -1);
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

}  // namespace test_confinement
}  // namespace dynlab::test
