#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/grading_bench.h"
#include "course/store/marks.h"

namespace dynlab::test {
namespace test_course_grading {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A course with a lab on a small lesson: x is checked, 2 points; q is marked by hand, 4 points.
class course_grading : public ::testing::Test {
  protected:
    course_grading()
        : bench_("--   x: number\n",
                 "check{id = 'x', points = 2, about = 'The number', test = function(a) return near(a.x, 42) end}\n"
                 "check{id = 'q', points = 4, about = 'The reason', by_hand = true, rubric = 'two reasons'}\n",
                 kSolution) {
        work().write("roster.csv",
                     "id,name,group,language\n221,Kim Min-jun,group-01,\n222,Élise Petit,group-01,\n"
                     "223,Max Mustermann,group-02,fr\n");
        done({"init", "k"});
        done({"import", "roster.csv"});
        done({"assignment", "lab4", "--kind", "lab", "--lesson", "99", "--first", "2026-03-01 12:00", "--costs",
              "late-day:10"});
    }
    const Workbench& work() { return bench_.bench(); }
    ChildResult course(std::vector<std::string> words) {
        if (words.front() != "init") words.insert(words.begin(), {"--course", "k"});
        words.insert(words.begin(), "course");
        return work().dynlab(words);
    }
    std::string done(std::vector<std::string> words) {
        const ChildResult result = course(std::move(words));
        EXPECT_EQ(result.exit_code, 0) << result.error_output << result.output;
        return result.output;
    }
    void submit(const std::string& who, const std::string& script, const std::string& at) {
        work().write("in/" + who + "/analysis.lua", script);
        done({"submit", "in/" + who + "/analysis.lua", "--from", who, "--at", at, "--isolation", bench_.level()});
    }
    ChildResult grade(std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"grade", "lab4", "--no-pdf", "--isolation", bench_.level()});
        return course(std::move(more));
    }
    std::string book() { return work().read("k/marks/lab4/gradebook.csv"); }

    static constexpr const char* kSolution = "answer('x', 42)\n";
    GradingBench bench_;
};

