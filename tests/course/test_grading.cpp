#include <fmt/format.h>
#include <gmock/gmock.h>

#include "course/grading_bench.h"
#include "documents/text_lines.h"

namespace dynlab::test {
namespace test_grading {
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* kAnswers = "--   x: number\n--   G: model\n";
constexpr const char* kSolution = "answer('x', 42 + 0*randn(1)[1])\nanswer('G', tf({2}, {1, 3}))\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2, about = 'The number', hint = 'Six times seven.',\n"
    "  test = function(a) return near(a.x, 42, {rel = 0.05, half = 0.2}) end,\n"
    "  mistakes = {{when = function(a) return a.x == -42 end, say = 'The sign is wrong.'}}}\n"
    "check{id = 'gain', points = 3, test = function(a) return near(dcgain(a.G), 2/3, {rel = 0.01}) end}\n";

/// What the points of one submission's checks come to.
std::vector<double> points(const nlohmann::json& result) {
    std::vector<double> all;
    for (const auto& test : result.at("tests")) all.push_back(test.value("score", -1.0));
    return all;
}

std::string message(const nlohmann::json& result, std::size_t check) {
    return result.at("tests").at(check).at("output").get<std::string>();
}

// oracle: the checks' definition
TEST(grading, gives_points_partial_credit_and_messages) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("right", kSolution);
    bench.submit_file("near", "answer('x', 48)\nanswer('G', tf({4}, {1, 6}))\n");
    bench.submit_file("sign", "answer('x', -42)\nanswer('G', tf({2}, {1, 4}))\n");
    bench.submit_file("starter", "-- YOUR CODE HERE\n");
    bench.submit_file("stops", "answer('x', 42)\nerror('no more')\n");
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(graded.output,
                HasSubstr("5 submissions: 5 graded now, 0 unchanged; isolation " + GradingBench::level()));
    EXPECT_EQ(points(bench.result("right")), (std::vector<double>{2, 3}));
    EXPECT_EQ(points(bench.result("near")), (std::vector<double>{1, 3}));
    EXPECT_EQ(points(bench.result("sign")), (std::vector<double>{0, 0}));
    EXPECT_EQ(message(bench.result("sign"), 0), "The sign is wrong.\nSix times seven.");
    EXPECT_THAT(message(bench.result("sign"), 1), HasSubstr("The error is 25 %"));
    EXPECT_EQ(points(bench.result("starter")), (std::vector<double>{0, 0}));
    EXPECT_EQ(message(bench.result("starter"), 1), "The answer \"G\" was not submitted.");
    EXPECT_EQ(points(bench.result("stops")), (std::vector<double>{2, 0}));
    EXPECT_THAT(GradingBench::error_reason(bench.result("stops")), HasSubstr("analysis.lua:2: no more"));
    EXPECT_EQ(bench.result("right").at("score"), 5);
    EXPECT_THAT(bench.bench().read("out/gradebook.csv"), HasSubstr(",near,graded,4,5,0,0,1,3\r\n"));
    EXPECT_THAT(bench.bench().read("out/results/near/feedback.md"), HasSubstr("*Six times seven.*"));
}

// Checks that an author tries may use the cache. For a submission, everything is computed, whatever the cache contains.
TEST(grading, reads_and_writes_no_cache) {
    const std::string solution =
        "local heat = load('heat_transfer')\n"
        "local found = srivcstruc(iddata(heat.y, heat.u, 1), {poles = {1, 4}})\n"
        "answer('x', found and 42)\n";
    GradingBench bench("--   x: number\n", "check{id = 'x', test = function(a) return near(a.x, 42) end}\n", solution);
    const auto kept_calls = [&bench] {
        std::vector<std::filesystem::path> names;
        std::error_code none;
        for (const auto& call : std::filesystem::directory_iterator(bench.bench().cache() / "dynlab/calls", none))
            names.push_back(call.path());
        return names;
    };
    bench.submit_file("right", solution);
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.output << graded.error_output;
    EXPECT_THAT(kept_calls(), IsEmpty());
    const ChildResult tried = bench.bench().dynlab({"checks", "try", "--lesson", "99"});
    ASSERT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
    ASSERT_THAT(kept_calls(), SizeIs(1));
    for (const std::filesystem::path& call : kept_calls()) std::filesystem::last_write_time(call, {});
    ASSERT_EQ(bench.grade({"--regrade"}).exit_code, 0);
    for (const std::filesystem::path& call : kept_calls())
        EXPECT_EQ(std::filesystem::last_write_time(call), std::filesystem::file_time_type()) << "it was recalled";
}

// oracle: the same script in English; the sandbox contains the translations of printed text
TEST(grading, french_scripts_print_what_they_estimate) {
    const std::string again =
        "check{id = 'again', points = 1, rerun = 'drive', test = function(a, b) return b.x == 42 end}\n";
    GradingBench bench(kAnswers, kChecks + again, kSolution);
    const std::string script = "print(iddata(range(1, 60), range(1, 60), 1))\n" + std::string(kSolution);
    const std::string header = GradingBench::header(kAnswers);
    bench.submit_file("english", header + script);
    bench.submit_file("french", replaced(header, "-- answers:", "-- language: fr\n-- answers:") + script);
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(points(bench.result("english")), (std::vector<double>{2, 3, 1}));
    EXPECT_EQ(points(bench.result("french")), (std::vector<double>{2, 3, 1}));
    const auto printed = bench.result("french").at("extra_data").at("dynlab").at("printed").get<std::string>();
    EXPECT_THAT(printed, HasSubstr("60 échantillons"));
}

// oracle: the fingerprint's purpose
TEST(grading, goes_on_where_it_was_and_keeps_manual_marks) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    bench.submit_file("b", "answer('x', 1)\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    EXPECT_THAT(bench.grade().output, HasSubstr("0 graded now, 2 unchanged"));
    bench.bench().write("out/marks.csv", "who,check,points,reason\nb,x,1.5,\"good idea, wrong number\"\n");
    EXPECT_THAT(bench.grade().output, HasSubstr("0 graded now, 2 unchanged"));
    EXPECT_EQ(points(bench.result("b")), (std::vector<double>{1.5, 0}));
    EXPECT_EQ(message(bench.result("b"), 0), "good idea, wrong number\nSix times seven.");
    EXPECT_THAT(bench.grade({"--regrade"}).output, HasSubstr("2 graded now, 0 unchanged"));
    EXPECT_EQ(points(bench.result("b")), (std::vector<double>{1.5, 0}));
    bench.bench().write("out/marks.csv", "who,check,points,reason\n");
    bench.grade();
    EXPECT_EQ(points(bench.result("b")), (std::vector<double>{0, 0}));
    bench.submit_file("b", kSolution);
    EXPECT_THAT(bench.grade().output, HasSubstr("1 graded now, 1 unchanged"));
    EXPECT_THAT(bench.grade({"--only", "a", "--regrade"}).output, HasSubstr("1 graded now, 0 unchanged"));
    const ChildResult unknown = bench.grade({"--only", "c"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.error_output, HasSubstr("no submission"));
}

// oracle: the mark that the instructor gave
TEST(grading, marks_of_submissions_that_are_not_chosen_reach_their_feedback) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    bench.submit_file("b", "answer('x', 1)\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    bench.bench().write("out/marks.csv", "who,check,points,reason\nb,x,1.5,good idea\n");
    EXPECT_THAT(bench.grade({"--only", "a"}).output, HasSubstr("0 graded now, 1 unchanged"));
    EXPECT_EQ(points(bench.result("b")), (std::vector<double>{1.5, 0}));
    EXPECT_THAT(bench.bench().read("out/results/b/feedback.md"), HasSubstr("good idea"));
}

// oracle: the course's own commands on what grade made
TEST(grading, results_are_of_a_course_with_every_version) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("group-1", kSolution);
    bench.bench().write("in/group-2/report.pdf", "%PDF");
    bench.bench().write("roster.csv", "id,name,group\n1,Anna Müller,group-1\n2,Zoë Ade,group-2\n");
    EXPECT_EQ(bench.grade({"--roster", "roster.csv"}).exit_code, 1) << "one cannot be read";
    const auto course = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"course", "--course", "out/course"});
        const ChildResult result = bench.bench().dynlab(words);
        EXPECT_EQ(result.exit_code, 0) << result.error_output;
        return result.output;
    };
    EXPECT_THAT(course({"marks"}), ContainsRegex("group-1 +v1 +5 of 5"));
    EXPECT_THAT(course({"who", "2"}), HasSubstr("v1"));
    bench.submit_file("group-1", "answer('x', 1)\n");
    bench.grade();
    EXPECT_THAT(bench.bench().read("out/gradebook.csv"), HasSubstr("1,Anna Müller,group-1,graded,0,"));
    EXPECT_THAT(course({"who", "1"}), HasSubstr("v2"));
    EXPECT_THAT(course({"verify"}), HasSubstr("complete and unaltered"));
}

