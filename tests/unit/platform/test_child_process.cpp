#include "platform/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_child_process {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

ChildOptions shell(const std::string& script) {
    ChildOptions options;
    options.command = {"sh", "-c", script};
    return options;
}

/// Gone, or dead and only waiting to be reaped by its new parent.
bool has_ended(const std::string& process) {
    std::ifstream file("/proc/" + process + "/stat");
    std::string line;
    return !std::getline(file, line) || line.find(") Z ") != std::string::npos;
}

bool ends_soon(const std::string& process) {
    const auto deadline = Clock::now() + 2s;
    while (!has_ended(process) && Clock::now() < deadline) std::this_thread::sleep_for(1ms);
    return has_ended(process);
}

TEST(child_process, returns_exit_code_and_both_outputs) {
    const ChildResult result = run_child(shell("printf out; printf err >&2; exit 7"), "dash");
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_EQ(result.output, "out");
    EXPECT_EQ(result.error_output, "err");
    EXPECT_FALSE(result.timed_out);
    EXPECT_FALSE(result.output_exceeded);
}

TEST(child_process, passes_arguments_without_a_shell) {
    ChildOptions options;
    options.command = {"printf", "%s|", "a b", "$HOME", "`id`", "*", ""};
    EXPECT_EQ(run_child(options, "coreutils").output, "a b|$HOME|`id`|*||");
}

TEST(child_process, echoes_more_than_a_pipe_holds_on_both_streams) {
    ChildOptions options = shell("tee /dev/stderr");
    for (int i = 0; i < 400000; ++i) options.input += std::to_string(i);
    const ChildResult result = run_child(options, "dash");
    EXPECT_EQ(result.output, options.input);
    EXPECT_EQ(result.error_output, options.input);
}

TEST(child_process, input_not_read_does_no_harm) {
    ChildOptions options = shell("exit 0");
    options.input = std::string(5 << 20, 'x');
    EXPECT_EQ(run_child(options, "dash").exit_code, 0);
}

/// As a page's sliders are computed in a copy of the process while Pandoc, started before, waits for its text.
TEST(child_process, input_that_is_given_later_ends_although_a_copy_of_this_process_holds_it_open) {
    ChildOptions options;
    options.command = {"cat"};
    options.input_later = true;
    options.timeout = 20s;
    ChildProcess child(options, "coreutils");
    const pid_t copy = ::fork();
    if (copy == 0) {
        ::alarm(60);
        for (;;) ::pause();
    }
    child.give_input("some text");
    const ChildResult result = child.wait();
    ::kill(copy, SIGKILL);
    ::waitpid(copy, nullptr, 0);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.output, "some text");
}

TEST(child_process, no_input_is_an_empty_input) {
    EXPECT_EQ(run_child(shell("cat; echo end"), "dash").output, "end\n");
}

TEST(child_process, runs_in_the_folder_with_the_environment) {
    const TemporaryFolder folder;
    setenv("DYNLAB_TEST_REPLACED", "old", 1);
    setenv("DYNLAB_TEST_KEPT", "kept", 1);
    ChildOptions options = shell("pwd -P; echo $DYNLAB_TEST_REPLACED $DYNLAB_TEST_KEPT $DYNLAB_TEST_NEW");
    options.folder = folder.path();
    options.environment = {{"DYNLAB_TEST_REPLACED", "new"}, {"DYNLAB_TEST_NEW", "a=b"}};
    EXPECT_EQ(run_child(options, "dash").output, fs::canonical(folder.path()).string() + "\nnew kept a=b\n");
}

TEST(child_process, timeout_kills_the_whole_group) {
    ChildOptions options = shell("sleep 60 & echo $!; sleep 60");
    options.timeout = 200ms;
    const auto start = Clock::now();
    const ChildResult result = run_child(options, "dash");
    EXPECT_LT(Clock::now() - start, 5s);
    EXPECT_TRUE(result.timed_out);
    EXPECT_EQ(result.exit_code, 128 + SIGKILL);
    EXPECT_TRUE(ends_soon(result.output.substr(0, result.output.find('\n'))));
}

