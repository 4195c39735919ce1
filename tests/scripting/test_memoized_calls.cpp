// The cache keeps results of long calls by content. Oracles: equality of every byte of computed and cached results; the
// number of computed calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/memoized_calls/value_archive.h"
#include "scripting/objects/data_object.h"
#include "support/environment_variable.h"

namespace test_memoized_calls {

using namespace dynlab;
using testing::HasSubstr;

const std::string kData =
    "s = tf('s')\nG0 = 2/(s^2 + 4*s + 3)\nu = prbs(4, 100)\nrng(1)\n"
    "d = iddata(lsim(G0, u, 0.01) + 0.2*randn(#u), u, 0.01, {InputName = 'voltage'})\n"
    "h = iddata(lsim(c2d(G0, 0.05), u, 0.05) + 0.02*randn(#u), u, 0.05)\n";

std::string archive_of_global(lua_State* L, const char* name) {
    lua_getglobal(L, name);
    CborWriter archive;
    EXPECT_TRUE(put_value(L, lua_gettop(L), archive)) << name;
    lua_pop(L, 1);
    return archive.bytes();
}

class memoized_calls : public testing::Test {
  protected:
    struct Use {
        std::string printed;
        std::size_t computed, from_cache;
    };
    /// Runs a script with what earlier ones left. How long calls take differs from machine to machine: where it does
    /// not matter, all are kept.
    Use run_with_cache(const std::string& code, CallCache::Duration min_duration = CallCache::Duration::zero(),
                       const std::string& language = "en") {
        const Cache cache;
        CallCache calls(cache, min_duration);
        RunOptions options;
        options.call_cache = &calls;
        const std::string printed = test::printed(kData + code, options, language);
        return {printed, calls.use().made, calls.use().from_cache};
    }
    TemporaryFolder home_;
    test::EnvironmentVariable cache_home_{"XDG_CACHE_HOME", home_.path()}, no_cache_{"DYNLAB_NO_CACHE", {}};
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
          "plant('thruster')",
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
        ASSERT_FALSE(made.error) << expression << ": " << made.error->text();
        const std::string bytes = archive_of_global(L, "value");
        CborReader archive(bytes);
        const Call call(L);
        std::vector<FigurePointer> figures;
        push_archived_value(call, archive, figures);
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
        CborWriter archive;
        EXPECT_FALSE(put_value(L, top, archive)) << value;
        EXPECT_EQ(lua_gettop(L), top) << value;
        lua_settop(L, 0);
    }
}

TEST_F(memoized_calls, in_another_language_a_call_is_made_again_and_says_so_in_it) {
    const std::string code = "delayest(d, {poles = {1, 3}, TdMax = 0.2})";
    const auto run_in = [&](const char* language) {
        return run_with_cache(code, CallCache::Duration::zero(), language);
    };
    EXPECT_THAT(run_in("en").printed, HasSubstr("The delay is"));
    EXPECT_THAT(run_in("fr").printed, HasSubstr("Le retard est"));
    const Use english = run_in("en"), french = run_in("fr");
    EXPECT_THAT(english.printed, HasSubstr("The delay is"));
    EXPECT_THAT(french.printed, HasSubstr("Le retard est"));
    EXPECT_EQ(english.from_cache, 1u);
    EXPECT_EQ(french.from_cache, 1u);
}

TEST_F(memoized_calls, an_equal_call_gives_the_result_the_text_and_the_figure_of_the_first) {
    const std::string code =
        "local delay, fig, D = delayest(d, {poles = {1, 3}, TdMax = 0.2})\n"
        "print(string.format('%.17g', delay), fig, D.message, D.model)\npresent(D.model)\n"
        "local M = montecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 100, estimators = {srivc = {{1, "
        "2, "
        "0}}}}\nprint(M)\nprint(srivcstruc(d, {poles = {1, 4}, zeros = {0, 3}}))\n"
        "local told = advice(d:range(1, 900))\nprint(told, told.clean, #told.discard)\n";
    const Use first = run_with_cache(code), second = run_with_cache(code);
    EXPECT_EQ(first.computed, 4u);
    EXPECT_EQ(first.from_cache, 0u);
    EXPECT_EQ(second.computed, 0u);
    EXPECT_EQ(second.from_cache, 4u);
    EXPECT_EQ(first.printed, second.printed);
    EXPECT_EQ(first.printed, test::printed(kData + code));

    const Cache cache;
    CallCache calls(cache, CallCache::Duration::zero());
    RunOptions options;
    options.call_cache = &calls;
    const RunRecord record = test::run(kData + "delayest(d, {poles = {1, 3}, TdMax = 0.2})", options);
    EXPECT_EQ(calls.use().from_cache, 1u);
    EXPECT_EQ(record.figures.size(), 1u);
    EXPECT_THAT(record.outputs.at("cell-1").front().printed, HasSubstr("delay"));
}

