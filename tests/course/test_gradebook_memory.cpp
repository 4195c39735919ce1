#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ctime>

#include "course/grading_bench.h"
#include "course/office/deadline_import.h"
#include "course/office/folder_grading.h"
#include "platform/error.h"
#include "platform/locks/file_lock.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace dynlab::test {
namespace test_gradebook_memory {
namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

constexpr const char* kAnswers = "--   x: number\n";
constexpr const char* kSolution = "answer('x', 42)\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2, test = function(a) return near(a.x, 42, {rel = 0.01}) end}\n";
constexpr const char* kOwn = "check{id = 'own', points = 3, test = function(a) return a.x > 0 end}\n";

void expect_refused(const ChildResult& graded, const std::string& reported) {
    EXPECT_EQ(graded.exit_code, 1) << graded.output;
    EXPECT_THAT(graded.error_output, AllOf(HasSubstr("were computed with other inputs"), HasSubstr(reported)));
}

// oracle: a gradebook of one kind of marks
TEST(gradebook_memory, marks_of_two_kinds_are_never_mixed) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    for (const char* name : {"a", "b"}) bench.submit_file(name, kSolution);
    work.write("own/more.lua", kOwn);
    work.write("secret.txt", "first");
    work.write("other.txt", "second");
    work.write("deadlines.csv", "submission,deadline\n*,2096-03-01 18:00\n");
    const std::vector<std::string> all = {"--checks", "own", "--secret", "secret.txt", "--deadlines", "deadlines.csv"};
    ASSERT_EQ(bench.grade(all).exit_code, 0);
    const std::string whole = work.read("out/gradebook.csv");
    EXPECT_THAT(whole, HasSubstr(",a,graded,5,5,"));
    expect_refused(bench.grade({"--secret", "other.txt", "--checks", "none", "--only", "a"}),
                   "your own checks (own then, none now), the secret");
    expect_refused(
        bench.grade({"--checks", "own", "--secret", "secret.txt", "--deadlines", "deadlines.csv", "--keep", "newest"}),
        "the choice of the submission that counts (best then, newest now)");
    EXPECT_EQ(work.read("out/gradebook.csv"), whole);
    EXPECT_THAT(bench.grade(all).output, HasSubstr("0 graded now, 2 unchanged"));
    // Deadlines that moved are wanted, or refused.
    work.write("deadlines.csv", "submission,deadline\n*,2001-03-01 18:00\n");
    std::vector<std::string> one = all, again = all;
    one.insert(one.end(), {"--only", "a"});
    again.push_back("--again");
    expect_refused(bench.grade(one), "the deadlines (deadlines.csv has changed)");
    expect_refused(bench.grade(all), "the deadlines (deadlines.csv has changed)");
    work.write("moved.csv", "submission,deadline\n*,2001-02-01 18:00\n");
    expect_refused(bench.grade({"--checks", "own", "--secret", "secret.txt", "--deadlines", "moved.csv"}),
                   "the deadlines (deadlines.csv then, moved.csv now)");
    EXPECT_EQ(work.read("out/gradebook.csv"), whole);
    // A penalty of all points waits until it is accepted, and stays so.
    const ChildResult waiting = bench.grade(again);
    EXPECT_EQ(waiting.exit_code, 1);
    EXPECT_THAT(waiting.output,
                AllOf(HasSubstr("2 late:\n  \"a\" is late by "), HasSubstr("2 notes need attention:"),
                      HasSubstr("the penalty of 100 % is not applied yet. Confirm the penalty with --accept-late")));
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr(",a,graded,5,5,0,"));
    std::vector<std::string> accepted = all;
    accepted.push_back("--accept-late");
    ASSERT_EQ(bench.grade(accepted).exit_code, 0);
    EXPECT_THAT(work.read("out/gradebook.csv"), AllOf(HasSubstr(",a,graded,0,5,5,"), HasSubstr(",b,graded,0,5,5,")));
    // Other checks, wanted: all marks again from the runs of before.
    work.write("own/more.lua", "check{id = 'own', points = 4, test = function(a) return a.x > 50 end}\n");
    expect_refused(bench.grade(all), "your own checks (own has changed)");
    work.write("own/more.lua", "check{id = 'own', points = 4, test = function(a) return a.x > 0 end}\n");
    EXPECT_THAT(bench.grade(again).output, HasSubstr("2 graded now, 0 unchanged"));
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr(",b,graded,0,6,6,"));
    EXPECT_THAT(bench.grade(all).output, HasSubstr("0 graded now, 2 unchanged"));
    EXPECT_THAT(bench.grade({"--secret", "empty.txt"}).error_output, HasSubstr("empty.txt"));
    work.write("empty.txt", "");
    EXPECT_THAT(bench.grade({"--secret", "empty.txt"}).error_output, HasSubstr("empty.txt is empty"));
}

