#include <gmock/gmock.h>
#include <matio.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_custom_checks {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAnswers = "--   x: number\n--   v: vector\n";
constexpr const char* kSolution = "answer('x', 42)\nanswer('v', vector{1, 2})\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2, test = function(a) return near(a.x, 42) end}\n"
    "check{id = 'v', points = 3, test = function(a) return near(a.v, {1, 2}) end}\n";

double earned(const nlohmann::json& result, std::size_t check) {
    return result.at("tests").at(check).value("score", -1.0);
}
std::string said(const nlohmann::json& result, std::size_t check) {
    return result.at("tests").at(check).at("output");
}

// oracle: the points of the answers that are right
TEST(custom_checks, an_answer_that_cannot_be_taken_costs_no_other) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("kind", "answer('x', {42})\nanswer('v', vector{1, 2})\n");
    bench.submit_file("twice", "answer('x', 42)\nanswer('x', 43)\nanswer('v', vector{1, 2})\n");
    bench.submit_file("name", "answer('xx', 42)\nanswer('v', vector{1, 2})\n");
    bench.submit_file("function", "answer('x', print)\nanswer('v', vector{1, 2})\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    for (const char* name : {"kind", "twice", "name", "function"}) {
        const auto result = bench.result(name);
        EXPECT_EQ(GradingBench::error_reason(result), "") << name;
        EXPECT_EQ(earned(result, 0), 0) << name;
        EXPECT_EQ(earned(result, 1), 3) << name;
    }
    EXPECT_EQ(said(bench.result("kind"), 0),
              "The answer \"x\" must be of the kind number, but a value of the kind table was given.");
    EXPECT_EQ(said(bench.result("twice"), 0),
              "The answer \"x\" already has another value; specify each answer only once.");
    EXPECT_EQ(said(bench.result("name"), 0), "The answer \"x\" was not submitted.");
    // Outside of grading, the author of the script gets the message at once.
    bench.bench().write("own.lua", GradingBench::header(kAnswers) + "answer('x', {42})\n");
    EXPECT_EQ(bench.bench().dynlab({"run", "own.lua"}).exit_code, 1);
}

// Field case 18. Oracle: the points of the same script without the copies.
TEST(custom_checks, a_copied_cell_and_an_answer_given_twice_cost_nothing) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("cell", "-- %% id=one\nanswer('x', 42)\n-- %% id=one\nanswer('v', vector{1, 2})\n");
    bench.submit_file("answer",
                      "answer('x', 42)\nanswer('x', 42)\nanswer('v', vector{1, 2})\nanswer('v', vector{1, 2})\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    for (const char* name : {"cell", "answer"}) {
        const auto result = bench.result(name);
        EXPECT_EQ(GradingBench::error_reason(result), "") << name;
        EXPECT_GT(earned(result, 0), 0) << name;
        EXPECT_EQ(earned(result, 1), 3) << name;
    }
}

// oracle: the marks that the instructor wrote
TEST(custom_checks, marked_by_hand_wait_for_their_points) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    bench.bench().write(
        "own/text.lua",
        "check{id = 'text', points = 4, about = 'Question 3', by_hand = true, rubric = 'two reasons'}\n");
    const ChildResult open = bench.grade({"--checks", "own"});
    EXPECT_THAT(open.error_output, Not(HasSubstr("reference solution")));
    EXPECT_EQ(bench.bench().read("out/marks.csv"),
              "who,check,points,reason,of,about,rubric\r\na,text,,,4,Question 3,two reasons\r\n");
    EXPECT_THAT(bench.bench().read("out/gradebook.csv"), HasSubstr(",a,partly ungraded,,5,"));
    EXPECT_THAT(bench.bench().read("out/summary.md"), HasSubstr("manual marks are missing from marks.csv"));
    bench.bench().write("out/marks.csv",
                        "submission;check;points;comment;of\na;text;2,5;one reason of two;4\na;x;;not looked at;2\n");
    const ChildResult marked = bench.grade({"--checks", "own"});
    EXPECT_EQ(marked.exit_code, 0) << marked.error_output;
    EXPECT_EQ(bench.result("a").at("score"), 7.5);
    EXPECT_THAT(bench.bench().read("out/results/a/feedback.md"), HasSubstr("one reason of two"));
    bench.bench().write("out/marks.csv", "who,check,points\na,text,9\n");
    EXPECT_THAT(bench.grade({"--checks", "own"}).error_output,
                HasSubstr("gets 9 points for the check \"text\", but the maximum is 4"));
    EXPECT_FALSE(bench.result("a").contains("score"));
    EXPECT_EQ(bench.grade({"--checks", "own", "--force"}).exit_code, 0);
    EXPECT_EQ(bench.result("a").at("score"), 14);
}

