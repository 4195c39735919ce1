#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/store/database.h"
#include "course/store/receipts.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/temporary_folder.h"
#include "support/other_file_system.h"

namespace dynlab::test {
namespace test_course_store {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// oracle: RFC 4231, test cases 1, 2 and 6
TEST(course_store, signs_as_the_standard_says) {
    EXPECT_EQ(hmac_sha256(std::string(20, '\x0b'), {"Hi There"}),
              "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
    EXPECT_EQ(hmac_sha256("Jefe", {"what do ya want ", "for nothing?"}),
              "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
    EXPECT_EQ(hmac_sha256(std::string(131, '\xaa'), {"Test Using Larger Than Block-Size Key - Hash Key First"}),
              "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

// oracle: definition; every letter counts
TEST(course_store, knows_genuine_receipts) {
    const Receipt receipt{"c", "crane", "group-01", "first", "report", "a\nb.pdf", std::string(64, 'a'),
                          1,   10,      0,          5,       6};
    const SigningKey key = SigningKey::derived("secret", "test"), other = SigningKey::derived("other", "test");
    const std::string text = signed_receipt(receipt, key);
    const auto genuine = [](const std::string& reported, const SigningKey& by) {
        return verify_receipt(reported, by.public_key()).genuine;
    };
    EXPECT_TRUE(genuine(text, key));
    EXPECT_FALSE(genuine(text, other));
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') continue;
        std::string altered = text;
        altered[i] ^= 1;
        EXPECT_FALSE(genuine(altered, key)) << i;
    }
    EXPECT_FALSE(genuine(text + "late: no\n", key));
    EXPECT_FALSE(genuine("late: no\n" + text, key));
    EXPECT_FALSE(genuine(text + text, key));
    EXPECT_FALSE(genuine(text.substr(0, text.find("signature")), key));
    EXPECT_FALSE(genuine("", key));
    std::string other_ends;
    for (const char c : text) other_ends += c == '\n' ? std::string("\r\n\r\n") : std::string(1, c);
    EXPECT_TRUE(genuine(other_ends, key));
}

// oracle: the store's own check, and the receipt's signature; a link leads to another file system
TEST(course_store, writes_receipts_and_outgoing_files_to_another_file_system) {
    const OtherFileSystem other;
    if (!other.is_there()) GTEST_SKIP() << "no second file system";
    CourseBench bench(2);
    for (const char* folder : {"receipts", "outbox"}) {
        std::filesystem::remove_all(bench.bench().path("k") / folder);
        std::filesystem::create_directory(other.path() / folder);
        std::filesystem::create_directory_symlink(other.path() / folder, bench.bench().path("k") / folder);
    }
    const auto files_in = [](const std::filesystem::path& folder) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.is_regular_file()) files.push_back(entry.path());
        return files;
    };
    for (int i = 0; i < 2; ++i) {  // the second time there is nothing to do
        CourseBench::expect_done(bench.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00"));
        const std::vector<std::filesystem::path> receipts = files_in(other.path());
        ASSERT_EQ(receipts.size(), 1u);
        EXPECT_THAT(bench.course({"verify", receipts[0].string()}).output, HasSubstr("genuine"));
    }
    EXPECT_THAT(bench.course({"verify"}).output, HasSubstr("complete and unaltered"));
    Course(bench.bench().path("k")).write({{bench.bench().path("k") / "outbox/report.pdf", "copy"}});
    EXPECT_EQ(read_file(other.path() / "outbox/report.pdf"), "copy");
    EXPECT_EQ(files_in(other.path()).size(), 2u);
    EXPECT_EQ(files_in(bench.bench().path("k") / "files").size(), 1u);
}

// oracle: calendars: Paris leaves summer time at 2026-10-25 03:00, and enters it at 2026-03-29 02:00
TEST(course_store, reads_times_in_the_zone) {
    const CourseClock paris("Europe/Paris");
    EXPECT_EQ(utc_text(paris.parse("2026-02-28 13:00", "t")), "2026-02-28T12:00:00Z");
    EXPECT_EQ(utc_text(paris.parse("2026-07-01T13:00", "t")), "2026-07-01T11:00:00Z");
    EXPECT_EQ(utc_text(paris.parse("2026-07-01 13:00Z", "t")), "2026-07-01T13:00:00Z");
    EXPECT_EQ(paris.show_exactly(paris.parse("2026-07-01 13:00:07", "t")), "2026-07-01 13:00:07 CEST");
    for (const char* wrong :
         {"2026-02-30 12:00", "2026-03-29 02:30", "2026-10-25 02:30", "tomorrow", "2026-03-01", "", "12:00 2026-03-01"})
        EXPECT_THROW(paris.parse(wrong, "t"), InvalidArgument) << wrong;
    EXPECT_EQ(utc_text(paris.parse("2026-10-25T00:30:00Z", "t")), "2026-10-25T00:30:00Z");
    EXPECT_THROW(CourseClock("Europe/Atlantis"), InvalidArgument);
    EXPECT_THROW(CourseClock("../../etc/passwd"), InvalidArgument);
    EXPECT_EQ(duration_text(*duration_of("90 min")), "1 h 30 min");
    EXPECT_EQ(duration_of("1 week"), std::nullopt);
}

// oracle: the rules of deadlines and versions
TEST(course_store, keeps_versions_and_reports_lateness) {
    const CourseBench bench(3);
    EXPECT_THAT(bench.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 12:10").output,
                HasSubstr("v1       on time"));
    EXPECT_THAT(bench.submit_file("group-01.pdf", small_pdf("one"), "2026-03-02 12:10").output,
                HasSubstr("already received"));
    EXPECT_THAT(bench.submit_file("group-01.pdf", small_pdf("two"), "2026-03-01 12:10:01").output,
                HasSubstr("v2       late by 10 min 1 s"));
    EXPECT_THAT(bench.submit_file("Student 2.pdf", "%PDF-1.4\nnothing", "2026-03-01 10:00").output,
                AllOf(HasSubstr("group-02"), HasSubstr("damaged: ask the group for a readable file")));
    const std::string status = bench.course({"status", "crane", "--at", "2026-03-01 14:00"}).output;
    EXPECT_THAT(status, HasSubstr("v2 (v1 on time)"));
    EXPECT_THAT(status, HasSubstr("v1 damaged"));
    EXPECT_THAT(status, HasSubstr("ask for the first version, or drop"));
    EXPECT_THAT(status, HasSubstr("3 groups: 2 submitted, 1 unreadable, 1 missing."));
}

// oracle: the store before; each kind of bad input
TEST(course_store, refuses_bad_input_and_stays_untouched) {
    CourseBench bench(3);
    bench.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00");
    const std::string before = bench.dump();
    const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
        const ChildResult result = bench.course(words);
        EXPECT_EQ(result.exit_code, 1) << words[0];
        EXPECT_THAT(result.error_output, HasSubstr(message));
        EXPECT_EQ(bench.dump(), before) << message;
    };
    bench.bench().write("columns.csv", "number,name\n1,Ada\n");
    refused({"import", "columns.csv"}, "the column \"id\" is missing; the columns are number, name");
    bench.bench().write("twice.csv", "id,name\ns8,Ada\ns9,Bo\ns8,Eve\n");
    refused({"import", "twice.csv"}, "twice.csv, line 4: the id \"s8\" occurs twice");
    bench.bench().write("empty.csv", "id,name\n");
    refused({"import", "empty.csv"}, "the file has no students");
    refused({"submit", "nowhere.pdf"}, "file or folder not found: 'nowhere.pdf'");
    bench.bench().write("gruop-02.pdf", small_pdf("x"));
    refused({"submit", "gruop-02.pdf"},
            "no group or student of the course is named \"gruop-02\" (the closest is group-02)");
    refused({"submit", "gruop-02.pdf", "--from", "group-9"}, "the group \"group-9\" does not exist");
    refused({"submit", "gruop-02.pdf", "--assignment", "crame"}, "Did you mean crane?");
    refused({"assignment", "b", "--first", "2026-03-09 12:00", "--review", "2026-03-08 12:00", "--final",
             "2026-03-15 12:00"},
            "the deadline of the reviews (Sun 2026-03-08 12:00) must be after the deadline of the first version");
    refused({"assignment", "b", "--first", "2026-03-09"}, "--first must be a time such as");
    refused({"assignment", "../b", "--first", "2026-03-09 12:00"},
            "must consist of at most 60 letters, digits, hyphens");
    refused({"assignment", "talk", "--kind", "talk", "--first", "2026-03-09 12:00", "--final", "2026-03-12 12:00"},
            "a talk has one deadline");
    refused({"assignment", "crane", "--first", "2026-02-01 12:00", "--review", "2026-03-08 12:00", "--final",
             "2026-03-15 12:00"},
            "you can only postpone deadlines and increase");
    refused({"drop", "group-77"}, "the group \"group-77\" does not exist");
    for (const char* group : {"../../up", "a/b", "..", "in\ntwo", ".hidden", "\u202Eback", "CON", "com1.txt", "trail.",
                              "moodle.zip", "Mail.csv", "lab\uFEFF", "\u3164"}) {
        bench.bench().write("odd.csv", fmt::format("id,name,group\ns77,Zoe,\"{}\"\n", group));
        refused({"import", "odd.csv"}, "cannot ");
    }
}

// oracle: the columns that are there
TEST(course_store, a_roster_changes_what_it_has_columns_for) {
    CourseBench bench(2);
    const auto import = [&](const std::string& csv, std::vector<std::string> more = {}) {
        bench.bench().write("more.csv", csv);
        std::vector<std::string> words = {"import", "more.csv"};
        words.insert(words.end(), more.begin(), more.end());
        return bench.course(words);
    };
    const auto rows = [&](const char* sql) {
        return bench.bench().shell(std::string("sqlite3 k/course.db '") + sql + "'").output;
    };
    CourseBench::expect_done(
        import("id,name,group,email,moodle,canvas\ns1,Ada King,group-01,ada@a.example,11,21\ns2,Bo "
               "Ek,group-02,bo@a.example,,\n"));
    CourseBench::expect_done(import("id,group\ns1,group-02\ns2,group-02\n"));
    const ChildResult graded = import("id,group,seed,language\ns1,group-02,7,fr\ns2,group-02,7,en\n");
    CourseBench::expect_done(graded);
    EXPECT_THAT(graded.error_output, Not(HasSubstr("unknown")));  // dynlab grade reads them
    EXPECT_THAT(graded.error_output, HasSubstr("2 ids with fewer than 3 letters and digits are not searched for in "
                                               "documents; an example is s1"));
    EXPECT_EQ(rows("SELECT id, name, mail, moodle, canvas FROM students"),
              "s1|Ada King|ada@a.example|11|21\ns2|Bo Ek|bo@a.example||\n");
    CourseBench::expect_done(import("id,group,mail\ns1,group-02,king@a.example\n"));
    EXPECT_EQ(rows("SELECT id, name, mail, moodle, canvas FROM students"),
              "s1|Ada King|king@a.example|11|21\ns2|Bo Ek|bo@a.example||\n");
    EXPECT_EQ(rows("SELECT student, name, mail FROM former_names"),
              "s1|Ada King|ada@a.example\ns1|Student 1|\ns2|Student 2|\n");

    // A group column of another name.
    const std::string before = bench.dump();
    const ChildResult refused = import("id,name,grp,email\ns1,Ada King,1,\ns3,Cy Ost,2,\n");
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(
        refused.error_output,
        AllOf(HasSubstr("the column \"group\" is missing; the file has the columns id, name, grp, email. dynlab "
                        "recognizes \"id\", \"name\", \"group\", \"email\" (or \"mail\"), \"moodle\" and \"canvas\""),
              HasSubstr("--no-groups")));
    EXPECT_EQ(bench.dump(), before);
    const ChildResult alone = import("id,name,grp\ns1,Ada King,1\ns3,Cy Ost,2\n", {"--no-groups"});
    CourseBench::expect_done(alone);
    EXPECT_THAT(alone.error_output, HasSubstr("unknown columns were ignored: grp"));
    EXPECT_EQ(
        rows("SELECT m.student, g.name FROM memberships m JOIN groups g ON g.id = m.group_id WHERE until IS NULL"),
        "s1|group-02\ns2|group-02\ns3|s3\n");
}

// oracle: the groups of the mistaken roster have no members and no submissions
TEST(course_store, groups_of_a_mistaken_roster_do_not_count) {
    CourseBench bench(2);
    bench.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00");
    bench.bench().write("wrong.csv", "id,group\ns1,wrong-1\ns2,wrong-2\n");
    CourseBench::expect_done(bench.course({"import", "wrong.csv"}));
    EXPECT_THAT(bench.course({"status"}).output, AllOf(HasSubstr("3 groups"), HasSubstr("group-01")));  // has work
    CourseBench::expect_done(bench.course({"import", "roster.csv"}));
    const std::string status = bench.course({"status"}).output;
    EXPECT_THAT(status, AllOf(HasSubstr("k: 2 groups\n"), HasSubstr("group-02"), Not(HasSubstr("wrong"))));
    EXPECT_THAT(bench.course({"review", "assign", "--at", "2026-03-02 10:00"}).error_output, Not(HasSubstr("map")));
}

// oracle: what each platform documents of its export, and the zip's own names
TEST(course_store, takes_a_platform_s_zip_and_leaves_out_what_leads_outside) {
    CourseBench bench(4);
    bench.bench().write("one.pdf", small_pdf("one"));
    bench.bench().write("two.pdf", small_pdf("two"));
    bench.bench().write("notes.txt", "notes");
    const ChildResult made = bench.bench().shell(
        "python3 - <<'END'\nimport zipfile\n"
        "z = zipfile.ZipFile('class.zip', 'w')\n"
        "z.write('one.pdf', 'Student 1_4711_assignsubmission_file_/my report.pdf')\n"
        "z.write('two.pdf', 'elsenobody_LATE_42_77_report.pdf')\n"
        "z.write('two.pdf', 'group-03_final2.pdf')\n"
        "z.write('notes.txt', 'group-04/notes.txt')\n"
        "z.write('one.pdf', '../../escaped.pdf')\n"
        "z.write('one.pdf', '/tmp/escaped.pdf')\n"
        "z.close()\nEND");
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    const ChildResult taken =
        bench.course({"submit", "class.zip", "--at", "2026-03-01 10:00", "--isolation", CourseBench::level()});
    EXPECT_EQ(taken.exit_code, 1);
    EXPECT_THAT(taken.output,
                AllOf(HasSubstr("3 files accepted, 0 late"), HasSubstr("group-01"), HasSubstr("group-03")));
    EXPECT_THAT(taken.error_output, AllOf(HasSubstr("\"../../escaped.pdf\" points outside"),
                                          HasSubstr("named \"elsenobody\""), Not(HasSubstr("notes.txt"))));
    EXPECT_FALSE(std::filesystem::exists(bench.bench().path("escaped.pdf")));
    EXPECT_FALSE(std::filesystem::exists("/tmp/escaped.pdf"));
    // Rejected files are kept, too: one of an unknown student, and two that point outside, of which only the names are
    // kept.
    EXPECT_THAT(bench.course({"verify"}).output, HasSubstr("4 files, 6 versions: complete and unaltered"));
}

// oracle: the versions of the tables
TEST(course_store, refuses_other_versions_of_the_store) {
    CourseBench bench(2);
    bench.bench().shell("sqlite3 k/course.db 'PRAGMA user_version = 99'");
    const ChildResult newer = bench.course({"status"});
    EXPECT_EQ(newer.exit_code, 1);
    EXPECT_THAT(newer.error_output,
                HasSubstr("a newer version of dynlab created this course (its tables have version 99"));
    bench.bench().shell("mkdir x && sqlite3 x/course.db 'CREATE TABLE other (a)'");
    EXPECT_THAT(
        bench.bench().dynlab({"course", "--course", "x", "status"}).error_output,
        HasSubstr("x/course.db: the file is not the database of a course; create a course with dynlab course init"));
    bench.bench().shell("mkdir y && echo 'no database at all, but long enough to be read' > y/course.db");
    EXPECT_THAT(bench.bench().dynlab({"course", "--course", "y", "status"}).error_output, HasSubstr("not a database"));
    EXPECT_THAT(bench.bench().dynlab({"course", "init", "k"}).error_output, HasSubstr("install the newer version"));
    EXPECT_THAT(bench.bench().dynlab({"course", "status"}).error_output, HasSubstr("no course was found in"));
}

// oracle: what SQL says of each query alone
TEST(course_store, queries_of_the_same_words_know_nothing_of_each_other) {
    const TemporaryFolder folder;
    Database db(folder.path() / "any.db", Database::Opening::kNew);
    db.execute("CREATE TABLE t (a PRIMARY KEY); INSERT INTO t VALUES (1), (2), (3)");
    constexpr const char* kBoth = "SELECT ?1, ?2";
    {
        Rows both = db.query(kBoth, 5, 6);
        ASSERT_TRUE(both.next());
        EXPECT_EQ(both.integer(0) + both.integer(1), 11);
    }
    Rows first_only = db.query(kBoth, 7);
    ASSERT_TRUE(first_only.next());
    EXPECT_EQ(first_only.integer(0), 7);
    EXPECT_FALSE(first_only.optional_integer(1)) << "the value of before";
    EXPECT_FALSE(first_only.next());

    constexpr const char* kAll = "SELECT a FROM t ORDER BY a";
    std::vector<std::int64_t> pairs;
    for (Rows outer = db.query(kAll); outer.next();)
        for (Rows inner = db.query(kAll); inner.next();) pairs.push_back(10 * outer.integer(0) + inner.integer(0));
    EXPECT_THAT(pairs, ::testing::ElementsAre(11, 12, 13, 21, 22, 23, 31, 32, 33));

    constexpr const char* kAdd = "INSERT INTO t VALUES (?)";
    EXPECT_THROW(db.run(kAdd, 3), EnvironmentError);
    db.run(kAdd, 4);
    {
        Rows left_at_the_first = db.query(kAll);
        ASSERT_TRUE(left_at_the_first.next());
    }
    EXPECT_NO_THROW(db.execute("DROP TABLE t")) << "held by a query that nobody asks any more";
}

}  // namespace test_course_store
}  // namespace dynlab::test