// oracle: the gradebook that all options gave
TEST(gradebook_memory, a_later_call_goes_on_with_the_options_of_the_first) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("group-1", "answer('x', 42)\nwhile true do end\n");
    work.write("own/more.lua", kOwn);
    work.write("secret.txt", "first");
    work.write("roster.csv", "id,name,group\n1,Anna Müller,group-1\n2,Zoë Ade,group-2\n");
    work.write("deadlines.csv", "submission,deadline\n*,2096-03-01 18:00\n");
    work.write("times.csv", "group,time\ngroup-1,2096-03-01 20:00\n");
    EXPECT_EQ(work.dynlab({"grade", "in", "--out", "out"}).exit_code, 2);  // nothing to go on with: no lesson
    ASSERT_EQ(bench
                  .grade({"--checks", "own", "--secret", "secret.txt", "--roster", "roster.csv", "--deadlines",
                          "deadlines.csv", "--times", "times.csv", "--timezone", "Europe/Paris", "--timeout", "2",
                          "--keep", "newest"})
                  .exit_code,
              0);
    const std::string book = work.read("out/gradebook.csv");
    EXPECT_THAT(book, HasSubstr("received 2096-03-01 20:00"));
    const ChildResult again = work.shell("mkdir below && cd below && \"$DYNLAB\" grade ../in --out ../out --no-pdf");
    EXPECT_EQ(again.exit_code, 0) << again.error_output;
    EXPECT_THAT(again.output, HasSubstr("0 graded now, 1 unchanged"));
    EXPECT_EQ(work.read("out/gradebook.csv"), book);
    bench.submit_file("group-2", kSolution);
    EXPECT_THAT(work.dynlab({"grade", "in", "--out", "out", "--no-pdf"}).output,
                HasSubstr("1 graded now, 1 unchanged"));
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr("2,Zoë Ade,group-2,graded,5,5,0,"));
}

// oracle: the summary
TEST(gradebook_memory, the_terminal_lists_what_the_summary_lists) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("group-1", "error('no')\n");
    bench.submit_file("group-2", kSolution);
    bench.submit_file("Zoë Ade", kSolution);
    work.write("in/group-3/report.pdf", "%PDF");
    work.write("roster.csv",
               "id,name,group\n1,Anna Müller,group-1\n2,Zoë Ade,group-2\n3,Ben Lee,group-3\n4,Uma Kepler,group-4\n");
    work.write("deadlines.csv", "submission,deadline,received\n*,2096-03-01 18:00,\ngroup-2,,2096-03-02 17:00\n");
    const ChildResult graded = bench.grade({"--roster", "roster.csv", "--deadlines", "deadlines.csv"});
    for (const char* sentence :
         {"the script of \"group-1\" stopped: ", "\"group-3\" cannot be read: ",
          "\"group-2\" was late; points deducted: 0.2 (", "group-2 has several submissions. The best submission, "})
        EXPECT_THAT(graded.output, HasSubstr(sentence));
    const std::string listed = work.shell("sed -n '/Needs attention/,/^# /p' out/summary.md | grep -c '^- '").output;
    EXPECT_THAT(graded.output, HasSubstr(listed.substr(0, listed.find('\n')) + " notes need attention"));
}