// oracle: the marks by hand, the points of the check, and 10 percent a day
TEST_F(course_grading, lab_is_graded_marked_extended_and_totalled) {
    submit("Kim Min-jun", kSolution, "2026-02-27 12:00");
    submit("Group 2", kSolution, "2026-03-01 13:00");
    const auto next = [&] {
        const std::string status = done({"status", "lab4", "--at", "2026-03-02 12:00"});
        return status.substr(std::min(status.find("Next: "), status.size()));
    };
    EXPECT_EQ(next(), "Next: dynlab course grade lab4\n");
    EXPECT_EQ(grade().exit_code, 1) << "q is not marked yet";
    EXPECT_EQ(next(), "Next: enter the missing marks in k/marks/lab4/marks.csv, then dynlab course grade lab4\n");
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"),
                AllOf(HasSubstr("group-01,q,,,4,The reason,two reasons"), HasSubstr("group-02,q,,")));
    // One mark by command, one in the file; each reaches the other's place.
    done({"mark", "lab4", "Élise Petit", "q", "3", "--reason", "one reason"});
    EXPECT_EQ(next(), "Next: dynlab course grade lab4\n");
    std::string rows = work().read("k/marks/lab4/marks.csv");
    rows.replace(rows.find("group-02,q,,"), 12, "group-02,q,4,");
    work().write("k/marks/lab4/marks.csv", rows);
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_EQ(next(), "Next: dynlab export-grades k/marks/lab4\n");
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-01,q,3,one reason"));
    EXPECT_THAT(book(), AllOf(HasSubstr("221,Kim Min-jun,group-01,graded,5,6,0,"),
                              HasSubstr("222,Élise Petit,group-01,graded,5,6,0,"),
                              HasSubstr("223,Max Mustermann,group-02,graded,5.4,6,0.6,")));
    EXPECT_THAT(work().read("k/marks/lab4/results/group-01/feedback.md"), HasSubstr("one reason"));
    EXPECT_THAT(done({"who", "223", "--at", "2026-03-02 12:00"}),
                AllOf(HasSubstr("late by 1 h"), HasSubstr("90 percent"), HasSubstr("group-02 has 4 points for q")));
    // A comment that a spreadsheet would take for a formula reaches the student as it was given.
    done({"mark", "lab4", "Élise Petit", "q", "3", "--reason=-1 for the sign"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-01,q,3,'-1 for the sign"));
    EXPECT_THAT(work().read("k/marks/lab4/results/group-01/feedback.md"),
                AllOf(HasSubstr("-1 for the sign"), Not(HasSubstr("'-1 for"))));
    // An extension holds at once in the course, and in the feedback with the next run.
    done({"extend", "lab4", "Max Mustermann", "2026-03-02 12:00", "--reason", "illness"});
    EXPECT_THAT(done({"export", "--at", "2026-03-05 12:00"}),
                AllOf(HasSubstr("lab4 percent (weight 1)"), HasSubstr("group-02,100,100,,"),
                      HasSubstr("group-01,83.33,83.33,,")));
    EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v1 +5 of 6"));
    EXPECT_THAT(done({"export", "lab4"}),
                ::testing::ContainsRegex("223,Max Mustermann,,,,group-02,2026-03-01 13:00,[^,]*,6,6,0,100,"));
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(book(), HasSubstr("223,Max Mustermann,group-02,graded,6,6,0,"));
}

// oracle: the points as they are given below, of 6; nothing by the deadline is 0
TEST_F(course_grading, both_exports_give_a_platform_the_same_marks) {
    work().write("more.csv",
                 "id,name,group,mail,language\n221,Kim Min-jun,group-01,,\n222,Élise Petit,group-01,,\n"
                 "223,Max Mustermann,group-02,m@u.example,fr\n224,Max Mustermann,group-03,max@u.example,\n");
    done({"import", "more.csv"});
    submit("group-01", kSolution, "2026-02-27 12:00");
    submit("group-03", kSolution, "2026-02-27 12:00");
    grade();
    done({"mark", "lab4", "group-01", "q", "4"});
    done({"mark", "lab4", "222", "q", "1", "--alone", "--reason", "was not there"});
    done({"mark", "lab4", "group-03", "q", "5", "--force"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(book(), AllOf(HasSubstr("221,Kim Min-jun,group-01,graded,6,6,0,0,2,4,,"),
                              HasSubstr("222,Élise Petit,group-01,graded,3,6,0,0,2,1,,was not there"),
                              HasSubstr("223,Max Mustermann,,nothing submitted,0,6,"),
                              HasSubstr("224,Max Mustermann,group-03,graded,7,6,0,0,2,5,,")));
    EXPECT_THAT(work().read("k/marks/lab4/results/group-03/feedback.md"), HasSubstr("7 of 6"));
    const auto sheet = [](const std::vector<std::string>& grades) {
        const std::vector<std::string> people = {"Kim Min-jun,", "Élise Petit,", "Max Mustermann,m@u.example",
                                                 "Max Mustermann,MAX@u.example"};
        std::string text = "Identifier,Full name,Email address,Grade,Maximum grade\n";
        for (std::size_t i = 0; i < people.size(); ++i)
            text += "Participant " + std::to_string(11 + i) + "," + people[i] + "," + grades[i] + ",12\n";
        return text;
    };
    work().write("sheet.csv", sheet({"", "", "", ""}));
    const std::string filled = sheet({"12", "6", "0", "14"});
    EXPECT_EQ(done({"export", "lab4", "--worksheet", "sheet.csv"}), filled);
    const auto handed_back = [&] {
        return work().dynlab({"export-grades", "k/marks/lab4", "--worksheet", "sheet.csv"});
    };
    const ChildResult back = handed_back();
    EXPECT_EQ(back.exit_code, 0) << back.error_output;
    EXPECT_EQ(work().read("k/marks/lab4/handed_back/moodle-grades.csv"), filled);
    EXPECT_THAT(back.error_output, HasSubstr("scaled from 6 points to the maximum grade of sheet.csv, which is 12"));
    // Feedback and marks are of one state.
    done({"mark", "lab4", "group-01", "q", "3"});
    EXPECT_EQ(handed_back().exit_code, 1);
    EXPECT_THAT(handed_back().error_output,
                HasSubstr("the marks of 221 changed after the last grading. Run dynlab course grade lab4"));
    grade();
    EXPECT_EQ(handed_back().exit_code, 0);
    work().dynlab({"export-grades", "k/marks/lab4"});
    EXPECT_THAT(work().read("k/marks/lab4/handed_back/mail.csv"),
                HasSubstr("224,Max Mustermann,group-03,max@u.example"));
}

// oracle: the group that the student submitted with
TEST_F(course_grading, a_student_who_moves_keeps_the_work_and_the_files_of_the_former_group) {
    submit("group-01", kSolution, "2026-02-20 12:00");
    submit("group-02", "answer('x', 1)\n", "2026-02-20 12:00");
    grade();
    EXPECT_THAT(done({"mark", "lab4", "222", "q", "3"}),
                HasSubstr("lab4: group-01 (Kim Min-jun, Élise Petit) has 3 points for q"));
    EXPECT_THAT(done({"mark", "lab4", "222", "q", "4", "--alone"}), HasSubstr("lab4: Élise Petit has 4 points for q"));
    done({"withdraw", "lab4", "222", "--mark", "q", "--alone", "--reason", "a slip"});
    done({"mark", "lab4", "group-02", "q", "1"});
    work().write("moved.csv", "id,group\n222,group-02\n");
    EXPECT_THAT(done({"import", "moved.csv", "--at", "2026-02-25 12:00"}),
                HasSubstr("222 moved from group-01 to group-02"));
    submit("group-02", "answer('x', 2)\n", "2026-02-26 12:00");
    done({"mark", "lab4", "group-02", "q", "1"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(book(), AllOf(HasSubstr("222,Élise Petit,group-01,graded,5,6,"),
                              HasSubstr("223,Max Mustermann,group-02 v2,graded,1,6,")));
    std::string rows = work().read("k/marks/lab4/marks.csv");
    work().write("k/marks/lab4/marks.csv", rows + "222,q,2,again\n");
    const ChildResult corrected = grade();
    EXPECT_EQ(corrected.exit_code, 0) << corrected.error_output;
    EXPECT_THAT(book(), AllOf(HasSubstr("222,Élise Petit,group-01,graded,4,6,"),
                              HasSubstr("223,Max Mustermann,group-02 v2,graded,1,6,")));
    done({"deliver", "lab4", "--out", "monday"});
    EXPECT_THAT(work().read("monday/mail.csv"),
                AllOf(HasSubstr("222,Élise Petit,group-01,"), Not(HasSubstr("222,Élise Petit,group-02,"))));
    // A move before the first work came: the work is that of the new group.
    work().write("back.csv", "id,group\n221,group-02\n");
    done({"import", "back.csv", "--at", "2026-02-19 12:00"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(book(), HasSubstr("221,Kim Min-jun,group-02 v2,graded,1,6,"));
}

// oracle: what the instructor wrote; nothing submitted is 0 points for checks that nobody marked
TEST_F(course_grading, marks_count_without_a_submission_and_tell_of_a_newer_one) {
    submit("group-01", kSolution, "2026-02-20 12:00");
    grade();
    done({"mark", "lab4", "group-01", "4", "--reason", "desk", "--at", "2026-02-21 12:00"});
    done({"mark", "lab4", "group-02", "q", "3", "--reason", "shown at the desk"});
    const ChildResult graded = grade();
    EXPECT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-02,q,3,shown at the desk"));
    EXPECT_THAT(book(), HasSubstr("223,Max Mustermann,,nothing submitted,3,6,"));
    EXPECT_THAT(done({"export"}), HasSubstr("223,Max Mustermann,,,,group-02,50,50,,"));
    submit("group-01", "answer('x', 42)\n-- better\n", "2026-02-22 12:00");
    const ChildResult again = grade();
    EXPECT_THAT(
        again.output + again.error_output,
        HasSubstr("\"group-01 v2\" arrived after you marked the complete submission; your mark of 4 still counts"));
}

// oracle: the help of the commands
TEST_F(course_grading, impossible_times_are_refused_and_a_plain_table_of_deadlines_is_read) {
    done({"assignment", "lab4", "--costs", "late-day:20", "--grace", "15 min"});
    submit("group-01", kSolution, "2026-02-20 12:00");
    EXPECT_THAT(
        course({"extend", "lab4", "group-01", "2026-02-25 12:00", "--reason", "illness"}).error_output,
        HasSubstr("the new deadline, 2026-02-25 12:00:00 UTC, is earlier than the deadline of the class, 2026-03-01 "
                  "12:00:00 UTC; give a later deadline"));
    EXPECT_THAT(course({"set-received", "lab4", "group-01", "2126-02-25 12:00", "--reason", "log"}).error_output,
                HasSubstr("the time of receipt, 2126-02-25 12:00:00 UTC, is in the future"));
    work().write("deadlines.csv", "group,deadline\nMax Mustermann,2026-03-05 12:00\n");
    EXPECT_EQ(done({"import", "deadlines.csv", "--deadlines", "lab4"}),
              "lab4: 1 extended, 0 with another time of receipt.\n");
    EXPECT_THAT(done({"who", "223"}), HasSubstr("2026-03-05 12:00"));
}

// oracle: the same marks after the folder was moved
TEST_F(course_grading, a_course_with_its_secret_and_checks_inside_can_be_moved) {
    work().write("k/secret.txt", "chosen by a test");
    work().write("k/own/more.lua", "check{id = 'own', points = 1, test = function(a) return a.x > 41 end}\n");
    done({"assignment", "lab4", "--secret", "k/secret.txt", "--checks", "k/own"});
    submit("group-01", kSolution, "2026-02-20 12:00");
    grade();
    done({"mark", "lab4", "group-01", "q", "2"});
    grade();
    const std::string before = book();
    EXPECT_THAT(before, HasSubstr("221,Kim Min-jun,group-01,graded,5,7,"));
    done({"export", "--json", "-o", "course.json"});
    done({"import", "course.json", "copy", "--from", "k"});
    // An export that names a place outside brings nothing with it.
    work().shell(
        "mkdir a && echo outside > a/outside.txt && mkdir a/k && cp -r k/. a/k && "
        "sed 's|\"secret.txt\"|\"../outside.txt\"|' course.json > hostile.json");
    EXPECT_THAT(work().read("hostile.json"), HasSubstr("../outside.txt"));
    done({"import", "hostile.json", "b/copy", "--from", "a/k"});
    EXPECT_FALSE(std::filesystem::exists(work().path("b/outside.txt")));
    work().shell("mv k elsewhere && mv copy k");
    const ChildResult graded = grade({"--regrade"});
    EXPECT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(book(), before);
}

// oracle: the maximum of the check; what was taken back is in force no more
TEST_F(course_grading, marks_above_the_maximum_are_refused_and_marks_are_taken_back) {
    submit("group-01", "answer('x', 1)\n", "2026-02-27 12:00");
    grade();
    const ChildResult refused = course({"mark", "lab4", "221", "q", "5", "--reason", "slip"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, HasSubstr("5 exceeds 4, the maximum number of points for \"q\""));
    EXPECT_THAT(course({"mark", "lab4", "221", "nosuch", "1", "--reason", "slip"}).error_output,
                HasSubstr("has no check \"nosuch\"; the checks are "));
    done({"mark", "lab4", "221", "5", "--reason", "shown at the desk"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(book(), HasSubstr("221,Kim Min-jun,group-01,graded,5,6,0,"));
    done({"withdraw", "lab4", "group-01", "--mark", "*", "--reason", "a mistake"});
    grade();
    EXPECT_THAT(book(), AllOf(HasSubstr("221,Kim Min-jun,group-01,partly ungraded,,"), Not(HasSubstr("graded,5"))));
    EXPECT_THAT(course({"grade", "nosuch"}).error_output, HasSubstr("unknown assignment \"nosuch\""));
}

// oracle: the marks that the instructor typed, in the order of typing; a command counts where the file did not change
TEST_F(course_grading, a_corrected_mark_stays_though_it_was_given_before) {
    submit("group-01", kSolution, "2026-02-27 12:00");
    grade();
    const auto typed = [&](const std::string& points) {
        std::string rows = work().read("k/marks/lab4/marks.csv");
        const std::size_t at = rows.find("group-01,q,") + 11;
        work().write("k/marks/lab4/marks.csv", rows.replace(at, rows.find(',', at) - at, points));
        EXPECT_EQ(grade().exit_code, 0);
        EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-01,q," + points + ","));
        EXPECT_THAT(done({"marks", "lab4"}),
                    ::testing::ContainsRegex("group-01 +v1 +" + std::to_string(2 + std::stoi(points)) + " of 6"));
    };
    typed("3"), typed("4"), typed("3");
    done({"mark", "lab4", "group-01", "q", "1", "--reason", "copied"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-01,q,1,copied"));
    typed("3");
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-01,q,3,copied"));
}

// oracle: each version's own mark; one of the whole group replaces both
TEST_F(course_grading, each_version_has_marks_of_its_own) {
    submit("group-01", kSolution, "2026-02-27 12:00");
    submit("group-01", "answer('x', 42)\n-- better\n", "2026-02-28 12:00");
    grade();
    std::string rows = work().read("k/marks/lab4/marks.csv");
    ASSERT_THAT(rows, AllOf(HasSubstr("group-01,q,,"), HasSubstr("group-01 v2,q,,")));
    rows.replace(rows.find("group-01,q,,"), 12, "group-01,q,1,");
    work().write("k/marks/lab4/marks.csv", rows);
    EXPECT_EQ(grade().exit_code, 1) << "the second version is not marked yet";
    rows = work().read("k/marks/lab4/marks.csv");
    ASSERT_THAT(rows, AllOf(HasSubstr("group-01,q,1,"), HasSubstr("group-01 v2,q,,")));
    rows.replace(rows.find("group-01 v2,q,,"), 15, "group-01 v2,q,4,");
    work().write("k/marks/lab4/marks.csv", rows);
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"),
                AllOf(HasSubstr("group-01,q,1,"), HasSubstr("group-01 v2,q,4,")));
    EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v2 +6 of 6"));
    done({"mark", "lab4", "group-01", "q", "2", "--reason", "both alike"});
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"),
                AllOf(HasSubstr("group-01,q,2,both alike"), HasSubstr("group-01 v2,q,2,both alike")));
    EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v[12] +4 of 6"));
    done({"withdraw", "lab4", "group-01", "--mark", "q", "--reason", "to be read again"});
    EXPECT_EQ(grade().exit_code, 1);
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), AllOf(HasSubstr("group-01,q,,"), HasSubstr("group-01 v2,q,,")));
}

// oracle: the last mark given; two marks for one work, and the file against a command, are refused with both values
TEST_F(course_grading, rows_about_the_same_work_agree_or_are_refused) {
    submit("group-01", kSolution, "2026-02-27 12:00");
    done({"mark", "lab4", "group-01", "5", "--reason", "desk"});
    EXPECT_EQ(grade().exit_code, 0);
    const std::string file = "k/marks/lab4/marks.csv";
    const auto replaced = [&](const std::string& row, const std::string& by) {
        std::string rows = work().read(file);
        work().write(file, rows.replace(rows.find(row), row.size(), by));
    };
    work().write(file, work().read(file) + "221,*,4,second look\n");
    for (int run = 0; run < 3; ++run) {
        EXPECT_EQ(grade().exit_code, 0);
        EXPECT_THAT(work().read(file), AllOf(HasSubstr("group-01,*,4,second look"), HasSubstr("221,*,4,second look")));
        EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v1 +4 of 6"));
    }
    done({"withdraw", "lab4", "group-01", "--mark", "*", "--reason", "again"});
    grade();
    EXPECT_THAT(work().read(file), AllOf(HasSubstr("group-01,*,,"), HasSubstr("221,*,,")));
    EXPECT_THAT(book(), HasSubstr("221,Kim Min-jun,group-01,partly ungraded,,"));

    work().write(file, work().read(file) + "222,*,2,\n");
    replaced("221,*,,", "221,*,3,");
    EXPECT_THAT(grade().error_output, HasSubstr("but give 3 and 2 points. Delete one of the two rows"));
    replaced("222,*,2,", "222,*,3,");
    EXPECT_EQ(grade().exit_code, 0);
    replaced("221,*,3,", "221,*,1,");
    done({"mark", "lab4", "group-01", "6", "--reason", "desk"});
    EXPECT_THAT(grade().error_output,
                HasSubstr("\"221\" has the mark 1 for the check \"*\", but dynlab course mark gave 6 since"));
    EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v1 +6 of 6"));
    replaced("221,*,1,", "221,*,6,");
    EXPECT_EQ(grade().exit_code, 0);
    EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v1 +6 of 6"));
}

// oracle: of equal marks the attempt with more points by the checks; a waiting penalty, as if it were confirmed
TEST_F(course_grading, the_better_attempt_counts_where_the_whole_is_marked_and_where_a_penalty_waits) {
    submit("group-01", "error('boom')\n", "2026-02-26 12:00");
    submit("group-01", kSolution, "2026-02-27 12:00");
    done({"mark", "lab4", "group-01", "5", "--reason", "desk"});
    submit("group-02", "answer('x', 42)\n-- a day late\n", "2026-03-02 11:00");
    work().write("in/late/analysis.lua", kSolution);
    course({"submit", "in/late/analysis.lua", "--from", "group-02", "--at", "2026-03-10 12:00", "--isolation",
            bench_.level()});
    done({"mark", "lab4", "group-02", "q", "4", "--reason", "both alike"});
    const ChildResult graded = grade();
    EXPECT_THAT(graded.output + graded.error_output,
                AllOf(HasSubstr("The best submission, \"group-01 v2\", counts"),
                      HasSubstr("The best submission, \"group-02\", counts"),
                      HasSubstr("a penalty of 90 % of the points is not applied until you confirm it")));
    EXPECT_THAT(book(), HasSubstr("223,Max Mustermann,group-02,graded,5.4,6,0.6,"));
    EXPECT_THAT(done({"marks", "lab4"}), AllOf(::testing::ContainsRegex("group-01 +v2 +5 of 6"),
                                               ::testing::ContainsRegex("group-02 +v1 +5.4 of 6")));
}

// oracle: the message, and the total without the refused mark
TEST_F(course_grading, a_row_above_the_maximum_does_not_reach_the_total) {
    submit("group-01", kSolution, "2026-02-27 12:00");
    grade();
    std::string rows = work().read("k/marks/lab4/marks.csv");
    rows.replace(rows.find("group-01,q,,"), 12, "group-01,q,40,");
    work().write("k/marks/lab4/marks.csv", rows);
    EXPECT_THAT(grade().error_output, HasSubstr("gets 40 points for the check \"q\", but the maximum is 4"));
    EXPECT_THAT(done({"marks", "lab4"}), Not(HasSubstr("42 of 6")));
    EXPECT_THAT(work().read("k/marks/lab4/marks.csv"), HasSubstr("group-01,q,40,")) << "nothing typed is lost";
}

// oracle: the group at the time of the submission; the message
TEST_F(course_grading, a_mark_by_a_student_s_name_goes_to_the_work_that_the_student_submitted) {
    submit("group-01", kSolution, "2026-02-27 12:00");
    submit("group-02", kSolution, "2026-02-27 12:00");
    work().write("roster.csv", "id,group\n221,group-02\n");
    done({"import", "roster.csv"});
    done({"mark", "lab4", "Kim Min-jun", "3", "--reason", "shown at the desk"});
    EXPECT_THAT(done({"marks", "lab4"}), ::testing::ContainsRegex("group-01 +v1 +3 of"));
    grade();
    std::string rows = work().read("k/marks/lab4/marks.csv");
    work().write("k/marks/lab4/marks.csv", rows + ",q,2,for whom\r\n");
    EXPECT_THAT(grade().error_output, HasSubstr("the row has points but no name"));
    EXPECT_THAT(done({"history"}), Not(HasSubstr("for whom")));
}

// oracle: the history and the store of before
TEST_F(course_grading, grading_again_what_has_not_changed_leaves_the_history_as_it_was) {
    submit("group-02", kSolution, "2026-02-27 12:00");
    grade();
    const std::string history = done({"history"});
    EXPECT_THAT(history, HasSubstr("lab4: 1 graded"));
    grade();
    EXPECT_EQ(done({"history"}), history);
}

// oracle: the history
TEST_F(course_grading, unreadable_file_can_be_withdrawn) {
    work().write("group-02.rar", "Rar!\x1a\x07\x01");
    course({"submit", "group-02.rar", "--at", "2026-02-27 12:00", "--isolation", bench_.level()});
    done({"withdraw", "lab4", "group-02", "--part", "unreadable", "--reason", "sent by mistake"});
    EXPECT_THAT(done({"history"}), HasSubstr("(unreadable v1) withdrawn; reason: sent by mistake"));
}

}  // namespace test_course_grading
}  // namespace dynlab::test
