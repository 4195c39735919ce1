// The guided demonstrations. Oracles: their scripts, and for what their texts claim the systems that made the data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "platform/atomic_file.h"
#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_demo {
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// The scripts by the names of their demonstrations.
std::map<std::string, fs::path> scripts() {
    std::map<std::string, fs::path> found;
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "lessons" / "demos"))
        found[entry.path().stem().string().substr(3)] = entry.path();
    return found;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(demo, list_names_each_demonstration_in_order) {
    const Workbench bench;
    const ChildResult result = bench.dynlab({"demo", "--list"});
    EXPECT_EQ(result.exit_code, 0);
    std::vector<std::string> names;
    for (const std::string& line : lines_of(result.output)) names.push_back(line.substr(0, line.find(' ')));
    EXPECT_THAT(names, testing::ElementsAre("getting_started", "delays", "order_selection", "irregular_sampling",
                                            "inside_srivc", "monte_carlo", "robot_arm", "frequency", "recursive"));
    EXPECT_EQ(names.size(), scripts().size());
    EXPECT_THAT(result.output, HasSubstr("A dead time that is not a whole number of samples\n"));
    EXPECT_EQ(bench.dynlab({"demo"}).output, result.output);
}

TEST(demo, each_runs_without_a_terminal_and_tells_everything_its_script_says) {
    for (const auto& [name, script] : scripts()) {
        const Workbench bench(Workbench::Memory::kShared);
        const ChildResult result = bench.dynlab({"demo", name});
        EXPECT_EQ(result.exit_code, 0) << name;
        EXPECT_THAT(result.error_output, IsEmpty()) << name;
        const std::string source = read_file(script);
        for (const std::string& line : lines_of(source.substr(source.find("-- %%")))) {
            if (line.rfind("-- %%", 0) == 0 || line.empty()) continue;
            const bool is_text = line.rfind("--", 0) == 0;
            const std::string told = is_text ? line.substr(std::min<std::size_t>(3, line.size())) : "> " + line;
            EXPECT_THAT(result.output, HasSubstr(told + '\n')) << name;
        }
        int figures = 0;
        for (const std::string& line : lines_of(result.output)) {
            if (line.rfind("figure: ", 0) != 0) continue;
            const std::string number = "/0" + std::to_string(++figures) + "-";
            EXPECT_THAT(line, AllOf(HasSubstr(name + "_out"), HasSubstr(number)));
            EXPECT_THAT(bench.read(line.substr(8)), StartsWith("%PDF")) << name;
        }
        EXPECT_GE(figures, 2) << name;
    }
}

