// Models, data and figures for other programs, and back. Oracles: these programs themselves, which compute from the
// files what dynlab computed: Octave (its package control, filter), Python (numpy, scipy.signal), gnuplot; the guide's
// code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "platform/atomic_file.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_interchange {
using testing::HasSubstr;

/// The code of one language in the guide.
std::string code_of_guide(const std::string& language) {
    const std::string guide = read_text(DYNLAB_SOURCE_DIR "/engine/scripting/reference/guides/guide-interchange.md");
    const std::size_t begin = guide.find("```" + language + "\n") + language.size() + 4;
    return guide.substr(begin, guide.find("\n```", begin) - begin) + "\n";
}

/// The files of the guide's code, and beside them what dynlab computes from the same models.
const Workbench& files() {
    static const Workbench bench;
    static const ChildResult made = [] {
        bench.write("work.lua", code_of_guide("lua") + R"code(
local H = c2d(tf({2, 3}, {1, 0.5, 4}), 0.1)
local t = linspace(0, 5, 51)
local w = vector{0.5, 2, 5}
local answer = freqresp(tf({2, 3}, {1, 0.5, 4}), w)
save_mat("more.mat", {H = H, S = ss(tf({2, 3}, {1, 0.5, 4})), y = lsim(P, u, 0.1), t = t,
  step = step(tf({2, 3}, {1, 0.5, 4}), t), u = u, gain = answer.abs})
local late = c2d(G, 0.1)
save_json("more.json", {late = late, late_y = lsim(late, u, 0.1), H = H, y = lsim(P, u, 0.1), t = t, step = step(tf({2, 3}, {1, 0.5, 4}), t)})
step(G)
save(plot(t, sin(t), "it's", {xlabel = "time (s)"}), "sine.gp")
)code");
        return bench.dynlab({"run", "--gnuplot", "work.lua"});
    }();
    EXPECT_EQ(made.exit_code, 0) << made.error_output;
    return bench;
}

bool runs(const std::string& command) {
    return files().shell(command + " >/dev/null 2>&1").exit_code == 0;
}

double number_after(const std::string& text, const std::string& name) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, std::regex(name + " ([-+.0-9e]+)"))) << name << " in\n" << text;
    return found.empty() ? NAN : std::stod(found[1]);
}

TEST(interchange, octave_computes_the_same_from_the_file_and_gives_a_model_back) {
    if (!runs("octave-cli -q --eval 'pkg load control'"))
        GTEST_SKIP() << "octave with its package control is not installed";
    files().write("read.m", R"code(pkg load control
S = load('work.mat'); M = load('more.mat');
G = tf(S.G.num, S.G.den);
printf('gain %.12g\n', dcgain(G));
printf('delay %.12g\n', S.G.IODelay);
H = c2d(G, 0.1); [num, den] = tfdata(H, 'vector');
printf('discrete %.12g\n', max(abs([num(end-1:end) - M.H.num, den - M.H.den])));
y = step(G, M.t); printf('step %.12g\n', max(abs(y(:) - M.step(:))));
printf('arx %.12g\n', max(abs(filter(S.P.B, S.P.A, M.u(:)) - M.y(:))));
printf('response %.12g\n', max(abs(abs(squeeze(freqresp(G, [0.5 2 5]))(:)) - M.gain(:))));
printf('system %.12g\n', dcgain(ss(M.S.A, M.S.B, M.S.C, M.S.D)));
printf('samples %d %d\n', rows(S.data.y), rows(S.data.u));
P = tf(S.P.num, S.P.den, S.P.Ts); printf('same %.12g\n', abs(dcgain(P) - sum(S.P.B)/sum(S.P.A)));
printf('name %s\n', S.data.OutputName{1});
[num, den] = tfdata(feedback(G, 1), 'vector'); R = struct('num', num, 'den', den, 'Ts', 0);
save('-v7', 'back.mat', 'R');
)code");
    const ChildResult read = files().shell("octave-cli -q read.m");
    ASSERT_EQ(read.exit_code, 0) << read.error_output;
    const std::string& reported = read.output;
    EXPECT_NEAR(number_after(reported, "gain"), 0.75, 1e-10);
    EXPECT_EQ(number_after(reported, "delay"), 0.5);
    for (const char* difference : {"discrete", "step", "arx", "response", "same"})
        EXPECT_NEAR(number_after(reported, difference), 0, 1e-8) << difference;
    EXPECT_NEAR(number_after(reported, "system"), 0.75, 1e-10);
    EXPECT_THAT(reported, HasSubstr("samples 635 635\n"));
    EXPECT_THAT(reported, HasSubstr("name y1\n"));
    const ChildResult back = files().dynlab(
        {"run", "-e", "local T = tf(load('back.mat').R) print(string.format('gain %.12g', dcgain(T)), #T.den)"});
    EXPECT_NEAR(number_after(back.output, "gain"), 3. / 7, 1e-9) << back.error_output;
}

