// Submissions that differ a little from the assignment: dynlab keeps and reports them. Oracles: the submitted bytes,
// and the rules in the help pages.
#include <gmock/gmock.h>

#include "course/course_bench.h"

namespace dynlab::test {
namespace test_unusual_submissions {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kInTime = "2026-03-01 10:00";

std::string reported(const ChildResult& result, int exit_code = 0) {
    EXPECT_EQ(result.exit_code, exit_code) << result.error_output;
    return result.output + result.error_output;
}

std::string shell(CourseBench& bench, const std::string& command) {
    return bench.bench().shell(command).output;
}

TEST(unusual_submissions, what_a_word_processor_wrote_is_kept_and_flagged) {
    CourseBench bench(3, 1);
    const std::string text = "PK\x03\x04 what Word writes";
    EXPECT_THAT(reported(bench.submit_file("group-01.docx", text, kInTime, {"--no-checks"})),
                AllOf(ContainsRegex("group-01 +report +v1 +on time +not-pdf: ask the group for a readable file"),
                      HasSubstr("1 file accepted")));
    EXPECT_THAT(reported(bench.course({"status", "crane", "--at", "2026-03-01 11:00"})),
                ContainsRegex("group-01 .*ask for a readable .*\\(not-pdf\\)"));
    EXPECT_EQ(shell(bench, "cat k/files/*/* k/files/* 2>/dev/null | grep -ac 'what Word writes'"), "1\n");
    // Beside the PDF that was made of it the text needs no remark.
    bench.bench().write("in/group-02.ODT", "text");
    bench.bench().write("in/group-02.pdf", small_pdf("two"));
    bench.bench().write("in/Student 3_900003_assignsubmission_file_/mine.doc", "text");
    bench.bench().write("in/Student 3_900003_assignsubmission_file_/mine.pdf", small_pdf("three"));
    EXPECT_THAT(reported(bench.course({"submit", "in", "--at", kInTime, "--isolation", bench.level()})),
                AllOf(HasSubstr("2 files accepted"), Not(HasSubstr("not-pdf"))));
    // The same for reviews, whichever report they are of.
    reported(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    bench.bench().write("review.docx", "text");
    EXPECT_THAT(reported(bench.course({"review", "collect", "review.docx", "--from", "group-02", "--at", kInTime})),
                ContainsRegex("group-02 +report-[0-9]+ +v1 +on time +not-pdf: ask"));
}

TEST(unusual_submissions, several_reviews_are_reported_in_one_call) {
    CourseBench bench(4, 2);
    for (int i = 1; i <= 4; ++i)
        reported(
            bench.submit_file(CourseBench::group(i) + ".pdf", small_pdf(std::to_string(i)), kInTime, {"--no-checks"}));
    reported(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    std::string reports =
        shell(bench, "$DYNLAB course --course k review pairs crane | awk '$1 == \"group-01\" {print $2}'");
    const std::string first = reports.substr(0, reports.find('\n'));
    const std::string second = reports.substr(first.size() + 1, reports.size() - first.size() - 2);
    bench.bench().write("a.pdf", small_pdf("of the second"));
    bench.bench().write("b.pdf", small_pdf("of the first"));
    const auto receive = [&](const std::vector<std::string>& of) {
        std::vector<std::string> words = {"review", "collect"};
        for (const std::string& report : of) words.insert(words.end(), {"--of", report});
        words.insert(words.end(), {"a.pdf", "b.pdf", "--from", "group-01", "--at", "2026-03-02 10:00", "--no-checks"});
        return bench.course(words);
    };
    reported(receive({second, first}));
    EXPECT_EQ(shell(bench,
                    "sqlite3 k/course.db \"SELECT v.name || ' report-' || printf('%02d', n.number) FROM versions v "
                    "JOIN pairs p ON p.id = v.pair JOIN pseudonyms n ON n.group_id = p.author AND n.role = 'author' "
                    "WHERE v.stage = 'review' ORDER BY 1\""),
              "a.pdf " + second + "\nb.pdf " + first + "\n");
    EXPECT_THAT(reported(receive({first, second, first}), 1), HasSubstr("2 files and 3 values of --of"));
}

TEST(unusual_submissions, a_version_that_was_there_before_and_a_review_as_a_report_are_reported) {
    CourseBench bench(2, 1);
    for (int i = 1; i <= 2; ++i)
        reported(
            bench.submit_file(CourseBench::group(i) + ".pdf", small_pdf(std::to_string(i)), kInTime, {"--no-checks"}));
    reported(bench.submit_file("group-01.pdf", small_pdf("other"), "2026-03-01 11:00", {"--no-checks"}));
    EXPECT_THAT(reported(bench.submit_file("group-01.pdf", small_pdf("1"), "2026-03-01 18:00", {"--no-checks"})),
                ContainsRegex("v3 +on time +the same file as v1 of Sun 2026-03-01 10:00"));
    reported(bench.course({"review", "assign", "--at", "2026-03-02 10:00"}));
    EXPECT_THAT(reported(bench.course({"issues", "group-01"})), Not(HasSubstr("No copy")));
    bench.bench().write("review.pdf", small_pdf("a review"));
    reported(bench.course(
        {"review", "collect", "review.pdf", "--from", "group-02", "--at", "2026-03-03 10:00", "--no-checks"}));
    bench.bench().write("mine.pdf", small_pdf("a review"));
    EXPECT_THAT(reported(bench.course({"submit", "--stage", "final", "mine.pdf", "--from", "group-02", "--at",
                                       "2026-03-10 10:00", "--no-checks"})),
                HasSubstr("the same file as a review by group-02"));
}

TEST(unusual_submissions, another_time_of_a_known_file_is_reported) {
    CourseBench bench(2, 1);
    for (int i = 1; i <= 2; ++i)
        bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf(std::to_string(i)));
    bench.bench().write("times.csv", "group,time\ngroup-01,2026-03-01 11:30\n");
    const auto receive = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"submit", "in", "--at", "2026-03-01 19:00", "--no-checks"});
        return reported(bench.course(more));
    };
    EXPECT_THAT(receive({}), ContainsRegex("group-01 +report +v1 +late by 7 h"));
    EXPECT_THAT(
        receive({"--times", "times.csv"}),
        AllOf(ContainsRegex("group-01 .*already received; according to --times, the file arrived on Sun 2026-03-01 "
                            "11:30; to correct the recorded time, run dynlab course set-received"),
              ContainsRegex("group-02 .*already received; nothing changed")));
    reported(
        bench.course({"set-received", "crane", "group-01", "2026-03-01 11:30", "--reason", "the platform's list"}));
    EXPECT_THAT(receive({"--times", "times.csv"}),
                ContainsRegex("group-01 .*on time +already received; nothing changed"));
}

