// Oracle: the list of what scripts must not have, and the limits given to the runtime.
#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "platform/error.h"
#include "platform/interrupt.h"
#include "script_run.h"

namespace test_sandbox {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;

TEST(sandbox, has_no_way_to_files_processes_or_other_code) {
    EXPECT_EQ(
        printed(
            "local names = {'io', 'os', 'debug', 'package', 'dofile', 'loadfile', 'loadstring', 'warn'}\n"
            "for _, name in ipairs(names) do if rawget(_G, name) ~= nil or pcall(function() return _G[name] end) then "
            "print(name) end end\n"
            "for _, name in ipairs{'dump'} do if pcall(function() return string[name] end) then print(name) end end"),
        "");
    EXPECT_EQ(error_of("\x1bLua"), "this is a compiled Lua chunk, which dynlab does not accept; use the source text");
}

TEST(sandbox, hides_the_metatables) {
    EXPECT_EQ(printed("print(getmetatable(''), getmetatable(_G), getmetatable(string), getmetatable(vector{1}))"),
              "string\tglobals\tstring\tvector\n");
    EXPECT_NE(error_of("getmetatable('').__index = 3"), "(no error)");
    EXPECT_NE(error_of("setmetatable(_G, {})"), "(no error)");
    EXPECT_NE(error_of("setmetatable(vector{1}, {})"), "(no error)");
    EXPECT_EQ(error_of("setmetatable({}, {__gc = function() end})"),
              "lesson.lua:1: setmetatable: the field __gc (finalizers) is not available to scripts");
    EXPECT_EQ(printed("for name in pairs(math) do if name == 'pi' then print(name) end end"), "pi\n");
    EXPECT_NE(error_of("rawset(string, 'rep', 1) print(('x').rep) error('unchanged', 0)").find("unchanged"),
              std::string::npos);
}

TEST(sandbox, ends_scripts_that_take_too_much_memory) {
    RunOptions options;
    options.memory_limit_bytes = 64 << 20;
    EXPECT_EQ(error_of("local t = {}\nfor i = 1, 1e9 do\n  t[i] = {i}\nend", options),
              "lesson.lua:3: the script needs more memory than the limit of 67.1 MB");
    EXPECT_EQ(error_of("local s = string.rep('x', 1e12)", options),
              "lesson.lua:1: rep: the string would require 1e+03 GB of memory, but the limit of the script is 67.1 MB");
    EXPECT_NE(error_of("zeros(1e12)", options)
                  .find("zeros: a vector of 1000000000000 values needs 8e+03 GB of memory, but the limit of the script "
                        "is 67.1 MB"),
              std::string::npos);
    EXPECT_NE(error_of("zeros(1e9, 1e9)", options).find("needs"), std::string::npos);
    EXPECT_NE(error_of("local s = 'x'\nwhile true do s = s .. s end", options)
                  .find("lesson.lua:2: the script needs more memory"),
              std::string::npos);
    EXPECT_EQ(
        printed("print(pcall(string.rep, '', 1e18))\nprint((select(2, pcall(table.concat, {}, '', 1, 1e18))))",
                options),
        "true\t\nlesson.lua:2: the range from 1 to 1000000000000000000 contains more elements than a table can have\n");
    EXPECT_NE(
        error_of("table.insert(setmetatable({}, {__len = function() return 1 << 60 end}), 1, 1)").find("more elements"),
        std::string::npos);
}

TEST(sandbox, collects_vectors_that_are_no_longer_used) {
    RunOptions options;
    options.memory_limit_bytes = 64 << 20;
    EXPECT_EQ(printed("for i = 1, 200 do local v = zeros(1e6) end print('done')", options), "done\n");
}

TEST(sandbox, gives_all_memory_back) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    runtime.run_code("x = 1", "warm-up");
    const std::size_t before = runtime.memory_bytes();
    runtime.run_code("local t = {} for i = 1, 1000 do t[i] = randn(100) end", "lesson.lua");
    EXPECT_GT(runtime.peak_memory_bytes(), before + 800'000);
    EXPECT_NEAR(static_cast<double>(runtime.memory_bytes()), static_cast<double>(before), 20'000);
}

TEST(sandbox, limits_printed_text) {
    RunOptions options;
    options.output_limit_bytes = 10'000;
    EXPECT_EQ(error_of("while true do print('flood') end", options),
              "lesson.lua:1: the script printed more than the limit of 0.01 MB; "
              "print fewer values, for example not in every iteration of a loop");
}

/// Seconds until the limit of 0.2 s of processor time stops `code`.
double seconds_until_end(const std::string& code) {
    RunOptions options;
    options.time = TimeLimits{std::chrono::milliseconds(200), 100};
    const auto start = std::chrono::steady_clock::now();
    EXPECT_NE(error_of(code, options).find("the script used more than 0.2 s of processor time"), std::string::npos)
        << code;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// These loops would run forever. The bound in seconds separates stopped from endless loops on any machine; it does not
/// measure speed.
constexpr double kEnds = 10;

TEST(sandbox, stops_every_endless_loop_at_the_time_limit) {
    for (const char* code : {
             "while true do end",
             "while true do pcall(function() while true do end end) end",
             "local function loop() while true do end end\nwhile true do xpcall(loop, loop) end",
             "local co = coroutine.wrap(function() while true do end end)\nwhile true do pcall(co) end",
             "local function f() local x <close> = setmetatable({}, {__close = function() while true do end end}) "
             "error('x') end\n"
             "while true do pcall(f) end",
             "local function nest(n) for i = 1, 100 do if n > 0 then coroutine.wrap(nest)(n - 1) end end end\nwhile "
             "true do nest(20) end",
             "while true do coroutine.wrap(function() local x <close> = setmetatable({}, {__close = function() while "
             "true do end end}) "
             "while true do end end)() end",
             "local t = setmetatable({}, {__index = function(t, k) while true do end end})\nlocal x = t.a",
         })
        EXPECT_LT(seconds_until_end(code), kEnds) << code;
}

// oracle: a script in one thread cannot use more processor time than passes by the clock
TEST(sandbox, stops_at_the_clock_what_uses_less_processor_time_than_it_may) {
    RunOptions options;
    options.time = TimeLimits{std::chrono::milliseconds(200), 1};
    EXPECT_EQ(error_of("while true do end", options), "lesson.lua:1: the script did not finish within 0.2 s");
}

/// Runs `code` and presses Ctrl-C after 50 ms; gives the seconds from there to the end of the run.
double seconds_after_interrupt(const std::string& code) {
    InterruptScope scope;
    std::chrono::steady_clock::time_point pressed;
    const pthread_t main_thread = pthread_self();
    std::thread presser([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        pressed = std::chrono::steady_clock::now();
        pthread_kill(main_thread, SIGINT);
    });
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    EXPECT_THROW(runtime.run_code(code, "lesson.lua"), Interrupted) << code;
    const auto end = std::chrono::steady_clock::now();
    presser.join();
    return std::chrono::duration<double>(end - pressed).count();
}

TEST(sandbox, obeys_control_c) {
    EXPECT_LT(seconds_after_interrupt("while true do end"), kEnds);
    EXPECT_LT(seconds_after_interrupt("while true do pcall(function() while true do end end) end"), kEnds);
    EXPECT_LT(seconds_after_interrupt("local v = zeros(1000)\nwhile true do v = v + 1 end"), kEnds);
}

TEST(sandbox, studies_obey_control_c) {
    const std::string study = "local G, u = tf({2}, {1, 4, 3}), prbs(10, 7)\nlocal x = lsim(G, u, 0.01)\n",
                      sizes = "montecarlo{system = G, input = u, Ts = 0.01, sigma = 0.2, runs = 1000000, ";
    EXPECT_LT(seconds_after_interrupt(study + sizes + "estimators = {coe = {{1, 2, 0}}}}"), kEnds);
    EXPECT_LT(seconds_after_interrupt(study + "pcall(function() " + sizes +
                                      "estimators = {own = function(d) return lssvf(d, {2, 1, 0}, 3) end}} end)\n"
                                      "while true do end"),
              kEnds);
    EXPECT_LT(seconds_after_interrupt(study + "while true do srivcstruc(iddata(x + randn(#x), u, 0.01)) end"), kEnds);
    EXPECT_LT(seconds_after_interrupt(study + "while true do delayest(iddata(x + randn(#x), u, 0.01)) end"), kEnds);
}

TEST(sandbox, works_on_after_an_interrupt) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    {
        InterruptScope scope;
        raise(SIGINT);
        EXPECT_THROW(runtime.run_code("while true do end", "a"), Interrupted);
    }
    const RunRecord record = runtime.run_code("print('again')", "b");
    EXPECT_FALSE(record.error);
    EXPECT_EQ(record.outputs.at("cell-1").front().printed, "again\n");
}

}  // namespace test_sandbox