TEST(demo, what_their_texts_claim_is_true) {
    const std::map<std::string, std::string> claims = {
        {"getting_started",
         "for k, true_value in ipairs({4, 3, 2}) do assert(math.abs(G.param[k] - true_value) < 3*G.std[k]) end\n"
         "assert(fit(validation, G) < 100 and select(2, resid(validation, G)).white)\n"},
        {"delays",
         "assert(math.abs(G.IODelay - 0.735) < 3*G.std[4] and G.std[4] < Ts/5)\n"
         "local loss, valleys = G.report.delay_loss, 0\n"
         "for k = 2, #loss - 1 do if loss[k] < loss[k - 1] and loss[k] < loss[k + 1] then valleys = valleys + 1 end "
         "end\n"
         "assert(valleys >= 3 and caught.num[1] < 0 and fit(data, caught) < fit(data, G) - 20)\n"
         "assert(math.abs(G.IODelay - caught.IODelay - math.pi/10) < 0.05)\n"},
        {"order_selection",
         "local rows, largest = candidates.rows, selcstruc(candidates, 'fit')\n"
         "assert(#G.den == 4 and #G.num == 2 and #largest.den == 4 and #largest.num == 3)\n"
         "assert(#rows == 6 and #rows[6].undetermined == 1 and #candidates.best.undetermined == 0)\n"
         "for k = 2, 5 do assert(rows[k].validation_fit > rows[k - 1].validation_fit + 0.5) end\n"
         "assert(math.abs(rows[6].validation_fit - rows[5].validation_fit) < 0.5)\n"
         "for k, true_value in ipairs({1.8, 4.8, 4, 1, 2}) do\n"
         "  assert(math.abs(G.param[k] - true_value) < 3*G.std[k])\n"
         "end\n"},
        {"irregular_sampling",
         "for k, true_value in ipairs({2.8, 4, 5}) do assert(math.abs(G.param[k] - true_value) < 3*G.std[k]) end\n"
         "assert(math.abs(wrong.param[1] - 2.8) > 5*wrong.std[1] and G.report.white and not wrong.report.white)\n"},
        {"inside_srivc",
         "assert(math.abs(first.param[1] - 4) > 1 and math.abs(G.param[1] - 4) < 3*G.std[1])\n"
         "local changes = G.report.changes\n"
         "for k = 3, #changes do assert(changes[k] < 0.1*changes[k - 1]) end\n"
         "for k = 1, 3 do assert(math.abs(coe(data, {1, 2, 0}, {Tol = 1e-12}).param[k] - G.param[k]) < 1e-7) end\n"},
        {"monte_carlo",
         "for k = 1, 3 do\n"
         "  local function bias(method) return math.abs(method.bias[k])/(method.std[k]/math.sqrt(study.runs)) end\n"
         "  assert(bias(study.lssvf) > 10 and bias(study.ivsvf) < 3.5 and bias(study.srivc) < 3.5)\n"
         "  local bound = study.srivc.cramer_rao_std[k]\n"
         "  assert(study.lssvf.std[k] < 0.9*bound and math.abs(study.srivc.std[k]/bound - 1) < 0.2)\n"
         "  assert(math.abs(study.srivc.reported_std[k]/study.srivc.std[k] - 1) < 0.1)\n"
         "end\n"
         "assert(study.runs == 200)\n"},
        // Second route: the poles and the gain of the system that made the records.
        {"frequency",
         "for k, true_value in ipairs({0.8, 4}) do assert(math.abs(G.param[k] - true_value) < 4*G.std[k]) end\n"
         "assert(sum(F.odd.distortion) > 20*math.abs(sum(F.even.distortion)) and sum(F.odd.power) > "
         "3*sum(F.odd.noise))\n"
         "assert(F.output_power > 100*F.noise_power and dcgain(G) > dcgain(Gs) + 3*G.std[3]/4)\n"
         "assert(math.abs(dcgain(Gs) - 1) < 0.05 and dcgain(G) > 1.05)\n"},
        {"recursive",
         "assert(average.param[1] > 1.1 and average.param[1] < 1.9)\n"
         "local function misses(G)\n"
         "  local h, far, count = G.history, 0, 0\n"
         "  for i = 1, #h.t do\n"
         "    local k = math.floor(h.t[i]/Ts + 1.5)\n"
         "    if k > 500 and math.abs(k - N/2) > 500 then\n"
         "      count = count + 1\n"
         "      if math.abs(h.theta[{i, 1}] - a[k]) > 3*h.std[{i, 1}] then far = far + 1 end\n"
         "    end\n"
         "  end\n"
         "  return far/count\n"
         "end\n"
         "assert(misses(G) < 0.1 and misses(walk) < 0.2 and misses(slow) > 0.2)\n"
         "assert(math.abs(G.param[2] - 3) < 4*G.std[2] and quick.std[1] > 1.5*G.std[1])\n"},
        // Second routes: the output error of a difference equation, and peaks of a spectrum without any model.
        {"robot_arm",
         "assert(A.report.prediction_fit_percent > 97.5 and A.report.prediction_fit_percent < 98.5)\n"
         "assert(A.report.fit_percent < 25)\n"
         "local O = oe(first, {6, 6, 1}, {InitialState = 'estimate'})\n"
         "assert(math.abs(O.report.fit_percent - G.report.fit_percent) < 0.01 and G.report.fit_percent > 97.5)\n"
         "assert(fit(second, G) > 96.5 and fit(second, G) > fit(second, G0) + 3)\n"
         "local _, S = etfe(raw:remove_mean(), {smooth = 4})\n"
         "for k, range in ipairs{{0.25, 0.5}, {0.6, 1}} do\n"
         "  local best, most = 0, 0\n"
         "  for j = 1, #S.w do\n"
         "    if S.w[j] > range[1] and S.w[j] < range[2] and S.magnitude[j] > most then\n"
         "      best, most = S.w[j], S.magnitude[j]\n"
         "    end\n"
         "  end\n"
         "  assert(math.abs(best - frequency[2*k]) < 0.02)\n"
         "end\n"
         "local _, left = resid(second, G, {quiet = true})\n"
         "assert(not left.white and left.outputs[1].inputs[1].p_value > 0.05)\n"
         "assert(fit(second, N, {k = 1}) > fit(second, G) + 1.5 and fit(second, N) < fit(second, G))\n"},
    };
    const Workbench bench(Workbench::Memory::kShared);
    for (const auto& [name, script] : scripts()) {
        ASSERT_TRUE(claims.count(name)) << name;
        bench.write("claim.lua", read_file(script) + "\n-- %% id=claims\n" + claims.at(name));
        const ChildResult result = bench.dynlab({"run", "claim.lua"});
        EXPECT_EQ(result.exit_code, 0) << name << ": " << result.error_output;
    }
}

