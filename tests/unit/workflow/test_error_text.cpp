// A script's error as a terminal shows it: place, line, and the calls that led there. Oracle: the lines of the scripts.
#include "workflow/error_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "workflow_run.h"

namespace dynlab::test {
namespace test_error_text {
using testing::HasSubstr;
using testing::Not;

/// The text of the error at which the script stops; paths are relative to the folder.
std::string shown(const WorkFolder& work, const std::string& code, const std::string& name = "a.lua") {
    std::string text;
    try {
        const PercentScript script = parse_percent_script(code, work.path(name));
        const RunRecord record = work.run(script).record;
        text = record.error ? error_text(*record.error, script) : "(no error)";
    } catch (const std::exception& error) {
        text = error.what();
    }
    const std::string folder = work.path().string();
    for (auto at = text.find(folder); at != text.npos; at = text.find(folder)) text.erase(at, folder.size());
    return text;
}

TEST(error_text, of_a_syntax_error_shows_the_line) {
    EXPECT_THAT(shown(WorkFolder(), "local x = 1\n  local y = = 2\n"),
                testing::MatchesRegex("a.lua:2: [^\n]*\n    local y = = 2"));
}

// oracle: Lua's limit of 200
TEST(error_text, of_more_locals_than_lua_can_have_names_the_limit) {
    std::string code;
    for (int i = 1; i <= 205; ++i) code += "local a" + std::to_string(i) + " = 0\n";
    EXPECT_THAT(shown(WorkFolder(), code),
                HasSubstr("a.lua:201: a function can have at most 200 local variables; declare further variables "
                          "without 'local', or put them in a table\n"));
}

TEST(error_text, of_the_main_chunk_shows_its_line_alone) {
    EXPECT_EQ(shown(WorkFolder(), "\nlocal v = zeros('x') -- here\n"),
              "a.lua:2: zeros: argument 1 (n) must be a number, but the string \"x\" was given\n"
              "    local v = zeros('x') -- here");
}

TEST(error_text, inside_functions_shows_the_callers_with_their_arguments) {
    EXPECT_EQ(shown(WorkFolder(),
                    "local function half(x, name)\n"
                    "  return zeros(x)\n"
                    "end\n"
                    "function twice(t, ...)\n"
                    "  local y = half('two', t[1])\n"
                    "  return y\n"
                    "end\n"
                    "for k = 1, 3 do\n"
                    "  print(twice({k, label = 'run'}))\n"
                    "end\n"),
              "a.lua:2: zeros: argument 1 (n) must be a number, but the string \"two\" was given\n"
              "    return zeros(x)\n"
              "  a.lua:5: called half(x = \"two\", name = 1)\n"
              "    local y = half('two', t[1])\n"
              "  a.lua:9: called twice(t = {1, label = \"run\"}, ...)\n"
              "    print(twice({k, label = 'run'}))");
}

TEST(error_text, cuts_long_arguments_and_long_chains_of_calls) {
    const std::string text = shown(WorkFolder(),
                                   "local s = string.rep('\u00e9', 500)\n"
                                   "local function deep(n, s)\n"
                                   "  if n == 0 then error('deep down') end\n"
                                   "  deep(n - 1, s)\n"
                                   "  return n\n"
                                   "end\n"
                                   "deep(1000, s)\n");
    EXPECT_THAT(text, testing::StartsWith("a.lua:3: deep down\n"));
    EXPECT_THAT(text, HasSubstr("  a.lua:4: called deep(n = 0, s = \"\u00e9\u00e9"));
    EXPECT_THAT(text, HasSubstr("  a.lua:7: started a longer chain of calls\n    deep(1000, s)"));
    EXPECT_LT(text.size(), 2000u);
    EXPECT_THAT(shown(WorkFolder(), "local function f() return 1 + f() end\nf()\n", "b.lua"),
                HasSubstr("b.lua:1: infinite recursion"));
}

TEST(error_text, names_a_required_file_with_its_folder_and_line) {
    const WorkFolder work;
    work.write("lib/tools.lua", "local t = {}\nfunction t.gain(G)\n  return G.gian.x\nend\nreturn t\n");
    EXPECT_EQ(shown(work, "local t = require('lib.tools')\nt.gain({})\n"),
              "lib/tools.lua:3: the field 'gian' is nil (it has no value), so it has no fields or elements\n"
              "    return G.gian.x\n"
              "  a.lua:2: called gain(G = {})\n"
              "    t.gain({})");
    work.write("wrong.lua", "error('at once')\n");
    EXPECT_EQ(shown(work, "\nrequire('wrong')\n"),
              "wrong.lua:1: at once\n    error('at once')\n  a.lua:2: ran wrong.lua\n    require('wrong')");
}

// What a script says of a place is no reason to read it.
TEST(error_text, shows_no_line_of_a_file_elsewhere) {
    const WorkFolder work;
    work.write("secret.lua", "secret words\n");
    work.write("A/b.lua", "a line of a neighbor\n");
    EXPECT_THAT(shown(work, "error('b.lua:1: x', 0)\n", "A/a.lua"), HasSubstr("\n    a line of a neighbor"));
    for (const char* place : {"../secret.lua:1: x", "/etc/passwd:1: x", "secret.txt:1: x"})
        EXPECT_THAT(shown(work, std::string("error('") + place + "', 0)\n", "A/a.lua"), Not(HasSubstr("\n    ")));
}

}  // namespace test_error_text
}  // namespace dynlab::test