// oracle: the log, which lists every run, and the definition of the checks
TEST(gradebook_memory, other_checks_need_no_other_run) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("loop", "answer('x', 42)\nwhile true do end\n");
    work.write("own/more.lua", kOwn);
    ASSERT_EQ(bench.grade({"--timeout", "2", "--checks", "own"}).exit_code, 0);
    EXPECT_THAT(work.read("out/logs/loop/log.txt"), HasSubstr("run main"));
    work.write("own/more.lua", "check{id = 'own', points = 5, test = function(a) return a.x == 42 end}\n");
    bench.grade({"--timeout", "2", "--checks", "own", "--again"});
    EXPECT_THAT(work.read("out/logs/loop/log.txt"),
                AllOf(HasSubstr("the earlier runs were used"), Not(HasSubstr("run main"))));
    EXPECT_EQ(GradingBench::score(bench.result("loop")), 7);
    bench.grade({"--timeout", "2", "--checks", "own", "--regrade"});
    EXPECT_THAT(work.read("out/logs/loop/log.txt"), HasSubstr("run main"));
    // A corrupt run file is created again.
    work.write("out/runs/loop/run.cbor", "spoilt");
    work.write("own/more.lua", kOwn);
    bench.grade({"--timeout", "2", "--checks", "own", "--again"});
    EXPECT_THAT(work.read("out/logs/loop/log.txt"), HasSubstr("run main"));
}

// oracle: the cached run of the reference solution, which no longer passes the checks after a change
TEST(gradebook_memory, the_worked_solution_is_run_again_when_it_has_changed) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("a", kSolution);
    ASSERT_EQ(bench.grade().exit_code, 0);
    const auto spoil = [&] {  // which ends in a form of the same length
        const std::string memory = "out/runs/.worked_solution.cbor";
        EXPECT_EQ(work.shell("LC_ALL=C grep -c '\"value\":42' " + memory).output, "1\n");
        work.shell("LC_ALL=C sed -i 's/\"value\":42/\"value\":13/' " + memory);
    };
    const std::string broken = "the check \"x\" is left ungraded, because the reference solution does not pass it";
    spoil();
    EXPECT_THAT(bench.grade().error_output, HasSubstr(broken));
    work.write("home/lessons/99_small/lesson.lua", GradingBench::header(kAnswers) + "answer('x', 6*7)\n");
    EXPECT_THAT(bench.grade().error_output, Not(HasSubstr(broken)));
    spoil();
    EXPECT_THAT(bench.grade({"--regrade"}).error_output, Not(HasSubstr(broken)));
}