TEST(demo, wrong_names_and_options_are_told) {
    const Workbench bench;
    const ChildResult unknown = bench.dynlab({"demo", "delay"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.error_output, HasSubstr("did you mean 'delays'?"));
    EXPECT_THAT(bench.dynlab({"demo", "zzzzzzzzzz"}).error_output, HasSubstr("getting_started, delays"));
    EXPECT_EQ(bench.dynlab({"demo", "--list", "delays"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"demo", "--wrong"}).exit_code, 2);
    EXPECT_THAT(bench.files(), IsEmpty());
}

TEST(demo, a_terminal_gets_a_menu_and_pages_that_wait) {
    const Workbench bench;
    Terminal terminal(bench, {"demo"});
    EXPECT_THAT(terminal.until("q to leave: "), AllOf(HasSubstr("1  getting_started"), HasSubstr("2  delays")));
    terminal.enter("99");
    EXPECT_THAT(terminal.until("q to leave: "), HasSubstr("There is no '99'"));
    terminal.enter("1");
    EXPECT_THAT(terminal.until("q leaves -- "), AllOf(HasSubstr("-- 1 of "), Not(HasSubstr("idplot"))));
    terminal.enter("");
    EXPECT_THAT(terminal.until("q leaves -- "), AllOf(HasSubstr("-- 2 of "), HasSubstr("idplot")));
    terminal.enter("q");
    terminal.until("q to leave: ");
    terminal.enter("inside_srivc");
    terminal.until("q leaves -- ");
    terminal.enter("q");
    terminal.until("q to leave: ");
    terminal.enter("q");
    EXPECT_EQ(terminal.wait_for_end(), 0);
}

TEST(demo, control_d_and_control_c_leave_the_menu) {
    const Workbench bench;
    Terminal closed(bench, {"demo"});
    closed.until("q to leave: ");
    closed.type(kControlD);
    EXPECT_EQ(closed.wait_for_end(), 0);
    Terminal interrupted(bench, {"demo", "delays"});
    interrupted.until("q leaves -- ");
    interrupted.type(kControlC);
    EXPECT_EQ(interrupted.wait_for_end(), 130);
}

}  // namespace test_demo
}  // namespace dynlab::test
