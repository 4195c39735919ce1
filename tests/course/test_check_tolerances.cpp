#include <gmock/gmock.h>

#include <algorithm>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_check_tolerances {

/// How the answers of a lesson's worked solution are moved: Lua that fills `move[name]`, functions of an answer. `e` is
/// the sign, and `inside` whether the answer must stay within what checks.lua allows or leave it.
struct Moved {
    const char* lesson;
    const char* moves;
    std::vector<std::string> untouched = {};  ///< checks of what is not moved
};

void PrintTo(const Moved& moved, std::ostream* out) {
    *out << moved.lesson;
}

const std::vector<Moved> kMoved = {
    {"01_process_models",
     R"(move.settling_time = scaled(0.05, 0.25)
move.exchanger_reading = scaled(vector{0.01, 0.05}, vector{0.08, 0.3})
move.G_exchanger = scaled(0.01, 0.06)
move.overshoot = scaled(0.03, 0.15)
move.suspension_reading = scaled(vector{0.01, 0.04, 0.02}, vector{0.1, 0.3, 0.15})
move.G_suspension = scaled(0.004, 0.05))"},
    {"02_least_squares",
     R"(for _, name in ipairs{"line", "rmse", "ct", "dt", "ct_noisy", "dt_noisy"} do move[name] = scaled(4e-4, 1e-2) end
move.paris = shifted(0.001, 0.02)
move.monte_carlo = function(x) return x + e*x[2]*(inside and vector{0.2, 0.1} or vector{1.5, 0.6}) end)"},
    {"03_crane",
     R"(move.discarded = shifted(vector{-0.05, 0.05}, vector{-6, 6})
move.rest_angle = shifted(5e-4, 5e-3)
move.G_position = scaled(0.003, 0.3)
move.G_angle = function(G)  -- another gain and another time scale
    local c = inside and 1 + 0.0005*e or 1 + 0.2*e
    local function stretched(polynomial)
        local all = {}
        for k = 1, #polynomial do all[k] = polynomial[k]*c^(#polynomial - k) end
        return all
    end
    return tf(stretched(G.num), stretched(G.den))*(inside and 1.002 or 1.3)
end
move.fits = shifted(0.3, 5)
move.free_swing = scaled(0.005, 0.06))"},
    {"03_workflow",
     R"(move.linear_orders = shifted(0, 1)
move.G_linear = scaled(0.01, 0.15)
move.linear_fit = shifted(0.1, 4)
move.G_heat = scaled(0.02, 0.2)
move.G_dryer = scaled(0.005, 0.3)
move.dryer_fit = shifted(0.1, 40))"},
    {"04_estimators",
     R"(local record
local function estimated(method, near, far)  -- a model of another record, as hands that wrote it down leave no estimate
    return function()
        local factor = 1 + e*(inside and near or far)
        return method(iddata(record.y*factor, record.u, record.Ts))
    end
end
move.record = function(data) record = data; return data end
move.own_without_noise, move.own = scaled(3e-7, 0.05), scaled(3e-7, 0.05)
move.G_lssvf = estimated(function(data) return lssvf(data, {2, 1, 0}, 3) end, 3e-7, 0.01)
move.G_ivsvf = estimated(function(data) return ivsvf(data, {2, 1, 0}, 3) end, 3e-7, 0.01)
move.G_final = estimated(function(data) return tfsrivc(data, 2, 0, {TdMax = 0}) end, 0.01, 0.7)
move.scatter = scaled(0.1, 0.7))",
     {"record"}},
    {"05_thruster",
     R"(move.ring_frequency = scaled(0.02, 0.2)
move.dead_band = shifted(vector{3, -3}, vector{25, -25})
move.delay = shifted(0.002, 0.02)
move.thrust_300 = scaled(0.03, 0.3)
move.model = function(m)
    return {width = m.width, level = m.level*(1 + e*(inside and 0.01 or 0.6)), G = m.G, root = m.root}
end
move.fit = shifted(0.3, 30))"}};

/// The worked solution with every answer moved on its way out.
std::string moved_solution(const Moved& moved, bool inside, int sign) {
    std::string script = quick_solution_of(moved.lesson);
    const std::string end_of_header = "\n-- ---\n";
    const std::size_t place = script.find(end_of_header) + end_of_header.size();
    const std::string prelude = "\nlocal inside, e, move = " + std::string(inside ? "true" : "false") + ", " +
                                std::to_string(sign) +
                                ", {}\n"
                                "local function scaled(near, far)\n"
                                "    return function(x) return x*(1 + e*(inside and near or far)) end\n"
                                "end\n"
                                "local function shifted(near, far)\n"
                                "    return function(x) return x + e*(inside and near or far) end\n"
                                "end\n"
                                "do\n" +
                                std::string(moved.moves) +
                                "\nend\n"
                                "local hand_in = answer\n"
                                "local function answer(name, value)\n"
                                "    hand_in(name, move[name](value))\n"
                                "end\n";
    return script.insert(place, prelude);
}

class check_tolerances : public ::testing::TestWithParam<Moved> {};

void expect_fair_marks(const Moved& moved, const Workbench& bench, const std::string& name, bool inside) {
    SCOPED_TRACE(name);
    const auto result = nlohmann::json::parse(bench.read("out/results/" + name + "/results.json"));
    const auto& ours = result.at("extra_data").at("dynlab");
    EXPECT_EQ(ours.at("trouble"), "");
    for (const auto& check : ours.at("checks")) {
        const std::string id = check.at("id");
        const bool looks_elsewhere =
            id == "figures" || std::find(moved.untouched.begin(), moved.untouched.end(), id) != moved.untouched.end();
        EXPECT_EQ(check.at("earned") == check.at("points"), inside || looks_elsewhere)
            << id << ": " << check.at("message");
    }
}

// oracle: the tolerances that each checks.lua states with its reasons: answers moved by less, up and down, get full
// marks everywhere, moved by more they lose some at every check that looks at them
TEST_P(check_tolerances, are_neither_harsh_nor_lenient) {
    const Moved& moved = GetParam();
    const Workbench bench;
    for (const auto& [direction, sign] : {std::pair("up", 1), std::pair("down", -1)}) {
        bench.write(std::string("in/inside_") + direction + "/analysis.lua", moved_solution(moved, true, sign));
        bench.write(std::string("in/outside_") + direction + "/analysis.lua", moved_solution(moved, false, sign));
    }
    bench.write("secret", "chosen by a test");
    const ChildResult graded = bench.dynlab({"grade", "in", "--lesson", moved.lesson, "--out", "out", "--secret",
                                             "secret", "--isolation", GradingBench::level(), "--no-pdf"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    for (const char* direction : {"up", "down"}) {
        expect_fair_marks(moved, bench, std::string("inside_") + direction, true);
        expect_fair_marks(moved, bench, std::string("outside_") + direction, false);
    }
}

INSTANTIATE_TEST_SUITE_P(all, check_tolerances, ::testing::ValuesIn(kMoved),
                         [](const auto& test) { return std::string(test.param.lesson); });

}  // namespace test_check_tolerances
}  // namespace dynlab::test