// oracle: who is meant
TEST(gradebook_memory, only_takes_a_name_a_group_an_id_or_a_student) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    for (const char* name :
         {"Anna Müller_900001_assignsubmission_file_", "group-2", "Ben Lee_900003_assignsubmission_file_"})
        bench.submit_file(name, kSolution);
    work.write("roster.csv", "id;name;group\n1;Anna Müller;group-1\n2;Zoë Ade;group-2\n3;Ben Lee;group-3\n");
    const TemporaryFolder store;
    Course::create(store.path(), "k", "UTC");
    Course course(store.path());
    import_roster(course, work.path("roster.csv"), true);
    Assignment lab;
    lab.name = lab.lesson = "99_small", lab.kind = "lab";
    set_assignment(course, lab);
    lab = assignment_named(course, "");
    const ClassSubmissions submissions(work.path("in"), Isolation::kProcess, DYNLAB_PROGRAM);
    const ReceivedClass received = receive_class(course, lab, submissions, {}, 0);
    const auto chosen = [&](const std::vector<std::string>& words) {
        CourseWork folder(course, lab, received);
        folder.choose(course, words);
        std::vector<std::string> names;
        for (const std::size_t place : folder.work().chosen)
            names.push_back(folder.work().items[place].submission.name.substr(0, 7));
        return names;
    };
    for (const char* word :
         {"group-1", "Group 1", "anna muller", "1", "900001", "Anna Müller_900001_assignsubmission_file_"})
        EXPECT_THAT(chosen({word}), ElementsAre("Anna M\xC3")) << word;
    EXPECT_THAT(chosen({"Zoë Ade", "3"}), UnorderedElementsAre("group-2", "Ben Lee"));
    EXPECT_EQ(chosen({}).size(), 3u);
    EXPECT_THROW(chosen({"group-4"}), EnvironmentError);
    // The command takes the words, and reports those that are not graded now but would get other marks.
    ASSERT_EQ(bench.grade({"--roster", "roster.csv"}).exit_code, 0);
    bench.submit_file("group-2", "answer('x', 1)\n");
    const ChildResult one = bench.grade({"--roster", "roster.csv", "--regrade", "--only", "3"});
    EXPECT_THAT(one.output, HasSubstr("1 graded now, 0 unchanged"));
    EXPECT_THAT(one.error_output, HasSubstr("the marks of \"group-2\" are out of date"));
    EXPECT_THAT(bench.grade({"--roster", "roster.csv", "--only", "group-4"}).error_output,
                HasSubstr("no submission, group or student is named \"group-4\""));
}

// oracle: the roster, and the group that submitted each file
TEST(gradebook_memory, unmatched_work_is_reported_and_a_list_assigns_it) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("my work", kSolution);
    bench.submit_file("group-2", "answer('x', 7)\n");
    bench.submit_file("Ben Lee", "answer('x', 7)\n");
    work.write("roster.csv",
               "Vorname;Nachname;ID-Nummer;E-Mail-Adresse;Gruppe\nJos\xE9;Garc\xED"
               "a;1;j@x;group-1\nZo\xEB;Ade;2;;group-2\nBen;Lee;3;;group-3\n");
    const ChildResult graded = bench.grade({"--roster", "roster.csv"});
    EXPECT_EQ(graded.exit_code, 1);
    EXPECT_THAT(graded.error_output, HasSubstr("roster.csv is not UTF-8, so dynlab read the file as Windows-1252"));
    EXPECT_THAT(graded.output,
                AllOf(HasSubstr("\"my work\" matches no student in the roster: the name matches no group"),
                      HasSubstr("\"Ben Lee\" and \"group-2\" are identical byte for byte")));
    EXPECT_THAT(work.read("out/gradebook.csv"),
                AllOf(HasSubstr("1,José García,,nothing submitted"), HasSubstr("2,Zoë Ade,group-2,graded,0,")));
    work.write("roster.csv", "id,name,group\n1,José García,group-1\n2,Zoë Ade,group-2\n3,Ben Lee,group-3\n");
    work.write("owners.csv", "submission;id\nmy work;1\n");
    ASSERT_EQ(bench.grade({"--roster", "roster.csv", "--owners", "owners.csv"}).exit_code, 0);
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr("1,José García,my work,graded,2,2,"));
    // The course knows roster and owners from now on.
    std::filesystem::remove(work.path("roster.csv")), std::filesystem::remove(work.path("owners.csv"));
    bench.submit_file("my work", "answer('x', 42.1)\n");
    ASSERT_EQ(work.dynlab({"grade", "in", "--out", "out", "--no-pdf"}).exit_code, 0);
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr("1,José García,my work,graded,2,2,"));
}

