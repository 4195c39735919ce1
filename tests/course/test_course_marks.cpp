// Scores, marks and presentations as they are typed in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/office/packed_document.h"

namespace dynlab::test {
namespace test_course_marks {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// Four groups who all review each other; `scores` gives what each (row) gives to each report (column), in all
/// criteria.
class ScoredCourse {
  public:
    explicit ScoredCourse(const std::vector<std::string>& scores) : bench_(assigned()) {
        std::string table;
        for (std::size_t i = 0; i < scores.size(); ++i) table += scores[i] + "\n";
        bench_.bench().write("table", table);
        const ChildResult made = bench_.bench().shell(
            "echo reviewer,report,data,steps,conclusions,strength,suggestions >s.csv\n"
            "awk 'NR == FNR {for (i = 1; i <= 4; i++) s[FNR, i] = $i; next} "
            "/^group/ {r = substr($1, 7) + 0; a = substr($3, 7) + 0; p = s[r, a]; "
            "print $1 \",\" $2 \",\" p \",\" p \",\" p \",\" p \",\" p}' table pairs >>s.csv");
        EXPECT_EQ(made.exit_code, 0) << made.error_output;
    }
    CourseBench& bench() { return bench_; }
    ChildResult read() { return bench_.course({"scores", "crane", "s.csv"}); }
    std::string marks() { return bench_.course({"marks", "crane"}).output; }

  private:
    static const CourseBench& assigned() {
        static const CourseBench bench = [] {
            CourseBench made(4, 3);
            for (int i = 1; i <= 4; ++i)
                made.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("report " + std::to_string(i)));
            CourseBench::expect_done(made.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
            CourseBench::expect_done(made.course({"review", "assign", "--at", "2026-03-02 10:00"}));
            made.bench().write("pairs", made.course({"review", "pairs"}).output);
            return made;
        }();
        return bench;
    }

