// What an instructor corrects afterwards. Oracles: the deadlines' arithmetic by hand, the rows that were there before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"

namespace dynlab::test {
namespace test_corrections {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class corrections : public testing::Test {
  protected:
    corrections() : course_(4) {}
    explicit corrections(const CourseBench& begun) : course_(begun) {}

    ChildResult course(const std::vector<std::string>& words) { return course_.course(words); }
    std::string done(const std::vector<std::string>& words) {
        const ChildResult result = course(words);
        EXPECT_EQ(result.exit_code, 0) << words[0] << ": " << result.error_output;
        return result.output;
    }
    std::string status(const std::string& at = "2026-03-02 12:00") { return done({"status", "crane", "--at", at}); }
    /// The rows of what was received, as they were signed.
    std::string signed_rows() { return shell("sqlite3 k/course.db 'SELECT * FROM versions'"); }
    std::string shell(const std::string& command) { return course_.bench().shell(command).output; }

    CourseBench course_;
};

/// All reports are on their way to two reviewers each.
class corrections_of_reviews : public corrections {
  protected:
    corrections_of_reviews() : corrections(sent()) {}

    static const CourseBench& sent() {
        static const CourseBench bench = [] {
            CourseBench made(4);
            for (int i = 1; i <= 4; ++i)
                made.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("report " + std::to_string(i)));
            CourseBench::expect_done(made.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
            CourseBench::expect_done(made.course({"review", "assign", "--at", "2026-03-02 10:00"}));
            EXPECT_THAT(made.course({"review", "send", "--at", "2026-03-02 11:00"}).output,
                        HasSubstr("8 sent now, 0 before"));
            return made;
        }();
        return bench;
    }
};

TEST_F(corrections, a_time_of_receipt_is_corrected_by_a_further_receipt) {
    course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 19:00", {"--no-checks"});
    EXPECT_THAT(status(), HasSubstr("v1 late 7 h"));
    const std::string before = signed_rows();
    EXPECT_THAT(course({"set-received", "crane", "group-01", "2026-03-01 11:30", "--reason", ""}).error_output,
                HasSubstr("give a reason"));
    EXPECT_EQ(course({"set-received", "crane", "group-02", "2026-03-01 11:30", "--reason", "x"}).exit_code, 1);
    done({"set-received", "crane", "group-01", "2026-03-01 11:30", "--reason", "the platform's log"});
    EXPECT_THAT(status(), Not(HasSubstr("late")));
    EXPECT_EQ(signed_rows(), before);
    const std::string corrected = shell("cat k/receipts/crane/*-corrected-1.txt");
    EXPECT_THAT(corrected, AllOf(HasSubstr("correction: 1\n"), HasSubstr("received: 2026-03-01T11:30:00Z\n"),
                                 HasSubstr("late: no\n")));
    EXPECT_THAT(shell("$DYNLAB verify $(ls k/receipts/crane/*-corrected-1.txt) group-01.pdf --key k/course.pub"),
                HasSubstr("genuine, for exactly this file, signed by the course \"k\""));
    done({"set-received", "crane", "group-01", "2026-03-01 13:00", "--reason", "no, an hour after"});
    EXPECT_THAT(status(), HasSubstr("v1 late 1 h"));
    EXPECT_THAT(shell("ls k/receipts/crane | wc -l"), HasSubstr("3"));
    EXPECT_THAT(done({"history"}), AllOf(HasSubstr("reason: the platform's log"), HasSubstr("no, an hour after")));
    EXPECT_THAT(done({"verify"}), HasSubstr("complete and unaltered"));
}

// Oracle: the whole store. Who repeats a command after it was killed does not know whether it was done.
TEST_F(corrections, a_repeated_command_is_recorded_once) {
    course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 19:00", {"--no-checks"});
    using Words = std::vector<std::string>;
    for (const Words& words : {Words{"extend", "crane", "group-01", "2026-03-01 15:00", "--reason", "illness"},
                               Words{"set-received", "crane", "group-01", "2026-03-01 11:30", "--reason", "by mail"},
                               Words{"extend", "crane", "group-01", "--end", "--reason", "no paper came"},
                               Words{"mark", "crane", "group-01", "work", "60", "--reason", "on paper"}}) {
        const std::string before = course_.dump();
        done(words);
        const std::string once = course_.dump();
        EXPECT_NE(once, before) << words[0];
        done(words);
        EXPECT_EQ(course_.dump(), once) << words[0];
    }
}

TEST_F(corrections, times_come_from_the_platform_s_worksheet) {
    course_.bench().write("sheet.csv",
                          "Identifier,Full name,Status,\"Last modified (submission)\",Grade\n"
                          "Participant 900001,Student 1,Submitted,\"Sunday, 1 March 2026, 11:59 AM\",\n"
                          "Participant 900002,Student 2,Submitted,\"Sunday, 1 March 2026, 12:11 PM\",\n"
                          "Participant 900003,Student 3,No submission,-,\n");
    for (const char* id : {"1", "2", "3"})
        course_.bench().write("all/Student " + std::string(id) + "_90000" + id + "_assignsubmission_file_/report.pdf",
                              small_pdf(id));
    EXPECT_THAT(done({"submit", "all", "--at", "2026-03-01 19:00", "--times", "sheet.csv", "--no-checks"}),
                AllOf(ContainsRegex("group-01 .* on time"), ContainsRegex("group-02 .* late by 11 min"),
                      ContainsRegex("group-03 .* late by 7 h")));
    course_.bench().write("bad.csv", "Identifier,Grade\nParticipant 1,3\n");
    EXPECT_THAT(course({"submit", "all", "--times", "bad.csv"}).error_output,
                HasSubstr("bad.csv: a column \"identifier\""));
    course_.bench().write("bad.csv", "group,time\ngroup-01,tomorrow\n");
    EXPECT_THAT(course({"submit", "all", "--times", "bad.csv"}).error_output, HasSubstr("bad.csv, line 2: the time"));
}

TEST_F(corrections, times_come_from_the_archive) {
    course_.bench().write("in/group-01/report.pdf", small_pdf("one"));
    course_.bench().write("in/group-02/report.pdf", small_pdf("two"));
    course_.bench().shell(
        "TZ=UTC touch -d '2026-03-01 11:00' in/group-01/report.pdf && TZ=UTC touch -d '2026-03-01 14:00' "
        "in/group-02/report.pdf && cd in && tar czf ../all.tar.gz .");
    EXPECT_THAT(done({"submit", "all.tar.gz", "--at", "2026-03-05 19:00", "--times", "archive", "--no-checks",
                      "--isolation", CourseBench::level()}),
                AllOf(ContainsRegex("group-01 .* on time"), ContainsRegex("group-02 .* late by 2 h")));
}

TEST_F(corrections, lateness_follows_deadlines_and_extensions) {
    course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 14:00", {"--no-checks"});
    course_.submit_file("group-02.pdf", small_pdf("two"), "2026-03-01 14:00", {"--no-checks"});
    done({"extend", "crane", "group-01", "2026-03-01 15:00", "--reason", "illness"});
    EXPECT_THAT(status(), AllOf(ContainsRegex("extended +group-01, first version: Sun 2026-03-01 15:00"),
                                ContainsRegex("group-01 +1 +v1  "), ContainsRegex("group-02 +1 +v1 late 2 h")));
    done({"extend", "crane", "group-01", "--end", "--reason", "no paper came"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v1 late 2 h"));
    done({"assignment", "crane", "--first", "2026-03-01 14:00", "--reason", "server down"});
    EXPECT_THAT(status(), Not(HasSubstr("v1 late")));
    done({"assignment", "crane", "--first", "2026-03-01 09:00", "--reason", "typed too late"});
    EXPECT_THAT(status(), ContainsRegex("group-02 +1 +v1 late 5 h"));
    EXPECT_THAT(done({"history"}),
                HasSubstr("first 2026-03-01 09:00:00 UTC instead of 2026-03-01 14:00:00 UTC; reason: typed too late"));
    EXPECT_THAT(course({"assignment", "crane", "--first", "2026-03-09 09:00", "--reason", "x"}).error_output,
                HasSubstr("must be after"));
    EXPECT_EQ(course({"extend", "crane", "group-01", "--reason", "x"}).exit_code, 1);
}

TEST_F(corrections, a_version_with_the_content_of_an_earlier_one_is_as_late_as_that) {
    done({"assignment", "crane", "--costs", "late-day:10", "--reason", "rules"});
    const auto submit_file = [&](const std::string& text, const std::string& at) {
        return course_.submit_file("group-01.pdf", small_pdf(text), at, {"--no-checks"}).output;
    };
    submit_file("one", "2026-03-01 10:00");
    EXPECT_THAT(submit_file("two", "2026-03-01 20:00"), HasSubstr("late by 8 h"));
    EXPECT_THAT(submit_file("one", "2026-03-02 06:00"),
                AllOf(HasSubstr("1 file accepted, 0 late"), ContainsRegex("v3 +on time +the same file as v1 of ")));
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v3  "));
    EXPECT_THAT(shell("cat k/receipts/crane/00003-*"), HasSubstr("late: 18 h\n"));  // when this version came
    EXPECT_THAT(course({"verify"}).output, HasSubstr("complete and unaltered"));
    done({"withdraw", "crane", "group-01", "--version", "1", "--reason", "the group's wish"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v3 late 18 h  "));  // no other valid version has its content
    done({"restore", "crane", "group-01", "--version", "1", "--reason", "no"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v3  "));
    done({"set-received", "crane", "group-01", "2026-03-01 14:00", "--version", "1", "--reason", "the platform's log"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v3 late 2 h  "));
}

TEST_F(corrections, a_version_is_withdrawn_and_is_reinstated) {
    course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00", {"--no-checks"});
    course_.submit_file("group-01.pdf", small_pdf("two"), "2026-03-01 14:00", {"--no-checks"});
    const std::string before = signed_rows();
    done({"withdraw", "crane", "group-01", "--reason", "somebody else's file"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v1  "));
    EXPECT_THAT(course_.submit_file("group-01.pdf", small_pdf("two"), "2026-03-01 15:00", {"--no-checks"}).output,
                HasSubstr("already received and withdrawn; to reinstate the file, run dynlab course restore"));
    done({"withdraw", "crane", "group-01", "--reason", "this one too"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +-  "));
    EXPECT_EQ(course({"withdraw", "crane", "group-01", "--reason", "x"}).exit_code, 1);
    done({"restore", "crane", "group-01", "--version", "2", "--reason", "it was right"});
    EXPECT_THAT(status(), ContainsRegex("group-01 +1 +v2 late 2 h"));
    EXPECT_EQ(signed_rows(), before);
    // The next one is the third, withdrawn or not.
    EXPECT_THAT(course_.submit_file("group-01.pdf", small_pdf("three"), "2026-03-01 11:00", {"--no-checks"}).output,
                HasSubstr("v3"));
}

TEST_F(corrections, an_override_is_taken_back) {
    done({"mark", "crane", "group-01", "work", "60", "--reason", "paper"});
    EXPECT_THAT(done({"marks", "crane"}), HasSubstr("60.0 (yours)"));
    done({"withdraw", "crane", "group-01", "--mark", "work", "--reason", "found"});
    EXPECT_THAT(done({"marks", "crane"}), Not(HasSubstr("yours")));
    EXPECT_THAT(course({"withdraw", "crane", "group-01", "--mark", "work", "--reason", "x"}).error_output,
                HasSubstr("group-01 has no manual mark for"));
    done({"mark", "crane", "group-01", "work", "105", "--force", "--reason", "more than was asked"});
    EXPECT_THAT(done({"marks", "crane"}), HasSubstr("105.0 (yours)"));
}

TEST_F(corrections, an_assignment_is_removed_while_nothing_hangs_on_it) {
    done({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00"});
    EXPECT_THAT(done({"scores", "--sheet", "talk"}), HasSubstr("group,content,slides,delivery,answers"));
    done({"assignment", "--remove", "talk", "--reason", "mistyped"});
    EXPECT_THAT(done({"status"}), Not(HasSubstr("talk")));
    EXPECT_THAT(done({"history"}), HasSubstr("assignment talk removed"));
    course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00", {"--no-checks"});
    EXPECT_THAT(course({"assignment", "--remove", "crane", "--reason", "x"}).error_output,
                HasSubstr("cannot be removed, because it already has submitted files"));
}

// oracle: the settings before and after, in the history
TEST_F(corrections, changes_of_an_assignment_are_recorded_or_refused) {
    done({"assignment", "crane", "--reviews", "3"});
    EXPECT_THAT(done({"history"}), HasSubstr("assignment crane changed: reviews 3 instead of 2"));
    course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00", {"--no-checks"});
    EXPECT_THAT(course({"assignment", "crane", "--reviews", "1"}).error_output, HasSubstr("give --reason"));
    done({"assignment", "crane", "--reviews", "1", "--criteria", "form:10,method:20", "--reason", "few came"});
    EXPECT_THAT(done({"history"}),
                AllOf(HasSubstr("reviews 1 instead of 3"), HasSubstr("criteria form:10,method:20 instead of data:5,"),
                      HasSubstr("; reason: few came")));
    EXPECT_THAT(course({"assignment", "crane", "--kind", "talk", "--reason", "x"}).error_output,
                HasSubstr("files were already submitted for crane, so its kind must remain report"));
    course_.bench().write("s.csv", "reviewer,report,form\ninstructor,group-01,8\n");
    done({"scores", "crane", "s.csv"});
    EXPECT_THAT(course({"assignment", "crane", "--criteria", "form:20", "--reason", "x"}).error_output,
                HasSubstr("scores were already entered for crane, so its criteria must remain form:10,method:20"));
    EXPECT_THAT(done({"marks", "crane"}), HasSubstr("80.0"));
}

// oracle: two days begun at 30 points each, only once the instructor says that the time is right
TEST_F(corrections, a_penalty_of_half_the_points_waits_for_the_instructor) {
    done({"assignment", "crane", "--costs", "late-day:30"});
    const ChildResult late = course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-03 11:00", {"--no-checks"});
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_THAT(late.error_output, HasSubstr("group-01 is late by 1 d 23 h; the penalty of 60 % is not applied until"));
    course_.bench().write("s.csv", "reviewer,report,data\ninstructor,group-01,5\n");
    done({"scores", "crane", "s.csv"});
    const auto marks = [&] { return done({"marks", "crane", "--at", "2026-03-04 12:00"}); };
    EXPECT_THAT(marks(), AllOf(HasSubstr("100.0"),
                               HasSubstr("60 % for a first version late by 1 d 23 h is not deducted until")));
    const ChildResult confirmed =
        course_.submit_file("group-01.pdf", small_pdf("one"), "2026-03-04 11:00", {"--no-checks", "--accept-late"});
    EXPECT_EQ(confirmed.exit_code, 0) << confirmed.error_output;
    EXPECT_THAT(confirmed.output, HasSubstr("-corrected-1.txt"));
    EXPECT_THAT(marks(), AllOf(HasSubstr("40.0"), Not(HasSubstr("wait"))));
    EXPECT_THAT(done({"verify"}), HasSubstr("complete and unaltered"));
}

TEST_F(corrections_of_reviews, a_newer_version_goes_out_again_or_is_held_back) {
    const std::string sent = shell("cat k/outbox/crane/to-review/*/*.pdf | sha256sum");
    course_.submit_file("group-01.pdf", small_pdf("better"), "2026-03-02 12:00", {"--no-checks"});
    EXPECT_THAT(status(), AllOf(HasSubstr("a newer version than was sent: review send"),
                                HasSubstr("Next: dynlab course review send crane")));
    done({"withhold", "crane", "group-01", "--reason", "to be read first"});
    EXPECT_THAT(status(), AllOf(HasSubstr("its report is withheld"), Not(HasSubstr("a newer version than was sent"))));
    const std::string held = done({"review", "send", "--at", "2026-03-02 13:00"});
    EXPECT_THAT(held, AllOf(HasSubstr("0 sent now"), HasSubstr("6 before"), HasSubstr("2 withheld"),
                            HasSubstr("Removed from the folder: group-0")));
    EXPECT_THAT(shell("ls k/outbox/crane/to-review/*/*.pdf | wc -l"), HasSubstr("6"));
    done({"withhold", "crane", "group-01", "--end", "--reason", "read"});
    EXPECT_THAT(done({"review", "send", "--at", "2026-03-02 14:00"}),
                HasSubstr("2 sent now (2 in a newer version), 6 before"));
    EXPECT_THAT(done({"review", "send", "--at", "2026-03-02 14:00"}), HasSubstr("0 sent now, 8 before"));
    EXPECT_NE(shell("cat k/outbox/crane/to-review/*/*.pdf | sha256sum"), sent);
    EXPECT_THAT(status(), Not(HasSubstr("newer version")));
    EXPECT_THAT(course({"withhold", "crane", "group-01", "--end", "--reason", "x"}).error_output,
                HasSubstr("not withheld"));
}

TEST_F(corrections_of_reviews, a_newer_review_goes_out_again_and_a_withdrawn_one_leaves_the_outbox) {
    const std::string report =
        shell("basename $(ls k/outbox/crane/to-review/group-01/*.pdf | head -1) .pdf | tr -d '\\n'");
    const auto review = [&](const std::string& text) {
        return course_.bench().write("r.pdf", small_pdf(text)),
               done({"review", "collect", "r.pdf", "--from", "group-01", "--of", report, "--at", "2026-03-08 10:00",
                     "--no-checks"});
    };
    review("good work");
    EXPECT_THAT(done({"review", "release", "--at", "2026-03-09 10:00"}), HasSubstr("1 sent now"));
    review("good work, but the units are missing");
    EXPECT_THAT(status("2026-03-09 11:00"), AllOf(HasSubstr("a newer review than was released: review release"),
                                                  HasSubstr("Next: dynlab course review release")));
    EXPECT_THAT(done({"review", "release", "--at", "2026-03-09 12:00"}),
                HasSubstr("1 sent now (1 in a newer version)"));
    done({"withdraw", "crane", "group-01", "--stage", "review", "--of", report, "--reason", "wrong form"});
    done({"withdraw", "crane", "group-01", "--stage", "review", "--of", report, "--reason", "this too"});
    EXPECT_THAT(done({"review", "release", "--at", "2026-03-09 13:00"}),
                AllOf(HasSubstr("0 sent now"), HasSubstr("Removed from the folder: group-0")));
    EXPECT_THAT(shell("ls k/outbox/crane/reviews/*/*.pdf | wc -l"), HasSubstr("0"));
}

TEST_F(corrections_of_reviews, pairs_are_set_and_forbidden_by_hand) {
    const auto reads = [&](const std::string& who, const std::string& whose) {
        return shell("$DYNLAB course --course k review pairs crane | awk '$1 == \"" + who + "\" && $3 == \"" + whose +
                     "\" && $NF != \"withdrawn\"' | wc -l") == "1\n";
    };
    const std::string partner = reads("group-01", "group-02") ? "group-02" : "group-03";
    ASSERT_TRUE(reads("group-01", partner));
    done({"review", "pairs", "--forbid", "crane", "group-01", partner, "--reason", "they share a flat"});
    done({"review", "assign", "--at", "2026-03-02 12:00"});
    EXPECT_FALSE(reads("group-01", partner));
    EXPECT_FALSE(reads(partner, "group-01"));
    done({"review", "pairs", "--free", "crane", "group-01", partner, "--reason", "moved out"});
    done({"review", "pairs", "--set", "crane", partner, "group-01", "--reason", "agreed"});
    done({"review", "assign", "--at", "2026-03-02 13:00"});
    EXPECT_TRUE(reads(partner, "group-01"));
    EXPECT_EQ(course({"review", "pairs", "--set", "crane", "group-01", "group-01", "--reason", "x"}).exit_code, 1);
}

TEST_F(corrections_of_reviews, who_joins_the_authors_reviews_them_no_more) {
    const std::string author =
        shell("$DYNLAB course --course k review pairs crane | awk '$1 == \"group-01\" {print $3; exit}'").substr(0, 8);
    course_.bench().write("roster.csv", "id,name,group\ns" + author.substr(7) + ",Student,group-01\n");
    done({"import", "roster.csv"});
    EXPECT_THAT(done({"review", "assign", "--at", "2026-03-02 12:00"}), Not(HasSubstr("0 withdrawn")));
    EXPECT_THAT(shell("sqlite3 k/course.db \"SELECT ended_reason FROM pairs WHERE ended_at IS NOT NULL\""),
                HasSubstr("they share a member"));
}

TEST_F(corrections, the_same_bytes_of_two_groups_are_reported_and_a_team_s_copies_are_one) {
    course_.bench().write("in/group-01.pdf", small_pdf("one"));
    course_.bench().write("in/group-02.pdf", small_pdf("one"));
    EXPECT_THAT(done({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}),
                HasSubstr("the same file as group-01's"));
    EXPECT_THAT(status(), AllOf(HasSubstr("submitted the same file as group-01"),
                                HasSubstr("submitted the same file as group-02")));
    course_.bench().write("roster.csv", "id,name,group\ns3,Student 3,group-03\ns4,Student 4,group-03\n");
    done({"import", "roster.csv"});
    for (const char* name : {"Student 3_900003", "Student 4_900004"})
        course_.bench().write("team/" + std::string(name) + "_assignsubmission_file_/report.pdf", small_pdf("three"));
    EXPECT_THAT(done({"submit", "team", "--at", "2026-03-01 10:00", "--no-checks"}), HasSubstr("1 file accepted"));
}

}  // namespace test_corrections
}  // namespace dynlab::test
