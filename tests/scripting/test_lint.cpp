// Messages about a script that is not run. Oracles: mistakes written by hand with their place marked by "^" in the line
// below; the lessons, demonstrations and examples of the help pages, which run and so have no mistakes; the lists of
// options in the sources of the bindings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "base/reader.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "scripting/lint/function_forms.h"
#include "scripting/lint/lint.h"
#include "scripting/runtime/help.h"

namespace dynlab::test {
namespace test_lint {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

std::string all_of(const std::vector<LintIssue>& findings) {
    std::string text;
    for (const LintIssue& one : findings)
        text += std::to_string(one.line) + ":" + std::to_string(one.column) + ": " + one.kind + ": " +
                message_text(one.message) + "\n";
    return text;
}

/// A script with a line of "^" below the word that is wrong, which is no part of it.
struct Planted {
    const char *script, *kind, *words;
};

constexpr const char* kAnswered = "-- ---\n-- title: T\n-- answers:\n--   gain: number\n--   G: model\n-- ---\n";

const Planted kPlanted[] = {
    // names
    {"print(zzz)\n      ^", "unknown-name", "'zzz'"},
    {"guess('x', 1)\n^", "earlier-name", "predict_first"},
    {"local x = 1\nprnt(x)\n^", "unknown-name", "did you mean 'print'"},
    {"local y = load(\"crane\")\nlocal G = srvic(y, {1, 2, 0})\n          ^", "unknown-name", "did you mean 'srivc'"},
    {"print(pi)\n      ^", "unknown-name", "math.pi"},
    {"disp(3)\n^", "unknown-name", "print(x)"},
    {"do local inside = 1 end\nprint(inside)\n      ^", "unknown-name", "'inside'"},
    {"for k = 1, 3 do print(k) end\nprint(k)\n      ^", "unknown-name", "'k'"},
    {"local function f(a) return a end\nprint(f(a))\n        ^", "unknown-name", "'a'"},
    {"local n = n + 1\n          ^", "unknown-name", "'n'"},
    {"repeat local done = true until done\nprint(done)\n      ^", "unknown-name", "'done'"},
    {"local t = {mean = men({1, 2})}\n                  ^", "unknown-name", "did you mean 'mean'"},
    {"print(\"é\", zzz)\n           ^", "unknown-name", "'zzz'"},
    {"local f = function() return missing end\n                            ^", "unknown-name", "'missing'"},
    {"if true then local a = 1 else print(a) end\n                                    ^", "unknown-name", "'a'"},
    {"print(math.sqr(4))\n           ^", "unknown-name", "did you mean 'sqrt'"},
    {"report.valeu(\"a\", 3)\n       ^", "unknown-name", "did you mean 'value'"},
    {"print(string.fromat(\"%d\", 3))\n             ^", "unknown-name", "did you mean 'format'"},
    {"print(math.mean({1, 2}))\n           ^", "unknown-name", "write mean(x), without math"},
    {"np.zeros(3)\n^", "unknown-name", "omit the prefix np"},
    {"x = 1\nx.y = yy\n      ^", "unknown-name", "'yy'"},
    // functions that are given another value
    {"mean = 3\n^", "library-name", "local mean"},
    {"local a\na, step = 1, 2\n   ^", "library-name", "local step"},
    {"function tf(x) return x end\n         ^", "library-name", "'tf'"},
    // options
    {"local d = iddata({1, 2}, {1, 2}, 1)\nsrivc(d, {1, 2, 0}, {Lamda = 3})\n                     ^", "unknown-option",
     "did you mean 'lambda'"},
    {"local d = iddata({1, 2}, {1, 2}, 1)\ntfsrivc(d, 2, 0, {TdMim = 3})\n                  ^", "unknown-option",
     "did you mean 'TdMin'"},
    {"local y = lsim(tf({1}, {1, 1}), prbs(4, 3), 0.1, {hld = \"foh\"})\n                                              "
     "    ^",
     "unknown-option", "did you mean 'hold'"},
    {"plot({1, 2}, {3, 4}, {xlabl = \"t\"})\n                      ^", "unknown-option", "did you mean 'xlabel'"},
    {"bode(tf({1}, {1, 1}), {labels = \"a\", confidnce = 1})\n                                     ^", "unknown-option",
     "did you mean 'confidence'"},
    {"histogram({1, 2, 3}, {bin = 3})\n                      ^", "unknown-option", "did you mean 'bins'"},
    {"dynlab.histogram({1, 2, 3}, {number = 3})\n                             ^", "unknown-option", "the options are"},
    {"load(\"crane\", {skipp = 3})\n               ^", "unknown-option", "did you mean 'skip'"},
    {"plant(\"crane\", {sed = 3})\n                ^", "unknown-option", "did you mean 'seed'"},
    {"figure{titel = \"t\", panels = {}}\n       ^", "unknown-option", "did you mean 'title'"},
    {"montecarlo{runns = 3}\n           ^", "unknown-option", "did you mean 'runs'"},
    // text that is no Lua
    {"local x = 3 +\n             ^", "syntax", ""},
    {"for k = 1, 3 do\n^  print(k)", "syntax", "'for' in line 1 has no 'end'"},
    {"x = 3 % gain\n        ^", "unknown-name", "a comment starts with --"},
    {"if x = 3 then end\n     ^", "syntax", "=="},
    {"print(\"open)\n      ^", "syntax", ""},
    {"local A = matrix{1, 2; 3, 4}\n^", "syntax", "each row of a matrix is a table"},
    {"x = 3,5\n^", "syntax", "use a decimal point"},
    {"y = {1, 2\nz = 3\n^", "syntax", "not closed"},
    {"x = 2 end\n      ^", "syntax", ""},
    // the header
    {"-- ---\n-- titel: T\n^-- ---\n", "header", "title"},
    {"-- %% kind=q\n^x = 1", "header", ""},
};

TEST(lint, finds_what_was_planted_with_line_and_column) {
    EXPECT_GE(std::size(kPlanted), 40u);
    for (const Planted& planted : kPlanted) {
        std::string source;
        int line = 0, column = 0, marked_line = 0;
        for (const std::string& text : lines_of(planted.script)) {
            const std::size_t mark = text.find('^');
            if (mark != std::string::npos) {
                column = static_cast<int>(mark) + 1;
                marked_line = line;
                const std::string rest = text.substr(mark + 1);
                if (rest.empty()) continue;
                source += rest + "\n";
                ++line;
                continue;
            }
            source += text + "\n";
            ++line;
        }
        const std::vector<LintIssue> found = lint_script(source, "a.lua");
        ASSERT_EQ(found.size(), 1u) << source << all_of(found);
        EXPECT_EQ(found[0].line, marked_line) << source << all_of(found);
        EXPECT_EQ(found[0].column, column) << source << all_of(found);
        EXPECT_EQ(found[0].kind, planted.kind) << source << all_of(found);
        EXPECT_THAT(message_text(found[0].message), HasSubstr(planted.words)) << source;
    }
}

TEST(lint, compares_answers_with_the_header) {
    const std::string header = kAnswered;
    const auto reported = [&](const std::string& code) { return all_of(lint_script(header + code, "a.lua")); };
    EXPECT_EQ(reported("answer(\"gain\", 1)\nanswer('G', tf({1}, {1, 1}))\n"), "");
    EXPECT_THAT(reported("answer(\"gain\", 1)\n"),
                HasSubstr("5:6: unused-answer: the script never submits the answer \"G\""));
    EXPECT_THAT(reported("answer(\"gian\", 1)\nanswer(\"G\", tf({1}, {1, 1}))\n"),
                testing::AllOf(HasSubstr("7:8: unknown-answer"), HasSubstr("did you mean \"gain\"?"),
                               HasSubstr("4:6: unused-answer")));
    EXPECT_EQ(reported("for _, name in ipairs{\"gain\", \"G\"} do answer(name, 1) end\n"), "") << "only a run knows";
}

TEST(lint, finds_each_of_many_answers_of_a_header) {
    constexpr int kAnswers = 20000;
    std::string source = "-- ---\n-- answers:\n";
    for (int i = 0; i < kAnswers; ++i) source += "--   a" + std::to_string(i) + ": number\n";
    const std::vector<LintIssue> found = lint_script(source + "-- ---\nx = 1\n", "a.lua");
    ASSERT_EQ(found.size(), static_cast<std::size_t>(kAnswers));
    EXPECT_EQ(found.back().line, kAnswers + 2);
    EXPECT_EQ(found.back().column, 6);
    EXPECT_THAT(message_text(found.back().message), HasSubstr("\"a19999\""));
}

TEST(lint, takes_nothing_amiss_that_is_right) {
    for (const char* script :
         {"", "x = 1\nprint(x)", "function later() return made_later end\nmade_later = 3\nprint(later())", "2 + 3\n-4",
          "local mean = 3\nprint(mean)", "goto out\n::out::\nprint(1)", "local t <const> = {a = {b = 1}}\nprint(t.a.b)",
          "local o = {}\nfunction o:m(k) return self, k end\nfunction o.n(...) return ... end", "print(#{...})",
          "local srivc = function(d, o, p) return p end\nsrivc(1, 2, {anything = 3})", "print[[\nlong]]",
          "local d = iddata({1, 2}, {1, 2}, 1)\nlocal G = srivc(d, {1, 2, 0}, {Lambda = 3, maxIter = 2})",
          "save_mat(\"a.mat\", {anything = 1})", "x = {1, 2; 3}\nfor i, v in ipairs(x) do print(i, v) end",
          "while true do local a = 1 if a then break end end",
          "local a, b = (function(...) return ... end)(1, 2)\nprint(a, b)"})
        EXPECT_EQ(all_of(lint_script(script, "a.lua")), "") << script;
}

TEST(lint, has_nothing_to_say_of_lessons_demonstrations_and_examples) {
    int scripts = 0;
    for (const auto& entry : fs::recursive_directory_iterator(DYNLAB_SOURCE_DIR "/lessons")) {
        const std::string name = entry.path().filename().string();
        const bool other_language = name == "checks.lua" || name == "moved_answers.lua";
        if (entry.path().extension() != ".lua" || other_language || name.starts_with("tasks.")) continue;
        ++scripts;
        EXPECT_EQ(all_of(lint_script(read_text(entry.path()), entry.path())), "") << entry.path();
    }
    EXPECT_GE(scripts, 40);
    for (const HelpPage& page : help_pages()) {
        if (page.name == "checks" || page.name == "review_marks") continue;
        const std::regex block("```lua\n([^]*?)\n```");
        const std::string text(page.text);
        for (std::sregex_iterator found(text.begin(), text.end(), block), end; found != end; ++found)
            EXPECT_EQ(all_of(lint_script((*found)[1], "example.lua")), "") << page.name;
    }
}

TEST(lint, reads_hostile_text_in_no_time) {
    for (const std::string& text : {std::string(100000, '('), std::string(2000, '{'),
                                    "x = " + std::string(300, '(') + "1" + std::string(300, ')'),
                                    std::string("\0\xff\xfe", 3), std::string("local x <"), std::string("-- ---\n")})
        EXPECT_THAT(lint_script(text, "a.lua"), testing::Not(IsEmpty()));
    std::string many;
    for (int i = 0; i < 3000; ++i) many += "local v" + std::to_string(i % 150) + " = zeros(3)\n";
    EXPECT_THAT(lint_script("do " + many + " end", "a.lua"), testing::SizeIs(testing::Le(1)));
}

}  // namespace test_lint
}  // namespace dynlab::test