TEST(custom_checks, change_and_drop_those_of_the_lesson) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", "answer('x', 42)\n");
    bench.bench().write("own/weights.lua", "change_check{id = 'x', points = 10}\ndrop_check('v')\n");
    ASSERT_EQ(bench.grade({"--checks", "own"}).exit_code, 0);
    EXPECT_EQ(bench.result("a").at("score"), 10);
    EXPECT_EQ(bench.result("a").at("tests").size(), 1u);
    bench.bench().write("own/weights.lua", "drop_check('y')\n");
    const ChildResult unknown = bench.grade({"--checks", "own"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.error_output, AllOf(HasSubstr("weights.lua:1"), HasSubstr("unknown check \"y\"")));
}

// oracle: what a reader of the scripts sees
TEST(custom_checks, see_what_the_script_calls) {
    GradingBench bench("--   x: number\n", "check{id = 'x', test = function(a) return a.x == 1 end}\n",
                       "answer('x', 1)\n");
    bench.bench().write(
        "own/calls.lua",
        "local uses = {main = 'lssvf'}\n"
        "check{id = 'own', points = 1, test = function(a) return not calls('lssvf') end}\n"
        "check{id = 'value', points = 1, test = function(a) return not calls('report.value') end}\n"
        "check{id = 'text', points = 1, test = function(a) return source():find('answer', 1, true) ~= nil end}\n");
    const std::vector<std::pair<std::string, bool>> scripts = {
        {"local f = lssvf\n", true},
        {"if false then print(lssvf(1)) end\n", true},
        {"local t = {pcall(lssvf, 1)}\n", true},
        {"local lssvf = lssvf\n", true},
        {"-- lssvf(1)\nprint('lssvf(1)')\n", false},
        {"local function lssvf(x) return x end\nlocal y = lssvf(1)\n", false},
        {"local t = {lssvf = 1}\nprint(t.lssvf)\n", false},
    };
    for (std::size_t k = 0; k < scripts.size(); ++k)
        bench.submit_file("s" + std::to_string(k), scripts[k].first + "answer('x', 1)\n");
    bench.submit_file("value", "report.value('n', 3)\nanswer('x', 1)\n");
    ASSERT_EQ(bench.grade({"--checks", "own"}).exit_code, 0);
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        EXPECT_EQ(earned(bench.result("s" + std::to_string(k)), 1), scripts[k].second ? 0 : 1) << scripts[k].first;
        EXPECT_EQ(earned(bench.result("s" + std::to_string(k)), 3), 1);
    }
    EXPECT_EQ(earned(bench.result("value"), 2), 0);
    EXPECT_EQ(earned(bench.result("value"), 1), 1);
}

constexpr const char* kGain = "--   K: number\n";
const std::string kComputes = "local d = load('rc')\nanswer('K', mean(d.y)/mean(d.u))\n";
constexpr const char* kNearTwo = "check{id = 'K', test = function(a) return near(a.K, 2, {rel = 0.01}) end}\n";

/// A course whose lesson has a data set that no simulated plant produces.
void add_data_set(GradingBench& bench, const std::string& data_set) {
    const Workbench& work = bench.bench();
    std::filesystem::remove(work.path("home/data"));
    work.shell("mkdir home/data && cp -r " DYNLAB_SOURCE_DIR "/data/* home/data");
    work.write("home/data/rc/SOURCE.md", "A record.\n");
    work.write("home/data/rc/rc.csv", data_set);
}

