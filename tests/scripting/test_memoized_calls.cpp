// Results of long calls are kept by content. Oracles: equality of every byte of what was computed and what was
// recalled; the number of calls computed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "platform/content_cache.h"
#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/memoized_calls/value_archive.h"

namespace test_memoized_calls {

using namespace dynlab;
using testing::HasSubstr;

const std::string kData =
    "s = tf('s')\nG0 = 2/(s^2 + 4*s + 3)\nu = prbs(4, 100)\nrng(1)\n"
    "d = iddata(lsim(G0, u, 0.01) + 0.2*randn(#u), u, 0.01, {InputName = 'voltage'})\n"
    "h = iddata(lsim(c2d(G0, 0.05), u, 0.05) + 0.02*randn(#u), u, 0.05)\n";

std::string archive_of_global(lua_State* L, const char* name) {
    lua_getglobal(L, name);
    ArchiveWriter archive;
    EXPECT_TRUE(put_value(L, lua_gettop(L), archive)) << name;
    lua_pop(L, 1);
    return archive.bytes();
}

class memoized_calls : public testing::Test {
  protected:
    void SetUp() override {
        setenv("XDG_CACHE_HOME", home_.path().c_str(), 1);
        unsetenv("DYNLAB_NO_CACHE");
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

    struct Use {
        std::string printed;
        std::size_t computed, recalled;
    };
    /// Runs a script with what earlier ones left.
    Use run_with_memory(const std::string& code) {
        ContentCache memory("calls");
        RunOptions options;
        options.memoized_calls = &memory;
        const std::string printed = test::printed(kData + code, options);
        return {printed, memory.remembered(), memory.recalled()};
    }
    TemporaryFolder home_;
};

// A value that was written and read back is written as the same bytes again: no member of any class is lost or changed.
TEST_F(memoized_calls, values_come_back_bit_by_bit) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    lua_State* L = runtime.state();
    ASSERT_FALSE(runtime.run_code(kData, "data.lua").error);
    for (const char* expression :
         {"{1, 1.0, 0/0, 1/0, -0.0, 'a\\0b', true, false, {x = {}, [2.5] = 'y'}}",
          "vector{1, 0/0, -1/0}",
          "matrix{{1, 2}, {3, 4}}",
          "d",
          "d:split(0.5)",
          "merge(d, d)",
          "G0",
          "ss(G0)",
          "pole(G0)",
          "pole(G0)[1]",
          "rig('thruster')",
          "step(G0)",
          "srivc(d, {1, 2, 0})",
          "coe(d, {1, 2, 0}, {Offset = 'estimate'})",
          "tfsrivc(d, 2, 0, {TdMax = 0.05, NumTd = 3})",
          "tfcoe(d, 2, 1)",
          "rivc(d, {1, 0, 1, 2, 0})",
          "tfrivc(d, 2, 0, {IODelay = 0})",
          "procsrivc(d, 'P2D')",
          "hammerstein(d, 2, 0, {IODelay = 0})",
          "n4sid(h, 2)",
          "oe(h, {1, 2, 1})",
          "sriv(h, {1, 2, 1})",
          "bj(h, {1, 1, 1, 2, 1})",
          "armax(h, {2, 1, 1, 1})",
          "iv4(h, {2, 1, 1})",
          "srivcstruc(d, {poles = {1, 3}, zeros = {0, 1}, validate = d})",
          "{delayest(d)}",
          "montecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 5, estimators = {srivc = {{1, 2, 0}}, "
          "lssvf = {{2, 1, 0}, 3}}}",
          "step_second_order(iddata(step(1/(s^2 + 0.4*s + 1), linspace(0, 60, 601)), ones(601), 0.1))"}) {
        const RunRecord made = runtime.run_code(std::string("value = ") + expression, "value.lua");
        ASSERT_FALSE(made.error) << expression << ": " << made.error->message;
        const std::string bytes = archive_of_global(L, "value");
        ArchiveReader archive(bytes);
        const Call call(L);
        push_archived_value(call, archive);
        EXPECT_TRUE(archive.at_end()) << expression;
        lua_setglobal(L, "again");
        EXPECT_TRUE(bytes == archive_of_global(L, "again")) << expression;
        const RunRecord shown = runtime.run_code(
            "local a, b = tostring(value), tostring(again)\n"
            "print(type(value) == 'table' or a == b)",
            "compare.lua");
        EXPECT_EQ(shown.outputs.at("cell-1").front().printed, "true\n") << expression;
    }
}

TEST_F(memoized_calls, what_has_no_lasting_content_is_refused) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    lua_State* L = runtime.state();
    for (const char* value : {"print", "{1, {2, print}}", "coroutine.create(print)", "setmetatable({}, {})",
                              "(function() local t = {} t.t = t return t end)()"}) {
        ASSERT_FALSE(runtime.run_code(std::string("value = ") + value, "value.lua").error) << value;
        lua_getglobal(L, "value");
        const int top = lua_gettop(L);
        ArchiveWriter archive;
        EXPECT_FALSE(put_value(L, top, archive)) << value;
        EXPECT_EQ(lua_gettop(L), top) << value;
        lua_settop(L, 0);
    }
}

