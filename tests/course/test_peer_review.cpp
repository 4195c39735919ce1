#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/review/review_marks.h"

namespace dynlab::test {
namespace test_peer_review {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

void submit_all(CourseBench& bench, int groups) {
    for (int i = 1; i <= groups; ++i)
        bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("report " + std::to_string(i)));
    CourseBench::expect_done(bench.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
}

// oracle: medians and distances by hand
TEST(peer_review, marks_by_median_and_distance) {
    const std::vector<Criterion> criteria = {{"a", 5}, {"b", 10}};
    const std::vector<ScoredReview> reviews = {
        {1, 10, 1, {4, 8}}, {2, 11, 1, {5, 6}}, {3, 12, 1, {0, 1}}, {4, 1, 12, {1, 2}}};
    const Marks marks = marks_of(criteria, reviews, {1, 12, 10});
    EXPECT_EQ(marks.groups[0].medians, (std::vector<std::optional<double>>{4, 6}));
    EXPECT_DOUBLE_EQ(*marks.groups[0].work, 100.0 * 10 / 15);
    EXPECT_EQ(marks.groups[0].reviews, std::nullopt);  // no other review scored that report
    EXPECT_DOUBLE_EQ(*marks.reviews[2].distance, (4.5 / 5 + 6.0 / 10) / 2);
    EXPECT_TRUE(marks.reviews[2].outlier);
    EXPECT_TRUE(marks.reviews[2].retaliation);  // group 1 had given 3 of 15 points to group 12
    EXPECT_DOUBLE_EQ(*marks.groups[1].reviews, 0);
    // Group 10: others' medians are 2.5 and 3.5.
    EXPECT_DOUBLE_EQ(*marks.groups[2].reviews, 100 * (1 - 2 * (1.5 / 5 + 4.5 / 10) / 2));
    EXPECT_FALSE(marks.reviews[0].outlier);
}

// oracle: the rules; nothing is sent while names cannot be searched for
TEST(peer_review, allots_mends_and_takes_reviews) {
    CourseBench bench(6);
    submit_all(bench, 6);
    EXPECT_THAT(bench.course({"review", "assign", "--at", "2026-03-01 11:00"}).error_output, HasSubstr("--early"));
    const ChildResult assigned = bench.course({"review", "assign", "--at", "2026-03-01 13:00"});
    EXPECT_THAT(assigned.output, HasSubstr("6 groups, 12 reviews: 12 new, 0 withdrawn."));
    const std::string before = bench.dump();
    EXPECT_THAT(bench.course({"review", "assign", "--at", "2026-03-01 14:00"}).output, HasSubstr("0 new, 0 withdrawn"));
    EXPECT_EQ(bench.dump(), before);
    const ChildResult unmatched =
        bench.submit_file("stray.pdf", small_pdf("x"), "2026-03-02 10:00", {"--from", "group-01"});
    CourseBench::expect_done(unmatched);
    bench.bench().write("r.pdf", small_pdf("a review"));
    const std::string report =
        bench.bench()
            .shell("$DYNLAB course --course k review pairs | awk '$1 == \"group-02\" {print $2; exit}'")
            .output;
    const std::string name = report.substr(0, report.find('\n'));
    EXPECT_THAT(bench.course({"review", "collect", "r.pdf", "--from", "group-02"}).error_output,
                HasSubstr("the review does not name the reviewed report. group-02 received report-"));
    CourseBench::expect_done(
        bench.course({"review", "collect", "r.pdf", "--from", "group-02", "--of", name, "--at", "2026-03-05 10:00"}));
    CourseBench::expect_done(bench.course({"drop", "group-02", "--reason", "ill"}));
    const ChildResult repaired = bench.course({"review", "assign", "--at", "2026-03-06 13:00"});
    CourseBench::expect_done(repaired);
    const std::string pairs = bench.course({"review", "pairs"}).output;
    EXPECT_THAT(pairs, ::testing::ContainsRegex("group-02 +" + name + ".* written"));
    EXPECT_THAT(bench.course({"status", "--at", "2026-03-06 14:00"}).output, HasSubstr("dropped out"));
}

// oracle: the roster's history; the pairs: four reports, two copies of each
TEST(peer_review, seeks_former_names_and_counts_copies) {
    CourseBench bench(4);
    const auto roster = [&](const std::string& first) {
        bench.bench().write("names.csv", "id,name,group,email\n" + first +
                                             "s2,Bo Ek,group-02,\ns3,Cy Ost,group-03,\ns4,Di Uhl,group-04,\n");
        CourseBench::expect_done(bench.course({"import", "names.csv"}));
    };
    roster("s1,Wilhelmina Rutherford,group-01,zwirner@a.example\n");
    roster("s1,Wilma Rathenau,group-01,wr@a.example\n");
    const std::vector<std::string> texts = {"by Wilhelmina Rutherford, zwirner@a.example", "by Wilma Rathenau", "three",
                                            "four"};
    for (int i = 1; i <= 4; ++i)
        bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf(texts[static_cast<std::size_t>(i) - 1]));
    CourseBench::expect_done(bench.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    const ChildResult sent = bench.course({"review", "send", "--at", "2026-03-01 14:00"});
    EXPECT_THAT(sent.output, HasSubstr("4 sent now, 0 before, 4 stopped, 0 outstanding"));
    EXPECT_THAT(sent.error_output,
                AllOf(HasSubstr("report of group-01 was not sent: page 1: "), HasSubstr("Wilhelmina Rutherford"),
                      HasSubstr("mail address"), HasSubstr("report of group-02 was not sent: page 1: ")));
    EXPECT_EQ(std::count(sent.error_output.begin(), sent.error_output.end(), '\n'), 2);
    EXPECT_THAT(bench.course({"history"}).output, HasSubstr("crane: copies of reports sent to reviewers: 4\n"));
    const std::string status = bench.course({"status", "--at", "2026-03-01 15:00"}).output;
    EXPECT_THAT(status,
                ::testing::ContainsRegex("group-01 .* its copy was not sent: see review send\ngroup-02 .* its copy was "
                                         "not sent: see review send\ngroup-03 [^\n:]*\ngroup-04 [^\n:]*\n"));
    EXPECT_THAT(bench.course({"review", "send", "--accept", "group-01"}).error_output, HasSubstr("--reason"));
    EXPECT_THAT(bench.course({"review", "send", "--accept", "group-77", "--reason", "x"}).error_output,
                HasSubstr("group-77"));
    const ChildResult accepted =
        bench.course({"review", "send", "--accept", "group-01", "--reason", "agreed", "--at", "2026-03-01 16:00"});
    EXPECT_THAT(accepted.output, HasSubstr("2 sent now, 4 before, 2 stopped, 0 outstanding"));
    EXPECT_THAT(accepted.error_output,
                AllOf(HasSubstr("report of group-01 was sent, although it contains names: page 1: "),
                      HasSubstr("report of group-02 was not sent: page 1: ")));
    EXPECT_THAT(bench.course({"history"}).output,
                HasSubstr("crane: the report of group-01 was sent, although it contains names; reason: agreed"));
    CourseBench::expect_done(bench.course({"export", "--json", "--out", "all.json"}));
    CourseBench::expect_done(bench.bench().dynlab({"course", "import", "all.json", "copy", "--from", "k"}));
    EXPECT_EQ(bench.bench().shell("sqlite3 copy/course.db .dump").output, bench.dump());
}

// oracle: the roster's history; the pairs
TEST(peer_review, seeks_the_groups_that_a_student_was_in_before) {
    CourseBench bench(3);
    for (const std::string first : {"lynx-77", "group-01"}) {
        bench.bench().write("names.csv",
                            "id,name,group\ns1,Ada Ek," + first + "\ns2,Bo Ost,group-02\ns3,Cy Uhl,group-03\n");
        CourseBench::expect_done(bench.course({"import", "names.csv"}));
    }
    const std::vector<std::string> texts = {"written by lynx-77", "two", "three"};
    for (int i = 1; i <= 3; ++i)
        bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf(texts[static_cast<std::size_t>(i) - 1]));
    CourseBench::expect_done(bench.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    const ChildResult sent = bench.course({"review", "send", "--at", "2026-03-01 14:00"});
    EXPECT_THAT(sent.error_output, AllOf(HasSubstr("report of group-01 was not sent: page 1: "), HasSubstr("lynx-77")));
    EXPECT_EQ(std::count(sent.error_output.begin(), sent.error_output.end(), '\n'), 1);
}

// oracle: the deadline of the reviews, with its ten minutes of grace
TEST(peer_review, releases_reviews_after_their_deadline) {
    CourseBench bench(4);
    submit_all(bench, 4);
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    const ChildResult early = bench.course({"review", "release", "--at", "2026-03-08 12:10"});
    EXPECT_EQ(early.exit_code, 1);
    EXPECT_THAT(early.error_output,
                HasSubstr("groups can submit reviews of crane until Sun 2026-03-08 12:10; wait, or give --early"));
    EXPECT_THAT(bench.course({"review", "release", "--at", "2026-03-08 12:10", "--early"}).output,
                HasSubstr("8 outstanding"));
    EXPECT_THAT(bench.course({"review", "release", "--at", "2026-03-08 12:11"}).output, HasSubstr("8 outstanding"));
}

// oracle: nothing was stopped, as the release itself says
TEST(peer_review, reviews_that_come_after_the_release_are_not_called_blocked) {
    CourseBench bench(4);
    submit_all(bench, 4);
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-01 13:00"}));
    bench.bench().write("review.pdf", small_pdf("sound work"));
    const auto collect = [&](const std::string& group, const std::string& at) {
        const std::string report =
            bench.bench()
                .shell("$DYNLAB course --course k review pairs | awk '$1 == \"" + group + "\" {print $2}' | head -1")
                .output;
        CourseBench::expect_done(bench.course({"review", "collect", "review.pdf", "--from", group, "--of",
                                               report.substr(0, report.find('\n')), "--at", at, "--no-checks"}));
    };
    collect("group-01", "2026-03-03 10:00");
    EXPECT_THAT(bench.course({"review", "release", "--at", "2026-03-09 10:00"}).output, HasSubstr("1 sent now"));
    EXPECT_THAT(bench.course({"history"}).output, HasSubstr("2026-03-09 10:00:00 UTC  crane: reviews released: 1\n"));
    collect("group-02", "2026-03-09 11:00");
    const std::string status = bench.course({"status", "--at", "2026-03-09 12:00"}).output;
    EXPECT_THAT(status, ::testing::ContainsRegex("group-02 .* a review by it is not released yet: review release"));
    EXPECT_THAT(status, ::testing::Not(HasSubstr("was not released: see")));
    bench.course({"review", "release", "--at", "2026-03-09 13:00"});
    EXPECT_THAT(bench.course({"status", "--at", "2026-03-09 14:00"}).output,
                ::testing::Not(HasSubstr("not released yet")));
}

// oracle: what was done with the student
TEST(peer_review, the_history_of_a_student_leaves_out_texts_that_contain_the_id) {
    const Workbench work;
    work.write("names.csv", "id,name,group\n2026,Ada Ek,group-01\n");
    const auto course = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"course", "--course", "c"});
        return work.dynlab(words);
    };
    CourseBench::expect_done(work.dynlab({"course", "init", "c", "--name", "Signals 2026"}));
    CourseBench::expect_done(course({"import", "names.csv"}));
    CourseBench::expect_done(course({"assignment", "talk", "--kind", "talk", "--first", "2027-03-01 12:00"}));
    CourseBench::expect_done(course({"extend", "talk", "2026", "2027-03-02 12:00", "--reason", "illness"}));
    EXPECT_THAT(course({"history"}).output, HasSubstr("course \"Signals 2026\" made"));
    EXPECT_THAT(course({"who", "2026"}).output, AllOf(HasSubstr("illness"), Not(HasSubstr("Signals 2026"))));
}

