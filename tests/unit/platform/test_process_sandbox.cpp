#include "platform/sandbox.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/reader.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_process_sandbox {
using ::testing::HasSubstr;
using ::testing::Not;

ChildResult shell(Sandbox& sandbox, const std::string& command, Sandbox::Limits limits = {}) {
    return sandbox.run({"/bin/sh", "-c", command}, {}, "", limits);
}

class full_sandbox : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const auto obstacle = obstacle_to(Isolation::kFull)) GTEST_SKIP() << message_text(*obstacle);
    }
    TemporaryFolder folder_;
    Sandbox sandbox_{Isolation::kFull};
};

// oracle: what the programs inside see
TEST_F(full_sandbox, holds_nothing_but_what_was_put_in) {
    write_file_atomically(folder_.path() / "a.txt", "inside\n");
    EXPECT_EQ(sandbox_.add(folder_.path(), "/box/files"), "/box/files");
    EXPECT_EQ(shell(sandbox_, "cat /box/files/a.txt").output, "inside\n");
    EXPECT_NE(shell(sandbox_, "echo x > /box/files/b.txt").exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b.txt"));
    EXPECT_EQ(shell(sandbox_, "ls -d /etc /home /root /var 2>/dev/null").output, "");
    EXPECT_NE(shell(sandbox_, "echo x > /usr/never").exit_code, 0);
    EXPECT_EQ(shell(sandbox_, "ls -A /tmp; pwd").output, "/tmp\n");
    EXPECT_EQ(shell(sandbox_, "env | grep -c HOME=").output, "1\n");
}

/// The number of processes whose command line contains `marker`.
int processes_with(const std::string& marker) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        std::ifstream file(entry.path() / "cmdline");
        bool found = false;
        for (std::string word; std::getline(file, word, '\0');) found = found || word.find(marker) != std::string::npos;
        count += found;
    }
    return count;
}

/// What the next test kills.
TEST_F(full_sandbox, DISABLED_sleeps) {
    shell(sandbox_, std::string("exec sleep ") + std::getenv("DYNLAB_TEST_SLEEP"));
}

