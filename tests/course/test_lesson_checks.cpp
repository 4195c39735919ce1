#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_lesson_checks {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A failure that a script of typical mistakes was written for.
struct Intended {
    std::string check, words;
};

/// The lines "-- expects: CHECK: part of the message" at the head of a script.
std::vector<Intended> intended_failures(const std::string& script) {
    static const std::regex line("-- expects: (\\w+): ([^\\n]+)");
    std::vector<Intended> all;
    for (std::sregex_iterator found(script.begin(), script.end(), line), end; found != end; ++found)
        all.push_back({(*found)[1], (*found)[2]});
    return all;
}

/// The checks' ids in the order of checks.lua, which is that of the results.
std::vector<std::string> declared_checks(const std::string& lesson) {
    static const std::regex declaration("\\bcheck \\{ id = \"(\\w+)\"");
    const std::string source = read_file(lesson_folder(lesson) / "checks.lua");
    std::vector<std::string> ids;
    for (std::sregex_iterator found(source.begin(), source.end(), declaration), end; found != end; ++found)
        ids.push_back((*found)[1]);
    return ids;
}

std::vector<fs::path> scripts_named(const std::string& beginning, const std::string& lesson) {
    std::vector<fs::path> scripts;
    for (const auto& entry : fs::directory_iterator(lesson_folder(lesson)))
        if (entry.path().filename().string().starts_with(beginning)) scripts.push_back(entry.path());
    std::sort(scripts.begin(), scripts.end());
    return scripts;
}

/// Exactly the checks that a script names fail, with its words; none of a right one.
void expect_intended_failures(const fs::path& script, const nlohmann::json& result,
                              const std::vector<std::string>& ids) {
    const std::vector<Intended> intended = intended_failures(read_file(script));
    EXPECT_EQ(result.at("extra_data").at("dynlab").at("trouble"), "");
    const auto& tests = result.at("tests");
    ASSERT_EQ(tests.size(), ids.size());
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const bool full = tests[k].value("score", -1.0) == tests[k].at("max_score");
        const std::string said = tests[k].value("output", "");
        bool meant = false;
        for (const Intended& one : intended) {
            if (one.check != ids[k]) continue;
            meant = true;
            EXPECT_FALSE(full) << ids[k];
            EXPECT_THAT(said, HasSubstr(one.words)) << ids[k];
        }
        if (!meant) {
            EXPECT_TRUE(full) << ids[k] << ": " << said;
        }
    }
    for (const Intended& one : intended)
        EXPECT_NE(std::find(ids.begin(), ids.end(), one.check), ids.end()) << "there is no check " << one.check;
}

class lesson_checks : public ::testing::TestWithParam<std::string> {};

// oracle: the worked solution, the untouched starter, scripts that say themselves which mistake they make, and one that
// comes to right results by other methods
TEST_P(lesson_checks, give_full_marks_none_and_the_intended_message) {
    const std::string lesson = GetParam();
    const Workbench bench;
    ASSERT_EQ(bench.dynlab({"new", lesson, "in/starter"}).exit_code, 0);
    const std::vector<fs::path> wrong = scripts_named("wrong_", lesson), right = scripts_named("right_", lesson);
    EXPECT_GE(wrong.size(), 3u);
    EXPECT_GE(right.size(), 1u);
    for (const auto& scripts : {wrong, right})
        for (const fs::path& script : scripts)
            bench.write("in/" + script.stem().string() + "/analysis.lua", read_file(script));
    bench.write("secret", "chosen by a test");

    // Exit code 0 says as well that the worked solution, which is tried first, passed every check with full points.
    const ChildResult graded = bench.dynlab({"grade", "in", "--lesson", lesson, "--out", "out", "--secret", "secret",
                                             "--isolation", GradingBench::level(), "--no-pdf"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const auto result = [&](const std::string& name) {
        return nlohmann::json::parse(bench.read("out/results/" + name + "/results.json"));
    };
    const std::vector<std::string> ids = declared_checks(lesson);
    EXPECT_GE(ids.size(), 6u);
    EXPECT_EQ(GradingBench::score(result("starter")), 0);
    for (const fs::path& script : wrong) EXPECT_FALSE(intended_failures(read_file(script)).empty()) << script;
    for (const auto& scripts : {wrong, right})
        for (const fs::path& script : scripts) {
            SCOPED_TRACE(script.filename().string());
            expect_intended_failures(script, result(script.stem().string()), ids);
        }
}

INSTANTIATE_TEST_SUITE_P(all, lesson_checks, ::testing::ValuesIn(lessons_with_checks()),
                         [](const auto& lesson) { return lesson.param; });

}  // namespace test_lesson_checks
}  // namespace dynlab::test
