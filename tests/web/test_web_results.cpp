// The engine as WebAssembly under Node. Oracle: the native program, which runs the same scripts and checks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "web/web_engine.h"

namespace dynlab::test {
namespace test_web_results {
using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kSource = DYNLAB_SOURCE_DIR;
constexpr double kRelative = 1e-9;

json run_in_node(const Workbench& bench, const std::string& words) {
    const ChildResult run =
        bench.shell("node " + (kSource / "tests/web/run_in_node.mjs").string() + " " +
                    (web_engine_folder() / "dynlab.js").string() + " " + kSource.string() + " " + words);
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    return json::parse(run.output);
}

/// Where two values differ by more than what libraries of mathematics differ; numbers in texts count as numbers.
void expect_alike(const json& native, const json& web, const std::string& place, double scale = 0) {
    if (native.is_number() && web.is_number()) {
        const double a = native, b = web, size = std::max({std::abs(a), std::abs(b), scale});
        EXPECT_LE(std::abs(a - b), kRelative * size) << place << ": " << a << " " << b;
        return;
    }
    ASSERT_EQ(native.type(), web.type()) << place;
    if (!native.is_structured()) {
        EXPECT_EQ(native, web) << place;
        return;
    }
    ASSERT_EQ(native.size(), web.size()) << place;
    double largest = scale;  // of a vector: its small elements are as exact as its large ones
    if (native.is_array())
        for (const json& one : native)
            if (one.is_number()) largest = std::max(largest, std::abs(one.get<double>()));
    for (auto one = native.begin(), other = web.begin(); one != native.end(); ++one, ++other) {
        if (native.is_object()) {
            ASSERT_EQ(one.key(), other.key()) << place;
        }
        expect_alike(*one, *other, place + (native.is_object() ? "." + one.key() : "[]"),
                     native.is_array() ? largest : 0);
    }
}

class web_results : public testing::TestWithParam<std::string> {};

TEST_P(web_results, are_those_of_the_native_program) {
    SKIP_WITHOUT_WEB_ENGINE();
    const Workbench bench(Workbench::Memory::kShared);
    const fs::path lesson = kSource / "lessons" / GetParam();
    bench.write("analysis.lua", read_text(lesson / "lesson.lua"));
    if (fs::exists(lesson / "data")) fs::copy(lesson / "data", bench.path("data"), fs::copy_options::recursive);
    const ChildResult run = bench.dynlab({"run", "analysis.lua", "--out", "out"});
    ASSERT_EQ(run.exit_code, 0) << run.error_output;
    const json native = json::parse(bench.read("out/record.json"));
    const json web = run_in_node(bench, bench.path("analysis.lua").string());
    ASSERT_EQ(web["errors"], json::array());
    for (const char* part : {"values", "tables", "answers", "texts", "sliders", "outputs"})
        if (native.contains(part)) expect_alike(native[part], web["results"][part], part);
    std::vector<std::string> figures, figures_of_web;
    for (const auto& [name, figure] : native["figures"].items()) figures.push_back(name);
    for (const auto& [name, figure] : web["results"]["figures"].items()) figures_of_web.push_back(name);
    EXPECT_EQ(figures, figures_of_web);
}

INSTANTIATE_TEST_SUITE_P(of, web_results,
                         testing::Values("01_process_models", "02_least_squares", "03_crane", "03_workflow",
                                         "04_estimators", "05_thruster", "06_physics", "07_feedback"));

/// Points by the native program's own words: "checks of lesson 02_least_squares: 12 of 20 points".
TEST(web_checks, give_the_points_of_dynlab_check) {
    SKIP_WITHOUT_WEB_ENGINE();
    for (const char* script : {"wrong_signs.lua", "wrong_typed_in.lua", "lesson.lua"}) {
        const Workbench bench(Workbench::Memory::kShared);
        const fs::path lesson = kSource / "lessons/02_least_squares";
        ASSERT_EQ(bench.dynlab({"new", "02", "work"}).exit_code, 0);
        bench.write("work/analysis.lua", read_text(lesson / script));
        const std::string said = bench.dynlab({"check", "work"}).output;
        const json web = run_in_node(
            bench, bench.path("work/analysis.lua").string() + " 02_least_squares " + (lesson / "checks.lua").string());
        double earned = 0, points = 0;
        for (const json& check : web["checked"]["checks"])
            earned += check["earned"].get<double>(), points += check["points"].get<double>();
        std::ostringstream words;
        words << "checks of lesson 02_least_squares: " << earned << " of " << points << " points";
        EXPECT_THAT(said, testing::HasSubstr(words.str())) << script;
    }
}

}  // namespace test_web_results
}  // namespace dynlab::test