TEST_F(memoized_calls, an_equal_call_gives_the_result_the_text_and_the_figure_of_the_first) {
    const std::string code =
        "local delay, fig, D = delayest(d, {poles = {1, 3}, TdMax = 0.2})\n"
        "print(string.format('%.17g', delay), fig, D.message, D.model)\npresent(D.model)\n"
        "local M = montecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 100, estimators = {srivc = {{1, "
        "2, "
        "0}}}}\nprint(M)\nprint(srivcstruc(d, {poles = {1, 4}, zeros = {0, 3}}))\n";
    const Use first = run_with_memory(code), second = run_with_memory(code);
    EXPECT_EQ(first.computed, 3u);
    EXPECT_EQ(first.recalled, 0u);
    EXPECT_EQ(second.computed, 0u);
    EXPECT_EQ(second.recalled, 3u);
    EXPECT_EQ(first.printed, second.printed);
    EXPECT_EQ(first.printed, test::printed(kData + code));

    ContentCache memory("calls");
    RunOptions options;
    options.memoized_calls = &memory;
    const RunRecord record = test::run(kData + "delayest(d, {poles = {1, 3}, TdMax = 0.2})", options);
    EXPECT_EQ(memory.recalled(), 1u);
    EXPECT_EQ(record.figures.size(), 1u);
    EXPECT_THAT(record.outputs.at("cell-1").front().printed, HasSubstr("delay"));
}

TEST_F(memoized_calls, any_difference_of_the_arguments_is_another_call) {
    const auto study = [](const std::string& options, const std::string& before = "") {
        return before + "montecarlo{system = G0, input = u, Ts = 0.01, runs = 200, " + options + "}\n";
    };
    const std::string srivc = "estimators = {srivc = {{1, 2, 0}}}";
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, " + srivc)).computed, 1u);
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, " + srivc)).computed, 0u);
    EXPECT_EQ(run_with_memory(study("sigma = 0.3, " + srivc)).computed, 1u);
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, seed = 2, " + srivc)).computed, 1u);
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, estimators = {srivc = {{1, 2, 0}, {MaxIter = 20}}}")).computed, 1u);
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, " + srivc, "G0 = G0*(1 + 1e-15)\n")).computed, 1u);
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, " + srivc, "u = 1*u\n")).computed, 0u);  // another, equal vector
    EXPECT_EQ(run_with_memory(study("sigma = 0.2, " + srivc, "u = prbs(4, 100, {-1, 1.5})\n")).computed, 1u);
    const std::string search = "srivcstruc(e, {poles = {1, 4}, zeros = {0, 3}})\n";
    EXPECT_EQ(run_with_memory("e = d\n" + search).computed, 1u);
    EXPECT_EQ(run_with_memory("e = d\n" + search).computed, 0u);
    EXPECT_EQ(
        run_with_memory("local y = d.y y[7] = y[7] + 1e-12 e = iddata(y, u, 0.01, {InputName = 'voltage'})\n" + search)
            .computed,
        1u);
    EXPECT_EQ(run_with_memory("e = iddata(d.y, u, 0.01, {InputName = 'force'})\n" + search).computed, 1u);
}

TEST_F(memoized_calls, functions_of_the_script_are_called_every_time) {
    const std::string code =
        "local n = 0\nmontecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 100, estimators = {own = "
        "function(e) n = n + 1 return lssvf(e, {2, 1, 0}, 3) end}}\nprint(n)\n";
    for (int i = 0; i < 2; ++i) {
        const Use use = run_with_memory(code);
        EXPECT_EQ(use.printed, "100\n");
        EXPECT_EQ(use.computed + use.recalled, 0u);
    }
}

TEST_F(memoized_calls, short_calls_and_failed_ones_are_not_kept) {
    EXPECT_EQ(run_with_memory("lssvf(d, {2, 1, 0}, 3)\nrig_truth('crane')\n").computed, 0u);
    const std::string failing =
        "print(pcall(montecarlo, {system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 200, estimators = {srivc = "
        "{{1, 2, 0}}, lssvf = {{9, 9, 0}, -3}}}))\n";
    const Use first = run_with_memory(failing);
    EXPECT_THAT(first.printed, HasSubstr("false"));
    EXPECT_EQ(first.computed, 0u);
    EXPECT_EQ(run_with_memory(failing).printed, first.printed);
}

}  // namespace test_memoized_calls