TEST(child_process, processor_time_is_counted_and_not_the_time_that_passes) {
    ChildOptions options = shell("while :; do :; done");
    options.processor_time = 1s;
    const ChildResult busy = run_child(options, "dash");
    EXPECT_TRUE(busy.timed_out);
    EXPECT_TRUE(busy.processor_time_used_up);

    options = shell("sleep 1.5; echo whole");
    options.processor_time = 1s;
    const ChildResult idle = run_child(options, "dash");
    EXPECT_FALSE(idle.timed_out);
    EXPECT_EQ(idle.output, "whole\n");
}

// Each alone would stay below the limit; the clock's is far away.
TEST(child_process, processor_time_of_children_that_run_together_is_counted_together) {
    const std::string spin = "while [ $i -lt 100000000 ]; do i=$((i+1)); done";
    ChildOptions options = shell("i=0; (" + spin + ") & (" + spin + ") & (" + spin + ") & wait");
    options.processor_time = 900ms;
    options.timeout = 120s;
    const ChildResult result = run_child(options, "dash");
    EXPECT_TRUE(result.processor_time_used_up);
    EXPECT_EQ(result.exit_code, 128 + SIGKILL) << "no single process reached it";
}

TEST(child_process, processor_time_of_children_that_have_ended_is_counted) {
    ChildOptions options = shell("while :; do (i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done); done");
    options.processor_time = 500ms;
    options.timeout = 120s;
    const ChildResult result = run_child(options, "dash");
    EXPECT_TRUE(result.timed_out);
    EXPECT_TRUE(result.processor_time_used_up);
}

TEST(child_process, the_clock_ends_what_only_waits) {
    ChildOptions options = shell("sleep 60");
    options.processor_time = 60s;
    options.timeout = 200ms;
    const ChildResult result = run_child(options, "dash");
    EXPECT_TRUE(result.timed_out);
    EXPECT_FALSE(result.processor_time_used_up);
}

TEST(child_process, is_given_up_when_asked) {
    ChildOptions options = shell("sleep 60 & echo begun; wait");
    int asked = 0;
    options.give_up = [&asked] { return ++asked == 4; };
    const Clock::time_point start = Clock::now();
    const ChildResult result = run_child(options, "dash");
    EXPECT_TRUE(result.given_up);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.output, "begun\n");
    EXPECT_EQ(asked, 4);
    EXPECT_LT(Clock::now() - start, 30s);
}

TEST(child_process, does_not_wait_for_what_the_program_leaves_running) {
    const auto start = Clock::now();
    const ChildResult result = run_child(shell("sleep 60 & echo $!"), "dash");
    EXPECT_LT(Clock::now() - start, 5s);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_TRUE(ends_soon(result.output.substr(0, result.output.find('\n'))));
}

TEST(child_process, timeout_holds_when_the_outputs_are_closed) {
    ChildOptions options = shell("exec >&- 2>&-; sleep 60");
    options.timeout = 100ms;
    EXPECT_TRUE(run_child(options, "dash").timed_out);
}

TEST(child_process, endless_output_is_cut_and_ends_the_child) {
    ChildOptions options = shell("yes");
    options.output_bytes = 100000;
    const ChildResult result = run_child(options, "dash");
    EXPECT_TRUE(result.output_exceeded);
    EXPECT_EQ(result.output.size(), 100000u);
    EXPECT_EQ(result.exit_code, 128 + SIGKILL);
}

TEST(child_process, output_of_exactly_the_limit_is_allowed) {
    ChildOptions options = shell("printf 12345678");
    options.output_bytes = 8;
    const ChildResult result = run_child(options, "dash");
    EXPECT_FALSE(result.output_exceeded);
    EXPECT_EQ(result.output, "12345678");
}

TEST(child_process, memory_is_limited) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer lets no limit of memory be set";
#endif
    // dd asks for one block of the given size: granted without the limit, refused with it.
    ChildOptions options = shell("dd if=/dev/zero of=/dev/null bs=300M count=1");
    EXPECT_EQ(run_child(options, "dash").exit_code, 0);
    options.memory_bytes = 100u << 20;
    EXPECT_NE(run_child(options, "dash").exit_code, 0);
}

