// Completion at the prompt. Oracles: the names the session itself defined, the catalog of functions, and a counter
// that shows whether a script's function was called.
#include "scripting/interpreter/catalog.h"
#include "scripting/prompt/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/prompt/prompt_session.h"

namespace dynlab::test {
namespace test_completion {
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Session {
  public:
    explicit Session(const std::vector<std::string>& statements = {}) {
        for (const std::string& typed : statements) run(typed);
    }
    std::string run(const std::string& typed) {
        printed_.clear();
        EXPECT_FALSE(prompt_.run(read_statement(typed, shown_calls()), "prompt").error) << typed;
        return printed_;
    }
    std::vector<std::string> names(const std::string& text) { return prompt_.complete_end(text).candidates; }
    std::string rest(const std::string& text) { return prompt_.complete_end(text).common_rest(); }
    Completion all(const std::string& text) { return prompt_.complete_end(text); }

  private:
    std::string printed_;
    PromptSession prompt_{"dynlab_out", [this](const std::string& text) { printed_ += text; }};
};

TEST(completion, offers_the_fields_that_the_object_has) {
    Session session({"G = tf({1}, {1, 2})", "P = idproc('P1D', {Kp = 2, Tp1 = 3, Td = 1})"});
    EXPECT_THAT(session.names("G."), AllOf(Contains("den"), Contains("Ts")));
    EXPECT_THAT(session.names("G."), Not(Contains("Tp1")));
    EXPECT_THAT(session.names("G."), Not(Contains("covariance")));
    EXPECT_THAT(session.names("P."), AllOf(Contains("Kp"), Contains("Td"), Not(Contains("Tp2"))));
}

TEST(completion, offers_variables_functions_and_words_of_lua) {
    Session session({"speed_of_motor = 1", "local speed_limit = 2"});
    EXPECT_THAT(session.names("x = speed_"), ElementsAre("speed_limit", "speed_of_motor"));
    EXPECT_THAT(session.names("procs"), Contains("procsrivc"));
    EXPECT_EQ(session.rest("procsr"), "ivc");
    EXPECT_EQ(session.rest("whi"), "le");
    EXPECT_THAT(session.names("no_such_name_at_a"), IsEmpty());
    EXPECT_THAT(session.names("function f(gain_of_loop)\n  return gain_"), ElementsAre("gain_of_loop"));
    EXPECT_THAT(session.names(""), IsEmpty());
    EXPECT_THAT(session.names("x = 'speed_"), IsEmpty()) << "not inside a text";
}

TEST(completion, offers_members_of_the_value_before_dot_and_colon) {
    Session session({"local data = iddata({1, 2, 3}, {1, 2, 3}, 0.1)", "G = tf(1, {1, 1})",
                     "nested = {inner = {first = data, second = 2}}"});
    EXPECT_THAT(session.names("G."), Contains("num"));
    EXPECT_THAT(session.names("data:det"), ElementsAre("detrend"));
    EXPECT_THAT(session.names("data."), Contains("Ts"));
    EXPECT_THAT(session.names("data."), Not(Contains("detrend"))) << "methods follow a colon";
    EXPECT_THAT(session.names("nested.inner."), ElementsAre("first", "second"));
    EXPECT_THAT(session.names("nested.inner.first:remo"), ElementsAre("remove_mean"));
    EXPECT_THAT(session.names("data.y:ran"), ElementsAre("range")) << "fields of objects are values, too";
    EXPECT_THAT(session.names("math.hu"), ElementsAre("huge"));
    EXPECT_THAT(session.names("report.va"), ElementsAre("value"));
    EXPECT_THAT(session.names("name = 'a' name:up"), IsEmpty()) << "it is no value yet";
    session.run("name = 'a'");
    EXPECT_THAT(session.names("name:upp"), ElementsAre("upper"));
    EXPECT_THAT(session.names("nowhere."), IsEmpty());
    EXPECT_THAT(session.names("G.num.nowhere.x"), IsEmpty());
    EXPECT_THAT(session.names("f()."), IsEmpty()) << "calls are not made";
}

TEST(completion, calls_nothing_of_the_script) {
    Session session({"calls = 0", "local function count() calls = calls + 1 return {} end",
                     "spy = setmetatable({own = 1}, {__index = count, __pairs = count, __call = count, __len = count})",
                     "heir = setmetatable({}, {__index = {inherited = 1}})"});
    EXPECT_THAT(session.names("spy."), ElementsAre("own"));
    EXPECT_THAT(session.names("spy.other."), IsEmpty());
    EXPECT_THAT(session.names("heir."), ElementsAre("inherited"));
    EXPECT_EQ(session.run("calls"), "0\n");
}

TEST(completion, ends_with_endless_chains) {
    Session session({"a = {own = 1}", "setmetatable(a, {__index = a})"});
    EXPECT_THAT(session.names("a."), ElementsAre("own"));
    EXPECT_THAT(session.names("a.none.x"), IsEmpty());
}

TEST(completion, offers_data_sets_help_pages_and_options) {
    Session session;
    EXPECT_EQ(session.rest("d = load(\"heat_e"), "xchanger\"");
    EXPECT_EQ(session.rest("d = load 'heat_e"), "xchanger'");
    EXPECT_THAT(session.names("help('mat"), Contains("matlab"));
    EXPECT_THAT(session.names("lsim(G, u, 0.1, {h"), ElementsAre("hold = "));
    EXPECT_THAT(session.names("lsim(G, u, 0.1, {hold = 'foh', "), ElementsAre("hold = ", "x0 = "));
    EXPECT_THAT(session.all("lsim(G, ").note, HasSubstr("lsim(G, u"));
    EXPECT_THAT(session.names("print('heat"), IsEmpty());
}

TEST(completion, takes_any_text) {
    Session session({"local t = {}"});
    std::string bytes;
    for (int i = 0; i < 2000; ++i) {
        bytes += static_cast<char>((i * 7919) % 256);
        session.names(bytes);
    }
    for (const char* text : {".", ":", "..", "t.:", "(", "{", "load(\"", "[[", "--[[", "1.", "a.1", "\xff\xfe", "}})"})
        session.names(text);
    EXPECT_THAT(session.names("local x = t"), Contains("t"));
}

}  // namespace test_completion
}  // namespace dynlab::test
