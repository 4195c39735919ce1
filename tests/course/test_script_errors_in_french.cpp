// What a script that stops says, in a document and in findings in French. Oracles: no English word is left outside of
// quotation marks; sentences written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "documents/text_lines.h"
#include "documents/weave.h"
#include "platform/atomic_file.h"
#include "scripting/conversions/option_words.h"
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

TEST(script_errors_in_french, of_orders_and_arguments_leave_no_english_word) {
    const std::string record = "local u = randn(50)\nlocal d = iddata(u, u, 1)\n";
    for (const char* call :
         {"srivc(d, {2, 0, 0})", "srivc(d, {0, 1, 0})", "srivc(d, {2, 1.5, 0})", "srivc(d, {2, 'a', 0})",
          "srivc(d, {2, {}, 0})", "srivc(d, {2, {true}, 0})", "srivc(d, {2, 1})", "srivc(d, {2, 1, 0, 0, 0})",
          "srivc(d, 'P1')", "srivc(d)", "bj(d, {2, 1})", "armax(d, {2, 1})", "det(matrix{{1, 2}})", "rng(-1)",
          "detrend(d, 'nosuch')"}) {
        const std::string message = error_of(record + call);
        EXPECT_NE(message, "(no error)") << call;
        expect_told_in_french(message);
    }
    EXPECT_EQ(
        in_french("analysis.lua:7: lssvf: argument 2 (orders) must be {na, nb, nk} (na: poles; nb: coefficients of "
                  "B; nk: samples of delay), but nb is 0, and with na = 2 must lie between 1 and 3"),
        "analysis.lua:7: lssvf: l'argument 2 (ordres) doit être {na, nb, nk} (na\u00A0: pôles\u00A0; nb\u00A0: "
        "coefficients de B\u00A0; nk\u00A0: échantillons de retard), mais nb vaut 0 et, avec na = 2, doit être "
        "entre 1 et 3");
}

struct Refusal {
    std::string sentence;  ///< with a number in each place for a value
    bool of_values = false;
};

/// What is written behind a text within brackets, from `at` to where they close, at each of its commas.
std::vector<std::string> arguments_at(const std::string& text, std::size_t at) {
    std::vector<std::string> arguments(1);
    bool quoted = false;
    for (int depth = 0; at < text.size() && depth >= 0; ++at) {
        if (text[at] == '"' && text[at - 1] != '\\') quoted = !quoted;
        if (!quoted) depth += (text[at] == '(' || text[at] == '{') - (text[at] == ')' || text[at] == '}');
        if (!quoted && depth == 0 && text[at] == ',')
            arguments.emplace_back();
        else
            arguments.back() += text[at];
    }
    return arguments;
}

/// A number for a value, with its noun where the source counts something: counted(n, "value").
std::string example_of(const std::string& argument) {
    static const std::regex count(R"re(^\s*counted\([^"]*"([a-z ]+)"(?:, "([a-z ]+)")?\)+\s*$)re");
    std::smatch found;
    if (!std::regex_match(argument, found, count)) return "7";
    return "7 " + (found[2].matched ? found[2].str() : found[1].str() + "s");
}

/// The sentence of fmt::format with examples of its values.
std::string with_examples(const std::string& format, const std::vector<std::string>& arguments) {
    static const std::regex value(R"(\{[^{}]*\})");
    std::string sentence = replaced(replaced(format, "{{", "\x01"), "}}", "\x02"), filled;
    std::size_t place = 0;
    for (std::smatch found; std::regex_search(sentence, found, value); sentence = found.suffix().str(), ++place)
        filled += found.prefix().str() + (place < arguments.size() ? example_of(arguments[place]) : "7");
    return replaced(replaced(filled + sentence, "\x01", "{"), "\x02", "}");
}

