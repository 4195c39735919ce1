#include <string>
#include <string_view>

#include "scripting/runtime/matlab_hints.h"

namespace dynlab::inline scripting {
namespace {

/// Words, and what is written here in their place.
struct NameHint {
    std::string_view names;
    Message hint;
};

const auto& name_hints() {
    static const NameHint hints[] = {
        {"CARX", Message("write lssvf(data, {na, nb, nk}, lambda), or ivsvf(data, {na, nb, nk}, lambda) if the "
                         "equation error is not white")},
        {"CBJ", Message("write rivc(data, {nb, nc, nd, nf, nk})")},
        {"ans", Message("store the result in a variable: local m = mean(v)")},
        {"axis", Message("set x_range = {a, b} and y_range = {a, b} in the options of plot")},
        {"bar", Message("write plot(x, y, {style = \"bars\"})")},
        {"cd pwd", Message("scripts cannot change the folder; they can write files only in the script's folder and the "
                           "output folder")},
        {"cell", Message("write a Lua table: local c = {}", "{}")},
        {"cell2mat", Message("write vector(t) for a Lua table t of numbers")},
        {"clc", Message("press Ctrl-L at the prompt to clear the screen")},
        {"clear", Message("every run and every session starts without variables; clear a variable with x = nil")},
        {"close", Message("figures do not need to be closed; dynlab adds them to the document")},
        {"dir ls", Message("scripts cannot list folders; load(name) reads a file by its name")},
        {"disp", Message("write print(x)")},
        {"dofile", Message("write require(\"name\") for name.lua in the script's folder")},
        {"eps", Message("write 2^-52")},
        {"exist", Message("a variable without a value is nil: x == nil")},
        {"fclose fopen", Message("read data with load(name) and write data with save_csv(path, data)")},
        {"fprintf printf", Message("write print(string.format(\"%.3f\", x))")},
        {"grid", Message("the grid is always drawn")},
        {"fzero", Message("write find(gt(v, 0))[1] for a sign change in a vector; dynlab has no equation solver")},
        {"hold", Message("plot all curves in one call: plot(x1, y1, \"a\", x2, y2, \"b\")")},
        {"horzcat reshape", Message("write matrix{v1, v2}: vectors are the columns")},
        {"io",
         Message("read data with load(name), write data with save_csv(path, data), and print values with print(x)")},
        {"isempty", Message("write #v == 0")},
        {"isnan",
         Message(
             "functions that require finite values report which vector contains NaN; for a number x, write x ~= x")},
        {"legend", Message("name the curves: plot(x1, y1, \"first\", x2, y2, \"second\")")},
        {"length numel len", Message("write #v")},
        {"line", Message("write plot(x, y)")},
        {"lsode", Message("lsim(G, u, Ts) simulates linear differential equations; for nonlinear equations, use lsim "
                          "with a model from idgrey")},
        {"mldivide", Message("write solve(A, b)")},
        {"nnz", Message("write #find(mask)")},
        {"num2str", Message("write string.format(\"%g\", x)")},
        {"ode45", Message("write lsim(idgrey(f, {}, {states = 2, x0 = {1, 0}}), u, Ts) with function f(t, x, u, p) "
                          "return {dx1, dx2} end",
                          "{}")},
        {"pi", Message("write math.pi")},
        {"rem mod", Message("write a % b, which has the sign of b, or math.fmod(a, b), which has the sign of a")},
        {"inf Inf", Message("write math.huge")},
        {"NaN nan", Message("write 0/0")},
        {"scatter", Message("write plot(x, y, {style = \"points\"})")},
        {"set", Message("specify the options of plot: plot(x, y, {xlabel = \"time (s)\"})")},
        {"size", Message("write #v for a vector, A.rows and A.columns for a matrix")},
        {"sprintf", Message("write string.format(\"%.3f\", x)")},
        {"sqrtm", Message("write sqrt(x) for the element-wise square root")},
        {"stairs", Message("write plot(x, y, {style = \"stairs\"})")},
        {"stem", Message("write plot(x, y, {style = \"stems\"})")},
        {"strcmp", Message("write a == b")},
        {"strcat", Message("write a .. b")},
        {"struct", Message("write {name = value}")},
        {"title", Message("set the title in the options: plot(x, y, {title = \"...\"})")},
        {"transpose", Message("write A:t()")},
        {"vertcat", Message("write vector{v1, v2}")},
        {"whos", Message("write who()")},
        {"xlabel", Message("set the label in the options: plot(x, y, {xlabel = \"time (s)\"})")},
        {"xlim", Message("set the limits in the options: plot(x, y, {x_range = {a, b}})")},
        {"ylabel", Message("set the label in the options: plot(x, y, {ylabel = \"output\"})")},
        {"ylim", Message("set the limits in the options: plot(x, y, {y_range = {a, b}})")},
        {"aic", Message("use the fields aic, bic and fpe of G.report, or of the rows of srivcstruc(data, ...)")},
        {"all", Message("write #find(mask) == #v")},
        {"angle", Message("write freqresp(G, w).arg, or bode_values(G, w) for degrees")},
        {"any", Message("write #find(mask) > 0")},
        {"cellfun", Message("write a loop: for i, x in ipairs(t) do ... end")},
        {"chol", Message("dynlab has no Cholesky factorization; solve(A, b) solves A*x = b")},
        {"cond rank", Message("write lsq(Phi, y); its result contains the condition number")},
        {"conj", Message("complex numbers have the fields re, im, abs and arg")},
        {"cpsd pwelch tfestimate", Message("write spa(data) or etfe(data), which return frequency responses")},
        {"ctrb obsv", Message("dynlab has no controllability or observability matrix; place(A, B, poles) reports a "
                              "system that is not controllable")},
        {"cumprod", Message("write exp(cumsum(log(v))) for a vector of positive values")},
        {"d2d", Message("write c2d(d2c(G), Ts)")},
        {"date datetime", Message("scripts have no access to the system or the date")},
        {"db mag2db", Message("write 20*log10(x)")},
        {"deconv",
         Message("dynlab has no polynomial division; pole(tf({1}, a)) returns the roots of the polynomial a")},
        {"double", Message("every number is in double precision; tonumber(text) converts a string")},
        {"exit quit", Message("a script ends after its last line")},
        {"expm", Message("use lsim(G, u, Ts) or c2d(G, Ts), which compute the matrix exponential")},
        {"fix", Message("write floor(x), or ceil(x) for negative x")},
        {"fliplr flipud", Message("write v:select(range(#v, -1, 1))")},
        {"fminsearch lsqnonlin",
         Message("dynlab has no general minimizer; estimators such as srivc and procsrivc fit models")},
        {"format", Message("write print(string.format(\"%.10g\", x)) for more digits")},
        {"fpe", Message("use the fields aic, bic and fpe of the rows of srivcstruc(data, ...)")},
        {"freqz", Message("write bode(G) or freqresp(G, w)")},
        {"getenv", Message("scripts have no access to the system")},
        {"getTrend", Message("write detrend(data), or mean(data.y) for the mean")},
        {"getpar", Message("write G.param")},
        {"hist", Message("write histogram(v)")},
        {"iddemo", Message("in a terminal, run: dynlab demo")},
        {"idnlarx nlarx", Message("write narx(data, {na, nb, nk}, {degree = 2}) for a polynomial difference equation")},
        {"imag", Message("write z.im for the imaginary part of a complex number z")},
        {"initial", Message("write lsim(G, u, t, {x0 = ...}) with an input of zeros")},
        {"input", Message("scripts have no interactive input; put the value in a variable")},
        {"int32", Message("write round(x)")},
        {"isa", Message("write type(x)")},
        {"iscell", Message("write type(x) == \"table\"")},
        {"isfield", Message("write t.name ~= nil; a missing field is nil")},
        {"isnumeric", Message("write type(x) == \"number\"")},
        {"keyboard",
         Message("write print(x); to inspect the script's variables at the prompt, run: dynlab run -i FILE")},
        {"lower", Message("write string.lower(text)")},
        {"meshgrid", Message("write two loops: for i = 1, m do for j = 1, n do ... end end")},
        {"minreal", Message("dynlab does not cancel poles and zeros; srivcstruc(data, ...) finds a structure in which "
                            "no zero cancels a pole")},
        {"nparams", Message("write #G.param")},
        {"null None", Message("write nil")},
        {"optimset", Message("specify the options in the call: srivc(data, {1, 2, 0}, {MaxIter = 50})")},
        {"prctile", Message("write sort(v)[ceil(#v*p/100)]")},
        {"quantile", Message("write sort(v)[ceil(#v*p)]")},
        {"pinv", Message("write lsq(Phi, y) for least squares")},
        {"qr", Message("write lsq(Phi, y) for least squares, or solve(A, b) for linear equations")},
        {"randi", Message("write math.random(a, b)")},
        {"randperm", Message("write local _, order = sort(rand(n))")},
        {"randomseed", Message("write rng(seed)")},
        {"real", Message("write z.re for the real part of a complex number z")},
        {"regexp", Message("write string.match(text, pattern) or string.gmatch")},
        {"repmat", Message("write vector{v, v}, or matrix{v, v} for columns side by side")},
        {"rlocus", Message("write pole(feedback(k*G, 1)) for each gain k")},
        {"setpar", Message("write tf(num, den) with the required values")},
        {"sisotool", Message("use margin(L), place or lqr")},
        {"ssdata", Message("write G.A, G.B, G.C and G.D of a state-space model")},
        {"strsplit", Message("write string.gmatch(text, \"[^,]+\") in a loop")},
        {"svd", Message("write eig(A:t()*A): the square roots of the eigenvalues are the singular values")},
        {"trace", Message("add the elements A[{i, i}] in a loop")},
        {"trapz", Message("write sum(y)*Ts for the integral, or cumsum(y)*Ts for the integral up to each sample")},
        {"unique", Message("write sort(v) and omit repeated values")},
        {"upper", Message("write string.upper(text)")},
        {"zpkdata", Message("write zero(G) and pole(G), and G.num[1]/G.den[1] for the gain")},
        {"allmargin", Message("write margin(G)")},
        {"balred",
         Message(
             "dynlab has no model reduction; srivcstruc(data, {poles = {1, 4}}) shows how many poles the data need")},
        {"comparec", Message("write compare(data, G); fit_measures(data, G).output contains the simulated output")},
        {"conv", Message("write (tf(a, {1})*tf(b, {1})).num for the product of two polynomials")},
        {"cov", Message("use std(v), var(v) and dot(v, w); the covariance of a model is G.covariance")},
        {"etime", Message("call tic() before and toc() after the code")},
        {"filter", Message("write lsim(G, u, Ts) for a transfer function, or idfilt(data, {lower, upper}) for data")},
        {"frd", Message("write idfrd(H, w) for a measured response")},
        {"getcov", Message("write G.covariance")},
        {"getpvec", Message("write G.param for the values and G.std for their standard errors")},
        {"hsrivc", Message("write hammerstein(data, np, nz)")},
        {"idinput", Message("use prbs(n, p), rbs(N, p), multisine({f1, f2}, T, Ts), chirp or sine")},
        {"idpoly", Message("polynomial models come from estimators such as arx, armax, oe and bj; write tf(num, den) "
                           "for a transfer function")},
        {"idss", Message("write ss(A, B, C, D)")},
        {"idtf", Message("write tf(num, den, {IODelay = Td}) with the delay Td in seconds")},
        {"isct isdt", Message("a discrete-time model has a positive G.Ts")},
        {"lpvsrivc", Message("rsrivc(data, {nb, nf, nk}, lambda, {forgetting = 0.99}) tracks parameters that change "
                             "with time; srivc(data, {nb, nf, nk}) fits data at one operating point")},
        {"isstable", Message("write stable(G)")},
        {"misdata", Message("write fillmissing(y) and fillmissing(u, {method = \"previous\"}) before you call iddata")},
        {"idnlgrey",
         Message("write idgrey(f, {k1 = 0.5}, {states = 2}) with function f(t, x, u, p) return {dx1, dx2} end")},
        {"nlgreyest", Message("write greyest(data, m) with a model from idgrey")},
        {"nlhw", Message("write hammerstein(data, ...) for a static characteristic before linear dynamics")},
        {"os",
         Message("scripts have no access to the system or the date; measure times with tic(), toc() and clock()")},
        {"pem", Message("use armax, bj or oe for a discrete-time model, or rivc or coe for a continuous-time model")},
        {"poly", Message("write ((s - r1)*(s - r2)).num with s = tf(\"s\")")},
        {"polyest", Message("write armax(data, {na, nb, nc, nk}), or use bj or oe")},
        {"procest", Message("write procsrivc(data, \"P1D\")")},
        {"rarx recursiveARX recursiveLS",
         Message("write rlssvf(data, {na, nb, nk}, lambda, {forgetting = 0.99}), or use rivsvf or rsrivc")},
        {"residc", Message("write resid(data, G)")},
        {"roots", Message("write pole(tf({1}, p)): the poles of 1/p are the roots of p")},
        {"rpem", Message("write rsrivc(data, {nb, nf, nk}, lambda, {forgetting = 0.99})")},
        {"shadedplot", Message("write figure{curves = {{x = t, y = low, y_upper = high}}}")},
        {"sidgpmf", Message("write n4sid(data, order) for a discrete-time model, or lsgpmf(data, {na, nb, nk}, lambda) "
                            "for a continuous-time model")},
        {"simc", Message("write sim(G, u, Ts, {snr = 10}) with snr in dB")},
        {"spafdr", Message("write spa(data, {w = frequencies})")},
        {"ssest ssregest", Message("write n4sid(data, order)")},
        {"tfdata", Message("write G.num and G.den")},
        {"tfest", Message("use tfsrivc(data, poles, zeros), also for idfrd objects")},
        {"xcorr", Message("write cra(data), or resid(data, G) for the correlations of a model's residuals")},
        {"zpk", Message("write tf(num, den); pole(G) and zero(G) return the roots")},
        {"zpplot", Message("write pzmap(G)")},
        {"False", Message("write false")},
        {"True", Message("write true")},
        {"awgn", Message("write x + sigma*randn(#x), or sim(G, u, Ts, {snr = 10}) with snr in dB")},
        {"contour mesh surf", Message("dynlab has no plots of functions of two variables; plot(x, y1, \"first\", x, "
                                      "y2, \"second\") draws curves")},
        {"continue", Message("write goto continue, and ::continue:: before the end of the loop")},
        {"csvread importdata pd readmatrix readtable", Message("write load(\"file.csv\")")},
        {"from import",
         Message("the functions of dynlab need no import; for your own file tools.lua, write local tools = "
                 "require(\"tools\")")},
        {"gca gcf", Message("every plotting function returns its figure: local fig = plot(x, y)")},
        {"global", Message("a variable is global unless it is declared local: x = 3")},
        {"inverse", Message("write inv(A)")},
        {"np", Message("omit the prefix np: write zeros(n), linspace(a, b, n) or mean(v)")},
        {"numpy", Message("omit the prefix numpy: write zeros(n), linspace(a, b, n) or mean(v)")},
        {"pause", Message("a script runs to its end without pausing; dynlab adds figures to the document")},
        {"plt", Message("omit the prefix plt: write plot(x, y) or another plotting function")},
        {"s", Message("write local s = tf(\"s\") first")},
        {"saveas", Message("write local fig = plot(x, y), then save(fig, \"a.pdf\")")},
        {"split", Message("write data:split(0.6)")},
        {"stepinfo", Message("write step_second_order(data) for a measured step, or damp(G) for a model")},
        {"struc", Message("specify ranges: arxstruc(data, {na = {1, 4}, nb = {1, 4}, nk = {1, 2}})")},
        {"xlsread", Message("write load(\"file.xlsx\")")},
        {"bool", Message("write x ~= 0 for a number; true and false are the logical values")},
        {"contsid_demo", Message("in a terminal, run: dynlab demo")},
        {"contsid_gui", Message("in a terminal, run: dynlab app")},
        {"del", Message("clear a variable with x = nil")},
        {"dict list tuple", Message("write a Lua table: {1, 2, 3} or {gain = 2}")},
        {"doc lookfor", Message("write help(\"lsim\"); to search for a word, write help(\"delay\")")},
        {"e", Message("write exp(x) for e^x, and exp(1) for e")},
        {"enumerate", Message("write for i, x in ipairs(t) do ... end")},
        {"float", Message("write tonumber(text); every number is in double precision")},
        {"import_crane_data", Message("write load(\"crane\")")},
        {"int", Message("write floor(x) or round(x)")},
        {"isinstance", Message("write type(x) == \"number\"")},
        {"pass", Message("an empty block needs no statement: remove pass")},
        {"raise", Message("write error(\"message\")")},
        {"str", Message("write tostring(x), or string.format(\"%.3f\", x)")},
        {"zip", Message("write for i = 1, #v do ... end, with v[i] and w[i]")},
        {"z", Message("write local z = tf(\"z\", Ts) first")},
    };
    return hints;
}

struct MemberHint {
    std::string_view type, names;
    Message hint;
};

/// Fields and methods that the same things have elsewhere.
const auto& member_hints() {
    static const Message kCounting =
        Message("#v counts the elements of a vector; for a matrix, use A.rows and A.columns");
    static const MemberHint hints[] = {
        {"iddata", "Fs", Message("write 1/data.Ts for the sampling frequency; data.Ts is the sampling time")},
        {"iddata", "InputData input", Message("the input is data.u")},
        {"iddata", "OutputData output", Message("the output is data.y")},
        {"iddata", "SamplingInstants", Message("the sampling instants are data.t")},
        {"iddata", "length size", Message("data.N is the number of samples")},
        {"matrix", "column", Message("column j of a matrix is A:col(j)")},
        {"matrix", "T", Message("the transpose of a matrix is A:t()")},
        {"matrix", "length shape size", kCounting},
        {"model", "Denominator denominator", Message("the denominator is G.den")},
        {"model", "Numerator numerator", Message("the numerator is G.num")},
        {"model", "Report", Message("write G.report; the fit is G.report.fit_percent")},
        {"vector", "T", Message("a vector is a column; the transpose of a matrix is A:t()")},
        {"vector", "append insert", Message("vector{v, x} appends x to v")},
        {"vector", "len length shape size", kCounting},
    };
    return hints;
}

/// Whether the word is one of those, between which there are spaces.
bool is_among(std::string_view word, std::string_view words) {
    return !word.empty() && (" " + std::string(words) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

}  // namespace

const Message* matlab_name_hint(std::string_view name) {
    for (const NameHint& one : name_hints())
        if (is_among(name, one.names)) return &one.hint;
    return nullptr;
}

const Message* foreign_member_hint(std::string_view type, std::string_view name) {
    for (const MemberHint& one : member_hints())
        if (one.type == type && is_among(name, one.names)) return &one.hint;
    return nullptr;
}

}  // namespace dynlab::inline scripting
