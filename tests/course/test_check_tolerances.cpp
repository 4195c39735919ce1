#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_check_tolerances {

/// The checks of what moved_answers.lua does not move: its lines "-- untouched: CHECK".
std::vector<std::string> untouched_checks(const std::string& moves) {
    static const std::regex line("-- untouched: (\\w+)");
    std::vector<std::string> all;
    for (std::sregex_iterator found(moves.begin(), moves.end(), line), end; found != end; ++found)
        all.push_back((*found)[1]);
    return all;
}

/// The worked solution with every answer moved on its way out.
std::string moved_solution(const std::string& lesson, const std::string& moves, bool inside, int sign) {
    std::string script = quick_solution_of(lesson);
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
                                moves +
                                "\nend\n"
                                "local hand_in = answer\n"
                                "local function answer(name, value)\n"
                                "    hand_in(name, move[name](value))\n"
                                "end\n";
    return script.insert(place, prelude);
}

class check_tolerances : public ::testing::TestWithParam<std::string> {};

void expect_fair_marks(const Workbench& bench, const std::string& name, bool inside,
                       const std::vector<std::string>& untouched) {
    SCOPED_TRACE(name);
    const auto result = nlohmann::json::parse(bench.read("out/results/" + name + "/results.json"));
    const auto& ours = result.at("extra_data").at("dynlab");
    EXPECT_EQ(ours.at("trouble"), "");
    for (const auto& check : ours.at("checks")) {
        const std::string id = check.at("id");
        const bool looks_elsewhere =
            id == "figures" || std::find(untouched.begin(), untouched.end(), id) != untouched.end();
        EXPECT_EQ(check.at("earned") == check.at("points"), inside || looks_elsewhere)
            << id << ": " << check.at("message");
    }
}

// oracle: the tolerances that each checks.lua states with its reasons: answers moved by less, up and down, get full
// marks everywhere, moved by more they lose some at every check that looks at them
TEST_P(check_tolerances, are_neither_harsh_nor_lenient) {
    const std::string lesson = GetParam(), moves = read_file(lesson_folder(lesson) / "moved_answers.lua");
    ASSERT_NE(moves, "") << lesson;
    const Workbench bench;
    for (const auto& [direction, sign] : {std::pair("up", 1), std::pair("down", -1)}) {
        bench.write(std::string("in/inside_") + direction + "/analysis.lua", moved_solution(lesson, moves, true, sign));
        bench.write(std::string("in/outside_") + direction + "/analysis.lua",
                    moved_solution(lesson, moves, false, sign));
    }
    bench.write("secret", "chosen by a test");
    const ChildResult graded = bench.dynlab({"grade", "in", "--lesson", lesson, "--out", "out", "--secret", "secret",
                                             "--isolation", GradingBench::level(), "--no-pdf"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    for (const char* direction : {"up", "down"}) {
        expect_fair_marks(bench, std::string("inside_") + direction, true, untouched_checks(moves));
        expect_fair_marks(bench, std::string("outside_") + direction, false, untouched_checks(moves));
    }
}

INSTANTIATE_TEST_SUITE_P(all, check_tolerances, ::testing::ValuesIn(lessons_with_checks()),
                         [](const auto& lesson) { return lesson.param; });

}  // namespace test_check_tolerances
}  // namespace dynlab::test