TEST_F(memoized_calls, any_difference_of_the_arguments_is_another_call) {
    const auto study = [](const std::string& options, const std::string& before = "") {
        return before + "montecarlo{system = G0, input = u, Ts = 0.01, runs = 200, " + options + "}\n";
    };
    const std::string srivc = "estimators = {srivc = {{1, 2, 0}}}";
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, " + srivc)).computed, 1u);
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, " + srivc)).computed, 0u);
    EXPECT_EQ(run_with_cache(study("sigma = 0.3, " + srivc)).computed, 1u);
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, seed = 2, " + srivc)).computed, 1u);
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, estimators = {srivc = {{1, 2, 0}, {MaxIter = 20}}}")).computed, 1u);
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, " + srivc, "G0 = G0*(1 + 1e-15)\n")).computed, 1u);
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, " + srivc, "u = 1*u\n")).computed, 0u);  // another, equal vector
    EXPECT_EQ(run_with_cache(study("sigma = 0.2, " + srivc, "u = prbs(4, 100, {-1, 1.5})\n")).computed, 1u);
    const std::string search = "srivcstruc(e, {poles = {1, 4}, zeros = {0, 3}})\n";
    EXPECT_EQ(run_with_cache("e = d\n" + search).computed, 1u);
    EXPECT_EQ(run_with_cache("e = d\n" + search).computed, 0u);
    EXPECT_EQ(
        run_with_cache("local y = d.y y[7] = y[7] + 1e-12 e = iddata(y, u, 0.01, {InputName = 'voltage'})\n" + search)
            .computed,
        1u);
    EXPECT_EQ(run_with_cache("e = iddata(d.y, u, 0.01, {InputName = 'force'})\n" + search).computed, 1u);
}

TEST_F(memoized_calls, functions_of_the_script_are_called_every_time) {
    const std::string code =
        "local n = 0\nmontecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 100, estimators = {own = "
        "function(e) n = n + 1 return lssvf(e, {2, 1, 0}, 3) end}};\nprint(n)\n";
    for (int i = 0; i < 2; ++i) {
        const Use use = run_with_cache(code);
        EXPECT_EQ(use.printed, "100\n");
        EXPECT_EQ(use.computed + use.from_cache, 0u);
    }
}

TEST_F(memoized_calls, short_calls_and_failed_ones_are_not_kept) {
    EXPECT_EQ(run_with_cache("lssvf(d, {2, 1, 0}, 3)\nrig_truth('crane')\n", CallCache::Duration::max()).computed, 0u);
    const std::string failing =
        "print(pcall(montecarlo, {system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 200, estimators = {srivc = "
        "{{1, 2, 0}}, lssvf = {{9, 9, 0}, -3}}}))\n";
    const Use first = run_with_cache(failing);
    EXPECT_THAT(first.printed, HasSubstr("false"));
    EXPECT_EQ(first.computed, 0u);
    EXPECT_EQ(run_with_cache(failing).printed, first.printed);
}

// A binding may put what it reads in the arguments' places, a vector for a table of numbers.
TEST_F(memoized_calls, calls_are_known_by_the_arguments_that_were_given) {
    const std::string code =
        "local long = prbs(14, 10)\nlocal e = iddata(lsim(G0, long, 0.01) + 0.2*randn(#long), long, 0.01)\n"
        "print(tfsrivc(e, {2}, {0}, {TdMax = 0.5}))\n";
    const Use first = run_with_cache(code), second = run_with_cache(code);
    EXPECT_EQ(first.computed, 1u);
    EXPECT_EQ(second.computed, 0u);
    EXPECT_EQ(second.from_cache, 1u);
    EXPECT_EQ(first.printed, second.printed);
}

