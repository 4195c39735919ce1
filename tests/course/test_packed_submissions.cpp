#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"

namespace dynlab::test {
namespace test_packed_submissions {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kInTime[] = "2026-03-01 10:00";

/// NAME.zip as dynlab pack makes it, of a folder with a script, a text and these PDFs.
void pack(CourseBench& bench, const std::string& name, const std::vector<std::string>& pdfs,
          const std::string& words = "words", const std::string& script = "-- %%\n") {
    bench.bench().write("work-" + name + "/analysis.lua", script);
    bench.bench().write("work-" + name + "/report.md", "# Words\n");
    for (const std::string& pdf : pdfs)
        bench.bench().write("work-" + name + "/" + pdf, small_pdf(words + " of " + pdf));
    CourseBench::expect_done(bench.bench().dynlab({"pack", "work-" + name, "-o", name + ".zip"}));
}

ChildResult receive(const CourseBench& bench, const std::vector<std::string>& files, const std::string& at,
                    std::vector<std::string> before = {}) {
    before.push_back("receive");
    before.insert(before.end(), files.begin(), files.end());
    before.insert(before.end(), {"--at", at, "--isolation", CourseBench::level()});
    return bench.course(before);
}

std::string report_hash(CourseBench& bench, const std::string& group) {
    return bench.bench()
        .shell(
            "sqlite3 k/course.db \"SELECT v.hash FROM versions v JOIN groups g ON g.id = v.group_id WHERE g.name = '" +
            group + "' AND part = 'report' ORDER BY number DESC LIMIT 1\"")
        .output;
}

// oracle: sha256sum of what was packed
TEST(packed_submissions, the_report_of_a_pack_counts) {
    CourseBench bench(4, 1);
    pack(bench, "group-01", {"report.pdf", "figures/step.pdf"});
    pack(bench, "group-02", {"my work.pdf"});
    pack(bench, "group-03", {}, "words", "error('stopped')\n");
    pack(bench, "group-04", {"a.pdf", "b.pdf"});
    const std::vector<std::string> all = {"group-01.zip", "group-02.zip", "group-03.zip", "group-04.zip"};
    const ChildResult taken = receive(bench, all, kInTime);
    CourseBench::expect_done(taken);
    EXPECT_THAT(taken.output,
                AllOf(ContainsRegex("group-01 +pack +v1"), ContainsRegex("group-01 +report \\(from the pack\\) +v1"),
                      ContainsRegex("group-02 +report \\(from the pack\\) +v1 +on time +[1-9][0-9]* rule"),
                      ContainsRegex("group-03 +pack .*the pack contains no PDF, and none can be created from it "
                                    "\\(.*stopped.*\\): ask the group for this file"),
                      ContainsRegex("group-04 +pack .*the pack contains 2 PDF files; exactly one must be named "
                                    "report.pdf: ask the group for this file"),
                      HasSubstr("6 files accepted")));
    const std::string packed = bench.bench().shell("sha256sum < work-group-01/report.pdf").output.substr(0, 64);
    EXPECT_EQ(report_hash(bench, "group-01"), packed + "\n");
    const std::string status = bench.course({"status", "crane", "--at", "2026-03-01 13:00"}).output;
    EXPECT_THAT(status,
                AllOf(ContainsRegex("group-01 +1 +v1"), ContainsRegex("group-03 .*the pack contains no PDF: ask"),
                      HasSubstr("4 groups: 2 submitted, 2 missing.")));
    EXPECT_THAT(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}).output,
                HasSubstr("2 groups, 2 reviews"));
    EXPECT_THAT(bench.course({"verify"}).output, HasSubstr("complete and unaltered"));
    const std::string before = bench.dump();
    CourseBench::expect_done(receive(bench, all, kInTime));
    EXPECT_EQ(bench.dump(), before);
}

// oracle: the words of the pack's report.md and a value of its script, as poppler reads them
TEST(packed_submissions, of_a_pack_without_a_pdf_the_report_is_made) {
    CourseBench bench(2, 1);
    bench.bench().write("work/analysis.lua",
                        "-- ---\n-- title: T\n-- ---\n\n-- %%\nreport.value('fit', 87.25, '%.2f')\n");
    bench.bench().write("work/report.md", "---\ntitle: Crane\n---\n\n# Words\n\nThe fit is `fit`{.value} percent.\n");
    CourseBench::expect_done(bench.bench().dynlab({"pack", "work", "-o", "group-01.zip"}));
    const ChildResult taken = receive(bench, {"group-01.zip"}, kInTime);
    CourseBench::expect_done(taken);
    EXPECT_THAT(
        taken.output,
        AllOf(ContainsRegex(
                  "group-01 +report \\(from the pack\\) +v1 .*created by dynlab, because the pack contains no PDF"),
              HasSubstr("2 files accepted")));
    const std::string hash = report_hash(bench, "group-01").substr(0, 64);
    EXPECT_THAT(bench.bench().shell("pdftotext $(find k/files -name '*" + hash.substr(2) + "') -").output,
                HasSubstr("The fit is 87.25 percent."));
    const std::string before = bench.dump();
    CourseBench::expect_done(receive(bench, {"group-01.zip"}, kInTime));
    EXPECT_EQ(bench.dump(), before);
}

