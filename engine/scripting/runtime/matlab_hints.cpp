#include "scripting/runtime/matlab_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <string_view>

#include "platform/utf8.h"

namespace dynlab::inline scripting {
namespace {

struct NameHint {
    std::string_view name;
    const char* hint;
};

constexpr std::array kNames = {
    NameHint{"ans", "keep the result in a variable: local x = ..."},
    NameHint{"axis", "give x_range = {a, b} and y_range = {a, b} among the options of plot"},
    NameHint{"bar", "write plot(x, y, {style = \"bars\"})"},
    NameHint{"cd", "scripts read and write in their own folder"},
    NameHint{"cell", "write a Lua table: local c = {}"},
    NameHint{"cell2mat", "a Lua table of numbers is accepted wherever a vector is: vector(t)"},
    NameHint{"clc", "at the prompt Ctrl-L clears the screen"},
    NameHint{"clear", "every run and every prompt starts afresh; one variable is cleared by x = nil"},
    NameHint{"close", "there is nothing to close: figures go into the document"},
    NameHint{"dir", "scripts cannot list folders; load(name) reads a file by its name"},
    NameHint{"disp", "write print(x)"},
    NameHint{"dofile", "write require(\"name\") for name.lua in the script's folder"},
    NameHint{"eps", "write 2^-52"},
    NameHint{"exist", "a variable that has no value is nil: x == nil"},
    NameHint{"fclose", "scripts read data with load(name) and write with save_csv(path, data)"},
    NameHint{"fopen", "scripts read data with load(name) and write with save_csv(path, data)"},
    NameHint{"fprintf", "write print(string.format(\"%.3f\", x))"},
    NameHint{"grid", "the grid is always drawn"},
    NameHint{"fzero", "write find(gt(v, 0))[1] for a change of sign in a vector; there is no solver of equations"},
    NameHint{"hold", "give all curves to one call: plot(x1, y1, \"a\", x2, y2, \"b\")"},
    NameHint{"horzcat", "write matrix{v1, v2}: vectors are the columns"},
    NameHint{"io", "scripts read with load(name), write with save_csv(path, data), and print with print(x)"},
    NameHint{"isempty", "write #v == 0"},
    NameHint{"isnan", "a vector with NaN is refused by name where it matters; for one number x write x ~= x"},
    NameHint{"legend", "name the curves: plot(x1, y1, \"first\", x2, y2, \"second\")"},
    NameHint{"length", "write #v"},
    NameHint{"line", "write plot(x, y)"},
    NameHint{"ls", "scripts cannot list folders; load(name) reads a file by its name"},
    NameHint{"lsode", "there is no solver of differential equations; lsim(G, u, Ts) simulates linear ones"},
    NameHint{"mldivide", "write solve(A, b)"},
    NameHint{"nnz", "write #find(mask)"},
    NameHint{"num2str", "write string.format(\"%g\", x)"},
    NameHint{"numel", "write #v"},
    NameHint{"ode45", "there is no solver of differential equations; lsim(G, u, Ts) simulates linear ones"},
    NameHint{"pi", "write math.pi"},
    NameHint{"rem", "write a % b"},
    NameHint{"mod", "write a % b"},
    NameHint{"inf", "write math.huge"},
    NameHint{"Inf", "write math.huge"},
    NameHint{"NaN", "write 0/0"},
    NameHint{"pwd", "scripts read and write in their own folder"},
    NameHint{"scatter", "write plot(x, y, {style = \"points\"})"},
    NameHint{"set", "give the options to plot: plot(x, y, {xlabel = \"time (s)\"})"},
    NameHint{"size", "write #v for a vector, A.rows and A.columns for a matrix"},
    NameHint{"sprintf", "write string.format(\"%.3f\", x)"},
    NameHint{"sqrtm", "write sqrt(x) for the root of every element"},
    NameHint{"stairs", "write plot(x, y, {style = \"stairs\"})"},
    NameHint{"stem", "write plot(x, y, {style = \"stems\"})"},
    NameHint{"strcmp", "write a == b"},
    NameHint{"strcat", "write a .. b"},
    NameHint{"struct", "write {name = value}"},
    NameHint{"title", "give it among the options: plot(x, y, {title = \"...\"})"},
    NameHint{"transpose", "write A:t()"},
    NameHint{"vertcat", "write vector{v1, v2}"},
    NameHint{"whos", "write who()"},
    NameHint{"xlabel", "give it among the options: plot(x, y, {xlabel = \"time (s)\"})"},
    NameHint{"xlim", "give it among the options: plot(x, y, {x_range = {a, b}})"},
    NameHint{"ylabel", "give it among the options: plot(x, y, {ylabel = \"output\"})"},
    NameHint{"ylim", "give it among the options: plot(x, y, {y_range = {a, b}})"},
    NameHint{"aic", "write G.report or srivcstruc(data, ...), whose rows have aic, bic and fpe"},
    NameHint{"all", "write #find(mask) == #v"},
    NameHint{"angle", "write freqresp(G, w):arg(), or bode_values(G, w) for degrees"},
    NameHint{"any", "write #find(mask) > 0"},
    NameHint{"cellfun", "write a loop: for i, x in ipairs(t) do ... end"},
    NameHint{"chol", "there is no Cholesky factor; solve(A, b) solves A*x = b"},
    NameHint{"cond", "write lsq(Phi, y), whose result tells the condition number"},
    NameHint{"conj", "complex numbers have the fields re, im, abs and arg"},
    NameHint{"cpsd", "write spa(data) or etfe(data): they give frequency responses"},
    NameHint{"ctrb", "write ss(A, B, C, D) and place or lqr"},
    NameHint{"cumprod", "write exp(cumsum(log(v)))"},
    NameHint{"d2d", "write c2d(d2c(G), Ts)"},
    NameHint{"date", "scripts have no access to the system and no date"},
    NameHint{"datetime", "scripts have no access to the system and no date"},
    NameHint{"db", "write 20*log10(x)"},
    NameHint{"deconv", "write pole(tf({1}, a)) for the roots of a polynomial"},
    NameHint{"double", "every number is one already; tonumber(text) reads a text"},
    NameHint{"exit", "a script ends with its last line"},
    NameHint{"expm", "write lsim or c2d(G, Ts): they take the matrix exponential"},
    NameHint{"fix", "write floor(x), or ceil(x) below zero"},
    NameHint{"fliplr", "write v:select(range(#v, -1, 1))"},
    NameHint{"flipud", "write v:select(range(#v, -1, 1))"},
    NameHint{"fminsearch", "there is no general minimiser; estimators such as srivc and procsrivc fit models"},
    NameHint{"format", "write print(string.format(\"%.10g\", x)) for more digits"},
    NameHint{"fpe", "write srivcstruc(data, ...), whose rows have aic, bic and fpe"},
    NameHint{"freqz", "write bode(G) or freqresp(G, w)"},
    NameHint{"getenv", "scripts have no access to the system"},
    NameHint{"getTrend", "write detrend(data), and mean(data.y) for the mean"},
    NameHint{"getpar", "write G.param"},
    NameHint{"hist", "write histogram(v)"},
    NameHint{"iddemo", "type dynlab demo"},
    NameHint{"idnlarx", "write hammerstein(data, ...) for a static characteristic before linear dynamics"},
    NameHint{"imag", "a complex number has the field im"},
    NameHint{"initial", "write lsim(G, u, t, {x0 = ...}) with an input of zeros"},
    NameHint{"input", "scripts ask nothing; give the value in a variable"},
    NameHint{"int32", "write math.floor(x)"},
    NameHint{"isa", "write type(x)"},
    NameHint{"iscell", "write type(x) == \"table\""},
    NameHint{"isfield", "a field that is not there is nil: t.name == nil"},
    NameHint{"isnumeric", "write type(x) == \"number\""},
    NameHint{"keyboard", "write print(x); dynlab run -i FILE opens the prompt with the script's variables"},
    NameHint{"lower", "write string.lower(text)"},
    NameHint{"lsqnonlin", "there is no general minimiser; estimators such as srivc and procsrivc fit models"},
    NameHint{"mag2db", "write 20*log10(x)"},
    NameHint{"meshgrid", "write two loops: for i = 1, m do for j = 1, n do ... end end"},
    NameHint{"minreal", "cancelling poles and zeros stay; srivcstruc(data, ...) tells a structure without them"},
    NameHint{"nan", "write 0/0"},
    NameHint{"nparams", "write #G.param"},
    NameHint{"null", "write nil"},
    NameHint{"obsv", "write ss(A, B, C, D) and place or lqr"},
    NameHint{"optimset", "give the options to the function: srivc(data, {1, 2, 0}, {MaxIter = 50})"},
    NameHint{"pinv", "write lsq(Phi, y) for least squares"},
    NameHint{"pwelch", "write spa(data) or etfe(data): they give frequency responses"},
    NameHint{"qr", "write lsq(Phi, y) for least squares, solve(A, b) for equations"},
    NameHint{"quit", "a script ends with its last line"},
    NameHint{"randi", "write math.random(a, b)"},
    NameHint{"randperm", "write local _, order = sort(rand(n))"},
    NameHint{"randomseed", "write rng(seed)"},
    NameHint{"rank", "write lsq(Phi, y), whose result tells the condition number"},
    NameHint{"real", "a complex number has the field re"},
    NameHint{"regexp", "write string.match(text, pattern) or string.gmatch"},
    NameHint{"repmat", "write vector{v, v}, or matrix{v, v} for columns side by side"},
    NameHint{"reshape", "write matrix{v1, v2}: vectors are the columns"},
    NameHint{"rlocus", "write pole(feedback(k*G, 1)) for each gain k"},
    NameHint{"setpar", "write tf(num, den) with the values wanted"},
    NameHint{"sisotool", "write margin(L), place or lqr"},
    NameHint{"ssdata", "write G.A, G.B, G.C and G.D of a state-space model"},
    NameHint{"strsplit", "write string.gmatch(text, \"[^,]+\") in a loop"},
    NameHint{"svd", "write eig(A:t()*A): its square roots are the singular values"},
    NameHint{"tfestimate", "write spa(data) or etfe(data): they give frequency responses"},
    NameHint{"trace", "write sum of A[{i, i}] in a loop"},
    NameHint{"trapz", "write sum(y)*Ts, or cumsum(y)*Ts for the integral over time"},
    NameHint{"unique", "write sort(v) and leave out what equals its neighbour"},
    NameHint{"upper", "write string.upper(text)"},
    NameHint{"zpkdata", "write zero(G), pole(G) and dcgain(G)"},
    // Identification.
    NameHint{"allmargin", "write margin(G)"},
    NameHint{"arxstruc",
             "write srivcstruc(data, {poles = {1, 4}, zeros = {0, 2}}), which tries structures in continuous time"},
    NameHint{"balred",
             "there is no model reduction; srivcstruc(data, {poles = {1, 4}}) tells how many poles the data want"},
    NameHint{"clsrivc", "no method here knows the controller; advice(data) tells whether one was running"},
    NameHint{"comparec", "write compare(data, G); fit_measures(data, G).output holds the simulated output"},
    NameHint{"conv", "write (tf(a, {1})*tf(b, {1})).num for the product of two polynomials"},
    NameHint{"cov", "std(v), var(v) and dot(v, w) are there; a model's covariance is G.covariance"},
    NameHint{"etime", "write tic() before and toc() after"},
    NameHint{"filter", "write lsim(G, u, Ts) for a transfer function, idfilt(data, {lower, upper}) for data"},
    NameHint{"frd", "write spa(data) or etfe(data): they give frequency responses"},
    NameHint{"getcov", "write G.covariance"},
    NameHint{"getpvec", "write G.param for the values and G.std for their standard errors"},
    NameHint{"hsrivc", "write hammerstein(data, np, nz)"},
    NameHint{"idfrd", "write spa(data) or etfe(data): they give frequency responses"},
    NameHint{"idinput", "write prbs(n, p), rbs(N, p), multisine({f1, f2}, T, Ts), chirp or sine"},
    NameHint{"idpoly",
             "polynomial models come from estimators: arx, armax, oe, bj; write tf(num, den) for a transfer function"},
    NameHint{"idss", "write ss(A, B, C, D)"},
    NameHint{"idtf", "write tf(num, den, {IODelay = s})"},
    NameHint{"isct", "a discrete model has G.Ts above zero"},
    NameHint{"isdt", "a discrete model has G.Ts above zero"},
    NameHint{"isstable", "write stable(G)"},
    NameHint{"lpvsrivc",
             "parameters are constant here; srivc(data, {nb, nf, nk}) fits a record at one operating point"},
    NameHint{"minreal", "there is no model reduction; pzmap(G) shows which poles and zeros cancel"},
    NameHint{"misdata", "write fillmissing(data)"},
    NameHint{"nlarx", "write hammerstein(data, ...) for a static characteristic before linear dynamics"},
    NameHint{"nlhw", "write hammerstein(data, ...) for a static characteristic before linear dynamics"},
    NameHint{"os", "scripts have no access to the system and no date; tic(), toc() and clock() time them"},
    NameHint{"pem", "write armax, bj or oe in discrete time, rivc or coe in continuous time"},
    NameHint{"poly", "write ((s - r1)*(s - r2)).num with s = tf(\"s\")"},
    NameHint{"polyest", "write armax(data, {na, nb, nc, nk}), bj or oe"},
    NameHint{"procest", "write procsrivc(data, \"P1D\")"},
    NameHint{"residc", "write resid(data, G)"},
    NameHint{"rlssvf", "there is no recursive estimation; lssvf(data, {na, nb, nk}, lambda) takes the whole record"},
    NameHint{"roots", "write pole(tf({1}, p)): the poles of 1/p are the roots of p"},
    NameHint{"rsrivc", "there is no recursive estimation; srivc(data, {nb, nf, nk}) takes the whole record"},
    NameHint{"selstruc", "write selcstruc(V) for what srivcstruc gave"},
    NameHint{"shadedplot", "write figure{curves = {{x = t, y = low, y_upper = high}}}"},
    NameHint{"sidgpmf", "write n4sid(data, order) in discrete time, lsgpmf(data, {na, nb, nk}, lambda) otherwise"},
    NameHint{"simc", "write sim(G, u, Ts, {snr = 10}), snr in dB"},
    NameHint{"ssest", "write n4sid(data, order)"},
    NameHint{"ssregest", "write n4sid(data, order)"},
    NameHint{"tfdata", "write G.num and G.den"},
    NameHint{"tfest", "write tfsrivc(data, poles, zeros)"},
    NameHint{"xcorr", "write cra(data), or resid(data, G) for the correlations of a model's errors"},
    NameHint{"zpk", "write tf(num, den); pole(G) and zero(G) give the roots"},
    NameHint{"zpplot", "write pzmap(G)"},
};

constexpr const char* kCommentHint = "a comment starts with -- in Lua";

/// A character that word processors and printed pages put in the place of one that Lua knows.
struct ForeignCharacter {
    char32_t character;
    const char* instead;
};

constexpr std::array kForeign = {ForeignCharacter{U'\u201c', "\""},      ForeignCharacter{U'\u201d', "\""},
                                 ForeignCharacter{U'\u201e', "\""},      ForeignCharacter{U'\u00ab', "\""},
                                 ForeignCharacter{U'\u00bb', "\""},      ForeignCharacter{U'\u2018', "'"},
                                 ForeignCharacter{U'\u2019', "'"},       ForeignCharacter{U'\u00b4', "'"},
                                 ForeignCharacter{U'\u2010', "-"},       ForeignCharacter{U'\u2011', "-"},
                                 ForeignCharacter{U'\u2012', "-"},       ForeignCharacter{U'\u2013', "-"},
                                 ForeignCharacter{U'\u2014', "-"},       ForeignCharacter{U'\u2212', "-"},
                                 ForeignCharacter{U'\u00d7', "*"},       ForeignCharacter{U'\u00b7', "*"},
                                 ForeignCharacter{U'\u22c5', "*"},       ForeignCharacter{U'\u00f7', "/"},
                                 ForeignCharacter{U'\u2044', "/"},       ForeignCharacter{U'\u2264', "<="},
                                 ForeignCharacter{U'\u2265', ">="},      ForeignCharacter{U'\u2260', "~="},
                                 ForeignCharacter{U'\u02c6', "^"},       ForeignCharacter{U'\u00b2', "^2"},
                                 ForeignCharacter{U'\u00b3', "^3"},      ForeignCharacter{U'\u221a', "sqrt(x)"},
                                 ForeignCharacter{U'\u03c0', "math.pi"}, ForeignCharacter{U'\u2026', "..."},
                                 ForeignCharacter{U'\u00a0', "a space"}, ForeignCharacter{U'\u2009', "a space"},
                                 ForeignCharacter{U'\u202f', "a space"}, ForeignCharacter{U'\u200b', "nothing"},
                                 ForeignCharacter{U'\ufeff', "nothing"}};

/// The line without its strings and Lua comment, so that their contents are not taken for code.
std::string code_only(const std::string& line) {
    std::string code;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line.compare(i, 2, "--") == 0) break;
        if (line[i] == '"') {
            const auto end = line.find('"', i + 1);
            if (end == std::string::npos) break;
            code += "\"\"";
            i = end;
        } else {
            code += line[i];
        }
    }
    return code;
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

bool name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string first_word(const std::string& code) {
    const auto start = code.find_first_not_of(" \t");
    if (start == std::string::npos) return {};
    auto end = start;
    while (end < code.size() && name_character(code[end])) ++end;
    return code.substr(start, end - start);
}

/// x' with the quote right behind a name, a bracket or another quote: MATLAB's transpose.
bool has_transpose(const std::string& code) {
    for (std::size_t i = 1; i < code.size(); ++i)
        if (code[i] == '\'' && (name_character(code[i - 1]) || code[i - 1] == ')' || code[i - 1] == ']'))
            return std::count(code.begin() + static_cast<std::ptrdiff_t>(i), code.end(), '\'') % 2 == 1;
    return false;
}

/// a:b or a:s:b between two values, outside a method call.
bool has_colon_range(const std::string& code) {
    for (std::size_t i = 1; i + 1 < code.size(); ++i) {
        if (code[i] != ':' || code[i + 1] == ':' || code[i - 1] == ':') continue;
        auto next = code.find_first_not_of(' ', i + 1);
        if (next == std::string::npos) continue;
        auto end = next;
        while (end < code.size() && name_character(code[end])) ++end;
        const bool method = end > next && !std::isdigit(static_cast<unsigned char>(code[next])) && end < code.size() &&
                            (code[end] == '(' || code[end] == '{' || code[end] == '"');
        if (!method) return true;
    }
    return false;
}

/// An opening bracket where a value starts: [1 2 3].
bool has_bracket_list(const std::string& code) {
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i] != '[') continue;
        const auto before = code.find_last_not_of(" \t", i == 0 ? std::string::npos : i - 1);
        if (i == 0 || before == std::string::npos ||
            std::string_view("=(,{+-*/^").find(code[before]) != std::string_view::npos)
            return true;
    }
    return false;
}

