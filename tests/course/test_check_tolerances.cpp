#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "base/reader.h"
#include "course/grading/grading_rules.h"
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

struct Way {
    const char* name;
    bool inside;
    int sign;
};
constexpr Way kWays[] = {
    {"inside_up", true, 1}, {"inside_down", true, -1}, {"outside_up", false, 1}, {"outside_down", false, -1}};

/// A copy of the lesson whose reference solution submits each answer four times, once for each change. The answers of
/// one run give four submissions.
std::string solution_moved_in_all_ways(const std::string& lesson, const std::string& moves) {
    static const std::regex declared("\n--   (\\w+)(: \\w+)");
    const std::string end_of_header = "\n-- ---\n";
    const std::string script = quick_solution_of(lesson);
    const std::size_t place = script.find(end_of_header);
    std::string header = script.substr(0, place), ways, names;
    for (const Way& way : kWays) {
        names += std::string("\n--   $1_") + way.name + "$2";
        ways +=
            std::string(way.name) + " = {" + (way.inside ? "true" : "false") + ", " + std::to_string(way.sign) + "}, ";
    }
    return std::regex_replace(header, declared, names) + end_of_header +
           "local answer = answer\n"
           "do\n"
           "    local hand_in, moves = answer, {}\n"
           "    for way, how in pairs{" +
           ways +
           "} do\n"
           "        local inside, e, move = how[1], how[2], {}\n"
           "        local function scaled(near, far)\n"
           "            return function(x) return x*(1 + e*(inside and near or far)) end\n"
           "        end\n"
           "        local function shifted(near, far)\n"
           "            return function(x) return x + e*(inside and near or far) end\n"
           "        end\n" +
           moves +
           "\n        moves[way] = move\n"
           "    end\n"
           "    answer = function(name, value)\n"
           "        for way, move in pairs(moves) do hand_in(name .. '_' .. way, move[name](value)) end\n"
           "    end\n"
           "end\n" +
           script.substr(place + end_of_header.size());
}

/// The submission of a script that changes its answers in one way.
CheckedSubmission moved_in_one(const CheckedSubmission& all, const std::string& way) {
    CheckedSubmission one = all;
    for (auto& [name, run] : one.runs) {
        std::map<std::string, RecordedAnswer> answers;
        for (const auto& [answer, value] : run.answers)
            if (answer.ends_with("_" + way)) answers[answer.substr(0, answer.size() - way.size() - 1)] = value;
        run.answers = std::move(answers);
    }
    return one;
}

class check_tolerances : public ::testing::TestWithParam<std::string> {};

void expect_fair_marks(const Grade& grade, bool inside, const std::vector<std::string>& untouched) {
    SCOPED_TRACE(grade.submission);
    EXPECT_EQ(message_text(grade.error_reason), "");
    for (const CheckGrade& check : grade.checks) {
        const bool looks_elsewhere =
            check.id == "figures" || std::find(untouched.begin(), untouched.end(), check.id) != untouched.end();
        EXPECT_EQ(check.earned == check.points, inside || looks_elsewhere)
            << check.id << ": " << message_text(check.message);
    }
}

// oracle: the tolerances that each checks.lua states with its reasons: answers moved by less, up and down, get full
// marks everywhere, moved by more they lose some at every check that looks at them
TEST_P(check_tolerances, are_neither_harsh_nor_lenient) {
    namespace fs = std::filesystem;
    const std::string lesson = GetParam(), moves = read_file(lesson_folder(lesson) / "moved_answers.lua");
    ASSERT_NE(moves, "") << lesson;
    const Workbench bench(Workbench::Memory::kShared);
    const fs::path copy = bench.path("lessons/" + lesson);
    fs::create_directories(copy.parent_path());
    fs::copy(lesson_folder(lesson), copy, fs::copy_options::recursive);
    const std::string script = solution_moved_in_all_ways(lesson, moves);
    bench.write("lessons/" + lesson + "/lesson.lua", script);
    bench.write("in/analysis.lua", script);
    GradingSetup setup;
    setup.lesson = {lesson, copy};
    setup.secret = "chosen by a test";
    setup.isolation = strongest_isolation();
    setup.program = DYNLAB_PROGRAM;
    setup.jobs = 2;
    setup.call_memory = bench.cache() / "dynlab";
    std::string log;
    const CheckedSubmission all = GradingRules(setup).work_in(bench.path("in"), {}, log);
    setup.lesson.folder = lesson_folder(lesson);
    std::vector<GradingRules::Work> works;
    for (const Way& way : kWays) works.push_back({way.name, moved_in_one(all, way.name), {}, ""});
    const std::vector<Grade> grades = GradingRules(setup).grade_all(works);
    for (std::size_t k = 0; k < std::size(kWays); ++k)
        expect_fair_marks(grades.at(k), kWays[k].inside, untouched_checks(moves));
}

INSTANTIATE_TEST_SUITE_P(all, check_tolerances, ::testing::ValuesIn(lessons_with_checks()),
                         [](const auto& lesson) { return lesson.param; });

}  // namespace test_check_tolerances
}  // namespace dynlab::test
