// What is typed at the prompt. Oracles: Lua's grammar (reference manual 5.4, chapter 9), and for the rewritten locals
// the definition: every statement gives what one script of all of them would give.
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/prompt_statement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/prompt/prompt_session.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::test {
namespace test_prompt_statement {
using Kind = PromptStatement::Kind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> token_texts(std::string_view text) {
    std::vector<std::string> texts;
    for (const LuaToken& token : lua_tokens(text)) texts.emplace_back(token.text);
    return texts;
}

/// The output and the errors of the statements, run in sequence in one session.
std::string session(const std::vector<std::string>& statements) {
    std::string text;
    PromptSession prompt("dynlab_out", [&text](const std::string& printed) { text += printed; });
    for (const std::string& typed : statements) {
        const StatementResult result = prompt.run(read_statement(typed, shown_calls()), "prompt");
        if (result.error) text += "ERROR " + result.error->text() + '\n';
    }
    return text;
}

TEST(prompt_statement, tokens_follow_the_grammar) {
    EXPECT_THAT(token_texts("a.b:c(1e-5,.5,0x1F)..'x\\'y' -- rest"),
                ElementsAre("a", ".", "b", ":", "c", "(", "1e-5", ",", ".5", ",", "0x1F", ")", "..", "'x\\'y'"));
    EXPECT_THAT(token_texts("x=[==[ ]] ]==]--[[ two\nlines ]]y~=z"),
                ElementsAre("x", "=", "[==[ ]] ]==]", "y", "~=", "z"));
    EXPECT_THAT(token_texts("1..2"), ElementsAre("1", "..", "2"));
    for (const char* open : {"'abc", "[[abc", "--[[ abc", "\"abc\\"}) {
        const auto tokens = lua_tokens(open);
        ASSERT_EQ(tokens.size(), 1u) << open;
        EXPECT_EQ(tokens[0].kind, LuaToken::Kind::kUnfinished) << open;
    }
}

TEST(prompt_statement, takes_any_bytes_apart_without_loss) {
    std::string bytes;
    for (int i = 0; i < 4096; ++i) bytes += static_cast<char>((i * 7919) % 256);
    std::size_t end = 0;
    for (const LuaToken& token : lua_tokens(bytes)) {
        EXPECT_GE(token.begin, end);
        EXPECT_FALSE(token.text.empty());
        end = token.end();
    }
    EXPECT_LE(end, bytes.size());
    EXPECT_NE(read_statement(bytes, shown_calls()).kind, Kind::kLeave);
}

TEST(prompt_statement, knows_what_must_go_on) {
    for (const char* open : {"function f(a)", "for k = 1, 3 do", "if a then", "x = (1", "x = {1,", "x = [[a", "2*(3",
                             "repeat", "f(function()", "--[[ a", "x =", "local t = {\n  a = 1,"})
        EXPECT_EQ(read_statement(open, shown_calls()).kind, Kind::kIncomplete) << open;
    for (const char* ready :
         {"x = 1", "1 + 1", "f()", "function f() end", "a.b", "x = 'open", "A'", "x = [1 2]", "end", ")"})
        EXPECT_EQ(read_statement(ready, shown_calls()).kind, Kind::kReady) << ready;
    for (const char* empty : {"", "  \t", "-- a comment", "--[[ a\n b ]]"})
        EXPECT_EQ(read_statement(empty, shown_calls()).kind, Kind::kEmpty) << empty;
}

TEST(prompt_statement, understands_habits) {
    for (const char* leave : {"quit", "exit", "quit()", " exit; "})
        EXPECT_EQ(read_statement(leave, shown_calls()).kind, Kind::kLeave) << leave;
    for (const char* other : {"quit = 1", "exit.a", "print(quit)"})
        EXPECT_NE(read_statement(other, shown_calls()).kind, Kind::kLeave) << other;
    EXPECT_EQ(session({"= 2*3", "2*3", "2*3;", "1, 2"}), "6\n6\n1\t2\n");
    EXPECT_EQ(session({"help tf"}), session({"help('tf')"}));
    EXPECT_EQ(session({"help"}), session({"help()"}));
    EXPECT_THAT(session({"help report.value"}), HasSubstr("report.value"));
    EXPECT_THAT(session({"hold on"}), HasSubstr("plot all curves in one call"));
    EXPECT_THAT(session({"x = [1 2 3]"}), HasSubstr("vector{1, 2, 3}"));
}

TEST(prompt_statement, locals_of_one_statement_are_seen_by_the_next) {
    EXPECT_EQ(session({"local a, b = 1, 2", "local c", "c == nil", "a + b"}), "true\n3\n");
    EXPECT_EQ(session({"local n <const> = 4", "n"}), "4\n");
    EXPECT_EQ(session({"local x = 1 local x = x + 1", "x"}), "2\n");
    EXPECT_EQ(session({"local function f(n) return n == 0 and 1 or n*f(n - 1) end", "f(5)"}), "120\n");
    EXPECT_EQ(session({"local n = 0; function up() n = n + 1 return n end", "up()", "up()", "n"}), "1\n2\n2\n");
    EXPECT_EQ(session({"local c = 3 (print)(c)"}), "3\n");
}

TEST(prompt_statement, inner_locals_stay_inside) {
    EXPECT_THAT(session({"do local inner = 1 end", "inner"}), HasSubstr("unknown function or variable 'inner'"));
    EXPECT_THAT(session({"function f() local inner = 1 end f()", "inner"}), HasSubstr("'inner'"));
    EXPECT_THAT(session({"repeat local inner = 1 until inner == 1", "inner"}), HasSubstr("'inner'"));
    EXPECT_EQ(session({"if true then local k = 1 end local k = 2", "k"}), "2\n");
}

TEST(prompt_statement, a_local_may_have_the_name_of_a_function) {
    EXPECT_EQ(session({"local sum = sum({1, 2})", "sum", "local sum = sum + 1", "sum"}), "3\n4\n");
    EXPECT_THAT(session({"sum = 3"}), HasSubstr("cannot be replaced"));
    EXPECT_EQ(session({"local sum = error('no')", "sum({1, 2})"}), "ERROR prompt:1: no\n3\n")
        << "a declaration that failed hides nothing";
}

TEST(prompt_statement, a_script_that_is_run_leaves_its_variables) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "analysis.lua") << "local k = 3\nlocal d = load('d.csv')\ngain = 2*k\nk\n";
    std::ofstream(folder.path() / "d.csv") << "t,y\n0,1\n1,5\n";
    std::ofstream(folder.path() / "wrong.lua") << "local ok = 1\nlocal = 2\n";
    const std::string path = folder.path().string();
    EXPECT_EQ(session({"run('" + path + "/analysis.lua')", "k + 1, gain, d.y"}), "3\n4\t6\t[1 5]\n");
    EXPECT_EQ(session({"run('" + path + "')", "k"}), "3\n3\n");
    EXPECT_EQ(session({"local k = 1", "g = 'text'", "who"}), "g  text\nk  1\n");
    EXPECT_EQ(session({"G = tf({1}, {1, 1, 1})", "who"}), "G  1/(s^2 + s + 1)\n");
    EXPECT_EQ(session({"G = tf({2, 1}, {1, 0.5}, {IODelay = 2})", "who"}), "G  exp(-2 s) (2 s + 1)/(s + 0.5)\n");
    EXPECT_EQ(session({"G = tf({1}, {1, 0.5}, 0.1)", "who"}), "G  1/(z + 0.5), Ts = 0.1 s\n");
    EXPECT_THAT(session({"run('" + path + "/wrong.lua')"}), HasSubstr("wrong.lua:2: "));
    EXPECT_THAT(session({"run('absent.lua')"}), HasSubstr("script not found: absent.lua"));
    EXPECT_THAT(error_of("run('x.lua')"), HasSubstr("in a script, write require(name)"));
}

TEST(prompt_statement, globals_random_numbers_and_errors_live_on) {
    EXPECT_EQ(session({"g = 5", "g", "_G.g"}), "5\n5\n");
    EXPECT_EQ(session({"a = randn(1)[1]", "b = randn(1)[1]", "a ~= b", "rng(1) c = randn(1)[1]", "a == c"}),
              "true\ntrue\n");
    EXPECT_EQ(session({"x = 1 error('no')", "x"}), "ERROR prompt:1: no\n1\n");
    EXPECT_THAT(session({"local speed = 1", "sped"}), HasSubstr("did you mean 'speed'?"));
}

TEST(prompt_statement, an_error_while_a_value_is_shown_is_an_error_of_the_statement) {
    EXPECT_EQ(session({"setmetatable({}, {__tostring = function() error('shy', 0) end})"}), "ERROR prompt:1: shy\n");
}

}  // namespace test_prompt_statement
}  // namespace dynlab::test