bool ends_with(const std::string& code, std::string_view tail) {
    const auto last = code.find_last_not_of(" \t\r");
    return last != std::string::npos && last + 1 >= tail.size() &&
           code.compare(last + 1 - tail.size(), tail.size(), tail) == 0;
}

/// A single = inside an if or while condition.
bool has_assignment_condition(const std::string& code) {
    const std::string word = first_word(code);
    if (word != "if" && word != "elseif" && word != "while") return false;
    for (std::size_t i = 1; i + 1 < code.size(); ++i)
        if (code[i] == '=' && code[i + 1] != '=' &&
            std::string_view("=~<>!").find(code[i - 1]) == std::string_view::npos)
            return true;
    return false;
}

std::string element_hint(const std::string& code) {
    if (contains(code, "[end") || contains(code, "(end"))
        return "the last element is x[#x]; vector{x, y} appends y to x";
    static const std::regex kTwoPlaces(R"(\w\[\s*[\w.:]+\s*,)");
    if (std::regex_search(code, kTwoPlaces)) return "the element in row 1 and column 2 is A[{1, 2}]";
    if (contains(code, "?")) return "write if ... then ... else ... end instead of ?";
    static const std::regex kElementSet(R"(^\s*(local\s+)?([A-Za-z_]\w*)\(([\w\s,:#]+)\)\s*=[^=].*)");
    std::smatch element;
    if (std::regex_match(code, element, kElementSet))
        return element[3].str().find(',') == std::string::npos
                   ? fmt::format("an element is written {}[{}]", element[2].str(), element[3].str())
                   : fmt::format("an element of a matrix is written {}[{{{}}}]", element[2].str(), element[3].str());
    static const std::regex kImaginary(R"((^|[^\w.])\d+(\.\d*)?[ij]\b)");
    if (std::regex_search(code, kImaginary))
        return "there are no complex numbers to calculate with; those that functions give have the fields re, im, abs, "
               "arg";
    return {};
}