// oracle: the gains with which the data sets were written
TEST(custom_checks, rerun_on_records_in_files) {
    GradingBench bench(kGain, kNearTwo, kComputes);
    add_data_set(bench, "u,y\n1,2\n2,4\n3,6\n");
    bench.bench().write("own/rerun/rc.csv", "u,y\n1,5\n2,10\n");
    bench.bench().write("own/hidden/other.csv", "u,y\n1,2\n2,4\n");
    bench.bench().write(
        "own/more.lua",
        "check{id = 'follows', points = 2, rerun = 'rc', test = function(a, b) return near(b.K, 5) end}\n"
        "check{id = 'hidden', points = 1, test = function(a)\n"
        "  local d = hidden('other') return near(a.K*mean(d.u), mean(d.y)) end}\n");
    bench.submit_file("computes", kComputes);
    bench.submit_file("types", "answer('K', 2)\n");
    const ChildResult graded = bench.grade({"--checks", "own"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(bench.result("computes").at("score"), 4);
    EXPECT_EQ(bench.result("types").at("score"), 2);
    // Another data set makes another class: no result of the old data is kept.
    bench.bench().write("own/rerun/rc.csv", "u,y\n1,5\n2,10\n3,15\n");
    EXPECT_THAT(bench.grade({"--checks", "own", "--again"}).output, HasSubstr("2 graded now"));
}

/// A vector u of one number in the format of MATLAB 7.3, which is HDF5.
void write_newer_matlab_file(const std::filesystem::path& file, double u) {
    std::filesystem::create_directories(file.parent_path());
    const std::unique_ptr<mat_t, int (*)(mat_t*)> mat(Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT73), Mat_Close);
    ASSERT_TRUE(mat);
    std::array<std::size_t, 2> size{1, 1};
    const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(
        Mat_VarCreate("u", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), &u, 0), Mat_VarFree);
    ASSERT_EQ(Mat_VarWrite(mat.get(), variable.get(), MAT_COMPRESSION_NONE), 0);
}

// oracle: the numbers that were written; such files are read by a library that is confined to memory
TEST(custom_checks, read_several_hidden_records_of_the_newer_matlab_format) {
    GradingBench bench(kGain, kNearTwo, kComputes);
    add_data_set(bench, "u,y\n1,2\n2,4\n3,6\n");
    write_newer_matlab_file(bench.bench().path("own/hidden/one.mat"), 3);
    write_newer_matlab_file(bench.bench().path("own/hidden/two.mat"), 4);
    bench.bench().write("own/more.lua",
                        "check{id = 'sum', test = function(a) return near(hidden('one').u + hidden('two').u, 7) end}\n"
                        "check{id = 'again', test = function(a) return near(hidden('one').u, 3) end}\n");
    bench.submit_file("computes", kComputes);
    const ChildResult graded = bench.grade({"--checks", "own"});
    ASSERT_EQ(graded.exit_code, 0) << graded.output << graded.error_output;
    EXPECT_EQ(bench.result("computes").at("score"), 3) << bench.result("computes").dump();
}

// oracle: arithmetic
TEST(custom_checks, zeros_differ_from_other_numbers_and_have_no_share) {
    GradingBench bench(kAnswers,
                       "check{id = 'differ', test = function(a) return differs(a.x, 0) end}\n"
                       "check{id = 'same', test = function(a) return differs(0, a.x - 40) end}\n"
                       "check{id = 'share', test = function(a) return near(a.x - 42, 0) end}\n",
                       kSolution);
    bench.submit_file("right", kSolution);
    bench.submit_file("off", "answer('x', 43)\n");
    bench.grade();
    EXPECT_EQ(earned(bench.result("right"), 0), 1);
    EXPECT_EQ(earned(bench.result("off"), 0), 1);
    EXPECT_EQ(earned(bench.result("off"), 1), 1);
    EXPECT_EQ(earned(bench.result("off"), 2), 0);
    EXPECT_THAT(said(bench.result("off"), 2), HasSubstr("{abs = ...}"));
}

