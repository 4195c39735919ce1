// A script whose montecarlo is made in parts. Oracle: the same script in one run, to the last bit.
#include "workflow/parts/study_parts.h"

#include <gmock/gmock.h>

#include <map>

#include "platform/error.h"
#include "unit/workflow/workflow_run.h"

namespace dynlab::test {
namespace test_study_parts {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kFirst = R"(
local M = montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 12, seed = 3,
    estimators = {lssvf = {{2, 1, 0}, 3}, mine = function(d) return lssvf(d, {2, 1, 0}, 2) end}}
print(M)
)";
constexpr const char* kSecond = R"(
print(montecarlo{system = tf({2}, {1, 4, 3 + M.lssvf.mean[1]}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 5,
    seed = 3, estimators = {lssvf = {{2, 1, 0}, 3}}})
)";

class study_parts : public testing::Test {
  protected:
    PercentScript script(const std::string& code) const { return parse_percent_script(code, work_.path("study.lua")); }
    MissingParts run(const std::string& code, std::optional<WorkPart> part, int count = 2) const {
        return run_study_part(script(code), 1, folder(), count, part);
    }
    fs::path folder() const { return work_.path("parts"); }
    std::string joined(const std::string& code) const {
        StudyParts parts(folder(), script(code), 1, 2, {});
        std::string printed;
        RunRequest request;
        request.script = script(code);
        request.seed = 1;
        request.out_folder = work_.path();
        request.parts = &parts;
        request.print = [&](const std::string& text) { printed += text; };
        GnuplotRenderer renderer;
        const RunRecord record = run_script(request, renderer);
        return record.error ? "error: " + record.error->text() : printed;
    }
    std::map<std::string, fs::file_time_type> files() const {
        std::map<std::string, fs::file_time_type> times;
        for (const auto& entry : fs::directory_iterator(folder()))
            times[entry.path().filename()] = entry.last_write_time();
        return times;
    }
    WorkFolder work_;
};

TEST_F(study_parts, give_together_what_one_run_gives) {
    const std::string alone = work_.run(kFirst, "study.lua").printed;
    ASSERT_FALSE(alone.empty());
    EXPECT_THAT(run(kFirst, {}).parts, ElementsAre(1, 2));
    EXPECT_THAT(run(kFirst, WorkPart{2, 2}).parts, ElementsAre(1));
    EXPECT_THAT(joined(kFirst), HasSubstr("1 part of this call of montecarlo"));
    EXPECT_THAT(run(kFirst, WorkPart{1, 2}).parts, IsEmpty());
    EXPECT_EQ(joined(kFirst), alone);
}

TEST_F(study_parts, are_not_made_again) {
    for (const int index : {1, 2}) run(kFirst, WorkPart{index, 2});
    const auto before = files();
    EXPECT_EQ(before.size(), 12u);
    for (const int index : {1, 2, 3}) EXPECT_THAT(run(kFirst, WorkPart{index, 3}, 3).parts, IsEmpty());
    joined(kFirst);
    EXPECT_EQ(files(), before);
    fs::remove(folder() / before.begin()->first);
    EXPECT_EQ(run(kFirst, {}).parts.size(), 1u);
}

TEST_F(study_parts, of_a_call_wait_for_all_parts_of_the_call_before) {
    const std::string both = std::string(kFirst) + kSecond;
    const std::string alone = work_.run(both, "study.lua").printed;
    run(both, WorkPart{1, 2});
    EXPECT_EQ(run(both, {}).call, 1u);
    run(both, WorkPart{2, 2});  // completes the first call and makes its share of the second
    EXPECT_EQ(run(both, {}), (MissingParts{{1}, 2}));
    run(both, WorkPart{1, 2});
    EXPECT_EQ(joined(both), alone);
}

TEST_F(study_parts, of_another_script_or_of_other_data_are_not_joined) {
    const std::string code = std::string("local d = load('mine.csv')\n") + kFirst;
    work_.write("mine.csv", "t,y\n0,1\n1,2\n2,3\n");
    for (const int index : {1, 2}) run(code, WorkPart{index, 2});
    EXPECT_THAT(run(code, {}).parts, IsEmpty());
    EXPECT_THAT(run("local other = 1\n" + code, {}).parts, ElementsAre(1, 2));
    work_.write("mine.csv", "t,y\n0,1\n1,2\n2,4\n");
    EXPECT_THAT(run(code, {}).parts, ElementsAre(1, 2));
}

TEST_F(study_parts, errors_of_the_script_are_passed_on) {
    EXPECT_THROW(run("error('no')\n", WorkPart{1, 2}), EnvironmentError);
}

TEST_F(study_parts, an_error_in_a_part_is_not_taken_for_other_parts_that_are_missing) {
    StudyParts parts(folder(), script(kFirst), 1, 2, WorkPart{2, 2});
    const auto fails = [](std::size_t, std::size_t) -> std::string { throw EnvironmentError("no"); };
    EXPECT_THROW(parts.all({}, 4, fails), EnvironmentError);
    EXPECT_THAT(parts.missing().parts, IsEmpty());
}

}  // namespace test_study_parts
}  // namespace dynlab::test