// oracle: sha256sum of the PDF that was submitted alone
TEST(packed_submissions, a_pdf_that_came_alone_holds) {
    CourseBench bench(3);
    pack(bench, "group-01", {"report.pdf"}, "packed");
    bench.bench().write("group-01.pdf", small_pdf("alone"));
    const std::string alone = bench.bench().shell("sha256sum < group-01.pdf").output.substr(0, 64) + "\n";
    EXPECT_THAT(receive(bench, {"group-01.zip", "group-01.pdf"}, kInTime).output,
                AllOf(HasSubstr("2 files accepted"), Not(HasSubstr("from the pack"))));
    EXPECT_EQ(report_hash(bench, "group-01"), alone);
    CourseBench::expect_done(receive(bench, {"group-01.zip"}, kInTime));  // known: it replaces nothing
    EXPECT_EQ(report_hash(bench, "group-01"), alone);
    bench.bench().write("group-02.zip", "PK\x03\x04 no archive at all");
    EXPECT_THAT(receive(bench, {"group-02.zip"}, kInTime).output,
                HasSubstr("damaged: ask the group for a pack that can be opened"));
}

// oracle: the rule that a review is a readable document
TEST(packed_submissions, a_pack_is_a_review_only_with_a_pdf) {
    CourseBench bench(2, 1);
    for (const char* group : {"group-01", "group-02"})
        bench.submit_file(std::string(group) + ".pdf", small_pdf(group), kInTime);
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    pack(bench, "group-01", {}, "words", "error('stopped')\n");
    pack(bench, "group-02", {"remarks.pdf"});
    const ChildResult taken = receive(bench, {"group-01.zip", "group-02.zip"}, "2026-03-09 10:00", {"review"});
    CourseBench::expect_done(taken);
    EXPECT_THAT(taken.output, AllOf(ContainsRegex("group-01 +report-[0-9]+ \\(pack\\) .*the pack contains no PDF"),
                                    ContainsRegex("group-02 +report-[0-9]+ \\(from the pack\\) +v1")));
    EXPECT_THAT(bench.course({"status", "--at", "2026-03-09 11:00"}).output, HasSubstr("crane"));
    EXPECT_THAT(bench.course({"status", "crane", "--at", "2026-03-09 11:00"}).output,
                AllOf(ContainsRegex("group-01 +1 +v1[^\n]* 0 of 1 [^\n]*the pack contains no PDF with its review of "
                                    "report-[0-9]+: ask the group for this file"),
                      Not(HasSubstr("send a reminder")), ContainsRegex("group-02 +1 +v1[^\n]* 1 of 1, 1 late")));
}

// oracle: the rules of deadlines: a review is late when no version of it came in time
TEST(packed_submissions, late_reviews_and_late_second_versions_are_distinguished) {
    CourseBench bench(3, 1);
    for (int i = 1; i <= 3; ++i) bench.submit_file(CourseBench::group(i) + ".pdf", small_pdf("one"), kInTime);
    bench.submit_file("group-01.pdf", small_pdf("two"), "2026-03-01 13:00");
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 14:00"}));
    bench.submit_file("r.pdf", small_pdf("r1"), "2026-03-07 10:00", {"--assignment", "crane"});
    const auto review = [&](const char* group, const char* text, const char* at) {
        bench.bench().write("r.pdf", small_pdf(text));
        CourseBench::expect_done(bench.course({"review", "collect", "r.pdf", "--from", group, "--at", at}));
    };
    review("group-01", "good", "2026-03-07 10:00"), review("group-01", "better", "2026-03-09 10:00");
    review("group-02", "good", "2026-03-09 10:00");
    const std::string status = bench.course({"status", "crane", "--at", "2026-03-09 12:00"}).output;
    EXPECT_THAT(status,
                AllOf(ContainsRegex("group-01 +1 +v2 \\(v1 on time\\)[^\n]* 1 of 1  "),
                      ContainsRegex("group-02 +1 +v1[^\n]* 1 of 1, 1 late"), HasSubstr("3 groups: 3 submitted;")));
    const std::string csv = bench.course({"export", "crane"}).output;
    EXPECT_THAT(csv, AllOf(HasSubstr(",reviews written,reviews late (h),"), HasSubstr(",2026-03-01 13:00,0,"),
                           ContainsRegex("group-01[^\n]*,1 of 1,0,"), ContainsRegex("group-02[^\n]*,1 of 1,22,"),
                           ContainsRegex("group-03[^\n]*,0 of 1,0,")));
}