// oracle: the law by which the plant in the file produces its data
TEST(custom_checks, rerun_on_records_of_a_plant_in_lua) {
    GradingBench bench(kGain, kNearTwo, kComputes);
    add_data_set(bench, "u,y\n1,2\n2,4\n3,6\n");
    bench.bench().write(
        "own/more.lua",
        "local function gain(specimen) return 1 + specimen % 7 end\n"
        "declare_plant{name = 'rc',\n"
        "  record = function(s) rng(s.seed) local u = 1 + rand(20) return {u = u, y = gain(s.variant)*u} end,\n"
        "  truth = function(s) return {K = gain(s.variant)} end}\n"
        "check{id = 'follows', points = 2, rerun = 'rc', test = function(a, b) return near(b.K, truth(b).K) end}\n"
        "check{id = 'hidden', points = 1, test = function(a)\n"
        "  local d = hidden('rc') return near(mean(d.y)/mean(d.u), truth('rc').K) end}\n");
    bench.submit_file("computes", kComputes);
    bench.submit_file("types", "answer('K', 2)\n");
    // With this secret the gain of the rerun is not 2.
    bench.bench().write("secret", "chosen by a test");
    const ChildResult graded = bench.grade({"--checks", "own", "--secret", "secret"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(bench.result("computes").at("score"), 4);
    EXPECT_EQ(bench.result("types").at("score"), 2);
}

TEST(custom_checks, mistakes_in_them_are_reported_with_file_and_line) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    const auto complaint = [&](const std::string& check) {
        bench.bench().write("own/mine.lua", check);
        return bench.grade({"--checks", "own", "--again"}).error_output;
    };
    EXPECT_THAT(complaint("\n\ncheck{id = 'y', test = function(a)\n  return nothing.at.all end}\n"),
                HasSubstr("mine.lua:4"));
    EXPECT_THAT(complaint("check{id = 'y', test = function(a) return 5 end}\n"),
                HasSubstr("a test returned 5; expected a number from 0 to 1"));
    EXPECT_THAT(complaint("check{id = 'y', document = true, test = function(a) return no_finding() end}\n"),
                HasSubstr("lesson 99_small has no document"));
    EXPECT_THAT(complaint("check{id = 'y', by_hand = true, test = function() end}\n"), HasSubstr("is marked manually"));
    EXPECT_THAT(complaint("check{id = 'y', rubric = 'x', test = function() end}\n"), HasSubstr("by_hand = true"));
    std::filesystem::remove(bench.bench().path("own/mine.lua"));
    EXPECT_THAT(bench.grade({"--checks", "own", "--again"}).error_output,
                HasSubstr("contains no checks (files *.lua)"));
}

// oracle: the checks' definition: 'x' bears no change of x, 'always' none at all, 'loose' every one
TEST(custom_checks, are_tried_on_what_is_known_to_be_right_or_wrong) {
    GradingBench bench(kAnswers, kChecks,
                       "-- BEGIN SOLUTION\n" + std::string(kSolution) + "-- END SOLUTION\nprint('done')\n");
    Workbench& work = bench.bench();
    work.write("own/mine.lua",
               "check{id = 'loose', test = function(a) return true end}\n"
               "check{id = 'essay', by_hand = true}\n");
    work.write("own/try/half_right.lua", "answer('x', 42)\nanswer('v', vector{2, 4})\n");
    work.write("home/lessons/99_small/wrong_sign.lua", "answer('x', -42)\nanswer('v', vector{1, 2})\n");
    const ChildResult tried = work.dynlab({"checks", "try", "own", "--lesson", "99"});
    EXPECT_EQ(tried.exit_code, 0) << tried.error_output;
    for (const char* line :
         {"reference solution: 6 of 6 points\n", "starter: 1 of 6 points\n", "wrong_sign.lua: 4 of 6 points\n    x ",
          "half_right.lua: 3 of 6 points\n    v ", "6 changes of one answer",
          "v left out                                   v\n", "x with the opposite sign                     x\n",
          "\nloose: no script fails it\n", "\nessay: marked by hand\n"})
        EXPECT_THAT(tried.output, HasSubstr(line));
    work.write("own/mine.lua", "check{id = 'always', test = function(a) return near(a.x, 43, {rel = 0.01}) end}\n");
    const ChildResult broken = work.dynlab({"checks", "try", "own", "--lesson", "99"});
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_THAT(broken.output, HasSubstr("always: the reference solution fails it"));
    EXPECT_THAT(work.files(), Not(::testing::Contains("out")));
}

// oracle: the theoretical gain of the common plant variant, which is number 0
TEST(custom_checks, what_theory_says_earns_no_points_where_scripts_are_graded) {
    GradingBench bench(
        kGain, "check{id = 'K', test = function(a) return near(a.K, truth(a, 'suspension').gain, {rel = 0.01}) end}\n",
        "local d = load('suspension')\nlocal theory = true_model('suspension').gain\n"
        "answer('K', mean(d.y:range(300, #d.y)))\n");
    bench.submit_file("peeks", "answer('K', true_model('suspension').gain)\n");
    bench.submit_file("computes", "local d = load('suspension')\nanswer('K', mean(d.y:range(300, #d.y)))\n");
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(GradingBench::error_reason(bench.result("peeks")), "");
    EXPECT_EQ(bench.result("peeks").at("score"), 0);
    EXPECT_EQ(bench.result("computes").at("score"), 1);
}

}  // namespace test_custom_checks
}  // namespace dynlab::test