std::string operator_hint(const std::string& code) {
    if (contains(code, ".*")) return "for vectors write x*y, for matrices A:times(B), instead of .*";
    if (contains(code, "./")) return "for vectors write x/y instead of ./";
    if (contains(code, ".^")) return "for vectors write x^2 instead of .^";
    if (contains(code, "!=")) return "'not equal' is ~= in Lua";
    if (contains(code, "&&")) return "'and' is written and";
    if (contains(code, "||")) return "'or' is written or";
    if (contains(code, "+=") || contains(code, "-=") || contains(code, "*="))
        return "write x = x + 1 instead of x += 1";
    if (contains(code, "++")) return "write x = x + 1 instead of x++";
    return {};
}

std::string block_hint(const std::string& code) {
    const std::string word = first_word(code);
    if ((word == "for" || word == "while") && !contains(code, " do"))
        return word == "for" ? "a loop is written: for k = 1, N do ... end"
                             : "a loop is written: while condition do ... end";
    if ((word == "if" || word == "elseif") && !contains(code, "then"))
        return "a condition is written: if a > b then ... end";
    if (word == "function" && contains(code, "=")) return "a function is written: function name(x) ... return y end";
    if (word == "switch" || word == "case" || word == "otherwise")
        return "Lua has no switch: write if ... elseif ... else ... end";
    if (word == "try" || word == "catch") return "write local ok, message = pcall(f) instead of try";
    if (word == "end" && contains(code, "end;")) return "one 'end' too many, or a block that was not opened";
    return {};
}