// oracle: equality of stores
TEST(peer_review, exports_and_imports_an_equal_store) {
    CourseBench bench(4, 1);
    submit_all(bench, 4);
    bench.course({"review", "assign", "--at", "2026-03-01 13:00"});
    bench.bench().write("s.csv", "reviewer,data,steps,conclusions,strength,suggestions\ngroup-01,5,4,3,4.5,2\n");
    CourseBench::expect_done(bench.course({"scores", "crane", "s.csv"}));
    EXPECT_THAT(bench.course({"scores", "crane", "s.csv"}).output, HasSubstr("0 new scores"));
    bench.bench().write("bad.csv", "reviewer,data\ngroup-02,4\ngroup-03,9\n");
    EXPECT_THAT(bench.course({"scores", "crane", "bad.csv"}).error_output,
                HasSubstr("bad.csv, line 3: data must be a number from 0 to 5, but \"9\" was given"));
    CourseBench::expect_done(
        bench.course({"mark", "crane", "group-02", "work", "80", "--reason", "=cmd|' /C calc'!A0"}));
    const std::string csv = bench.course({"export", "crane"}).output;
    EXPECT_THAT(csv, HasSubstr("s2,Student 2,,,,group-02"));
    EXPECT_THAT(csv, HasSubstr(",80,'=cmd|"));
    CourseBench::expect_done(bench.course({"export", "--json", "--out", "all.json"}));
    CourseBench::expect_done(bench.bench().dynlab({"course", "import", "all.json", "copy", "--from", "k"}));
    EXPECT_EQ(bench.bench().shell("sqlite3 copy/course.db .dump").output, bench.dump());
    EXPECT_THAT(bench.bench().dynlab({"course", "--course", "copy", "verify"}).output,
                HasSubstr("4 files, 4 versions: complete and unaltered"));
    EXPECT_THAT(bench.bench().dynlab({"course", "import", "s.csv", "other", "--from", "k"}).error_output,
                HasSubstr("is not an export of dynlab course"));
    const auto refusal = [&](const std::string& text) {
        bench.bench().write("bad.json", text);
        const ChildResult refused = bench.bench().dynlab({"course", "import", "bad.json", "bad", "--from", "k"});
        EXPECT_EQ(refused.exit_code, 1) << text;
        return refused.error_output;
    };
    EXPECT_THAT(refusal("{}"), HasSubstr("bad.json: the file is not an export of dynlab course"));
    EXPECT_THAT(refusal(R"({"dynlab course": 1, "tables": {"course": []}})"),
                HasSubstr("the table \"files\" is missing"));
    EXPECT_THAT(refusal(R"({"dynlab course": 1, "tables": {"course": [{"key": {}}], "files": []}})"),
                HasSubstr("tables[\"course\"][1][\"key\"]: expected a string"));
    EXPECT_THAT(refusal(R"({"dynlab course": 1, "tables": {"course": [{"key": "name"}], "files": []}})"),
                HasSubstr("a row has no value for \"value\""));
    EXPECT_THAT(refusal(R"({"dynlab course": 1, "tables": {"course": [], "files": []}})"),
                HasSubstr("the course's name is missing"));
}

