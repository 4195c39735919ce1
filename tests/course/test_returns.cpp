// What goes back to students. Oracles: the files of the outbox, unpacked by other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/export/mailing.h"
#include "course/export/returned_files.h"
#include "course/office/receive.h"
#include "course/review/review_pairs.h"
#include "course/store/senders.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_returns {
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(returns, bring_what_is_new_for_whom) {
    CourseBench course(3, 1);
    course.bench().write("roster.csv",
                         "id,name,group,mail,moodle\ns1,Ada Müller,group-01,ada@course.example,900001\n"
                         "s2,Student 2,group-02,,900002\ns3,Student_3,group-03,c@course.example,900003\n");
    const auto done = [&](const std::vector<std::string>& words) {
        const ChildResult result = course.course(words);
        EXPECT_EQ(result.exit_code, 0) << words[0] << ": " << result.error_output;
        return result.output + result.error_output;
    };
    const auto shell = [&](const std::string& command) { return course.bench().shell(command).output; };
    done({"import", "roster.csv"});
    for (int i = 1; i <= 3; ++i)
        course.submit_file(CourseBench::group(i) + ".pdf", small_pdf(std::to_string(i)), "2026-03-01 10:00",
                           {"--no-checks"});
    done({"review", "assign", "--at", "2026-03-02 10:00"});
    done({"review", "send", "--at", "2026-03-02 11:00"});
    const std::string reported = done({"deliver", "crane", "--out", "monday", "--moodle"});
    EXPECT_THAT(reported, AllOf(HasSubstr("group-01: 00001-group-01-first-report.txt, report-"),
                                HasSubstr("Files for 3 groups are in monday"),
                                HasSubstr("no email address is known for group-02")));
    EXPECT_EQ(shell("ls monday/*/report-*.pdf | wc -l"), "3\n");
    EXPECT_EQ(
        shell("for f in monday/*/report-*.pdf; do cmp $f k/outbox/crane/to-review/${f#monday/} || echo differs; done"),
        "");
    EXPECT_THAT(shell("cat monday/mail.csv"), AllOf(HasSubstr("id,name,group,mail,files,new\r\n"),
                                                    HasSubstr("s1,Ada Müller,group-01,ada@course.example,\"group-01/"
                                                              "00001-group-01-first-report.txt; group-01/report-")));
    EXPECT_THAT(shell("python3 -c \"import zipfile; print(zipfile.ZipFile('monday/moodle.zip').namelist())\""),
                AllOf(HasSubstr("Ada Müller_900001_assignfeedback_file_/report-"),
                      HasSubstr("Student 3_900003_assignfeedback_file_/00003-group-03-first-report.txt")));
    EXPECT_THAT(done({"deliver", "crane", "--out", "tuesday"}), HasSubstr("No new files to deliver."));
    EXPECT_EQ(shell("ls -d tuesday 2>/dev/null"), "");
    // A newer version is new for its reviewer, and its receipt for the group; nothing else.
    course.submit_file("group-01.pdf", small_pdf("better"), "2026-03-02 12:00", {"--no-checks"});
    done({"review", "send", "--at", "2026-03-02 13:00"});
    done({"deliver", "crane", "--out", "wednesday"});
    EXPECT_EQ(shell("find wednesday -name '*.pdf' | wc -l"), "1\n");
    EXPECT_EQ(shell("find wednesday -name '*.txt' | wc -l"), "1\n");
    done({"deliver", "crane", "--out", "all", "--all"});
    EXPECT_EQ(shell("find all -name '*.pdf' | wc -l"), "3\n");
    EXPECT_THAT(course.course({"deliver", "crane", "--out", "all"}).error_output, HasSubstr("already exists"));
    done({"verify"});
}

// oracle: the exit codes, and the files that the outbox and the receipts are
TEST(returns, two_deliveries_into_one_folder_are_one) {
    CourseBench course(12, 2);
    for (int i = 1; i <= 12; ++i)
        course.submit_file(CourseBench::group(i) + ".pdf", small_pdf(std::to_string(i)), "2026-03-01 10:00",
                           {"--no-checks"});
    ASSERT_EQ(course.course({"review", "assign", "--at", "2026-03-02 10:00"}).exit_code, 0);
    ASSERT_EQ(course.course({"review", "send", "--at", "2026-03-02 11:00"}).exit_code, 0);
    for (int round = 1; round <= 4; ++round) {
        const ChildResult both = course.bench().shell(
            "rm -rf out; for k in 1 2; do \"$DYNLAB\" course --course k deliver crane --all --out out >/dev/null 2>&1 "
            "& eval "
            "p$k=$!; done; wait $p1; a=$?; wait $p2; echo $((a + $?)); find out -type f -name '*.*' | wc -l; ls -A");
        EXPECT_THAT(both.output, ::testing::ContainsRegex("^1\n37\n")) << round;
        EXPECT_THAT(both.output, ::testing::Not(HasSubstr(".new-")));
    }
}

