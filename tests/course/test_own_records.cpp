#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numeric>
#include <regex>

#include "base/reader.h"
#include "course/grading/grading_rules.h"
#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_own_records {
using ::testing::HasSubstr;

struct GroupsOfLesson {
    std::string lesson;
    std::vector<int> seeds;
};

class own_records : public ::testing::TestWithParam<GroupsOfLesson> {};
class own_records_of_many : public ::testing::TestWithParam<GroupsOfLesson> {};

/// A copy of the lesson whose checks request no runs on other data.
Lesson with_own_data_sets_alone(const Workbench& bench, const std::string& lesson) {
    static const std::regex expected(R"(rerun = "(?!seed")\w+",)");
    const std::filesystem::path folder = bench.path("alone") / lesson;
    std::filesystem::create_directories(folder.parent_path());
    std::filesystem::copy(lesson_folder(lesson), folder, std::filesystem::copy_options::recursive);
    const std::string checks = read_file(folder / "checks.lua");
    bench.write(folder / "checks.lua", std::regex_replace(checks, expected, ""));
    bench.write(folder / "lesson.lua", quick_solution_of(lesson));  // a run shows which data sets groups have
    return {lesson, folder};
}

/// The reference solution is right on any data. Its results on data of another plant are the same for every group, so
/// that it runs on them once.
void expect_full_marks(const GroupsOfLesson& groups, Workbench::Memory memory,
                       const std::string& secret = "chosen by a test") {
    const auto& [lesson, seeds] = groups;
    const Workbench bench(memory);
    bench.write("in/analysis.lua", quick_solution_of(lesson));
    GradingSetup setup;
    setup.lesson = {lesson, lesson_folder(lesson)};
    setup.secret = secret;
    setup.isolation = strongest_isolation();
    setup.program = DYNLAB_PROGRAM;
    setup.jobs = 2;
    setup.call_memory = bench.cache() / "dynlab";
    const GradingRules rules(setup);
    setup.lesson = with_own_data_sets_alone(bench, lesson);
    const GradingRules own_only(setup);
    std::vector<GradingRules::Work> works;
    for (const int seed : seeds) {
        const auto group = static_cast<std::uint32_t>(seed);
        std::string log;
        CheckedSubmission work = (works.empty() ? rules : own_only).work_in(bench.path("in"), group, log);
        if (!works.empty())
            work.runs.insert(works.front().submission.runs.begin(), works.front().submission.runs.end());
        works.push_back({fmt::format("seed {}", seed), std::move(work), group, log});
    }
    for (const Grade& grade : rules.grade_all(works)) {
        EXPECT_EQ(message_text(grade.error_reason), "") << grade.submission;
        for (const CheckGrade& check : grade.checks)
            EXPECT_TRUE(check.graded && check.earned == check.points)
                << grade.submission << ", " << message_text(check.about) << ": " << message_text(check.message);
    }
}

// oracle: the lesson's own answers
TEST_P(own_records, cost_the_worked_solution_no_points) {
    expect_full_marks(GetParam(), Workbench::Memory::kShared);
}
// A quarter of an hour for the crane: scripts/test --long.
TEST_P(own_records_of_many, cost_the_worked_solution_no_points) {
    expect_full_marks(GetParam(), Workbench::Memory::kOwn);
}
// Each seed makes a course whose hidden data sets are drawn from another secret.
TEST_P(own_records_of_many, cost_no_points_whatever_the_secret) {
    for (const int seed : GetParam().seeds) {
        const std::string secret = fmt::format("secret {}", seed);
        SCOPED_TRACE(secret);
        expect_full_marks({GetParam().lesson, {1}}, Workbench::Memory::kOwn, secret);
    }
}

// A crane whose pendulum swings 8 % faster than that of all, one whose limits are hard to notice, and a thruster with
// 8 % more reverse thrust.
INSTANTIATE_TEST_SUITE_P(all, own_records,
                         ::testing::Values(GroupsOfLesson{"03_crane", {9, 56}}, GroupsOfLesson{"05_thruster", {7}},
                                           GroupsOfLesson{"07_feedback", {7, 12}}),
                         [](const auto& groups) { return groups.param.lesson; });

std::vector<GroupsOfLesson> a_hundred_groups_of_each() {
    std::vector<GroupsOfLesson> all;
    for (const std::string& lesson : lessons_with_checks()) {
        const std::string script = read_file(lesson_folder(lesson) / "lesson.lua");
        const bool simulated = script.find("load(\"") != std::string::npos;
        for (int from = 1; simulated && from <= 100; from += 10) {
            std::vector<int> seeds(10);
            std::iota(seeds.begin(), seeds.end(), from);
            all.push_back({lesson, seeds});
        }
    }
    return all;
}
INSTANTIATE_TEST_SUITE_P(all, own_records_of_many, ::testing::ValuesIn(a_hundred_groups_of_each()),
                         [](const auto& groups) {
                             return fmt::format("{}_from_{}", groups.param.lesson, groups.param.seeds.front());
                         });

constexpr const char* kGainAnswer = "--   K: number\n";
const std::string kComputesGain = "local d = load(\"suspension\")\nanswer('K', mean(d.y:range(300, #d.y)))\n";

// oracle: the true model of the plant variant that each script names
TEST(own_records, truth_is_that_of_the_record_which_the_answers_came_from) {
    const char* checks =
        "local function gain(seed) return true_model('suspension', {variant = seed}).gain end\n"
        "local function says(words, ...)\n"
        "  local ended, message = pcall(truth, ...)\n"
        "  return not ended and tostring(message):find(words, 1, true) ~= nil\n"
        "end\n"
        "check{id = 'near', test = function(a) return near(a.K, truth(a, 'suspension').gain, {rel = 0.02}) end}\n"
        "check{id = 'own', test = function(a) return truth(a, 'suspension').gain == gain(a.specimen) end}\n"
        "check{id = 'again', rerun = 'seed', test = function(a, b)\n"
        "  return truth(b, 'suspension').gain == gain(a.specimen) end}\n"
        "check{id = 'other', rerun = 'suspension', test = function(a, b)\n"
        "  return truth(a, 'suspension').gain == gain(a.specimen) and truth(b).gain ~= gain(a.specimen)\n"
        "    and truth(b, 'suspension').gain == truth(b).gain and truth(b).gain == truth('suspension').gain end}\n"
        "check{id = 'not_own', test = function(a)\n"
        "  return truth(a, 'thruster').delay == true_model('thruster').delay end}\n"
        "check{id = 'refusals', test = function(a)\n"
        "  return says('give the data set', a) and says('answers', {}, 'suspension') and says('thrusters', a, "
        "'thrusters') end}\n";
    const auto script = [](int variant_number) {
        return kComputesGain + fmt::format("answer('specimen', {})\n", variant_number);
    };
    GradingBench bench("--   K: number\n--   specimen: number\n", checks, script(0));
    bench.submit_file("group-7", script(7));
    bench.submit_file("group-8", script(7));
    bench.submit_file("others", script(0));
    bench.bench().write("roster.csv", "id,group,seed\n1,group-7,7\n2,group-8,8\n3,others,\n");
    const ChildResult graded = bench.grade({"--roster", "roster.csv"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(bench.result("group-7").at("score"), 6);
    EXPECT_EQ(bench.result("group-8").at("score"), 3);
    EXPECT_EQ(bench.result("others").at("score"), 6);
}

// oracle: the points that grade gives for the same work, and the data set that dynlab new wrote
TEST(own_records, check_promises_the_points_that_grade_gives) {
    const char* checks =
        "local y = load('suspension').y\n"
        "check{id = 'truth', test = function(a) return near(a.K, truth(a, 'suspension').gain, {rel = 0.02}) end}\n"
        "check{id = 'record', test = function(a) return near(a.K, mean(y:range(300, #y)), {rel = 1e-9}) end}\n";
    GradingBench bench(kGainAnswer, checks, kComputesGain);
    const Workbench& work = bench.bench();
    work.write("roster.csv", "id,group,seed\n1,group-7,7\n2,all,\n");
    ASSERT_EQ(work.dynlab({"new", "99", "in/group-7", "--group-seed", "7"}).exit_code, 0);
    ASSERT_EQ(work.dynlab({"new", "99", "in/all"}).exit_code, 0);
    for (const char* name : {"group-7", "all"}) {
        bench.submit_file(name, GradingBench::header(kGainAnswer) + kComputesGain);
        work.write(std::string("in/") + name + "/report.md", "The gain was read off the record of the experiment.\n");
        // The seed of the random numbers may change; the data set does not change with it.
        work.write(std::string("in/") + name + "/group.toml", "seed = 4\n");
        EXPECT_THAT(work.dynlab({"check", std::string("in/") + name}).output,
                    HasSubstr("checks of lesson 99_small: 2 of 2 points"));
    }
    ASSERT_EQ(bench.grade({"--roster", "roster.csv"}).exit_code, 0);
    EXPECT_EQ(bench.result("group-7").at("score"), 2);
    EXPECT_EQ(bench.result("all").at("score"), 2);
    EXPECT_NE(work.read("in/group-7/data/suspension/SOURCE.md").find("\nSpecimen: 7\n"), std::string::npos);
    const char* repeated =
        "print(max(abs(plant('suspension', {variant = 7, seed = 7}).y - load('suspension').y)) < 1e-5)";
    EXPECT_EQ(work.shell(std::string("cd in/group-7 && $DYNLAB run -e \"") + repeated + "\"").output, "true\n");
}

// oracle: the points of a script that reads the same data, whatever the lesson's script looks like
TEST(own_records, are_given_whatever_the_lesson_calls_its_data) {
    const char* checks =
        "check{id = 'truth', test = function(a) return near(a.K, truth(a, 'suspension').gain, {rel = 0.02}) end}\n"
        "check{id = 'own', test = function(a)\n"
        "  return truth(a, 'suspension').gain == true_model('suspension', {variant = a.specimen}).gain end}\n";
    for (const char* loading :
         {"local d = load 'suspension'\n", "local name = [[suspension]]\nlocal d = load(name)\n"}) {
        GradingBench bench("--   K: number\n--   specimen: number\n", checks,
                           loading + std::string("answer('K', mean(d.y:range(300, #d.y)))\nanswer('specimen', 0)\n"));
        bench.submit_file("group-7", kComputesGain + "answer('specimen', 7)\n");
        bench.bench().write("roster.csv", "id,group,seed\n1,group-7,7\n");
        const ChildResult graded = bench.grade({"--roster", "roster.csv"});
        ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
        EXPECT_EQ(bench.result("group-7").at("score"), 2) << loading;
    }
}

}  // namespace test_own_records
}  // namespace dynlab::test