// oracle: the story: every group that stayed writes two reviews and gets two
TEST(peer_review, runs_a_whole_course) {
    const Workbench bench;
    const ChildResult reported =
        bench.shell("DYNLAB=$DYNLAB " + std::string(DYNLAB_SOURCE_DIR) + "/scripts/course_demo story");
    EXPECT_EQ(reported.exit_code, 0) << reported.output << reported.error_output;
    EXPECT_THAT(reported.output, HasSubstr("12 groups: 11 submitted, 1 late, 1 missing."));
    EXPECT_THAT(
        reported.output,
        HasSubstr("12 groups: 11 submitted; 0 reviews outstanding; 8 final versions."));  // both late ones corrected
    EXPECT_THAT(reported.output, HasSubstr("report of group-08 was not sent: page 1: The email address"));
    EXPECT_THAT(reported.output, HasSubstr("20 sent now, 0 before, 2 stopped, 0 outstanding"));
    EXPECT_THAT(reported.output, HasSubstr("2 sent now, 20 before, 0 stopped, 0 outstanding"));
    EXPECT_THAT(reported.output, HasSubstr("21 sent now, 0 before, 0 stopped, 0 outstanding, 1 withheld"));
    EXPECT_THAT(reported.output, HasSubstr("1 sent now, 21 before, 0 stopped, 0 outstanding"));
    EXPECT_THAT(reported.output, ::testing::ContainsRegex("group-01 +1 +[1-9][0-9]* % +[0-9]+ +[0-9]+ +1 of 1 +2"));
    EXPECT_THAT(reported.output, ::testing::ContainsRegex("group-02 +1 +[1-9][0-9]* % +[0-9]+ +[0-9]+ +- +2"));
    EXPECT_THAT(reported.output, ::testing::ContainsRegex("group-04 +1 +0 % +0 +0 +- +2 +the text is unchanged"));
    EXPECT_THAT(reported.output, HasSubstr("8 of 12 groups have a final version."));
    EXPECT_EQ(bench.shell("grep -rlaE 's[0-9]{3}@|Student' story/signals/outbox").output, "");
    EXPECT_THAT(reported.output, HasSubstr("complete and unaltered"));
}

