#include "figures/gnuplot_process.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "platform/process_group.h"

namespace dynlab {
namespace test_gnuplot_process {

/// Processes that any thread of this one has started.
pid_t child_of(pid_t process) {
    for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
        pid_t child = 0;
        if (std::ifstream(thread.path() / "children") >> child) return child;
    }
    return 0;
}

// oracle: the kernel's word that the process has ended
TEST(gnuplot_process, of_a_killed_program_ends_with_it) {
    Pipe ready;
    const pid_t program = ::fork();
    if (program == 0) {
        GnuplotProcess gnuplot;
        std::FILE* commands = gnuplot.take_input();
        std::fputs((GnuplotProcess::report_command(1) + "do for [i=1:1000000000] { a = i }\n").c_str(), commands);
        std::fflush(commands);
        gnuplot.wait_for_report(1);
        write_all(ready.write_end.get(), "x", 1);
        for (;;) ::pause();
    }
    char said = 0;
    ASSERT_EQ(::read(ready.read_end.get(), &said, 1), 1);
    const pid_t gnuplot = child_of(program);
    ASSERT_GT(gnuplot, 0);
    const FileDescriptor watched(static_cast<int>(::syscall(SYS_pidfd_open, gnuplot, 0)));
    ASSERT_GE(watched.get(), 0);
    ::kill(program, SIGKILL);
    ::waitpid(program, nullptr, 0);
    pollfd end{watched.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&end, 1, 10'000), 1);  // at once, not when it next reads commands
    ::kill(gnuplot, SIGKILL);
}

// oracle: gnuplot's answer, from another thread than that which started it and has ended
TEST(gnuplot_process, outlives_the_thread_that_asked_for_it) {
    std::unique_ptr<GnuplotProcess> gnuplot;
    std::thread([&] { gnuplot = std::make_unique<GnuplotProcess>(); }).join();
    std::FILE* commands = gnuplot->take_input();
    std::fputs(("print 1 + 1\n" + GnuplotProcess::report_command(7)).c_str(), commands);
    std::fflush(commands);
    EXPECT_EQ(gnuplot->wait_for_report(7), "2\n");
    std::fclose(commands);
}

}  // namespace test_gnuplot_process
}  // namespace dynlab
