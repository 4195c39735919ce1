// Calls that would go on for minutes, and what Lua's own functions and libraries do without looking at any flag: one
// signal ends the program, with its temporary files. Oracles: POSIX, of how a process ended; what is left in folders.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "platform/child_process.h"
#include "support/environment_variable.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_long_calls {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr const char* kCalls[] = {
    R"lua(string.find(string.rep("a", 40000), string.rep("a*", 20) .. "b"))lua",
    R"lua(string.match(string.rep("a", 100000), ".-.-.-.-b"))lua",
    R"lua(string.gsub(string.rep("a", 200000), "a*a*a*a*b", ""))lua",
    R"lua(for _ in string.gmatch(string.rep("a", 100000), ".-.-.-b") do end)lua",
    R"lua(string.find(string.rep("(", 200000), "%b()", 1))lua",
    R"lua(local s = string.rep("a", 2^26) while true do s:gsub("a", "b") end)lua",
    R"lua(local s = string.rep("a", 2^26) while true do s:gsub(".", string.upper) end)lua",
    R"lua(local s = string.rep("a", 2^28) while true do s:upper() end)lua",
    R"lua(local s = string.rep("a", 2^28) while true do s:reverse() end)lua",
    R"lua(while true do string.rep("ab", 2^27) end)lua",
    R"lua(while true do string.format("%99.99f %q", 1e300, string.rep("x", 1e7)) end)lua",
    R"lua(local t = {} for i = 1, 3e6 do t[i] = i end while true do table.concat(t, ",") end)lua",
    R"lua(local t = {} for i = 1, 3e6 do t[i] = (i * 7919) % 1000003 end while true do table.sort(t) t[1], t[#t] = t[#t], t[1] end)lua",
    R"lua(local t = {} for i = 1, 1e5 do t[i] = i end table.sort(t, function(a, b) return string.rep("x", 100) .. a < string.rep("x", 100) .. b end) while true do table.move(t, 1, #t, 2) end)lua",
    R"lua(while true do end)lua",
    R"lua(while true do pcall(error, "no") end)lua",
    R"lua(while true do pcall(function() while true do end end) end)lua",
    R"lua(local function f(n) return n < 2 and n or f(n - 1) + f(n - 2) end f(60))lua",
    R"lua(local co = coroutine.wrap(function() while true do coroutine.yield() end end) while true do co() end)lua",
    R"lua(fft(randn(8000009)))lua",
    R"lua(local u = randn(2000003) etfe(iddata(u, u, 1)))lua",
    R"lua(local s = 0 while true do s = s + sum(randn(1000000)) end)lua",
    R"lua(inv(randn(3000, 3000)))lua",
    R"lua(eig(randn(1500, 1500)))lua",
    R"lua(det(randn(3500, 3500)))lua",
    R"lua(while true do sort(randn(2000000)) end)lua",
    R"lua(while true do cumsum(randn(5000000)) end)lua",
    R"lua(multisine(linspace(1e-6, 4, 3000), 1e6, 0.1))lua",
    R"lua(while true do multisine({1, 2, 3}, 1e6, 0.1) end)lua",
    R"lua(while true do prbs(18, 3) end)lua",
    R"lua(local G = tf({1}, {1, 0.1, 1}) while true do lsim(G, randn(2000000), range(0, 1999999)) end)lua",
    R"lua(local d = iddata(randn(100000), randn(100000), 1) while true do arx(d, {60, 60, 1}) end)lua",
    R"lua(local d = iddata(randn(50000), randn(50000), 1) while true do oe(d, {6, 6, 1}) end)lua",
    R"lua(local d = iddata(randn(50000), randn(50000), 1) while true do armax(d, {6, 6, 6, 1}) end)lua",
    R"lua(local d = iddata(randn(50000), randn(50000), 1) while true do bj(d, {5, 5, 5, 5, 1}) end)lua",
    R"lua(local d = iddata(randn(20000), randn(20000), 1) while true do n4sid(d, 12) end)lua",
    R"lua(local d = iddata(randn(200000), randn(200000), 0.1) while true do srivc(d, {5, 6, 0}) end)lua",
    R"lua(local d = iddata(randn(300000), randn(300000), 1) while true do spa(d, {window = 5000}) end)lua",
    R"lua(local d = iddata(randn(300000), randn(300000), 1) while true do impulseest(d, 400) end)lua",
    R"lua(while true do local f = plot(randn(1000000), randn(1000000)) save(f, "x.pdf") end)lua",
    R"lua(while true do save_csv("x.csv", {a = randn(1000000)}) end)lua",
    R"lua(while true do save_mat("x.mat", {a = randn(2000000)}) end)lua",
    R"lua(while true do loglog(rand(100000), rand(100000)) end)lua",
    R"lua(local A = randn(2500, 2500) while true do A = A * A end)lua",
    R"lua(local A = randn(400, 400) while true do A:t() end)lua",
};