// oracle: the store before; the course's dates
TEST(packed_submissions, a_first_version_after_the_reviews_is_asked_about) {
    CourseBench bench(2, 1);
    for (const char* group : {"group-01", "group-02"})
        bench.submit_file(std::string(group) + ".pdf", small_pdf(group), kInTime);
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    CourseBench::expect_done(
        bench.submit_file("group-01.pdf", small_pdf("more"), "2026-03-09 10:00"));  // no reviewer reads it
    bench.bench().shell(  // inserted as review send and release do
        "sqlite3 k/course.db \"INSERT INTO sendings (pair, way, version, hash, made_at) SELECT p.id, 'to reviewer', "
        "v.id, "
        "v.hash, 0 FROM pairs p JOIN versions v ON v.group_id = p.author WHERE v.number = 1\"");
    CourseBench::expect_done(
        bench.submit_file("group-02.pdf", small_pdf("again"), "2026-03-07 10:00"));  // while they read
    EXPECT_THAT(bench.course({"status", "crane", "--at", "2026-03-07 12:00"}).output,
                HasSubstr("Next: dynlab course review send crane"));  // the newer one of group-02
    const std::string before = bench.dump();
    const ChildResult late = bench.submit_file("group-02.pdf", small_pdf("last"), "2026-03-09 10:00");
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_THAT(late.error_output,
                HasSubstr("the reviews of the report of group-02 are already due: did you mean dynlab course submit "
                          "--stage final? To submit a first version anyway, give --first"));
    EXPECT_EQ(bench.dump(), before);
    bench.bench().shell(
        "sqlite3 k/course.db \"INSERT INTO sendings (pair, way, version, hash, made_at) SELECT pair, 'to author', "
        "version, "
        "hash, 0 FROM sendings\"");
    EXPECT_THAT(bench.submit_file("group-02.pdf", small_pdf("last"), "2026-03-07 10:00").error_output,
                HasSubstr("the reviews of the report of group-02 are already released: did you mean dynlab course "
                          "submit --stage final?"));
    EXPECT_THAT(bench.course({"status", "crane", "--at", "2026-03-09 12:00"}).output,
                HasSubstr("Next: dynlab course scores crane FILE.csv, then dynlab course marks crane"));
    CourseBench::expect_done(bench.submit_file("group-02.pdf", small_pdf("again"), "2026-03-09 10:00"));  // known
    CourseBench::expect_done(bench.submit_file("group-02.pdf", small_pdf("last"), "2026-03-09 10:00", {"--first"}));
    CourseBench::expect_done(receive(bench, {"group-02.pdf"}, "2026-03-10 10:00", {"final"}));
}

// oracle: the rule; what lies beside a report needs no word
TEST(packed_submissions, takes_folders_as_students_keep_them) {
    CourseBench bench(3);
    bench.bench().write("records/long.csv", "t,y\n");
    for (const char* group : {"group-01", "group-02"}) {
        bench.bench().write(std::string("in/") + group + "/analysis.lua", "-- %%\n");
        bench.bench().write(std::string("in/") + group + "/report.md", "# Words\n");
    }
    bench.bench().write("in/group-01/report.pdf", small_pdf("one"));
    bench.bench().write("in/group-01/data/paper.pdf", small_pdf("not theirs"));
    bench.bench().shell("ln -s $PWD/records in/group-02/data; mkfifo in/group-02/pipe");
    const ChildResult taken = receive(bench, {"in"}, kInTime);
    EXPECT_THAT(taken.output,
                AllOf(HasSubstr("3 files accepted"), ContainsRegex("group-01 +report +v1"),
                      ContainsRegex("group-02 +unreadable +v2 +on time +other-kind: ask the group for a readable")));
    EXPECT_THAT(taken.error_output, AllOf(HasSubstr("pipe: not a regular file"), Not(HasSubstr("group-01")),
                                          Not(HasSubstr("filesystem")), Not(HasSubstr("data"))));
}

}  // namespace test_packed_submissions
}  // namespace dynlab::test