/// What InvalidArgument is given in a source, as a script reads it behind the function that says it.
std::vector<Refusal> refusals_in(const std::filesystem::path& source) {
    std::string text = std::regex_replace(read_text(source), std::regex("(^|[^:\"])//[^\n]*"), "$1");
    text = std::regex_replace(text, std::regex("\"\\s*\n\\s*\""), "");
    static const std::regex refusal(R"re(InvalidArgument\(\s*(fmt::format\(\s*)?"((?:[^"\\]|\\.)*)"\s*[,)])re"),
        own_name("^(?!roots)[a-z0-9]+: "), in_capitals("^(All|At|Each|Irregular|The|With) ");
    std::vector<Refusal> refusals;
    for (std::sregex_iterator found(text.begin(), text.end(), refusal), end; found != end; ++found) {
        std::string sentence = replaced(replaced((*found)[2].str(), "\\\"", "\""), "\\\\", "\\");
        const bool formatted = (*found)[1].matched;
        if (formatted)
            sentence = with_examples(sentence,
                                     arguments_at(text, static_cast<std::size_t>(found->position() + found->length())));
        sentence = std::regex_replace(in_lua_words(sentence), own_name, "");
        if (std::regex_search(sentence, in_capitals)) sentence[0] += 'a' - 'A';
        refusals.push_back({"analysis.lua:1: f: " + sentence, formatted});
    }
    return refusals;
}

std::vector<Refusal> all_refusals() {
    std::vector<Refusal> all;
    for (const char* layer : {"engine/figures", "engine/numerics", "engine/scripting"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(DYNLAB_SOURCE_DIR) / layer)) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
            const std::vector<Refusal> refusals = refusals_in(entry.path());
            all.insert(all.end(), refusals.begin(), refusals.end());
        }
    return all;
}

/// A sentence whose frame has an entry and whose pieces have none would be half in each language.
TEST(script_errors_in_french, are_told_whole_or_not_at_all) {
    int told = 0;
    for (const Refusal& refusal : all_refusals()) {
        if (in_french(refusal.sentence) == refusal.sentence) continue;
        ++told;
        expect_told_in_french(refusal.sentence);
    }
    EXPECT_GT(told, 380);
}

/// Where a place stands for words, a number finds no entry though the words would; no more sentences may join these.
constexpr int kOfWords = 31;

/// What no script brings about.
const char* const kStayEnglish[] = {"a rig's part must be carried by one before it",
                                    "a piece of a rig must have as many x as y and parts",
                                    "a piece of a rig belongs to a part that is not there",
                                    "irregular sampling wants companion matrices",
                                    "irregular sampling wants inputs that drive the first state alone",
                                    "its parameters, their names, standard errors and covariance differ in number",
                                    "its channels do not make whole outputs"};

TEST(script_errors_in_french, are_told_for_all_that_scripts_are_refused) {
    int of_words = 0;
    std::vector<std::string> missing;
    for (const Refusal& refusal : all_refusals()) {
        if (in_french(refusal.sentence) != refusal.sentence) continue;
        const bool stays =
            std::ranges::any_of(kStayEnglish, [&](const char* english) { return refusal.sentence.ends_with(english); });
        if (refusal.of_values)
            ++of_words;
        else if (!stays)
            missing.push_back(refusal.sentence);
    }
    EXPECT_THAT(missing, testing::IsEmpty()) << "these want an entry in report_templates/script_errors.fr.txt";
    EXPECT_LE(of_words, kOfWords);
}

TEST(script_errors_in_french, of_calls_leave_no_english_word) {
    const std::string record = "local u = prbs(6, 2)\nlocal d = iddata(u, u, 1)\n";
    for (const char* call : {"local y = vector{1, 2} + vector{1}",
                             "local y = matrix{{1, 2}} * matrix{{1, 2}}",
                             "solve(matrix{{1}, {1, 2}}, 1)",
                             "sum{1, 'a'}",
                             "local y = u[0]",
                             "local y = u[1.5]",
                             "u[200] = 1",
                             "local y = u < u",
                             "local y = d[1]",
                             "local n = u.length",
                             "print(d.Fs)",
                             "d.y2 = 1",
                             "local t = 'a' .. d",
                             "sqrt(-2)",
                             "inv(matrix{{1, 1}, {1, 1}})",
                             "report.value('a b', 1)",
                             "slider('k', {from = 2, to = 1})",
                             "load('nosuch')",
                             "save_csv('a.txt', {t = u})",
                             "plot({1, 2}, {1, 2, 3})",
                             "plot({1, 2}, {1, 2}, 'LineWidth', 2)",
                             "plot()",
                             "histogram{}",
                             "subplot(1, 1, 2)",
                             "d:experiment(2)",
                             "d:range(1, 200)",
                             "d:split(2)",
                             "iddata({1, 0/0}, {1, 2}, 1)",
                             "iddata({1, 2}, {1}, 1)",
                             "tf({1}, {0})",
                             "tf({1}, {1, 1}, 0.1) + tf({1}, {1, 1}, 0.2)",
                             "c2d(tf({1}, {1, 1}, 1), 1)",
                             "lsim(tf({1, 0, 0}, {1, 1}), u, 1)",
                             "procsrivc(d, 'P4')",
                             "lssvf(d, {1, 1, 0}, -1)",
                             "n4sid(d, 0)",
                             "polyfit({1, 2}, {1, 2, 3}, 1)",
                             "step_first_order(d)",
                             "local x = 2 # 3",
                             "local v = x += 1",
                             "ode45(1)"}) {
        const std::string message = error_of(record + call);
        EXPECT_NE(message, "(no error)") << call;
        expect_told_in_french(message);
    }
}

TEST(script_errors_in_french, keep_file_line_and_function) {
    EXPECT_EQ(in_french("analysis.lua:7: fit: argument 1 (data) must be an iddata, but 0.5 was given"),
              "analysis.lua:7: fit: l'argument 1 (data) doit être un objet iddata, mais 0,5 a été donné");
    EXPECT_EQ(in_french("analysis.lua:7: something of the author's own: 0.5"),
              "analysis.lua:7: something of the author's own: 0.5");
}

TEST(script_errors_in_french, keep_all_functions_that_say_them) {
    const std::string zero =
        "lssvf: the input u is zero throughout: it does not excite the system, and its effect cannot be estimated";
    const std::string nul =
        "lssvf: l'entrée u est nulle d'un bout à l'autre\u00A0: elle n'excite pas le système, et son effet ne peut "
        "être "
        "estimé";
    EXPECT_EQ(in_french("analysis.lua:7: montecarlo: " + zero), "analysis.lua:7: montecarlo: " + nul);
    EXPECT_EQ(in_french("analysis.lua:7: pole: roots: every number is a root of the zero polynomial"),
              "analysis.lua:7: pole: roots\u00A0: tout nombre est racine du polynôme nul");
    const std::string every = "analysis.lua:7: montecarlo: every run of 'a' failed; the first one says: ";
    const std::string toutes =
        "analysis.lua:7: montecarlo: toutes les répétitions de «\u00A0a\u00A0» ont échoué\u00A0; la première "
        "dit\u00A0: ";
    EXPECT_EQ(in_french(every + zero), toutes + nul);
    EXPECT_EQ(in_french(every + "analysis.lua:3: " + zero), toutes + "analysis.lua:3: " + nul);
    EXPECT_EQ(in_french(every + "lssvf: the author's own"), every + "lssvf: the author's own") << "whole or not at all";
}

TEST(script_errors_in_french, count_one_and_more) {
    EXPECT_EQ(in_french("analysis.lua:7: dot: a has 1 value, but b has 2"),
              "analysis.lua:7: dot: a contient 1 valeur, mais b en contient 2");
    EXPECT_EQ(in_french("analysis.lua:7: lsim: the system has 2 inputs but the data have 1 input channel"),
              "analysis.lua:7: lsim: le système a 2 entrées mais les données ont 1 voie d'entrée");
    EXPECT_EQ(
        in_french("analysis.lua:7: zeros: a vector of 9 values needs 8.5 GB, but the script may use 67.1 MB in all "
                  "and holds 0.04 MB already"),
        "analysis.lua:7: zeros: un vecteur de 9 valeurs demande 8,5 Go, mais le script a droit à 67,1 Mo en tout et "
        "en tient déjà 0,04 Mo");
    EXPECT_EQ(in_french("analysis.lua:7: my own sentence about 3 values"),
              "analysis.lua:7: my own sentence about 3 values");
}

TEST(script_errors_in_french, words_for_kinds_are_french_and_names_stay) {
    EXPECT_EQ(in_french("The answer \"model\" (model) is not given."),
              "La réponse « model » (modèle) n'est pas donnée.");
    EXPECT_EQ(in_french("a model that is not known here."), "a model that is not known here.");
}

TEST(script_errors_in_french, stand_in_the_text_of_a_french_document) {
    RunRecord record;
    record.error = RecordedError{Message("there is no function or variable '{}'", "y"), "lesson.lua", 5};
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