/// How one of them ended after one signal.
struct Ending {
    bool begun = false;
    int status = 0;
    std::chrono::duration<double> time{};
};

/// The words are made before the fork: in between only system calls are allowed.
Ending ended_by(int number, const std::string& code, const Workbench& bench) {
    std::vector<std::string> words = {"dynlab", "run", "-e", "print('begun') " + code};
    std::vector<char*> pointers = pointers_to(words);
    const std::string folder = bench.path().string();
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return {};
    const pid_t process = ::fork();
    if (process == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        const int nowhere = ::open("/dev/null", O_RDWR);
        ::dup2(nowhere, STDIN_FILENO), ::dup2(nowhere, STDERR_FILENO);
        if (::chdir(folder.c_str()) == 0) ::execv(DYNLAB_PROGRAM, pointers.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    Ending ending;
    pollfd said{ends[0], POLLIN, 0};
    char word[5];
    ending.begun = ::poll(&said, 1, 60'000) > 0 && ::read(ends[0], word, sizeof word) == sizeof word;
    std::this_thread::sleep_for(150ms);  // into the call
    const auto before = Clock::now();
    ::kill(process, number);
    std::thread last_resort([process, fd = ends[0]] {  // the pipe closes when the process ends
        pollfd end{fd, 0, 0};
        if (::poll(&end, 1, 30'000) == 0) ::kill(process, SIGKILL);
    });
    ::waitpid(process, &ending.status, 0);
    ending.time = Clock::now() - before;
    last_resort.join();
    ::close(ends[0]);
    return ending;
}

TEST(long_calls, end_soon_after_the_first_signal) {
    const Workbench bench;
    const fs::path temporary = bench.path("temporary");
    fs::create_directories(temporary);
    const EnvironmentVariable folder("TMPDIR", temporary.string()), home("DYNLAB_HOME", DYNLAB_SOURCE_DIR),
        cache("XDG_CACHE_HOME", bench.cache().string()), state("XDG_STATE_HOME", bench.cache().string());
    std::vector<Ending> endings(std::size(kCalls));
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < std::size(kCalls); i = next++)
            endings[i] = ended_by(i % 2 == 0 ? SIGINT : SIGTERM, kCalls[i], bench);
    };
    std::thread other(work);
    work();
    other.join();
    double longest = 0;
    for (std::size_t i = 0; i < std::size(kCalls); ++i) {
        const Ending& ending = endings[i];
        EXPECT_TRUE(ending.begun) << kCalls[i];
        if (i % 2 == 0)
            EXPECT_TRUE(WIFEXITED(ending.status) && WEXITSTATUS(ending.status) == 130) << kCalls[i];
        else
            EXPECT_TRUE(WIFSIGNALED(ending.status) && WTERMSIG(ending.status) == SIGTERM) << kCalls[i];
        EXPECT_LT(ending.time, 5s) << kCalls[i];  // a third of a second on a machine that does nothing else
        longest = std::max(longest, ending.time.count());
    }
    RecordProperty("longest_in_milliseconds", static_cast<int>(1000 * longest));
    EXPECT_TRUE(fs::is_empty(temporary));
    for (const std::string& name : bench.files())
        EXPECT_TRUE(name == "temporary" || !name.starts_with('.')) << name << " is left behind";
}

}  // namespace test_long_calls
}  // namespace dynlab::test