// oracle: the store's own check, after kill -9 at random moments; the repeated command completes
TEST(peer_review, survives_being_killed_at_any_moment) {
    CourseBench bench(8);
    for (int i = 1; i <= 8; ++i)
        bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("report " + std::to_string(i)));
    const ChildResult killed = bench.bench().shell(
        "set -e; killed=0; mkdir rounds; cp -r k rounds/k; begun=$(date +%s%N)\n"
        "$DYNLAB course --course rounds/k submit in --no-checks --at '2026-03-01 10:00' >/dev/null\n"
        "took=$(( ($(date +%s%N) - begun)/1000 )); rm -r rounds/k\n"  // microseconds
        "for round in $(seq 30); do\n"
        "  cp -r k rounds/k\n"
        "  $DYNLAB course --course rounds/k submit in --no-checks --at '2026-03-01 10:00' >/dev/null 2>&1 &\n"
        "  sleep $(printf 0.%06d $((took*round/30))); kill -9 $! 2>/dev/null && killed=$((killed + 1)); wait $! "
        "2>/dev/null "
        "|| true\n"
        "  $DYNLAB course --course rounds/k submit in --no-checks --at '2026-03-01 10:00' >/dev/null\n"
        "  $DYNLAB course --course rounds/k verify | grep -q '8 files, 8 versions: complete' || { echo round $round; "
        "exit 1; }\n"
        "  rm -r rounds/k\n"
        "done; echo killed $killed");
    EXPECT_EQ(killed.exit_code, 0) << killed.output << killed.error_output;
    EXPECT_THAT(killed.output, ::testing::ContainsRegex("killed [1-9][0-9]"));  // ten at least came in time
}