// oracle: what unzip and Windows take as a name
TEST(returns, names_of_people_are_plain_in_the_zip) {
    MoodleFeedback feedback;
    const TemporaryFolder folder;
    feedback.add({"s1", "A\x1b[31m\nB<C>:?*\xEF\xBB\xBF", "", "", "900001"}, "feedback.pdf", "x");
    feedback.write(folder.path() / "moodle.zip");
    EXPECT_EQ(Workbench()
                  .shell("python3 -c \"import zipfile; print(zipfile.ZipFile('" +
                         (folder.path() / "moodle.zip").string() + "').namelist())\"")
                  .output,
              "['A [31m B C     _900001_assignfeedback_file_/feedback.pdf']\n");
}

// oracle: Moodle numbers participants for each assignment: the names of its folders, and its worksheet
TEST(returns, participants_have_the_numbers_of_this_assignment) {
    CourseBench bench(3, 1);
    const Workbench& work = bench.bench();
    work.write("roster.csv",
               "id,name,group,moodle\ns1,Student 1,group-01,12345\ns2,Student 2,group-02,12346\ns3,Student "
               "3,group-03,12347\n");
    Course course(work.path("k"));
    import_roster(course, work.path("roster.csv"));
    const Assignment crane = assignment_named(course, "crane");
    work.write("in/Student 1_99345_assignsubmission_file_/report.pdf", small_pdf("1"));
    work.write("in/group-02.pdf", small_pdf("2"));
    ReceiveRequest request;
    request.files = {work.path("in")};
    request.assignment = "crane", request.at = course.clock().parse("2026-03-01 10:00", "time");
    request.checks = false;
    receive(course, request);
    EXPECT_EQ(participants_of(course, crane.id), (std::map<std::string, std::string>{{"s1", "99345"}}));
    const auto numbers = [&](const std::string& folder, const std::string& worksheet) {
        ReturnRequest back;
        back.folder = work.path(folder), back.moodle = true, back.all = true, back.now = request.at;
        if (!worksheet.empty()) back.worksheet = work.path(worksheet);
        const ReturnOutcome done = return_files(course, crane, back);
        EXPECT_EQ(done.other_numbers, worksheet.empty() ? 1 : 2);
        return work
            .shell("python3 -c \"import zipfile; print(sorted({n.split('_')[1] for n in zipfile.ZipFile('" + folder +
                   "/moodle.zip').namelist()}))\"")
            .output;
    };
    // The roster's number of the second student is of the other assignment, too.
    EXPECT_EQ(numbers("without", ""), "['99345']\n");
    work.write("sheet.csv",
               "Identifier,Full name,Grade,Maximum Grade\nParticipant 99345,Student 1,,20\nParticipant 99346,Student "
               "2,,20\n");
    EXPECT_EQ(numbers("with", "sheet.csv"), "['99345', '99346']\n");
}

TEST(returns, reviews_are_known_by_the_names_that_people_give) {
    const Group reviewer{1, "group-01", false, {}};
    const std::vector<ReviewPair> pairs = [] {
        ReviewPair one, other;
        one.id = 10, one.reviewer = 1, one.author = 2, one.report_number = 7;
        other.id = 20, other.reviewer = 1, other.author = 3, other.report_number = 68;
        return std::vector<ReviewPair>{one, other};
    }();
    for (const char* name : {"Review 68.pdf", "review-report-68.pdf", "Report_68.PDF", "report-68", "REVIEW068.pdf",
                             "group-01 review of report #68.pdf"})
        EXPECT_EQ(reviewed_pair(pairs, reviewer, name).id, 20) << name;
    EXPECT_EQ(reviewed_pair(pairs, reviewer, "report_07.PDF").id, 10);
    for (const char* name : {"my review.pdf", "report-687.pdf", "Review 6.pdf"})
        EXPECT_THROW(reviewed_pair(pairs, reviewer, name), EnvironmentError) << name;
    try {
        reviewed_pair(pairs, reviewer, "review-report-12.pdf");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("the file is a review of report-12, which group-01 did not receive; the reports "
                              "to review are report-07 and report-68"));
    }
}

}  // namespace test_returns
}  // namespace dynlab::test