/// Commands of words alone: hold on, close all, clear x y; step G; ?lsim.
std::string command_hint(const std::string& code, const std::string& near) {
    static const std::regex kAsked(R"(\s*\?\s*(\w+)\s*)"), kTwoWords(R"(\s*([A-Za-z_]\w*)[ \t]+(\w+)[\s;]*)");
    std::smatch words;
    if (std::regex_match(code, words, kAsked)) return fmt::format("help is asked for by help(\"{}\")", words[1].str());
    const bool words_only = std::all_of(code.begin(), code.end(), [](char c) {
        return name_character(c) || std::string_view(" \t\r;").find(c) != std::string_view::npos;
    });
    const char* hint = words_only ? matlab_name_hint(first_word(code)) : nullptr;
    if (hint != nullptr) return hint;
    const std::string block = block_hint(code);
    if (block.empty() && std::regex_match(code, words, kTwoWords) && words[2] == near && words[1] != "local" &&
        words[1] != "return" && words[1] != "goto" && words[1] != "function")
        return fmt::format("a call is written {}({})", words[1].str(), words[2].str());
    return {};
}

}  // namespace

std::string lone_word_hint(const std::string& line) {
    const std::string code = code_only(line), word = first_word(code);
    const auto last = code.find_last_not_of(" \t\r;");
    if (last == std::string::npos || last + 1 != code.find(word) + word.size()) return {};
    return word == "try" || word == "catch" ? "'" + word + "' is no word of Lua; " + block_hint(code) : "";
}