// oracle: the runs that do not end
TEST(grading, reports_what_stopped_the_worked_solution_before_what_is_missing) {
    const std::string endless = "while true do end\nanswer('x', 42)\n";
    GradingBench bench(kAnswers, "check{id = 'x', test = function(a) return a.x == 42 end}\n", endless);
    bench.submit_file("a", kSolution);
    EXPECT_THAT(bench.grade({"--timeout", "2"}).error_output,
                ContainsRegex("the check \"x\" is left ungraded, because the run of the reference solution stopped: "
                              ".*\\. The check reports: The answer \"x\""));
    GradingBench other(kAnswers, "check{id = 'x', rerun = 'suspension', test = function(a, b) return b.x == 42 end}\n",
                       "local y = load('suspension').y\n"
                       "if math.abs(mean(y:range(300, #y)) - 10) > 0.05 then while true do end end\n"
                       "answer('x', 42)\n");
    other.submit_file("a", kSolution);
    EXPECT_THAT(other.grade({"--timeout", "2"}).error_output,
                ContainsRegex("is left ungraded, because the run of the reference solution on suspension stopped: "
                              ".*\\. The check reports: "));
}

// oracle: the rule that a broken check costs no student points
TEST(grading, leaves_ungraded_what_the_worked_solution_does_not_pass) {
    GradingBench bench(kAnswers, std::string(kChecks) + "check{id = 'broken', test = function(a) return a.x.y.z end}\n",
                       kSolution);
    bench.submit_file("a", kSolution);
    const ChildResult graded = bench.grade();
    EXPECT_EQ(graded.exit_code, 1);
    EXPECT_THAT(graded.error_output,
                HasSubstr("the check \"broken\" is left ungraded, because the reference solution does not pass it"));
    const auto result = bench.result("a");
    EXPECT_EQ(points(result), (std::vector<double>{2, 3, -1}));
    EXPECT_FALSE(result.contains("score"));
    EXPECT_THAT(bench.bench().read("out/gradebook.csv"), HasSubstr(",a,partly ungraded,,5,"));
}

