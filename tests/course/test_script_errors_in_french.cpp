// What a script that stops says, in a document and in findings in French. Oracles: no English word is left outside of
// quotation marks; sentences written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "documents/weave.h"
#include "scripting/script_run.h"
#include "told_in_french.h"

namespace dynlab::test {
namespace test_script_errors_in_french {

using testing::HasSubstr;

TEST(script_errors_in_french, leave_no_english_word) {
    const char* scripts[] = {"local x\nx()",
                             "local t = {}\nt.a()",
                             "local v = vector{1}\nv(1)",
                             "local A = matrix{{1}}\nA(1, 1)",
                             "local x\nlocal y = x.a",
                             "local x = 2\nlocal y = x[1]",
                             "local x = {}\nlocal y = x + 1",
                             "local x = true\nlocal y = x & 1",
                             "local x\nlocal y = 'a' .. x",
                             "local x = 1\nlocal y = #x",
                             "local y = 'a' + 1",
                             "local y = {} < 3",
                             "local y = {} < {}",
                             "local y = pole(tf({1}, {1, 0, 1}))[1] < 1",
                             "for i = 1, 'x' do end",
                             "for i = 1, 2, 0 do end",
                             "local t = {}\nlocal k\nt[k] = 1",
                             "local t = {}\nt[0/0] = 1",
                             "local y = 1//0",
                             "local y = 1%0",
                             "local function f() return f() + 1 end\nf()",
                             "string.format('%d', 3.5)",
                             "math.sqrt(vector{1})",
                             "string.rep()",
                             "print(yy)",
                             "prnt(1)",
                             "damp('x')",
                             "step(tf({1}, {1, 1}), 'a')",
                             "range(1.5, 2, 3, 4)",
                             "plot({1}, {titel = 'x'})",
                             "plot({1}, {style = 'lines'})",
                             "zeros(2.5)",
                             "zeros(-1)",
                             "zeros()",
                             "local v = vector{1}\nv.xx = 1",
                             "math.foo(1)",
                             "print(iddata({1, 2}, {3, 4}, 1).yy)",
                             "for k = 1, 2 do\n",
                             "local f = (1 + 2\nlocal b = 1",
                             "local x = 'abc",
                             "local x <const> = 1\nx = 2",
                             "break",
                             "local x =",
                             "end",
                             "local = 3",
                             "x y z",
                             "if 1 == 1\nprint(1) end",
                             "while true\nprint(1) end",
                             "local a = 1\n% my comment\nprint(a)",
                             "local v = [1 2 3]",
                             "local a = 1 != 2"};
    for (const char* script : scripts) {
        const std::string message = error_of(script);
        EXPECT_NE(message, "(no error)") << script;
        expect_told_in_french(message);
        expect_told_in_french("From a clean copy of the folder no report comes out: " + message);
    }
}

TEST(script_errors_in_french, keep_file_line_and_function) {
    EXPECT_EQ(in_french("analysis.lua:7: fit: argument 1 (data) must be an iddata, but 0.5 was given"),
              "analysis.lua:7: fit: l'argument 1 (data) doit être un objet iddata, mais 0,5 a été donné");
    EXPECT_EQ(in_french("analysis.lua:7: something of the author's own: 0.5"),
              "analysis.lua:7: something of the author's own: 0.5");
}

TEST(script_errors_in_french, words_for_kinds_are_french_and_names_stay) {
    EXPECT_EQ(in_french("The answer \"model\" (model) is not given."),
              "La réponse « model » (modèle) n'est pas donnée.");
    EXPECT_EQ(in_french("a model that is not known here."), "a model that is not known here.");
}

TEST(script_errors_in_french, stand_in_the_text_of_a_french_document) {
    RunRecord record;
    record.error = RecordedError{"lesson.lua:5: there is no function or variable 'y'", 5};
    const auto woven = [&](const std::string& language) {
        return weave_cells(parse_percent_script("-- ---\n-- language: " + language + "\n-- ---\n-- %% id=a\nprint(y)\n",
                                                "lesson.lua"),
                           record)
            .text;
    };
    EXPECT_THAT(woven("fr"),
                HasSubstr("lesson.lua:5: il n'y a ni fonction ni variable « y »\nLe script s'est arrêté ici"));
    EXPECT_THAT(woven("en"), HasSubstr("lesson.lua:5: there is no function or variable 'y'\nThe script stopped here"));
}

}  // namespace test_script_errors_in_french
}  // namespace dynlab::test