    CourseBench bench_;
};

// oracle: medians, distances and means by hand; group 4's zero for report 3 is 0.4 of the scale below the median 2, and
// group 3's one for report 4 is 0.8 below the median 5
TEST(course_marks, follow_the_scores_and_flag_revenge) {
    ScoredCourse course({"- 3 2 5", "4 - 2 5", "4 3 - 1", "5 3 0 -"});
    EXPECT_THAT(course.read().output, HasSubstr("crane: 60 new scores."));
    const std::string marks = course.marks();
    EXPECT_THAT(marks, ContainsRegex("group-01 +4 +4 +4 +4 +4 +80\\.0 +60\\.0"));
    EXPECT_THAT(marks, ContainsRegex("group-02 +3 +3 +3 +3 +3 +60\\.0 +53\\.3"));
    EXPECT_THAT(marks, ContainsRegex("group-03 +2 +2 +2 +2 +2 +40\\.0 +60\\.0"));
    EXPECT_THAT(marks, ContainsRegex("group-04 +5 +5 +5 +5 +5 +100\\.0 +60\\.0"));
    const std::string page = read_file(DYNLAB_SOURCE_DIR "/engine/scripting/reference/review_marks.md");
    for (const char* row : {"| group-01 | 80.0 | 60.0 |", "| group-02 | 60.0 | 53.3 |", "| group-03 | 40.0 | 60.0 |",
                            "| group-04 | 100.0 | 60.0 |", "| group-04 | 5 | 3 | 0 | - |"})
        EXPECT_THAT(page, HasSubstr(row));  // the help's example is this one
    EXPECT_THAT(marks, HasSubstr("Check the review of group-03 by group-04: its scores are far below the others; "
                                 "group-03 had given group-04 few points."));
    EXPECT_THAT(marks, HasSubstr("Check the review of group-04 by group-03: its scores are far below the others; "
                                 "group-04 had given group-03 few points."));
    EXPECT_THAT(marks, Not(HasSubstr("by group-01")));
    EXPECT_THAT(marks, Not(HasSubstr("by group-02")));
}

// oracle: the instructor's word, in table and export; the store where it is refused
TEST(course_marks, the_instructor_has_the_last_word_and_gives_a_reason) {
    ScoredCourse course({"- 3 2 5", "4 - 2 5", "4 3 - 5", "5 3 2 -"});
    course.read();
    CourseBench& bench = course.bench();
    const std::string before = bench.dump();
    EXPECT_EQ(bench.course({"mark", "crane", "group-04", "reviews", "75"}).exit_code, 1);
    EXPECT_THAT(bench.course({"mark", "crane", "group-04", "reviews", "75", "--reason", ""}).error_output,
                HasSubstr("give a reason"));
    EXPECT_THAT(bench.course({"mark", "crane", "group-04", "reviews", "201", "--force", "--reason", "x"}).error_output,
                HasSubstr("from 0 to 200 percent, but 201 was given"));
    EXPECT_THAT(bench.course({"mark", "crane", "group-04", "work", "150", "--reason", "x"}).error_output,
                HasSubstr("150 exceeds 100, the maximum number of points for \"work\""));
    EXPECT_THAT(bench.course({"mark", "crane", "group-04", "voice", "75", "--reason", "x"}).error_output,
                HasSubstr("crane has no mark \"voice\"; the marks are \"work\" and, for a report, \"reviews\""));
    EXPECT_EQ(bench.dump(), before);
    CourseBench::expect_done(bench.course({"mark", "crane", "group-04", "reviews", "70", "--reason", "too hard"}));
    CourseBench::expect_done(
        bench.course({"mark", "crane", "group-04", "reviews", "75", "--reason", "hard, but with reasons"}));
    EXPECT_THAT(course.marks(), ContainsRegex("group-04 .* 75\\.0 \\(yours\\)"));
    EXPECT_THAT(bench.course({"export", "crane"}).output,
                AllOf(HasSubstr("\"hard, but with reasons\""), Not(HasSubstr("too hard"))));
}

// oracle: the store before
TEST(course_marks, wrong_scores_are_refused_with_their_line) {
    ScoredCourse course({"- 3 2 5", "4 - 2 5", "4 3 - 5", "5 3 2 -"});
    CourseBench& bench = course.bench();
    const std::string before = bench.dump(), good = bench.bench().read("s.csv");
    const auto refused = [&](const std::string& csv, const std::string& message) {
        bench.bench().write("s.csv", csv);
        const ChildResult result = course.read();
        EXPECT_EQ(result.exit_code, 1) << csv;
        EXPECT_THAT(result.error_output, HasSubstr(message));
        EXPECT_EQ(bench.dump(), before) << csv;
    };
    refused("group,data\ngroup-01,3\n",
            "s.csv, line 1: a column named reviewer is required; the columns are group, data");
    refused("reviewer,report,beauty\ngroup-01,report-1,3\n",
            "s.csv, line 1: unknown columns: beauty; the criteria of crane are data, steps, conclusions, strength, "
            "suggestions");
    refused("reviewer,report,data,workflow,style\ngroup-01,,3,3,3\n", "unknown columns: workflow, style;");
    refused("reviewer,report\ngroup-01,\n", "no column has the name of a criterion; the criteria of crane are data, ");
    refused(good + "group-01,report-1000,3,3,3,3,3\n", "s.csv, line 14: ");
    refused(good + "gruop-01,,3,3,3,3,3\n", "group-01");
    refused("reviewer,data\ngroup-01,3\n", "s.csv, line 2: ");  // which of its three?
}

// oracle: what a presentation is: slides and script, one deadline, a sheet for the oral
TEST(course_marks, of_a_talk_come_from_the_sheet_of_the_oral) {
    CourseBench bench(3);
    CourseBench::expect_done(bench.course({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00",
                                           "--criteria", "content:10,figures:5,answers:5"}));
    for (int i = 1; i <= 2; ++i) {
        bench.bench().write("in/" + CourseBench::group(i) + "/slides.pdf", small_pdf("slide"));
        bench.bench().write("in/" + CourseBench::group(i) + "/talk.lua", "print(1)\n");
    }
    bench.bench().write("in/group-03/talk.lua", "print(2)\n");
    const ChildResult taken = bench.course({"submit", "in", "--assignment", "talk", "--at", "2026-04-01 11:00"});
    EXPECT_THAT(taken.output, AllOf(HasSubstr("5 files accepted, 0 late"), ContainsRegex("group-01 +slides +v1"),
                                    ContainsRegex("group-01 +script +v1")));
    bench.bench().write("group-03.pdf", small_pdf("late slide"));
    EXPECT_THAT(bench.course({"submit", "group-03.pdf", "--assignment", "talk", "--at", "2026-04-01 13:30"}).output,
                ContainsRegex("group-03 +slides +v1 +late by 1 h 30 min"));
    EXPECT_THAT(bench.course({"status", "talk", "--at", "2026-04-02 10:00"}).output,
                AllOf(HasSubstr("script"), Not(HasSubstr("final version"))));
    for (const char* stage : {"review", "final"})
        EXPECT_THAT(bench.course({stage, "receive", "group-03.pdf", "--assignment", "talk"}).error_output,
                    HasSubstr("talk is a talk and has no "));
    EXPECT_THAT(bench.course({"review", "assign", "talk", "--at", "2026-04-02 10:00"}).error_output, HasSubstr("talk"));
    for (const std::vector<std::string>& words : {std::vector<std::string>{"review", "send", "talk"},
                                                  {"review", "pairs", "talk"},
                                                  {"review", "release", "talk"},
                                                  {"mark", "talk", "group-01", "reviews", "80", "--reason", "x"}})
        EXPECT_THAT(bench.course(words).error_output, HasSubstr("talk is a talk and has no reviews"));
    EXPECT_THAT(bench.course({"scores", "--sheet", "crane"}).error_output,
                HasSubstr("only for talks, but crane is a report. "));
    EXPECT_EQ(bench.course({"scores", "--sheet", "talk"}).output,
              "group,content,figures,answers,comment\r\ngroup-01,,,,\r\ngroup-02,,,,\r\ngroup-03,,,,\r\n");
    bench.bench().write("oral.csv", "group,content,figures,answers\ngroup-01,8,5,3\ngroup-02,10,,\n");
    EXPECT_THAT(bench.course({"scores", "talk", "oral.csv"}).output, HasSubstr("talk: 4 new scores."));
    const std::string marks = bench.course({"marks", "talk"}).output;
    EXPECT_THAT(marks, ContainsRegex("group-01 +8 +5 +3 +80\\.0"));
    EXPECT_THAT(marks, ContainsRegex("group-02 +10 +0 +0 +50\\.0"));  // others have points there
    EXPECT_THAT(marks, ContainsRegex("group-03 +- +- +- +- "));
    EXPECT_THAT(bench.course({"scores", "--sheet", "talk"}).output, HasSubstr("group-01,8,5,3,\r\n"));
    bench.bench().write("oral.csv", "group,content\ngroup-01,11\n");
    EXPECT_THAT(bench.course({"scores", "talk", "oral.csv"}).error_output,
                HasSubstr("content must be a number from 0 to 10, but \"11\" was given"));
}

// oracle: medians of four, distances to the instructor's 4, and means by hand: group 1 gave report 2 what the others
// gave (100 percent), report 3 a fifth more than their median of 1 (60), report 4 a fifth more than the instructor (60)
TEST(course_marks, the_instructor_is_a_reviewer_whom_others_are_held_against) {
    ScoredCourse course({"- 3 2 5", "4 - 2 5", "4 3 - 1", "5 3 0 -"});
    CourseBench& bench = course.bench();
    course.read();
    bench.bench().write("mine.csv",
                        "reviewer,report,data,steps,conclusions,strength,suggestions\n"
                        "instructor,group-04,4,4,4,4,4\n");
    EXPECT_THAT(bench.course({"scores", "crane", "mine.csv"}).output, HasSubstr("5 new scores"));
    EXPECT_THAT(bench.course({"scores", "crane", "mine.csv"}).output, HasSubstr("0 new scores"));
    EXPECT_THAT(course.marks(),
                AllOf(ContainsRegex("group-04 +4\\.5 .* 90\\.0 "), ContainsRegex("group-01 .* 73\\.3")));
    bench.bench().write("group-04.pdf", small_pdf("final"));
    CourseBench::expect_done(
        bench.course({"submit", "--stage", "final", "group-04.pdf", "--at", "2026-03-14 10:00", "--no-checks"}));
    bench.bench().write("final.csv", "group,data,steps,conclusions,strength,suggestions\ngroup-04,5,5,5,5,5\n");
    CourseBench::expect_done(bench.course({"scores", "crane", "final.csv", "--stage", "final"}));
    EXPECT_THAT(course.marks(), AllOf(ContainsRegex("group-04 +4\\.5 .* 95\\.0 "),
                                      HasSubstr("group-04: the final version has 100.0 percent, 50 percent of")));
    CourseBench::expect_done(bench.course({"assignment", "crane", "--final-weight", "20", "--reason", "as announced"}));
    EXPECT_THAT(course.marks(), ContainsRegex("group-04 +4\\.5 .* 92\\.0 "));
}

// oracle: 25 h late are two days begun, 5 points each; three reviews not written, 10 points each; no final version, 15;
// group 2 gave 4 where the others' median is 4.5 (80 percent) and twice what they gave: 93.3 for its reviews
TEST(course_marks, what_is_late_or_missing_costs_what_the_course_says) {
    ScoredCourse course({"- 3 2 5", "4 - 2 5", "4 3 - 5", "5 3 2 -"});
    CourseBench& bench = course.bench();
    course.read();
    CourseBench::expect_done(
        bench.course({"set-received", "crane", "group-01", "2026-03-02 13:00", "--reason", "log"}));
    EXPECT_THAT(bench.course({"assignment", "crane", "--costs", "late:5", "--reason", "x"}).error_output,
                HasSubstr("penalties are late-day, late-most, missing-final, late-review and missing-review"));
    CourseBench::expect_done(bench.course(
        {"assignment", "crane", "--costs", "late-day:5,missing-final:15,missing-review:10", "--reason", "rules"}));
    const auto marks = [&](const std::string& at) { return bench.course({"marks", "crane", "--at", at}).output; };
    EXPECT_THAT(marks("2026-03-07 12:00"), AllOf(ContainsRegex("group-01 .* 70\\.0 "), Not(HasSubstr("missing"))));
    const std::string reviewed = marks("2026-03-10 12:00"), all = marks("2026-03-20 12:00");
    EXPECT_THAT(reviewed,
                AllOf(ContainsRegex("group-02 .* 60\\.0 +63\\.3"), HasSubstr("30 % deducted for 3 missing reviews")));
    EXPECT_THAT(
        all,
        AllOf(
            ContainsRegex("group-01 .* 55\\.0 "), ContainsRegex("group-02 .* 45\\.0 "),
            HasSubstr("10 % deducted for a first version late by 1 d 1 h, 15 % deducted for a missing final version")));
    EXPECT_THAT(bench.course({"export", "crane"}).output, HasSubstr("15 % deducted for a missing final version"));
}

// oracle: the sheet
TEST(course_marks, a_forgotten_cell_is_reported) {
    CourseBench bench(2);
    CourseBench::expect_done(bench.course({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00"}));
    bench.bench().write("oral.csv", "group,content,slides,delivery,answers\ngroup-01,4,3,,5\ngroup-02,4,4,4,4\n");
    CourseBench::expect_done(bench.course({"scores", "talk", "oral.csv"}));
    EXPECT_THAT(
        bench.course({"marks", "talk"}).output,
        AllOf(HasSubstr("group-01: the points for delivery are missing and count as 0."), Not(HasSubstr("group-02:"))));
}

// oracle: by hand: a group of 7 of 10 points, one of whose members has 4 + 5; a day late costs 10; the help's example
TEST(course_marks, students_have_points_of_their_own_at_the_oral) {
    CourseBench bench(2);
    bench.bench().write("roster.csv", "id,name,group\ns1,Ada King,group-01\ns2,Bo Ek,group-01\ns3,Cy Li,group-02\n");
    CourseBench::expect_done(bench.course({"import", "roster.csv"}));
    CourseBench::expect_done(bench.course({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00",
                                           "--criteria", "content:5,answers:5", "--costs", "late-day:10"}));
    EXPECT_EQ(bench.course({"scores", "--sheet", "talk", "--students"}).output,
              "group,student,name,content,answers,comment\r\ngroup-01,,,,,\r\ngroup-01,s1,Ada King,,,\r\n"
              "group-01,s2,Bo Ek,,,\r\ngroup-02,,,,,\r\ngroup-02,s3,Cy Li,,,\r\n");
    const auto read = [&](const std::string& csv) {
        bench.bench().write("oral.csv", csv);
        return bench.course({"scores", "talk", "oral.csv"});
    };
    const std::string sheet =
        "group,student,name,content,answers,comment\ngroup-01,,,4,\"3,0\",a good plot of the poles\n"
        "group-01,s1,Ada King,,,\ngroup-01,s2,Bo Ek,,5,knew the bias\ngroup-02,,,5,,\n";
    EXPECT_THAT(read(sheet).output, HasSubstr("talk: 6 new scores."));
    EXPECT_THAT(read(sheet).output, HasSubstr("talk: 0 new scores."));
    const auto marks = [&] { return bench.course({"marks", "talk"}).output; };
    EXPECT_THAT(marks(), AllOf(ContainsRegex("group-01 +4 +3 +70\\.0 "), ContainsRegex("s2 +Bo Ek +4 +5 +90\\.0"),
                               Not(HasSubstr("Ada King")), HasSubstr("group-01: a good plot of the poles\n"),
                               HasSubstr("group-01, Bo Ek (s2): knew the bias\n")));
    const auto mark_of = [&](const std::string& id) {
        return bench.bench()
            .shell("$DYNLAB course --course k export talk | awk -F, '$1 == \"" + id + "\" {printf \"%s\", $13}'")
            .output;
    };
    EXPECT_EQ(mark_of("s1"), "70");
    EXPECT_EQ(mark_of("s2"), "90");
    EXPECT_THAT(bench.course({"export", "talk"}).output,
                AllOf(ContainsRegex("s1,Ada King[^\n]*,a good plot of the poles\r\n"),
                      HasSubstr(",\"a good plot of the poles; knew the bias\"\r\n")));
    EXPECT_THAT(bench.course({"scores", "--sheet", "talk", "--students"}).output,
                HasSubstr("group-01,s2,Bo Ek,,5,knew the bias\r\n"));
    bench.bench().write("group-01.pdf", small_pdf("slide"));
    CourseBench::expect_done(
        bench.course({"submit", "group-01.pdf", "--assignment", "talk", "--at", "2026-04-02 11:00", "--no-checks"}));
    EXPECT_EQ(mark_of("s1") + " " + mark_of("s2"), "60 80");
    CourseBench::expect_done(bench.course({"mark", "talk", "group-01", "work", "50", "--reason", "film only"}));
    EXPECT_EQ(mark_of("s1") + " " + mark_of("s2"), "50 50");
    CourseBench::expect_done(bench.course({"withdraw", "talk", "group-01", "--mark", "work", "--reason", "no"}));
    CourseBench::expect_done(read("student,answers\nBo Ek,-\n"));  // by name; the group's points hold again
    EXPECT_EQ(mark_of("s2"), "60");
    const std::string before = bench.dump();
    EXPECT_THAT(read("group,student,content\ngroup-02,s2,3\n").error_output,
                HasSubstr("oral.csv, line 2: the student s2 is in group-01, not in group-02"));
    EXPECT_THAT(read("student,content\ns1,3\ns33,3\n").error_output,
                HasSubstr("oral.csv, line 3: unknown student \"s33\"; did you mean s3?"));
    EXPECT_THAT(read("content\n3\n").error_output,
                HasSubstr("a column named group or student is required; the columns are content"));
    EXPECT_THAT(read("group,content\ngroup-01,x\n").error_output,
                HasSubstr("content must be a number from 0 to 5, but \"x\" was given"));
    EXPECT_EQ(bench.dump(), before);
    EXPECT_THAT(bench.course({"assignment", "--remove", "talk", "--reason", "x"}).error_output,
                HasSubstr("the assignment talk cannot be removed, because it already has"));
}

// oracle: a permutation, the same each time, of groups that are neither all in the order of their names
TEST(course_marks, the_order_of_talks_is_drawn) {
    CourseBench bench(16);  // one of 16! orders is that of the names
    CourseBench::expect_done(bench.course({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00"}));
    const std::string drawn = bench.course({"scores", "--sheet", "talk", "--drawn"}).output;
    const std::string plain = bench.course({"scores", "--sheet", "talk"}).output;
    EXPECT_NE(drawn, plain);
    EXPECT_EQ(bench.course({"scores", "--sheet", "talk", "--drawn"}).output, drawn);
    const auto sorted = [](std::string text) { return std::sort(text.begin(), text.end()), text; };
    EXPECT_EQ(sorted(drawn), sorted(plain));
}

// oracle: the template's own table, filled in
TEST(course_marks, scores_come_with_the_reviews_packs) {
    std::string script = read_file(DYNLAB_SOURCE_DIR "/report_templates/peer_review.lua");
    EXPECT_TRUE(scores_in_script(script).empty());  // nothing is given there
    for (const auto& [name, points] : {std::pair("data", "4"), {"steps", "2"}, {"suggestions", "5"}}) {
        const std::string empty = std::string(name) + " = nil";
        script.replace(script.find(empty), empty.size(), std::string(name) + " = " + points);
    }
    const std::map<std::string, double> given = {{"data", 4}, {"steps", 2}, {"suggestions", 5}};
    EXPECT_EQ(scores_in_script(script), given);
    EXPECT_TRUE(scores_in_script("-- scores = {data = 4}\nscores = load('x')").empty());
    EXPECT_EQ(scores_in_script("scores={data=3,steps=os.exit(),conclusions = 1e3}").size(), 1u);
    EXPECT_EQ(scores_in_script("x = {}\n  local scores\n=\n{ data = 3 }").size(), 1u);
    EXPECT_TRUE(scores_in_script("my scores = {data = 3}\nlocalscores = {data = 3}").empty());
    // The parser must not use stack space for every character of a submission.
    for (const std::string& filling :
         {std::string(900'000, '\n'), std::string(900'000, ' '), std::string(900'000, 'a')})
        EXPECT_EQ(scores_in_script(filling + "\nscores = {data = 4}").size(), 1u);
    EXPECT_TRUE(scores_in_script("scores = {" + std::string(3900, 'a') + "}").empty());
    CourseBench bench(2, 1);
    for (const char* group : {"group-01", "group-02"})
        bench.submit_file(std::string(group) + ".pdf", small_pdf(group), "2026-03-01 10:00", {"--no-checks"});
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-02 10:00"}));
    bench.bench().write("r/analysis.lua", script);
    bench.bench().write("r/review.pdf", small_pdf("a review"));
    bench.bench().shell("tar czf r.tar.gz -C r .");
    EXPECT_THAT(bench
                    .course({"review", "collect", "r.tar.gz", "--from", "group-01", "--at", "2026-03-08 10:00",
                             "--no-checks", "--isolation", CourseBench::level()})
                    .output,
                HasSubstr("3 scores read"));
    EXPECT_THAT(bench.course({"marks", "crane"}).output, ContainsRegex("group-02 +4 +2 +- +- +5 +73\\.3"));
}

}  // namespace test_course_marks
}  // namespace dynlab::test