TEST(grading, checks_that_cannot_be_read_stop_before_anything_is_written) {
    for (const auto& [checks, fragment] :
         {std::pair("check{id = 'x' test = 1}", "checks.lua:1"), std::pair("local a = 1", "declares no checks"),
          std::pair("check{id = 'x', test = function() end, pionts = 3}", "points"),
          std::pair("check{id = 'x', test = function() end}\ncheck{id = 'x', test = function() end}", "check \"x\""),
          std::pair("check{id = 'x', rerun = 'hairdryer', test = function() end}", "hairdryer"),
          std::pair("check{id = 'x', points = 0, test = function() end}", "greater than 0 and at most 1000")}) {
        GradingBench bench(kAnswers, checks, kSolution);
        bench.submit_file("a", kSolution);
        const ChildResult graded = bench.grade();
        EXPECT_EQ(graded.exit_code, 1);
        EXPECT_THAT(graded.error_output, HasSubstr(fragment));
    }
}

// oracle: data of another plant variant, whose true model the answers must follow
TEST(grading, typed_in_answers_do_not_follow_other_records) {
    const char* checks =
        "check{id = 'K', rerun = 'suspension', test = function(a, b)\n"
        "  return all_of(near(b.K, truth(b).gain, {rel = 0.05}), differs(a.K, b.K)) end}\n"
        "check{id = 'fits', test = function(a)\n"
        "  local h = hidden(\"suspension\")\n"
        "  return #h.y == 401 and truth('suspension').gain > 0 end}\n"
        "check{id = 'noise', rerun = 'seed', test = function(a, b) return differs(a.r, b.r) end}\n";
    const std::string computes =
        "local d = load('suspension')\nanswer('K', mean(d.y:range(300, #d.y)))\nanswer('r', randn(1)[1])\n";
    GradingBench bench("--   K: number\n--   r: number\n", checks, computes);
    bench.submit_file("computes", computes);
    bench.submit_file("typed", "answer('K', 10)\nanswer('r', -1)\n");
    // A file that imitates the official data is not read.
    bench.submit_file("own_data", computes);
    bench.bench().write("in/own_data/suspension.csv", "t,u,y\n0,1,10\n1,1,10\n");
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(points(bench.result("computes")), (std::vector<double>{1, 1, 1}));
    EXPECT_EQ(points(bench.result("own_data")), (std::vector<double>{1, 1, 1}));
    EXPECT_EQ(points(bench.result("typed")), (std::vector<double>{0, 1, 0}));
}