TEST(child_process, death_by_a_signal_is_128_plus_its_number) {
    EXPECT_EQ(run_child(shell("kill -SEGV $$"), "dash").exit_code, 128 + SIGSEGV);
}

TEST(child_process, signals_that_we_ignore_are_not_ignored_by_children) {  // oracle: what the shell itself dies of
    for (const auto& [name, number] : {std::pair("PIPE", SIGPIPE), std::pair("XFSZ", SIGXFSZ)}) {
        const auto before = std::signal(number, SIG_IGN);
        const ChildResult result = run_child(shell(std::string("kill -") + name + " $$; echo still here"), "dash");
        std::signal(number, before);
        EXPECT_EQ(result.exit_code, 128 + number) << name;
        EXPECT_EQ(result.output, "");
    }
}

TEST(child_process, missing_program_names_the_package) {
    ChildOptions options;
    options.command = {"pandoc-of-another-world", "--version"};
    try {
        run_child(options, "pandoc");
        FAIL();
    } catch (const MissingProgram& error) {
        EXPECT_STREQ(error.what(),
                     "pandoc-of-another-world is not installed. Install it with: sudo apt install pandoc");
    }
}

TEST(child_process, failure_to_start_names_the_reason) {
    const TemporaryFolder folder;
    ChildOptions options = shell("true");
    options.folder = folder.path() / "none";
    try {
        run_child(options, "dash");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no such file or directory (in " + options.folder.string() + ")"));
    }
    write_file_atomically(folder.path() / "broken", "#!/none/such\n");
    fs::permissions(folder.path() / "broken", fs::perms(0755));
    options = {};
    options.command = {(folder.path() / "broken").string()};
    EXPECT_THROW(run_child(options, "none"), EnvironmentError);
}

TEST(child_process, interrupt_kills_the_group_and_throws) {
    const InterruptScope scope;
    const TemporaryFolder folder;
    ChildOptions options = shell("echo $$ > pid; sleep 60");
    options.folder = folder.path();
    std::thread ctrl_c([&, waiting = pthread_self()] {
        while (!fs::exists(folder.path() / "pid")) std::this_thread::sleep_for(1ms);
        while (read_file(folder.path() / "pid").empty()) std::this_thread::sleep_for(1ms);
        pthread_kill(waiting, SIGINT);
    });
    EXPECT_THROW(run_child(options, "dash"), Interrupted);
    ctrl_c.join();
    std::string process = read_file(folder.path() / "pid");
    EXPECT_TRUE(ends_soon(process.substr(0, process.size() - 1)));
}

TEST(child_process, one_that_must_end_whole_does_so_although_it_is_interrupted) {
    const InterruptScope scope;
    ::raise(SIGINT);
    ASSERT_TRUE(interrupted());
    ChildOptions options = shell("sleep 0.2; echo undone");
    EXPECT_THROW(run_child(options, "dash"), Interrupted);
    options.heeds_interrupt = false;
    EXPECT_EQ(run_child(options, "dash").output, "undone\n");
}

TEST(child_process, works_while_others_do) {
    ChildProcess first(shell("sleep 0.2; echo first"), "dash"), second(shell("echo second"), "dash");
    EXPECT_EQ(second.wait().output, "second\n");
    EXPECT_EQ(first.wait().output, "first\n");
    EXPECT_THROW(first.wait(), std::logic_error);
}

TEST(child_process, dropped_without_waiting_is_killed) {
    const TemporaryFolder folder;
    ChildOptions options = shell("echo $$ > pid; sleep 60");
    options.folder = folder.path();
    {
        const ChildProcess child(options, "dash");
        while (!fs::exists(folder.path() / "pid") || read_file(folder.path() / "pid").empty()) {
            std::this_thread::sleep_for(1ms);
        }
    }
    std::string process = read_file(folder.path() / "pid");
    EXPECT_TRUE(ends_soon(process.substr(0, process.size() - 1)));
}

}  // namespace test_child_process
}  // namespace dynlab