// Oracle: the files below the cache folder. Where nothing was kept of a call's shape, its arguments are not looked at;
// where nothing can be kept, nothing is written.
TEST_F(memoized_calls, quick_calls_and_calls_without_a_cache_leave_nothing) {
    run_with_cache("for i = 1, 3 do srivc(d[{1, 200}], {1, 2, 0}) end\n", CallCache::Duration::max());
    EXPECT_FALSE(std::filesystem::exists(home_.path() / "dynlab/calls"));
    no_cache_.set("1");
    const std::string study =
        "montecarlo{system = G0, input = u, Ts = 0.01, sigma = 0.2, runs = 200, estimators = {srivc = {{1, 2, 0}}}}\n";
    for (int i = 0; i < 2; ++i) {
        const Use use = run_with_cache(study + study);
        EXPECT_EQ(use.computed, 2u);
        EXPECT_EQ(use.from_cache, 0u);
    }
    EXPECT_FALSE(std::filesystem::exists(home_.path() / "dynlab/calls"));
}

// Oracle: the first run. A cache entry that is corrupt on the disk, or that contains another form of results, is
// created again. Printed text and figures appear once.
TEST_F(memoized_calls, damaged_entries_are_computed_again) {
    const std::string code = "delayest(d, {poles = {1, 3}, TdMax = 0.6})\n";
    const Use first = run_with_cache(code);
    ASSERT_EQ(first.computed, 1u);
    const std::filesystem::path entry = *std::filesystem::directory_iterator(home_.path() / "dynlab/calls");
    const std::string name = "calls/" + entry.filename().string();
    const std::string file = read_file(entry), bytes = Cache().load_entry(name).value();
    std::string flipped = file;
    flipped[file.size() / 2] ^= 1;
    std::string other_kind = bytes;
    other_kind[0] = '\xf6';
    const auto expect_computed_again = [&](const char* damage) {
        const Cache cache;
        CallCache calls(cache, CallCache::Duration::zero());
        RunOptions options;
        options.call_cache = &calls;
        const RunRecord record = test::run(kData + code, options);
        ASSERT_FALSE(record.error) << damage << ": " << record.error->text();
        EXPECT_EQ(calls.use().made, 1u) << damage;
        EXPECT_EQ(calls.use().from_cache, 0u) << damage;
        EXPECT_EQ(record.figures.size(), 1u) << damage;
        const Use again = run_with_cache(code);
        EXPECT_EQ(again.from_cache, 1u) << damage;
        EXPECT_EQ(again.printed, first.printed) << damage;
    };
    for (const auto& [damage, content] :
         {std::pair("an empty file", std::string()), std::pair("half the file", file.substr(0, file.size() / 2)),
          std::pair("one bit flipped", flipped)}) {
        write_file_atomically(entry, content);
        expect_computed_again(damage);
    }
    for (const auto& [damage, content] :
         {std::pair("nothing", std::string()), std::pair("half the result", bytes.substr(0, bytes.size() / 2)),
          std::pair("all but the last byte", bytes.substr(0, bytes.size() - 1)),
          std::pair("a byte behind it", bytes + '\0'), std::pair("another kind of value", other_kind)}) {
        Cache().save_entry(name, content);
        expect_computed_again(damage);
    }
}

std::optional<std::string> text_of(Runtime& runtime, const std::string& arguments, LargeArguments large,
                                   const char* function = "f") {
    EXPECT_FALSE(runtime.run_code("call = table.pack(" + arguments + ")", "text.lua").error) << arguments;
    lua_State* L = runtime.state();
    lua_getglobal(L, "call");
    const int packed = lua_gettop(L);
    const int count = static_cast<int>(lua_rawlen(L, packed));
    for (int i = 1; i <= count; ++i) lua_rawgeti(L, packed, i);
    auto text = call_text(L, function, packed + 1, packed + count, large);
    lua_settop(L, packed - 1);
    return text;
}

// Oracle: definition; what is kept of a shape makes later calls of it be looked up, which quick ones are not worth.
TEST_F(memoized_calls, shapes_whose_calls_turn_out_quick_are_forgotten) {
    const Cache cache;
    CallCache calls(cache, CallCache::Duration::max());
    RunOptions options;
    options.call_cache = &calls;
    GnuplotRenderer renderer;
    Runtime runtime(options, renderer);
    ASSERT_FALSE(runtime.run_code(kData, "data.lua").error);
    const auto shape = text_of(runtime, "d[{1, 200}], {1, 2, 0}", LargeArguments::kBySize, "srivc");
    ASSERT_TRUE(shape);
    calls.save_entry(*shape, "another call of this shape", "its result");
    ASSERT_TRUE(calls.knows(*shape));
    ASSERT_FALSE(runtime.run_code("srivc(d[{1, 200}], {1, 2, 0})", "quick.lua").error);
    EXPECT_FALSE(calls.knows(*shape));
}