TEST(interchange, python_computes_the_same_from_json_and_csv_and_gives_a_model_back) {
    const std::string python = "/usr/bin/python3";
    if (!runs(python + " -c 'import numpy, scipy.signal'"))
        GTEST_SKIP() << "python3 with numpy and scipy is not installed";
    files().write("read.py", code_of_guide("python") + R"code(
M = json.load(open("more.json"))
num, den, Ts = sg.cont2discrete((S["G"]["num"], S["G"]["den"]), 0.1)
print("discrete", float(max(abs(num.flatten()[1:] - M["H"]["num"]).max(), abs(den - M["H"]["den"]).max())))
t, response = sg.step(G, T=np.array(M["t"]))
print("step", float(abs(response - M["step"]).max()))
print("arx", float(abs(y - M["y"]).max()))
late = sg.lfilter(M["late"]["B"], M["late"]["F"], S["data"]["u"])
print("late", float(abs(late - M["late_y"]).max()), M["late"]["B"][:5])
print("csv", float(abs(csv["y1"] - S["data"]["y"]).max()), len(csv))
print("delay", S["G"]["IODelay"], S["P"]["kind"], len(S["P"]["names"]))
json.dump({"R": {"num": [5], "den": [1, 2, 3]}}, open("back.json", "w"))
)code");
    const ChildResult read = files().shell(python + " read.py");
    ASSERT_EQ(read.exit_code, 0) << read.error_output;
    for (const char* difference : {"discrete", "step", "arx", "late"})
        EXPECT_NEAR(number_after(read.output, difference), 0, 1e-8) << difference;
    EXPECT_NEAR(number_after(read.output, "csv"), 0, 1e-5) << "7 digits";
    EXPECT_THAT(read.output, HasSubstr("[0.0, 0.0, 0.0, 0.0, 0.0]"));
    EXPECT_THAT(read.output, HasSubstr("delay 0.5 idpoly 4"));
    const ChildResult back = files().dynlab({"run", "-e", "print(dcgain(tf(load('back.json').R)))"});
    EXPECT_THAT(back.output, testing::StartsWith("1.66")) << back.error_output;
}

TEST(interchange, gnuplot_draws_the_figures_again_from_their_files) {
    const Workbench& bench = files();
    const std::string name = "work_out/" + bench.shell("cd work_out && ls *.gp").output;
    const std::string stem = name.substr(0, name.find('.'));
    const auto drawn = [&](const std::string& pdf) {
        const ChildResult pixels = bench.shell("pdftoppm -gray -r 40 " + pdf + " | md5sum");
        EXPECT_EQ(pixels.exit_code, 0);
        return pixels.output;
    };
    const std::string before = drawn(stem + ".pdf");
    ASSERT_EQ(bench.shell("rm " + stem + ".pdf && cd work_out && gnuplot *.gp").exit_code, 0);
    EXPECT_EQ(drawn(stem + ".pdf"), before);
    ASSERT_EQ(bench.shell("gnuplot sine.gp").exit_code, 0);
    EXPECT_THAT(bench.shell("pdftotext sine.pdf -").output, HasSubstr("time (s)"));
    EXPECT_EQ(bench.dynlab({"run", "work.lua"}).exit_code, 0);
    EXPECT_EQ(bench.shell("ls work_out/*.gp").exit_code, 2) << "those of an earlier run are removed";
}

TEST(interchange, refuses_what_is_no_model) {
    for (const auto& [code, words] :
         {std::pair("tf({num = 'a', den = {1, 2}})", "the field num of a model table must be a vector"),
          {"tf({num = vector{1}, den = vector{1, 2}, Ts = 'x'})", "the field Ts of a model table must be a number"},
          {"tf({num = vector{1}, den = zeros(2)})", "denominator"},
          {"save_json('a.mat', {x = 1})", "must end in .json"},
          {"save_json('a.json', {f = print})", "'f' must be"}}) {
        const ChildResult refused = files().dynlab({"run", "-e", code});
        EXPECT_EQ(refused.exit_code, 1) << code;
        EXPECT_THAT(refused.error_output, HasSubstr(words)) << code;
    }
}

}  // namespace test_interchange
}  // namespace dynlab::test