// oracle: the kernel's list of processes, after kills at every stage of the start of a sandbox
TEST_F(full_sandbox, ends_with_the_program_that_made_it) {
    const std::string marker = "4711." + std::to_string(::getpid());
    ::setenv("DYNLAB_TEST_SLEEP", marker.c_str(), 1);
    for (int i = 0; i < 60; ++i) {
        const pid_t program = ::fork();
        if (program == 0) {
            ::close(STDOUT_FILENO);
            ::execl("/proc/self/exe", "tests", "--gtest_also_run_disabled_tests", "--gtest_filter=*DISABLED_sleeps",
                    nullptr);
            ::_exit(1);
        }
        for (int k = 0; k < 200 && processes_with(marker) == 0; ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::this_thread::sleep_for(std::chrono::microseconds(200 * i));
        ::kill(program, SIGKILL);
        ::waitpid(program, nullptr, 0);
    }
    for (int i = 0; i < 600 && processes_with(marker) > 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(processes_with(marker), 0);
}

// oracle: a script that lists what lies beside it, inside and outside
TEST(process_sandbox, a_program_finds_its_own_libraries_beside_it) {
    const TemporaryFolder prefix;
    for (const char* folder : {"bin", "lib/dynlab"}) std::filesystem::create_directories(prefix.path() / folder);
    write_file_atomically(prefix.path() / "bin/tool", "#!/bin/sh\nls \"$(dirname \"$0\")/../lib/dynlab\"\n");
    std::filesystem::permissions(prefix.path() / "bin/tool", std::filesystem::perms(0755));
    write_file_atomically(prefix.path() / "lib/dynlab/one.so", "");
    EXPECT_EQ(library_folder_of(prefix.path() / "bin/tool"), prefix.path() / "lib/dynlab");
    EXPECT_FALSE(library_folder_of(prefix.path() / "lib/dynlab/one.so"));
    for (const Isolation level : {Isolation::kFull, Isolation::kProcess}) {
        if (obstacle_to(level)) continue;
        Sandbox sandbox(level);
        const ChildResult run = sandbox.run({sandbox.add_program(prefix.path() / "bin/tool").string()}, {}, "", {});
        EXPECT_EQ(run.output, "one.so\n") << run.error_output;
    }
}

// oracle: what the kernel says of a process inside, and what it lets it do
TEST_F(full_sandbox, gives_no_one_the_rights_of_root) {
    sandbox_.add(folder_.path(), "/box/files");
    EXPECT_EQ(shell(sandbox_, "grep -E '^Cap(Prm|Eff|Bnd)' /proc/self/status | tr -d '0\\n\\t'").output,
              "CapPrm:CapEff:CapBnd:");
    EXPECT_NE(shell(sandbox_, "mount -o remount,bind,rw /box/files && echo x > /box/files/b.txt").exit_code, 0);
    EXPECT_NE(shell(sandbox_, "mount -t tmpfs none /tmp").exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b.txt"));
}

TEST_F(full_sandbox, has_a_writable_place_of_limited_size) {
    const auto inside = sandbox_.add_writable(folder_.path(), "/box/out");
    EXPECT_EQ(shell(sandbox_, "echo y > " + inside.string() + "/y.txt").exit_code, 0);
    EXPECT_EQ(read_file(folder_.path() / "y.txt"), "y\n");
    Sandbox::Limits limits;
    limits.scratch_bytes = 1 << 20;
    EXPECT_NE(shell(sandbox_, "head -c 3M /dev/zero > /tmp/big", limits).exit_code, 0);
}

TEST_F(full_sandbox, sees_no_other_processes_and_no_network) {
    EXPECT_EQ(shell(sandbox_, "ls /proc | grep -c '^[0-9]'").output.size(), 2u);
    EXPECT_THAT(shell(sandbox_, "cat /proc/net/dev").output, Not(HasSubstr("eth")));
}

TEST_F(full_sandbox, ends_with_all_it_started) {
    Sandbox::Limits limits;
    limits.time = {std::chrono::milliseconds(500), 1};
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(shell(sandbox_, "setsid sleep 1234 & sleep 1234", limits).timed_out);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    EXPECT_EQ(shell(sandbox_, "(setsid sleep 1235 >/dev/null 2>&1 &) ; echo done").output, "done\n");
    ChildOptions look;
    look.command = {"pgrep", "-fx", "sleep 123[45]"};
    // The kernel ends the processes of the sandbox soon after its first process.
    std::string left = "not looked yet";
    for (int i = 0; i < 100 && !left.empty(); ++i, std::this_thread::sleep_for(std::chrono::milliseconds(20)))
        left = run_child(look, "procps").output;
    EXPECT_EQ(left, "");
}

// oracle: the kernel counts three processes in one sandbox, none of which uses the whole time
TEST_F(full_sandbox, counts_the_processor_time_of_all_its_processes) {
    Sandbox::Limits limits;
    limits.time = {std::chrono::milliseconds(900), 100};
    const std::string spin = "(i=0; while [ $i -lt 100000000 ]; do i=$((i+1)); done)";
    EXPECT_TRUE(shell(sandbox_, spin + " & " + spin + " & " + spin + " & wait", limits).processor_time_used_up);
    limits.time = {std::chrono::milliseconds(500), 5};
    EXPECT_EQ(shell(sandbox_, "sleep 1; echo whole", limits).output, "whole\n");
}

TEST(process_box, keeps_the_places_and_empties_the_environment) {
    const TemporaryFolder folder;
    Sandbox sandbox(Isolation::kProcess);
    EXPECT_EQ(sandbox.add(folder.path(), "/box/files"), folder.path());
    sandbox.set_environment("DYNLAB_HOME", "/somewhere");
    EXPECT_EQ(shell(sandbox, "echo $DYNLAB_HOME $USER").output, "/somewhere\n");
    EXPECT_EQ(obstacle_to(Isolation::kProcess), std::nullopt);
}

}  // namespace test_process_sandbox
}  // namespace dynlab::test
