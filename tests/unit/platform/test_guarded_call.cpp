#include "platform/guarded_call.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_guarded_call {

using namespace std::chrono_literals;
using testing::HasSubstr;

// The address sanitizer catches a crash itself and does not allow a memory limit.
#ifdef __SANITIZE_ADDRESS__
constexpr int kExitOfCrash = 1;
#else
constexpr int kExitOfCrash = 128 + SIGSEGV;
#endif

TEST(guarded_call, returns_the_result) {
    const std::string large(3 << 20, 'r');
    const ChildResult result = run_guarded([&] { return large; }, {});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.output, large);
}

TEST(guarded_call, returns_the_message_of_an_exception) {
    const ChildResult result = run_guarded([]() -> std::string { throw std::runtime_error("no good"); }, {});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.error_output, "no good");
}

TEST(guarded_call, survives_crash_hang_and_gluttony) {
    const auto crash = [] { return std::raise(SIGSEGV), std::string(); };
    EXPECT_EQ(run_guarded(crash, {}).exit_code, kExitOfCrash);
    const auto hang = []() -> std::string {
        for (;;) pause();
    };
    EXPECT_EQ(run_guarded(hang, {.time = {100ms}}).time_limit(), TimeLimit::kClock);
    const auto spin = []() -> std::string {
        for (volatile int turns = 0;;) turns = turns + 1;
    };
    EXPECT_EQ(run_guarded(spin, {.time = {100ms, 1000}}).time_limit(), TimeLimit::kProcessor);
#ifndef __SANITIZE_ADDRESS__
    const auto gluttony = [] { return std::string(1u << 30, 'x'); };
    const ChildResult result = run_guarded(gluttony, {.memory_bytes = 100u << 20});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.error_output, HasSubstr("bad_alloc"));
#endif
    const auto flood = [] { return std::string(1u << 20, 'x'); };
    EXPECT_TRUE(run_guarded(flood, {.output_bytes = 1000}).output_exceeded);
}

TEST(guarded_call, sees_no_open_file_of_the_caller) {
    const TemporaryFolder folder;
    std::FILE* kept_open = std::fopen((folder.path() / "f").c_str(), "w");
    const int fd = fileno(kept_open);
    const auto write_there = [&] { return std::string(write(fd, "x", 1) == 1 ? "written" : "closed"); };
    const std::string result = run_guarded(write_there, {}).output;
    std::fclose(kept_open);
    // The number may have become one of the copy's own two pipes; the file must be untouched in any case.
    EXPECT_EQ(read_file(folder.path() / "f"), "") << result;
}

// oracle: the kernel's answers
TEST(guarded_call, starts_no_process_and_reaches_no_network) {
    EXPECT_FALSE(is_guarded_copy());
    const auto tried = [] {
        const bool reached = ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0 || ::fork() >= 0 || ::kill(::getppid(), 0) == 0 ||
                             ::symlink("/etc", "/tmp/never") == 0;
        return std::string(!is_guarded_copy() ? "no copy" : reached ? "reached" : "refused");
    };
    EXPECT_EQ(run_guarded(tried, {}).output, "refused");
    EXPECT_FALSE(is_guarded_copy());
    EXPECT_GE(::kill(::getpid(), 0), 0) << "the caller keeps what the copy gave up";
}

TEST(guarded_call, prints_nowhere) {
    testing::internal::CaptureStdout();
    run_guarded([] { return std::printf("noise\n"), std::fflush(stdout), std::string(); }, {});
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace test_guarded_call
}  // namespace dynlab