// oracle: calendar and clock by hand: 20 min late of which 15 min are free costs a day's 10 % of 2 points
TEST(gradebook_memory, deadlines_know_grace_zones_and_more_time) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    for (const char* name : {"group-1", "group-2", "Ben Lee", "Uma Kepler"}) bench.submit_file(name, kSolution);
    work.shell("touch -d '2026-03-01 17:20 UTC' in/*/analysis.lua; touch -d '2026-03-01 17:14 UTC' in/group-2/*");
    work.write("roster.csv",
               "id,name,group\n1,Anna Müller,group-1\n2,Zoë Ade,group-2\n3,Ben Lee,group-3\n4,Uma "
               "Kepler,group-4\n5,Last One,group-5\n");
    work.write("deadlines.csv",
               "submission;deadline;extra;grace;percent_per_day\n*;2026-03-01 18:00;;15 min;10\n3;;2 d;;\nGroup "
               "4;2026-03-01 18:04:30;;;\ngroup-5;;1 d;;\n");
    const ChildResult graded =
        bench.grade({"--roster", "roster.csv", "--deadlines", "deadlines.csv", "--timezone", "Europe/Paris"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const std::string book = work.read("out/gradebook.csv");
    const std::string reason =
        "received 2026-03-01 18:20 CET, 20 min after the deadline of 2026-03-01 18:00 CET; the penalty is 10 % of the "
        "points for each day or part of a day";
    EXPECT_THAT(book, HasSubstr("1,Anna Müller,group-1,graded,1.8,2,0.2,0.33,2,\"" + reason + "\"\r\n"));
    EXPECT_THAT(book, HasSubstr("2,Zoë Ade,group-2,graded,2,2,0,0,2,\r\n"));
    EXPECT_THAT(book, HasSubstr("3,Ben Lee,Ben Lee,graded,2,2,0,0,2,\r\n"));
    EXPECT_THAT(book, HasSubstr("4,Uma Kepler,Uma Kepler,graded,1.8,2,0.2,0.26,2,"));
    EXPECT_THAT(
        work.read("out/results/group-1/feedback.md"),
        HasSubstr("Your submission was late. Points deducted: 0.2 (received 2026-03-01 18:20 CET, 20 min after"));
    EXPECT_THAT(bench.result("group-1").at("output").get<std::string>(),
                HasSubstr("The submission was late. Points deducted: 0.20 (" + reason + ")."));
    EXPECT_THAT(bench.grade({"--timezone", "Nowhere/Land", "--again"}).error_output, HasSubstr("Nowhere/Land"));
}

// oracle: the calendar: days that do not exist, and the hour that summer time leaves out
TEST(gradebook_memory, deadlines_that_are_no_time_are_refused_with_their_line) {
    const TemporaryFolder work;
    const std::filesystem::path file = work.path() / "deadlines.csv";
    const auto refusal = [&](const std::string& rows) -> std::string {
        write_file_atomically(file, rows);
        const EnvironmentVariable zone("TZ", "Europe/Paris");
        ::tzset();
        try {
            read_deadlines(file);
        } catch (const EnvironmentError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal("submission,deadline\n*,2026-03-29 03:30\n"), "");
    EXPECT_THAT(refusal("submission,deadline,extra\ngroup-1,,2 d\n"), HasSubstr("line 2: deadline must be a time"));
    for (const std::string wrong : {"2026-02-30 18:00", "2026-03-29 02:30"})
        EXPECT_THAT(
            refusal("submission,deadline\n*," + wrong + "\n"),
            HasSubstr("line 2: deadline must be a time that exists in the time zone, but \"" + wrong + "\" was given"));
    ::tzset();
}

// oracle: the row of *, and the calendar
TEST(gradebook_memory, a_row_of_deadlines_may_give_only_what_differs) {
    const TemporaryFolder work;
    const EnvironmentVariable zone("TZ", "UTC");
    ::tzset();
    const std::filesystem::path file = work.path() / "deadlines.csv";
    write_file_atomically(file,
                          "submission,deadline,extra,grace,received\n*,2026-03-09 18:00,,15 min,\n"
                          "Max Mustermann,,,,2026-03-09 19:00\nAnn,,2 h,,\n");
    const auto rows = read_deadlines(file);
    const Instant due = 1773079200;  // date -u -d '2026-03-09 18:00' +%s
    EXPECT_EQ(rows.at("*").deadline, due);
    EXPECT_EQ(rows.at("Max Mustermann").deadline, due);
    EXPECT_EQ(rows.at("Max Mustermann").received, due + 3600);
    EXPECT_EQ(rows.at("Max Mustermann").grace, 900);
    EXPECT_EQ(rows.at("Ann").deadline, due + 7200);
    EXPECT_EQ(rows.at("Ann").received, std::nullopt);
    EXPECT_EQ(rows.at("Ann").percent_per_day, 10);
    ::tzset();
}

// oracle: the better of two submissions, or the later one
TEST(gradebook_memory, the_better_or_the_newest_submission_counts) {
    for (const auto& [keep, points] : {std::pair("best", "2"), std::pair("newest", "0")}) {
        GradingBench bench(kAnswers, kChecks, kSolution);
        const Workbench& work = bench.bench();
        bench.submit_file("Anna Müller", kSolution);
        bench.submit_file("Zoë Ade", "answer('x', 1)\n");
        work.write("in/group-1/report.pdf", "%PDF");
        work.shell(
            "touch -d '2026-03-01 10:00' 'in/Anna Müller/analysis.lua'; touch -d '2026-03-01 12:00' 'in/Zoë "
            "Ade/analysis.lua'");
        work.write("roster.csv", "id,name,group\n1,Anna Müller,group-1\n2,Zoë Ade,group-1\n");
        bench.grade({"--roster", "roster.csv", "--keep", keep});
        const std::string book = work.read("out/gradebook.csv");
        EXPECT_THAT(book, HasSubstr(fmt::format("1,Anna Müller,{},graded,{},2,",
                                                points[0] == '2' ? "Anna Müller" : "Zoë Ade", points)));
        EXPECT_THAT(work.read("out/summary.md"),
                    HasSubstr(fmt::format("group-1 has several submissions. The {} submission, ",
                                          points[0] == '2' ? "best" : "newest")));
    }
}

// oracle: two simultaneous runs would do the same work twice; results are not submissions
TEST(gradebook_memory, one_run_at_a_time_and_results_are_no_submissions) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("a", kSolution);
    fs::create_directories(work.path("out"));
    {
        const FileLock lock(work.path("out/.lock"));
        ASSERT_TRUE(lock.held());
        EXPECT_THAT(bench.grade().error_output, HasSubstr("another run of dynlab grade uses out"));
    }
    const auto inside = [&](const char* out) {
        return work.dynlab(
            {"grade", "in", "--lesson", "99", "--out", out, "--isolation", GradingBench::level(), "--no-pdf"});
    };
    EXPECT_EQ(inside("in/marks").exit_code, 0);
    EXPECT_THAT(inside("in/marks").output, HasSubstr("1 submission: 0 graded now, 1 unchanged"));
    const ChildResult second = inside("in/marks2");
    EXPECT_THAT(second.output, HasSubstr("1 submission: 1 graded now"));
    EXPECT_THAT(second.error_output, HasSubstr("\"marks\" contains the results of dynlab grade; left out"));
}

// oracle: what a killed run had made until then, in a folder that was moved since
TEST(gradebook_memory, results_of_a_killed_run_are_no_submissions) {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name) {
        fs::create_directories((folder.path() / name).parent_path());
        write_file_atomically(folder.path() / name, "x");
    };
    for (const char* file :
         {"group-1/analysis.lua", "locked/.lock", "begun/.lock", "begun/.course.lock", "begun/course/course.db",
          "begun/results/group-1/results.json", "begun/runs/group-1/run.cbor", "work/.lock", "work/analysis.lua"})
        write(file);
    std::vector<Message> left_out;
    std::vector<std::string> names;
    for (const Submission& submission : submissions_in(folder.path(), left_out)) names.push_back(submission.name);
    EXPECT_THAT(names, ElementsAre("group-1", "work"));
    ASSERT_EQ(left_out.size(), 2u);
    EXPECT_THAT(message_text(left_out[0]), HasSubstr("\"begun\" contains the results of dynlab grade"));
}

}  // namespace test_gradebook_memory
}  // namespace dynlab::test