TEST(unusual_submissions, reports_are_held_against_what_their_lesson_asks_for) {
    CourseBench bench(1, 1);
    const auto add = [&](const std::string& name, const std::string& lesson) {
        return bench.course({"assignment", name, "--lesson", lesson, "--first", "2026-03-01 12:00", "--review",
                             "2026-03-08 12:00", "--final", "2026-03-15 12:00", "--reviews", "1"});
    };
    reported(add("lines", "02"));
    reported(add("labs", "03_crane"));
    EXPECT_THAT(add("none", "22").error_output,
                AllOf(HasSubstr("unknown lesson or folder '22'; the lessons are "), HasSubstr("02_least_squares")));
    EXPECT_THAT(bench.course({"assignment", "lines", "--lesson", "22", "--reason", "a slip"}).error_output,
                HasSubstr("unknown lesson or folder '22'"));
    reported(bench.submit_file("group-01.pdf", small_pdf("The winning times"), kInTime, {"--assignment", "lines"}));
    EXPECT_THAT(bench.course({"issues", "group-01", "--assignment", "lines"}).output,
                AllOf(HasSubstr("checked as lesson"), Not(HasSubstr("lab_report"))));
    for (const char* name : {"labs", "crane"}) {  // one of a lesson that asks for it, one without a lesson
        reported(bench.submit_file("group-01.pdf", small_pdf("The winning times"), kInTime, {"--assignment", name}));
        EXPECT_THAT(reported(bench.course({"issues", "group-01", "--assignment", name}), 1),
                    HasSubstr("Checked as lab_report"));
    }
}

TEST(unusual_submissions, the_findings_of_a_report_state_that_its_copy_did_not_go_out) {
    CourseBench bench(2, 1);
    reported(bench.submit_file("group-01.pdf", small_pdf("A report by Student 1 of this course"), kInTime));
    reported(bench.submit_file("group-02.pdf", small_pdf("A report"), kInTime));
    reported(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    EXPECT_THAT(reported(bench.course({"review", "send", "--at", "2026-03-01 13:30"}), 1), HasSubstr("1 stopped"));
    EXPECT_THAT(reported(bench.course({"issues", "group-01"}), 1),
                HasSubstr("No copy of it was sent to others yet: run dynlab course review send crane to see why"));
    EXPECT_THAT(reported(bench.course({"issues", "group-02"}), 1), Not(HasSubstr("No copy")));
}

TEST(unusual_submissions, what_canvas_calls_late_is_reported_where_the_time_does_not_say_so) {
    CourseBench bench(2, 1);
    bench.bench().write("roster.csv", "id,name,group,canvas\ns1,Student 1,group-01,31\ns2,Student 2,group-02,32\n");
    reported(bench.course({"import", "roster.csv"}));
    bench.bench().write("in/student1_LATE_31_77_report.pdf", small_pdf("1"));
    bench.bench().write("in/student2_32_78_report.pdf", small_pdf("2"));
    EXPECT_THAT(
        reported(bench.course({"submit", "in", "--at", kInTime, "--no-checks", "--isolation", bench.level()})),
        AllOf(ContainsRegex(
                  "group-01 +report +v1 +on time +marked late by the platform: enter the time of receipt with --times"),
              ContainsRegex("group-02 +report +v1 +on time *\n")));
}

}  // namespace test_unusual_submissions
}  // namespace dynlab::test