// oracle: the true model of the plant variant that the group's seed draws
TEST(grading, groups_are_held_against_their_own_records) {
    const char* checks =
        "check{id = 'K', test = function(a) return near(a.K, mean(load('suspension').y:range(300, 401)), {rel = 1e-9}) "
        "end}\n";
    const std::string computes = "local d = load(\"suspension\")\nanswer('K', mean(d.y:range(300, #d.y)))\n";
    GradingBench bench("--   K: number\n", checks, computes);
    const Workbench& work = bench.bench();
    ASSERT_EQ(work.dynlab({"new", "99", "own", "--group-seed", "7"}).exit_code, 0);
    work.write("own/analysis.lua", computes);
    work.shell(
        "$DYNLAB run own/analysis.lua --out o1; $DYNLAB run -e \"local d = load('suspension') "
        "answer('K', mean(d.y:range(300, #d.y)))\" --out o2");
    const auto value = [&](const char* file) {
        return nlohmann::json::parse(work.read(file)).at("answers").at("K").at("value").get<double>();
    };
    const double own = value("o1/record.json"), common = value("o2/record.json");
    EXPECT_NE(own, common);
    bench.submit_file("group-7", "answer('K', " + fmt::format("{:.17g}", own) + ")\n");
    bench.submit_file("group-8", "answer('K', " + fmt::format("{:.17g}", own) + ")\n");
    bench.submit_file("others", "answer('K', " + fmt::format("{:.17g}", common) + ")\n");
    work.write("roster.csv", "id,group,seed\n1,group-7,7\n2,group-8,8\n3,others,\n");
    ASSERT_EQ(bench.grade({"--roster", "roster.csv"}).exit_code, 0);
    // Of the twelve submissions, one sandbox grades these three, which come last.
    for (int i = 1; i <= 9; ++i) bench.submit_file("a" + std::to_string(i), computes);
    bench.grade({"--roster", "roster.csv", "--jobs", "1", "--regrade"});
    EXPECT_EQ(bench.result("group-7").at("score"), 1);
    EXPECT_EQ(bench.result("group-8").at("score"), 0);
    EXPECT_EQ(bench.result("others").at("score"), 1);
}

TEST(grading, hidden_checks_show_points_and_hint_only) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.bench().write(
        "more/extra.lua",
        "check{id = 'secret', hint = 'Think of poles.', test = function(a) return near(a.x, 42) end}\n");
    bench.submit_file("a", "answer('x', 84)\n");
    ASSERT_EQ(bench.grade({"--checks", "more"}).exit_code, 0);
    EXPECT_EQ(message(bench.result("a"), 2), "Think of poles.");
    EXPECT_THAT(bench.bench().read("out/results/a/feedback.md"), HasSubstr("Think of poles"));
    EXPECT_THAT(message(bench.result("a"), 0), HasSubstr("The error is 100 %"));
}

