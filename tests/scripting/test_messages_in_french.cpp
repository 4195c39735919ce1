// What numerics says, in French scripts. Oracles: no English word is left; both languages name the same numbers;
// sentences written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/text_lines.h"
#include "numerics/validation/advice.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/script_run.h"
#include "support/advice_corpus.h"

namespace dynlab::test {
namespace test_messages_in_french {

using testing::HasSubstr;
using testing::Not;

std::string text_in_language(const std::string& language, const std::string& code) {
    const std::string text = printed(code, {}, language);
    EXPECT_FALSE(text.starts_with("ERROR")) << text << "\n" << code;
    return text;
}

/// Sorted, with points.
std::vector<std::string> numbers_in(const std::string& text) {
    static const std::regex number(R"(\d+([.,]\d+)?(e[-+]?\d+)?)");
    std::vector<std::string> numbers;
    for (std::sregex_iterator found(text.begin(), text.end(), number), end; found != end; ++found) {
        numbers.push_back(found->str());
        std::replace(numbers.back().begin(), numbers.back().end(), ',', '.');
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// Nothing for French text.
std::string english_words_in(const std::string& given) {
    static const std::regex english(
        "(^|[^A-Za-z'_:.-])(the|The|this|This|of|is|are|was|it|It|its|be|to|not|that|with|With|for|from|by|by|in|and|"
        "or|"
        "has|have|which|when|samples?|lags?|poles?|zeros?|fit|delay|input|output|model|noise|record|error)"
        "($|[^A-Za-z'_:(=-])");
    std::string text = given, words;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c >= 0x80; }, 'x');  // é is a letter
    for (std::sregex_iterator found(text.begin(), text.end(), english), end; found != end; ++found)
        words += found->str(2) + " ";
    return words;
}

void expect_french(const std::string& english, const std::string& french) {
    EXPECT_EQ(english_words_in(french), "") << english << "\nis told as\n" << french;
    EXPECT_EQ(numbers_in(english), numbers_in(french)) << english << "\nis told as\n" << french;
    EXPECT_FALSE(std::regex_search(french, std::regex(R"([a-zé)] [;:?!%]([ .,;)]|$))")))
        << "a sign without its narrow blank in\n"
        << french;
}

/// What a script prints in both languages. Tables keep their points, and a row may hold nothing to translate.
void expect_french_text(const std::string& code) {
    const std::vector<std::string> english = lines_of(text_in_language("en", code)),
                                   french = lines_of(text_in_language("fr", code));
    ASSERT_EQ(english.size(), french.size()) << code;
    for (std::size_t i = 0; i < english.size(); ++i) expect_french(english[i], french[i]);
}

/// Data of two poles and a delay with white noise at the output: `d`, and `s` with ten times the noise.
const std::string kDataSet = R"(rng(3)
local u = prbs(6, 12)
local t = range(0, 0.1, 0.1*(#u - 1))
local G0 = tf({2}, {1, 1.2, 4}, {IODelay = 0.3})
local x = lsim(G0, u, t)
local d = iddata(x + 0.02*randn(#u), u, 0.1)
local s = iddata(x + 0.2*randn(#u), u, 0.1)
local function say(G) print(G.report.message) print(G.report.residual_verdict) present(G) end
)";

TEST(messages_in_french, of_estimators_are_french) {
    const char* const calls[] = {"srivc(d, {1, 2, 3})",
                                 "srivc(d, {4, 4, 0})",
                                 "srivc(d, {1, 2, 3}, {MaxIter = 0})",
                                 "srivc(s, {1, 2, 3}, {InitialState = 'estimate', Offset = 'estimate'})",
                                 "srivc(d, {1, 2, 3}, {InitialState = 'steady'})",
                                 "srivc(iddata(x + 3, u, 0.1), {1, 2, 3})",
                                 "srivc(d:range(200, 700), {1, 2, 3})",
                                 "tfsrivc(d, 2, 0)",
                                 "tfsrivc(d, 2, 2)",
                                 "tfsrivc(d, 2, 0, {TdMax = 0.1})",
                                 "tfsrivc(d, 2, 0, {TdMin = 0.5, TdMax = 1})",
                                 "tfsrivc(iddata(matrix{x, 2*x}, u, 0.1), {2, 2}, {0, 0})",
                                 "coe(d, {1, 2, 3})",
                                 "coe(s, {4, 4, 0}, {MaxIter = 2})",
                                 "rivc(s, {1, 1, 1, 2, 3})",
                                 "rivc(iddata(x, u, 0.1), {1, 1, 1, 2, 3})",
                                 "lssvf(d, {2, 1, 3}, 0.01)",
                                 "lssvf(s, {2, 1, 3}, 3)",
                                 "ivsvf(d, {2, 1, 3}, 3)",
                                 "procsrivc(d, 'P2UD')",
                                 "procsrivc(d, 'P3')",
                                 "procsrivc(d, 'P2Z')",
                                 "procsrivc(d, 'P1DI')",
                                 "hammerstein(d, 2, 0)",
                                 "arx(d, {2, 2, 1})",
                                 "arx(s, {6, 6, 1})",
                                 "iv4(d, {2, 2, 3})",
                                 "oe(d, {2, 2, 3})",
                                 "oe(s, {4, 5, 1})",
                                 "sriv(d, {2, 2, 3})",
                                 "armax(d, {2, 2, 2, 3})",
                                 "bj(s, {2, 1, 1, 2, 3})",
                                 "n4sid(d, 3)",
                                 "narx(s, {2, 2, 3})",
                                 "sindy(d, {threshold = 0.3})",
                                 "sindy(d, {weak = true})",
                                 "dmdc(s, {delays = 3})"};
    for (const char* call : calls) expect_french_text(kDataSet + "say(" + call + ")");
}

TEST(messages_in_french, of_records_are_french) {
    expect_french_text(
        "local u = randn(20)\nprint(iddata(u, u, 0.5), iddata(matrix{u, u}, matrix{u, u}, 0.5))\n"
        "print(merge(iddata(u, u, 0.5), iddata(u, u, 0.5)))\nprint(iddata(u, u, nil, {SamplingInstants = cumsum(u^2 + "
        "1)}))");
}

TEST(messages_in_french, of_step_tests_and_regressions_are_french) {
    expect_french_text(
        "local t = range(0, 0.05, 20)\nlocal u = t*0 + 1\n"
        "local d = iddata(step(tf({2}, {1.5, 1}), t), u, 0.05)\nlocal e = iddata(step(tf({2}, {1, 0.6, 4}), t), u, "
        "0.05)\n"
        "print(step_first_order(d).report.message)\nprint(step_delayed(d).report.message)\n"
        "print(step_second_order(e).report.message)");
    expect_french_text(
        "local Phi = matrix{{1, 2}, {1, 3}, {1, 5}}\nprint(lsq(Phi, vector{1, 2, 4}).message)\n"
        "print(lsq(matrix{{1, 1}, {2, 2}, {3, 3}}, vector{1, 2, 4}).message)\n"
        "print(gradient_descent(Phi, vector{1, 2, 4}).message)\n"
        "print(gradient_descent(Phi, vector{1, 2, 4}, {step = 100}).message)\n"
        "print(gradient_descent(Phi, vector{1, 2, 4}, {MaxIter = 2}).message)");
}

TEST(messages_in_french, of_validation_are_french) {
    expect_french_text(kDataSet + R"(
resid(d, G0)
resid(d, tf({2}, {1, 1.2, 4}))
resid(d, tf({2}, {1, 1}))
resid(d, tf({-2}, {1, 1.2, 4}))
resid(d, tf({2}, {1, 1.2, 4}, {IODelay = 0.6}))
resid(iddata(x, u, 0.1), G0)
resid(d, srivc(d, {3, 4, 3}))
resid(iddata(matrix{x, x + 0.1*randn(#u)}, u, 0.1), tfsrivc(iddata(matrix{x, x}, u, 0.1), {2, 2}, {0, 0}))
resid(d, arx(d, {2, 2, 1}), {prediction = true})
resid(d:range(200, 700), G0, {InitialState = "zero", Offset = "none"})
local walk = cumsum(randn(#u))
resid(iddata(x + 0.2*walk/math.sqrt(#u), u, 0.1), G0)
print(fit_measures(d, G0).message)
print(fit_measures(d, G0, {InitialState = "estimate", Offset = "estimate"}).message)
local f, told = predict(d, arx(d, {2, 2, 1}), {k = 3})
print(type(told) == "table" and told.message or "")
crossvalidate(d, function(part) return srivc(part, {1, 2, 3}) end, {folds = 3})
)");
}

TEST(messages_in_french, of_searches_and_studies_are_french) {
    expect_french_text(kDataSet + R"(
local V = srivcstruc(d, {poles = {1, 3}, zeros = {0, 1}})
print(V.recommendation)
for _, criterion in ipairs{"recommended", "RT2", "YIC", "AIC", "BIC", "FPE", "fit"} do selcstruc(V, criterion) end
print(srivcstruc(d:range(1, 400), {poles = {2, 3}, zeros = {0, 1}, validate = d:range(401, 700)}))
print(srivcstruc(d, {poles = {2, 3}, zeros = {0, 1}, delays = {0, 3}}).recommendation)
print(srivcstruc(d, {poles = {1, 2}, zeros = {0, 0}, Integration = true}).recommendation)
delayest(d)
delayest(s, {poles = {1, 1}})
local A = arxstruc(d, {na = {1, 2}, nb = {1, 2}, nk = {1, 3}})
for _, criterion in ipairs{"loss", "AIC", "BIC"} do selstruc(A, criterion) end
print(arxstruc(d:range(1, 400), {na = {1, 2}, nb = {1, 2}, nk = {1, 3}, validate = d:range(401, 700)}))
)");
}

TEST(messages_in_french, of_intervals_are_french) {
    expect_french_text(kDataSet + R"(
local G = procsrivc(s, "P2UD")
profile(G, s, "Td", {points = 7})
bootstrap(G, s, {runs = 20})
bootstrap(procsrivc(d, "P1"), d, {runs = 20})
bootstrap(procsrivc(d, "P1"), d, {runs = 20, kind = "parametric"})
)");
}

TEST(messages_in_french, of_responses_are_french) {
    expect_french_text(kDataSet + R"(
impulseest(d)
impulseest(d, {lags = 10, smooth = false})
impulseest(iddata(randn(#u), u, 0.1))
cra(d)
cra(iddata(x, lsim(tf({1}, {5, 1}), u, t), 0.1))
etfe(d)
etfe(d, {smooth = 3})
spa(d)
spa(d:range(101, 160), {window = 30})
)");
}

TEST(messages_in_french, of_advice_are_french) {
    const auto expect_advice = [](const IdData& data) {
        for (const DataIssue& issue : advise(data).findings) {
            expect_french(message_text(issue.message, {nullptr, option_name}),
                          message_text(issue.message, {catalog_of("fr"), option_name}));
        }
    };
    for (const CorpusKind& kind : faulty_kinds()) expect_advice(kind.simulated_data(1));
    expect_french_text(kDataSet + R"(
local function with(change) local y = vector(x + 0.02*randn(#u)) change(y) return y end
advice(iddata(with(function(y) y[100] = 30 y[101] = 31 end), u, 0.1))
advice(iddata(x, u*0 + 1, 0.1))
advice(iddata(x*0, u, 0.1))
advice(iddata(t, u, 0.1))
advice(iddata(u, u, 0.1))
advice(iddata(round(x*3)/3, u, 0.1, {OutputUnit = "V"}))
advice(iddata(60*x, u, 0.1, {OutputUnit = "rad"}))
advice(iddata(x, sin(t), 0.1))
advice(d:range(1, 12))
advice(merge(d, s))
local late = vector(t)
for k = 300, #late do late[k] = late[k] + 5 end
advice(iddata(d.y, u, nil, {SamplingInstants = late}))
for k = 300, #late do late[k] = t[300] + 0.25*(k - 300) end
advice(iddata(d.y, u, nil, {SamplingInstants = late}))
)");
}

TEST(messages_in_french, are_as_written_by_hand) {
    EXPECT_THAT(text_in_language("fr", kDataSet + "print(fit(d, G0)) resid(d, G0)"), HasSubstr("L'erreur de sortie"));
    const std::string order = text_in_language("fr", kDataSet + "srivcstruc(d, {poles = {1, 2}, zeros = {0, 1}})");
    EXPECT_THAT(order, testing::AllOf(HasSubstr("Structure recommandée : 2 pôles et "), HasSubstr(" (R_T^2 = 0,9")));
    EXPECT_THAT(order, HasSubstr("pôles zéros"));
    EXPECT_THAT(text_in_language("fr", "present(tf({2}, {1, 0.6, 1.7}))"), HasSubstr("  -0,3 + 1,2689i "));
    EXPECT_THAT(text_in_language("fr", "print(zeros(100), zeros(20, 20))"),
                testing::AllOf(HasSubstr("] (100 valeurs)"), HasSubstr("... (matrice 20 x 20)")));
    EXPECT_THAT(text_in_language("fr", kDataSet + "resid(d, G0)"), HasSubstr("y1\u202F: L'erreur"));
}

TEST(messages_in_french, of_scripts_own_stay_and_english_scripts_are_english) {
    EXPECT_EQ(text_in_language("fr", "print('The model is unstable.')"), "The model is unstable.\n");
    EXPECT_THAT(text_in_language("en", kDataSet + "resid(d, G0)"), HasSubstr("The output error is"));
    EXPECT_THAT(text_in_language("fr", kDataSet + "resid(d, G0)"), Not(HasSubstr("error")));
}

}  // namespace test_messages_in_french
}  // namespace dynlab::test
