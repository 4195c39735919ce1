#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "course/grading_bench.h"
#include "lessons/lesson_record.h"

namespace dynlab::test {
namespace test_lesson_checks {

std::size_t scripts_named(const std::string& beginning, const std::string& lesson) {
    std::size_t scripts = 0;
    for (const auto& entry : std::filesystem::directory_iterator(lesson_folder(lesson)))
        scripts += entry.path().filename().string().starts_with(beginning);
    return scripts;
}

/// The answers of a script as a run writes them. Long calls come from the cache if another test made them.
nlohmann::json answers_of(const Workbench& bench, const std::filesystem::path& script) {
    const ChildResult run = bench.dynlab({"run", script.string(), "--out", "made"});
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    return nlohmann::json::parse(bench.read("made/record.json")).at("answers");
}

class lesson_checks : public ::testing::TestWithParam<std::string> {};

// oracle: the reference solution, the untouched starter, scripts that state their mistake, and a script that gets right
// results by other methods. test_own_course.cpp tests that the command finds faults.
TEST_P(lesson_checks, give_full_marks_none_and_the_intended_message) {
    const std::string lesson = GetParam();
    EXPECT_GE(scripts_named("wrong_", lesson), 3u);
    EXPECT_GE(scripts_named("right_", lesson), 1u);
    static const std::regex declaration("\\bcheck \\{ id = \"\\w+\"");
    const std::string checks = read_file(lesson_folder(lesson) / "checks.lua");
    EXPECT_GE(std::distance(std::sregex_iterator(checks.begin(), checks.end(), declaration), std::sregex_iterator()),
              6);
    const Workbench bench(Workbench::Memory::kShared);
    const std::filesystem::path copy = bench.path("lessons/" + lesson);
    std::filesystem::create_directories(copy.parent_path());
    std::filesystem::copy(lesson_folder(lesson), copy, std::filesystem::copy_options::recursive);
    bench.write("lessons/" + lesson + "/lesson.lua", quick_solution_of(lesson));
    bench.write("secret", "chosen by a test");
    const ChildResult tested = bench.dynlab({"test-lesson", copy.string(), "--part", "checks", "--secret", "secret"});
    EXPECT_EQ(tested.exit_code, 0) << tested.output << tested.error_output;
    if (quick_solution_of(lesson) != read_file(lesson_folder(lesson) / "lesson.lua")) {
        EXPECT_EQ(answers_of(bench, copy / "lesson.lua"), record_of_lesson(lesson).at("answers"));
    }
}

INSTANTIATE_TEST_SUITE_P(all, lesson_checks, ::testing::ValuesIn(lessons_with_checks()),
                         [](const auto& lesson) { return lesson.param; });

}  // namespace test_lesson_checks
}  // namespace dynlab::test
