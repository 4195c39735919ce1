// The guided demonstrations. Oracles: their scripts, and for the claims of their texts the systems that made the data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "documents/text_lines.h"
#include "workflow/demonstration.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_demonstrations {
using testing::HasSubstr;

/// Assertions in Lua that are run behind a demonstration, by its name.
const std::map<std::string, std::string>& claims() {
    static const std::map<std::string, std::string> kClaims = {
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
        // Second route: the poles and the gain of the system that made the data.
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
    return kClaims;
}

class demonstration_pages : public testing::TestWithParam<std::string> {};

TEST_P(demonstration_pages, show_all_that_their_scripts_say_and_claim_nothing_false) {
    const WorkFolder work;
    const Demonstration demonstration = find_demonstration(GetParam());
    const std::string source = read_file(demonstration.script);
    const RunRecord record =
        work.run(source + "\n-- %% id=claims\n" + claims().at(GetParam()), "demonstration.lua").record;
    ASSERT_FALSE(record.error) << record.error->text();
    std::string shown;
    for (const std::string& page : pages_of(read_percent_script(demonstration.script), record)) shown += page + '\n';
    for (const std::string& line : lines_of(source.substr(source.find("-- %%")))) {
        if (line.starts_with("-- %%") || line.empty()) continue;
        const bool is_text = line.starts_with("--");
        EXPECT_THAT(shown,
                    HasSubstr((is_text ? line.substr(std::min<std::size_t>(3, line.size())) : "> " + line) + '\n'));
    }
    std::size_t figures = 0;
    for (auto at = shown.find("\nfigure: "); at != shown.npos; at = shown.find("\nfigure: ", at + 1)) ++figures;
    EXPECT_GE(figures, 2u);
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& [name, claim] : claims()) all.push_back(name);
    return all;
}
INSTANTIATE_TEST_SUITE_P(all, demonstration_pages, testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

TEST(demonstrations, are_all_tested_and_have_a_title) {
    std::vector<std::string> found;
    for (const Demonstration& one : dynlab::demonstrations()) {
        EXPECT_NE(one.title, "") << one.name;
        found.push_back(one.name);
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(names()));
}

TEST(demonstrations, with_an_unknown_name_suggest_the_nearest_or_list_all) {
    EXPECT_THAT(error_of([] { find_demonstration("delay"); }), HasSubstr("did you mean 'delays'?"));
    EXPECT_THAT(error_of([] { find_demonstration("zzzzzzzzzz"); }), HasSubstr("getting_started, delays"));
}

// oracle: the cell with the error is the last
TEST(demonstrations, that_stop_show_the_pages_up_to_the_error) {
    const PercentScript script =
        parse_percent_script("-- %%\nprint('one')\n-- %%\nerror('two')\n-- %%\nprint('three')\n", "a.lua");
    const auto pages = pages_of(script, WorkFolder().run(script).record);
    ASSERT_EQ(pages.size(), 2u);
    EXPECT_EQ(pages[0], "> print('one')\n\none\n");
    EXPECT_EQ(pages[1], "> error('two')\n");
}

}  // namespace test_demonstrations
}  // namespace dynlab::test