TEST(grading, a_row_for_each_student_lateness_and_neutral_formulas) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("group-1", kSolution);
    bench.submit_file("Ada Lovelace_77_assignsubmission_file_", kSolution);
    bench.submit_file("hoppergrace_LATE_99_1234_work", kSolution);
    bench.submit_file("=cmd()", kSolution);
    bench.bench().write("roster.csv",
                        "ID;Name;Group\r\n001;A. Kalman;group-1\r\n002;R. Kalman;group-1\r\n003;Ada Lovelace;\r\n"
                        "99;Grace Hopper;\r\n005;Nobody;\r\n006;=1+1;=cmd()\r\n");
    bench.bench().write("deadlines.csv",
                        "submission,deadline,received,percent_per_day,most_percent\n"
                        "*,2026-01-10 12:00,2026-01-10 11:00,10,100\nhoppergrace_LATE_99_1234_work,2026-01-10 12:00,"
                        "2026-01-11 13:00,10,100\n");
    const ChildResult graded = bench.grade({"--roster", "roster.csv", "--deadlines", "deadlines.csv"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const std::string book = bench.bench().read("out/gradebook.csv");
    EXPECT_THAT(book, HasSubstr("001,A. Kalman,group-1,graded,5,5,0,0,2,3,\r\n002,R. Kalman,group-1,graded,5,"));
    EXPECT_THAT(book, HasSubstr("003,Ada Lovelace,Ada Lovelace_77_assignsubmission_file_,graded,5,"));
    EXPECT_THAT(book, HasSubstr("99,Grace Hopper,hoppergrace_LATE_99_1234_work,graded,4,5,1,25,"));
    EXPECT_THAT(book, HasSubstr("005,Nobody,,nothing submitted,"));
    EXPECT_THAT(book, HasSubstr("006,'=1+1,'=cmd(),graded,5,"));
}

// oracle: the same class graded by a single job, and in another order
TEST(grading, marks_depend_on_neither_threads_nor_order) {
    const auto book_with = [](const char* jobs) {
        GradingBench bench(kAnswers, kChecks, kSolution);
        for (int i = 0; i < 12; ++i)
            bench.submit_file("s" + std::to_string(i),
                              i % 3 == 0 ? "error('broken')\n" : "answer('x', " + std::to_string(35 + i) + ")\n");
        EXPECT_EQ(bench.grade({"--jobs", jobs}).exit_code, 0);
        return bench.bench().read("out/gradebook.csv") + bench.bench().read("out/results/s4/results.json");
    };
    EXPECT_EQ(book_with("1"), book_with("4"));
}

// oracle: the score of the first submission; state that a check keeps would reveal other submissions
TEST(grading, what_is_graded_in_one_sandbox_sees_nothing_of_the_others) {
    GradingBench bench(kAnswers,
                       "seen, others = 0, {}\n"
                       "check{id = 'first', test = function(a) seen = seen + 1 return seen == 1 end}\n"
                       "check{id = 'alone', test = function(a) table.insert(others, a.x) return #others == 1 and "
                       "others[1] < 50 end}\n",
                       "answer('x', 42)\n");
    for (int i = 0; i < 12; ++i)
        bench.submit_file(fmt::format("s{:02}", i), fmt::format("answer('x', {})\n", i == 4 ? 60 : 30 + i));
    ASSERT_EQ(bench.grade({"--jobs", "1"}).exit_code, 0);
    for (int i = 0; i < 12; ++i)
        EXPECT_EQ(points(bench.result(fmt::format("s{:02}", i))), (std::vector<double>{1, i == 4 ? 0.0 : 1.0})) << i;
}

// oracle: the score of each submission when it is graded alone
TEST(grading, a_check_that_comes_to_no_end_costs_no_other) {
    GradingBench bench(kAnswers,
                       "check{id = 'x', test = function(a)\n"
                       "  if a.x == 1 then local t = {} while true do t[#t + 1] = zeros(1000000) end end\n"
                       "  return near(a.x, 42) end}\n"
                       "check{id = 'other', test = function(a) return a.x > 0 end}\n",
                       "answer('x', 42)\n");
    for (int i = 0; i < 12; ++i)
        bench.submit_file(fmt::format("s{:02}", i), fmt::format("answer('x', {})\n", i == 4 ? 1 : 42));
    bench.grade({"--jobs", "1"});
    for (int i = 0; i < 12; ++i)
        EXPECT_EQ(points(bench.result(fmt::format("s{:02}", i))), (std::vector<double>{i == 4 ? 0.0 : 1.0, 1})) << i;
}

/// All files that a run of grade wrote, except those that differ by nature: logs, the cached run of the reference
/// solution, which contains its duration, and the course, which has a secret key.
std::map<std::string, std::string> files_of(GradingBench& bench) {
    std::map<std::string, std::string> files;
    const std::filesystem::path out = bench.bench().path("out");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
        if (entry.is_regular_file() && entry.path().filename() != "log.txt" &&
            entry.path().filename() != ".worked_solution.cbor" &&
            *entry.path().lexically_relative(out).begin() != "course")
            files[entry.path().lexically_relative(out)] = read_file(entry.path());
    return files;
}

// oracle: what each of two hundred must get, and the same class graded serially
TEST(grading, a_class_of_sixty_with_one_in_ten_broken) {
    const auto graded = [](const char* jobs) {
        GradingBench bench(kAnswers, kChecks, kSolution);
        for (int i = 0; i < 60; ++i)
            bench.submit_file(
                fmt::format("s{:03}", i),
                i % 10 == 3 ? "answer('x', 42)\nlocal y = nothing.at_all\n"
                            : fmt::format("answer('x', {})\nanswer('G', tf({{2}}, {{1, 3}}))\n", i % 2 == 0 ? 42 : 48));
        EXPECT_EQ(bench.grade({"--jobs", jobs}).exit_code, 0);
        for (int i = 0; i < 60; ++i)
            EXPECT_EQ(bench.result(fmt::format("s{:03}", i)).at("score"), i % 10 == 3 ? 2 : i % 2 == 0 ? 5 : 4) << i;
        return files_of(bench);
    };
    EXPECT_EQ(graded("1"), graded("3"));
}

// oracle: the same class once more
TEST(grading, the_same_class_gives_the_same_documents) {
    const auto graded = [] {
        GradingBench bench(kAnswers, kChecks, kSolution);
        for (const char* name : {"first", "second"}) bench.submit_file(name, "answer('x', 42)\n");
        const ChildResult run = bench.bench().dynlab(
            {"grade", "in", "--lesson", "99", "--out", "out", "--isolation", GradingBench::level()});
        EXPECT_EQ(run.exit_code, 0) << run.error_output;
        return files_of(bench);
    };
    const auto files = graded();
    EXPECT_THAT(files, Contains(Key("summary.pdf")));
    EXPECT_THAT(files, Contains(Key("results/second/feedback.pdf")));
    EXPECT_EQ(files, graded());
}

// oracle: the undisturbed run
TEST(grading, killed_at_any_moment_it_ends_with_the_same_gradebook) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    for (int i = 0; i < 10; ++i)
        bench.submit_file("s" + std::to_string(i), "answer('x', " + std::to_string(38 + i) + ")\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    const std::string whole = bench.bench().read("out/gradebook.csv");
    bench.bench().shell("rm -r out");
    for (int i = 1; i <= 10; ++i)
        bench.bench().shell("$DYNLAB grade in --lesson 99 --out out --no-pdf --isolation " + GradingBench::level() +
                            " >/dev/null 2>&1 & sleep 0." + std::to_string(i * 7 % 10) + "3; kill -9 $!; wait");
    ASSERT_EQ(bench.grade().exit_code, 0);
    EXPECT_EQ(bench.bench().read("out/gradebook.csv"), whole);
}

// oracle: unzip and sha256sum, other programs; the same bytes twice
TEST(grading, packs_are_whole_repeatable_and_can_be_graded) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    ASSERT_EQ(work.dynlab({"new", "99", "mine"}).exit_code, 0);
    work.write("mine/analysis.lua", kSolution);
    work.write("mine/notes/ü.txt", "u");
    work.shell("ln -s /etc/passwd mine/link");
    const ChildResult packed = work.dynlab({"pack", "mine", "-o", "in/mine.zip"});
    ASSERT_EQ(packed.exit_code, 0) << packed.error_output;
    EXPECT_THAT(packed.error_output, HasSubstr("link"));
    EXPECT_THAT(packed.output, Not(HasSubstr("data/")));
    work.shell("touch -d '2001-02-03 04:05' mine/analysis.lua");
    ASSERT_EQ(work.dynlab({"pack", "mine", "-o", "again.zip"}).exit_code, 0);
    EXPECT_EQ(work.read("in/mine.zip"), work.read("again.zip"));
    const std::string listed =
        work.shell("unzip -Z1 again.zip; unzip -tq again.zip; unzip -p again.zip MANIFEST.json").output;
    EXPECT_THAT(listed, HasSubstr("MANIFEST.json\nanalysis.lua\ngroup.toml\n"));
    EXPECT_THAT(listed, HasSubstr("No errors detected"));
    EXPECT_THAT(listed, HasSubstr("0bfe935e70c321c7ca3afc75ce0d0ca2f98b5422e008bb31c00c6d7f1f1c0ad6"));
    ASSERT_EQ(bench.grade().exit_code, 0);
    EXPECT_EQ(points(bench.result("mine")), (std::vector<double>{2, 3}));
    // All of a class in one zip, as an LMS exports it.
    work.shell(
        "cd in && zip -q ../export.zip mine.zip && cd .. && rm in/mine.zip && mv export.zip in.zip && rmdir in && mv "
        "in.zip in");
    EXPECT_THAT(bench.grade().output, HasSubstr("1 submission: 0 graded now, 1 unchanged"));
    ASSERT_EQ(work.dynlab({"bundle", "99", "-o", "lesson.zip"}).exit_code, 0);
    const std::string starter = work.shell("unzip -Z1 lesson.zip; unzip -p lesson.zip 99_small/analysis.lua").output;
    EXPECT_THAT(starter, HasSubstr("99_small/checks.lua"));
}

}  // namespace test_grading
}  // namespace dynlab::test