// oracle: both writers' versions are there; a writer that waits too long gets the reason
TEST(peer_review, keeps_two_writers_apart) {
    CourseBench bench(8);
    for (int i = 1; i <= 8; ++i)
        bench.bench().write((i % 2 == 0 ? "even/" : "odd/") + CourseBench::group(i) + ".pdf", small_pdf("r"));
    const ChildResult both = bench.bench().shell(
        "$DYNLAB course --course k submit even --at '2026-03-01 10:00' & "
        "$DYNLAB course --course k submit odd --at '2026-03-01 10:00'; a=$?; wait $!; echo $a $?");
    EXPECT_THAT(both.output, HasSubstr("\n0 0\n"));
    EXPECT_THAT(bench.course({"verify"}).output, HasSubstr("1 file, 8 versions: complete"));
    const ChildResult blocked = bench.bench().shell(
        "(echo 'BEGIN IMMEDIATE;'; echo '.shell touch begun'; sleep 20) 2>/dev/null | sqlite3 k/course.db >/dev/null "
        "2>&1 & "
        "until [ -e begun ]; do sleep 0.02; done; "
        "$DYNLAB course --course k drop group-01; code=$?; kill $!; exit $code");
    EXPECT_EQ(blocked.exit_code, 1);
    EXPECT_THAT(blocked.error_output, HasSubstr("another dynlab is writing to this course; nothing was changed"));
}

}  // namespace test_peer_review
}  // namespace dynlab::test