struct Arguments {
    const char *one, *other;
};
constexpr Arguments kOtherContents[] = {{"d", "iddata(y, d.u, 0.01, {InputName = 'voltage'})"},
                                        {"d", "iddata(d.y, -d.u, 0.01, {InputName = 'voltage'})"},
                                        {"d", "iddata(d.y, d.u, 0.02, {InputName = 'voltage'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'force'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'voltage', OutputName = 'x'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'voltage', InputUnit = 'V'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'voltage', OutputUnit = 'm'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'voltage', InterSample = 'foh'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'voltage', TimeUnit = 'min'})"},
                                        {"d", "iddata(d.y, d.u, 0.01, {InputName = 'voltage', Tstart = 5})"},
                                        {"d", "h"},
                                        {"d.y", "y"},
                                        {"{x = d.y}", "{x = y}"},
                                        {"m", "t"},
                                        {"G0", "2*G0"}};
constexpr Arguments kOtherShapes[] = {{"d", "d[{1, 100}]"},
                                      {"d", "merge(d[{1, 700}], d[{701, 1500}])"},
                                      {"u", "u:range(1, 10)"},
                                      {"u", "matrix{{1, 2}}"},
                                      {"1", "2"},
                                      {"1", "1.0"},
                                      {"1", "'1'"},
                                      {"1", "true"},
                                      {"0.1", "0.1 + 2e-17"},
                                      {"{1, 2}", "{2, 1}"},
                                      {"{{1}, 2}", "{1, {2}}"},
                                      {"'ab', 'c'", "'a', 'bc'"},
                                      {"{runs = 5}", "{runs = 500}"}};

// Oracle: the definition of equal calls, and of equal shapes.
TEST_F(memoized_calls, texts_of_calls_distinguish_contents_and_shapes) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    const std::string more =
        "e = iddata(d.y, d.u, 0.01, {InputName = 'voltage'})\ny = d.y y[7] = y[7] + 1e-12\n"
        "m = matrix{{1, 2}, {3, 4}} t = matrix{{1, 3}, {2, 4}}";
    ASSERT_FALSE(runtime.run_code(kData + more, "data.lua").error);
    const auto text = [&](const std::string& arguments) {
        return text_of(runtime, arguments, LargeArguments::kByContent);
    };
    const auto shape = [&](const std::string& arguments) {
        return text_of(runtime, arguments, LargeArguments::kBySize);
    };
    EXPECT_TRUE(text("d, {1, 2, 0}, {lambda = 3, Tol = 1}"));
    EXPECT_EQ(text("d, {1, 2, 0}, {lambda = 3, Tol = 1}"), text("e, {1, 2, 0}, {Tol = 1, lambda = 3}"));
    EXPECT_EQ(text("{a = {b = u}}"), text("{a = {b = 1*u}}"));
    for (const auto& [one, other] : kOtherContents) {
        EXPECT_NE(text(one), text(other)) << one << " and " << other;
        EXPECT_EQ(shape(one), shape(other)) << one << " and " << other;
    }
    for (const auto& [one, other] : kOtherShapes) {
        EXPECT_NE(text(one), text(other)) << one << " and " << other;
        EXPECT_NE(shape(one), shape(other)) << one << " and " << other;
    }
    for (const char* none : {"print", "{1, {2, print}}", "coroutine.create(print)", "setmetatable({}, {})",
                             "(function() local t = {} t.t = t return t end)()"})
        EXPECT_FALSE(text(none)) << none;
}

// Oracle: definition; a cached digest equals the digest of an equal data set that is created again.
TEST_F(memoized_calls, digests_are_kept_with_the_record) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    lua_State* L = runtime.state();
    ASSERT_FALSE(runtime.run_code(kData, "data.lua").error);
    const auto digest = [&] {
        lua_getglobal(L, "d");
        const Digest result = digest_of_object<IdData>(L, -1);
        lua_pop(L, 1);
        return result;
    };
    const Digest first = digest();
    EXPECT_EQ(digest(), first);
    EXPECT_TRUE(runtime.run_code("d.y = vector{1}", "change.lua").error) << "records can be changed";
    ASSERT_FALSE(runtime.run_code("local y = d.y y[1] = 7", "copy.lua").error);
    lua_getglobal(L, "d");
    EXPECT_EQ(Userdata<IdData>::digest(*to_object<IdData>(L, -1)), first);
    lua_pop(L, 1);
    ASSERT_FALSE(runtime.run_code("local y = d.y y[1] = 7 d = iddata(y, d.u, 0.01)", "copy.lua").error);
    EXPECT_NE(digest(), first);
}

}  // namespace test_memoized_calls