std::optional<std::string> foreign_character_sentence(const std::string& line) {
    const std::string code = code_only(line);
    std::string_view rest = code;
    while (!rest.empty()) {
        const std::optional<char32_t> character = take_character(rest);
        if (!character) return "a byte that is not UTF-8 cannot stand here; save the script as UTF-8";
        if (*character < 128) continue;
        const auto known = std::find_if(kForeign.begin(), kForeign.end(),
                                        [&](const ForeignCharacter& one) { return one.character == *character; });
        const std::string instead = known == kForeign.end() ? "names are made of the letters a to z, digits and _"
                                                            : std::string("write ") + known->instead + " instead";
        return fmt::format("the character {} (U+{:04X}) cannot stand here; {}", utf8_of(*character),
                           static_cast<unsigned>(*character), instead);
    }
    return std::nullopt;
}

std::string comment_hint(const std::string& line, const std::string& name) {
    const std::string code = code_only(line);
    const auto sign = code.find_first_of("%#");
    return sign != std::string::npos && code.find(name, sign) != std::string::npos ? kCommentHint : "";
}

bool begins_foreign_comment(const std::string& line) {
    const auto first = line.find_first_not_of(" \t");
    return first != std::string::npos && (line[first] == '%' || line.compare(first, 2, "# ") == 0);
}

