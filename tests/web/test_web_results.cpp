// The engine as WebAssembly under Node. Oracle: the native program, which runs the same scripts and checks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "platform/temporary_folder.h"
#include "web/web_engine.h"
#include "workflow/site/site_data.h"

namespace dynlab::test {
namespace test_web_results {
using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kSource = DYNLAB_SOURCE_DIR;
constexpr double kRelative = 1e-9;
const std::vector<std::string> kLessons = {"01_process_models", "02_least_squares", "03_crane",   "03_workflow",
                                           "04_estimators",     "05_thruster",      "06_physics", "07_feedback"};

/// The data sets as a page fetches them: also those that natively come from packages of the system.
const fs::path& home_of_pages() {
    static const TemporaryFolder home;
    static const bool written = [] {
        for (const auto& [file, content] : data_of_site()) {
            fs::create_directories((home.path() / file).parent_path());
            write_file_atomically(home.path() / file, content);
        }
        return true;
    }();
    EXPECT_TRUE(written);
    return home.path();
}

json run_in_node(const Workbench& bench, const std::string& words) {
    const ChildResult run =
        bench.shell("node " + (kSource / "tests/web/run_in_node.mjs").string() + " " +
                    (web_engine_folder() / "dynlab.js").string() + " " + home_of_pages().string() + " " + words);
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

/// A page's results have a figure and what was printed before it in one entry, a record has two.
json in_pieces(const json& outputs) {
    json result = json::object();
    for (const auto& [cell, entries] : outputs.items())
        for (const json& entry : entries)
            for (const char* part : {"printed", "figure"})
                if (entry.contains(part)) result[cell].push_back({{part, entry[part]}});
    return result;
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
    for (const char* part : {"values", "tables", "answers", "texts", "sliders"})
        if (native.contains(part)) expect_alike(native[part], web["results"][part], part);
    expect_alike(in_pieces(native["outputs"]), in_pieces(web["results"]["outputs"]), "outputs");
    std::vector<std::string> figures, figures_of_web;
    for (const auto& [name, figure] : native["figures"].items()) figures.push_back(name);
    for (const auto& [name, figure] : web["results"]["figures"].items()) figures_of_web.push_back(name);
    EXPECT_EQ(figures, figures_of_web);
}

INSTANTIATE_TEST_SUITE_P(of, web_results, testing::ValuesIn(kLessons));

/// An index has 32 bits in a browser, and a seed has 32 without a sign.
TEST(web_numbers, whole_numbers_beyond_an_index_are_those_of_the_native_program) {
    SKIP_WITHOUT_WEB_ENGINE();
    const Workbench bench;
    bench.write("analysis.lua",
                "-- %% id=seeds\n"
                "local own = {variant = 3844151627, seed = 2528797659}\n"
                "rng(4294967295)\n"
                "print(rand(), own.seed, plant(\"step_response\", own).y_noisy[2])\n"
                "print(true_model(\"step_response\", {variant = own.specimen}).a)\n"
                "print(multisine(16, {seed = own.seed})[3])\n"
                "-- %% id=sizes\n"
                "local short = vector{1, 2, 3}\n"
                "print((pcall(zeros, 2^32 + 3)), (pcall(zeros, 2^32, 2^32)), (pcall(range, 1, 1e12)))\n"
                "print((pcall(short.range, short, 1, 2^32 + 2)), (pcall(short.range, short, 2^32 + 1, 2)))\n");
    const ChildResult run = bench.dynlab({"run", "analysis.lua", "--out", "out"});
    ASSERT_EQ(run.exit_code, 0) << run.error_output;
    const json web = run_in_node(bench, bench.path("analysis.lua").string());
    EXPECT_EQ(web["errors"], json::array());
    expect_alike(json::parse(bench.read("out/record.json"))["outputs"], web["results"]["outputs"], "outputs");
}

/// In the native program, the solutions earn all points (tests/course), also on the data of the reruns, whose seeds are
/// large and small.
TEST(web_checks, worked_solutions_earn_all_points) {
    SKIP_WITHOUT_WEB_ENGINE();
    const Workbench bench;
    for (const std::string& lesson : kLessons) {
        const fs::path folder = kSource / "lessons" / lesson;
        const json web = run_in_node(
            bench, (folder / "lesson.lua").string() + " " + lesson + " " + (folder / "checks.lua").string());
        ASSERT_TRUE(web["checked"].is_object()) << lesson << web["errors"];
        for (const json& check : web["checked"]["checks"])
            if (check["tried"].get<bool>()) {
                EXPECT_EQ(check["earned"], check["points"]) << lesson << ": " << check;
            }
    }
}

/// Points by the native program's own words: "checks of lesson 02_least_squares: 12 of 20 points".
TEST(web_checks, give_the_points_of_dynlab_check) {
    SKIP_WITHOUT_WEB_ENGINE();
    for (const char* script : {"wrong_signs.lua", "wrong_typed_in.lua", "lesson.lua"}) {
        const Workbench bench(Workbench::Memory::kShared);
        const fs::path lesson = kSource / "lessons/02_least_squares";
        ASSERT_EQ(bench.dynlab({"new", "02", "work"}).exit_code, 0);
        std::string text = read_text(lesson / script);
        if (!text.starts_with("-- ---"))
            text = "-- ---\n-- lesson: 02_least_squares\n-- template: lesson\n-- ---\n" + text;
        bench.write("work/analysis.lua", text);  // `dynlab check` reads in its header which lesson it is
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