const char* matlab_name_hint(const std::string& name) {
    const auto found =
        std::find_if(kNames.begin(), kNames.end(), [&](const NameHint& hint) { return hint.name == name; });
    return found == kNames.end() ? nullptr : found->hint;
}

std::string matlab_syntax_hint(const std::string& line, const std::string& near) {
    const std::string code = code_only(line);
    if (std::string hint = command_hint(code, near); !hint.empty()) return hint;
    const auto first = code.find_first_not_of(" \t");
    if (first != std::string::npos && (code[first] == '%' || code[first] == '#')) return kCommentHint;
    if (has_assignment_condition(code)) return "to compare, write == instead of =";
    if (std::string hint = operator_hint(code); !hint.empty()) return hint;
    if (ends_with(code, "...") && near != ")") return "a statement may simply go on in the next line, without ...";
    if (has_transpose(code)) return "the transpose is A:t(); vectors are columns already";
    if (std::string hint = block_hint(code); !hint.empty()) return hint;
    if (std::string hint = element_hint(code); !hint.empty()) return hint;
    if (has_bracket_list(code)) return "a vector is written vector{1, 2, 3}, a matrix matrix{{1, 2}, {3, 4}}";
    if (has_colon_range(code))
        return "a range is range(first, last) or range(first, step, last), a part of a vector v:range(i, j)";
    if (contains(code, "%") || contains(code, "# ")) return kCommentHint;
    if (contains(code, "\\")) return "A\\b is written solve(A, b)";
    static const std::regex kBeginsWithDigit(R"(\d+[A-Za-z_]\w*)");
    if (std::regex_match(near, kBeginsWithDigit)) return "a name begins with a letter";
    if (contains(code, "@(")) return "a function is written function(x) return x^2 end";
    return {};
}

}  // namespace dynlab::inline scripting
