// What a course is like after the machine failed a command at any place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/store/course_schema.h"
#include "platform/error.h"
#include "platform/files/replacement_file.h"
#include "platform/files/temporary_file.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_course_faults {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

// Runs $1 in a copy of the course k, with the machine failing it as $2 says (kill, full) at the first change of a file
// and each $5th behind it (at every one with DYNLAB_EVERY_PLACE=1) until it comes to its end; each time $3 is asked
// whether all is well, the command is repeated without failure, and $4 is asked. `course` is dynlab course for the
// copy. In the end no temporary file or folder is left. Threads are left out: one core, so that the order of the
// changes is the same each time.
constexpr const char* kTryAll = R"(
course() { taskset -c 0 $DYNLAB course --course try "$@"; }
command=$1 fault=$2 between=$3 after=$4
export TMPDIR=$PWD/temporary
for place in $(seq 1 ${DYNLAB_EVERY_PLACE:-$5} 400); do
  rm -rf try temporary; cp -r k try; mkdir temporary; rm -f count
  taskset -c 0 env FAULT="$fault $place" FAULT_COUNT=$PWD/count LD_PRELOAD=$FAULTS \
    $DYNLAB course --course try $command >said 2>&1; code=$?
  [ -e count ] && [ $(cat count) -lt $place ] && { echo "failed at $(cat count) places"; exit 0; }
  eval "$between" || { echo "place $place, code $code, at once"; cat said; exit 1; }
  course $command >said2 2>&1 || { echo "place $place, repeated"; cat said said2; exit 1; }
  eval "$after" || { echo "place $place, after all"; cat said said2; exit 1; }
  left=$(find try temporary -name ".*" -o -name "dynlab-*")
  [ -z "$left" ] || { echo "place $place, left behind: $left"; exit 1; }
done
echo "no end"; exit 1
)";

class course_faults : public ::testing::Test {
  protected:
    course_faults() : bench_(4, 1) {
        for (int i = 1; i <= 4; ++i)
            bench_.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("report " + std::to_string(i)));
        bench_.bench().write("try_all", kTryAll);
        bench_.bench().write("receive", "receive in --no-checks --at 2026-03-01T10:00");
        bench_.bench().write("assign", "review assign --at 2026-03-02T10:00");
    }
    ChildResult try_all(const std::string& command, const std::string& fault, const std::string& between,
                        const std::string& after, int step = 3) {
        return bench_.bench().shell("FAULTS=" DYNLAB_FAULTS " DYNLAB=$DYNLAB-course bash try_all \"$(cat " + command +
                                    ")\" " + fault + " '" + between + "' '" + after + "' " + std::to_string(step));
    }
    void receive_all() {
        CourseBench::expect_done(bench_.course({"submit", "in", "--no-checks", "--at", "2026-03-01 10:00"}));
    }

    CourseBench bench_;
};

constexpr const char* kAllThere =
    "course verify | grep -q \"4 files, 4 versions: complete\" && "
    "[ $(ls try/receipts/crane | wc -l) = 4 ]";
// Whatever the store speaks of is there and unaltered.
constexpr const char* kSound =
    "course verify >verified 2>&1 && grep -q \"complete and unaltered\" verified && "
    "[ \"$(sqlite3 try/course.db \"PRAGMA integrity_check\")\" = ok ]";

// oracle: the store's own check and SQLite's, after a kill before every single change of a file
TEST_F(course_faults, a_kill_anywhere_while_receiving_loses_nothing) {
    const ChildResult tried = try_all("receive", "kill", kSound, kAllThere);
    EXPECT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
    EXPECT_THAT(tried.output, ContainsRegex("failed at [5-9][0-9] places|failed at [1-9][0-9][0-9] places"));
}

// After a kill there are no pairs, or all of them, which a repetition leaves as they are.
constexpr const char* kNoneOrAll =
    " && course review pairs >pairs && [ $(grep -c allotted pairs) = 0 -o $(grep -c allotted pairs) = 4 ]";
constexpr const char* kAllAsBefore =
    "course review pairs >after && [ $(grep -c allotted after) = 4 ] && "
    "{ ! grep -q allotted pairs || cmp -s pairs after; }";

// oracle: counting; the pairs themselves are drawn again where the kill came before they were stored
TEST_F(course_faults, a_kill_anywhere_while_allotting_loses_nothing) {
    receive_all();
    const ChildResult tried = try_all("assign", "kill", std::string(kSound) + kNoneOrAll, kAllAsBefore);
    EXPECT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
    EXPECT_THAT(tried.output, ContainsRegex("failed at [1-9][0-9]* places"));
}

// oracle: what the same commands write where nothing disturbs them
TEST_F(course_faults, a_kill_anywhere_in_other_commands_loses_nothing) {
    receive_all();
    bench_.bench().write("more.csv", "id,name,group\ns1,Student One,group-02\ns9,Student 9,group-09\n");
    const std::vector<std::pair<std::string, std::string>> commands = {
        {"import more.csv", "SELECT id, name FROM students; SELECT student, group_id, until IS NULL FROM memberships"},
        {"assignment add second --first 2026-04-01T12:00 --review 2026-04-08T12:00 --final 2026-04-15T12:00",
         "SELECT name, first_due FROM assignments; SELECT * FROM criteria"},
        {"override crane group-02 work 80 --reason late", "SELECT DISTINCT group_id, item, points, reason FROM marks"}};
    for (const auto& [command, query] : commands) {
        bench_.bench().write("command", command);
        bench_.bench().shell("rm -rf calm && cp -r k calm && $DYNLAB course --course calm " + command +
                             " && sqlite3 calm/course.db '" + query + "' >expected");
        const ChildResult tried =
            try_all("command", "kill", kSound, "sqlite3 try/course.db \"" + query + "\" | cmp -s - expected");
        EXPECT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
        EXPECT_THAT(tried.output, ContainsRegex("failed at [1-9][0-9] places")) << command;
    }
}

// Whether both anonymized copies went the way $1, once each, and are in the outbox folder $2 as stored.
constexpr const char* kAllSent = R"sh(
ask() { sqlite3 try/course.db "SELECT $1 FROM sendings WHERE way = '$way' $2"; }
way=$1
[ "$(ask 'count(*), count(DISTINCT pair)')" = '2|2' ] || exit 1
find "try/outbox/crane/$2" -name '*.pdf' -exec sha256sum {} + | cut -c1-64 | sort >outbox
ask hash 'ORDER BY hash' | cmp -s - outbox
)sh";

// oracle: the store's list of sent copies, and the hashes of the files in the outbox
TEST_F(course_faults, a_kill_anywhere_while_sending_copies_loses_none) {
    if (obstacle_to(Isolation::kFull)) GTEST_SKIP() << "no bubblewrap here";
    CourseBench::expect_done(
        bench_.course({"submit", "in/group-01.pdf", "in/group-02.pdf", "--no-checks", "--at", "2026-03-01 10:00"}));
    CourseBench::expect_done(bench_.course({"review", "assign", "--at", "2026-03-02 10:00"}));
    bench_.bench().write("all_sent", kAllSent);
    const auto try_sending = [&](const std::string& command, const std::string& way, const std::string& folder) {
        bench_.bench().write("command", command);
        const ChildResult tried =
            try_all("command", "kill", kSound, "bash all_sent \"" + way + "\" \"" + folder + "\"", 10);
        EXPECT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
        EXPECT_THAT(tried.output, ContainsRegex("failed at [1-9][0-9] places")) << command;
        CourseBench::expect_done(bench_.bench().shell("$DYNLAB course --course k " + command));
    };
    try_sending("review send --at 2026-03-02T11:00", "to reviewer", "to-review");
    bench_.bench().write("review.pdf", small_pdf("The data are good."));
    CourseBench::expect_done(bench_.bench().shell(
        "set -e; $DYNLAB course --course k review pairs | awk '$NF == \"sent\" {print $1, $2}' | while read -r group "
        "report; do\n"
        "$DYNLAB course --course k review collect review.pdf --from $group --of $report --no-checks "
        "--at 2026-03-04T10:00; done"));
    try_sending("release --at 2026-03-09T11:00", "to author", "reviews");
}

// oracle: the store before, or all of it once the transaction is done; the sentence
TEST_F(course_faults, a_full_disk_changes_nothing_and_is_named) {
    bench_.bench().shell("sqlite3 k/course.db .dump >before");
    const char* const all_or_nothing =
        "[ $code = 0 ] || { grep -qi \"no space left\" said && { sqlite3 try/course.db .dump | cmp -s - before || "
        "[ $(sqlite3 try/course.db \"SELECT count(*) FROM versions\") = 4 ]; }; }";
    const ChildResult tried = try_all("receive", "full", all_or_nothing, kAllThere);
    EXPECT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
    EXPECT_THAT(tried.output, ContainsRegex("failed at [2-9][0-9] places|failed at [1-9][0-9][0-9] places"));
}

// oracle: the lock that a process holds ends with it; the file of a process that lives stays
TEST_F(course_faults, leftovers_of_killed_runs_are_removed_and_reported) {
    std::filesystem::create_directories(bench_.bench().path() / "k/files");
    ReplacementFile in_use(bench_.bench().path() / "k/files/in_use");  // which also removes what lies there
    const ChildResult killed = bench_.bench().shell(
        "for place in $(seq 400); do\n"
        "  env FAULT=\"kill $place\" FAULT_COUNT=$PWD/count LD_PRELOAD=" DYNLAB_FAULTS
        " $DYNLAB-course course --course k receive in --no-checks --at 2026-03-01T10:00 >/dev/null 2>&1 && break\n"
        "  ls -A k/files | grep dynlab- | grep -qv in_use && exit 0\n"
        "done; exit 1");
    ASSERT_EQ(killed.exit_code, 0) << "no kill left a file";
    const std::string other = "k/files/.0123.dynlab-" + machine_in_names() + "x-1-0";  // of another machine
    bench_.bench().write(other, "half");
    bench_.bench().write("k/receipts/.00001-group-01-first-report.txt.4711-0", "of an earlier, interrupted dynlab");
    const ChildResult reported = bench_.course({"verify"});
    EXPECT_EQ(reported.exit_code, 0) << reported.error_output;
    EXPECT_THAT(reported.output,
                ContainsRegex("removed [^\n]*/k/files/\\.[0-9a-f]+\\.dynlab-[^\n]*, left by an interrupted run\n"));
    EXPECT_THAT(reported.output,
                HasSubstr("report.txt.4711-0 is a temporary file of an earlier, interrupted run of dynlab"));
    EXPECT_THAT(bench_.course({"verify"}).output, ::testing::Not(HasSubstr("removed")));
    EXPECT_TRUE(std::filesystem::exists(bench_.bench().path() / other));
    in_use.append("whole");
    in_use.commit();
    EXPECT_EQ(bench_.bench().read("k/files/in_use"), "whole");
}

// oracle: the store before; no user, not even root, can write into a folder that is mounted read-only
TEST_F(course_faults, a_folder_that_may_not_be_written_to_is_named) {
    if (obstacle_to(Isolation::kFull)) GTEST_SKIP() << "no bubblewrap here";
    receive_all();
    const std::string before = bench_.dump();
    bench_.bench().shell("mkdir more && cp in/group-01.pdf more/group-02.pdf");
    for (const char* command :
         {"receive more --no-checks --at 2026-03-01T11:00", "drop group-01", "review assign --at 2026-03-02T10:00"}) {
        const ChildResult refused = bench_.bench().shell(
            std::string("bwrap --dev-bind / / --ro-bind $PWD/k $PWD/k $DYNLAB course --course $PWD/k ") + command);
        EXPECT_EQ(refused.exit_code, 1) << command;
        EXPECT_THAT(refused.error_output, ::testing::AnyOf(HasSubstr("write permission"), HasSubstr("are writable"),
                                                           HasSubstr("Read-only file system")))
            << command;
        EXPECT_EQ(bench_.dump(), before) << command;
    }
    // What only reads is as ever.
    for (const std::string command : {"status --at 2026-03-02T10:00", "verify", "history", "who group-01"}) {
        const std::string call = "$DYNLAB course --course $PWD/k " + command;
        const ChildResult read = bench_.bench().shell("bwrap --dev-bind / / --ro-bind $PWD/k $PWD/k " + call);
        EXPECT_EQ(read.exit_code, 0) << command << ": " << read.error_output;
        EXPECT_EQ(read.output, bench_.bench().shell(call).output) << command;
        EXPECT_NE(read.output, "") << command;
    }
}

// oracle: the shell's limit; the file that reaches it is named
TEST_F(course_faults, a_limit_of_file_sizes_is_an_error_that_names_the_file) {
    bench_.bench().write("big.pdf", small_pdf("big") + std::string(3 << 20, ' '));
    const ChildResult refused = bench_.bench().shell(
        "ulimit -f 2000; $DYNLAB course --course k submit big.pdf --from group-01 --at '2026-02-27 12:00' --no-checks");
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, AllOf(HasSubstr("cannot write"), HasSubstr("k/files")));
}

// oracle: the tables' own contents before and after each step
TEST(course_migration, goes_step_by_step_or_not_at_all) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "course.db";
    {
        Database database(file, Database::Opening::kNew);
        migrate_course(database, Database::Opening::kNew, "k");
        database.run("INSERT INTO course VALUES ('name', 'Signals')");
    }
    std::vector<const char*> steps = course_steps();
    const auto version = [&] {
        Database database(file, Database::Opening::kExisting);
        Rows rows = database.query("PRAGMA user_version");
        rows.next();
        return rows.integer(0);
    };
    const auto migrate = [&] {
        Database database(file, Database::Opening::kExisting);
        migrate_course(database, Database::Opening::kExisting, "k", steps);
    };
    const auto known = static_cast<std::int64_t>(steps.size());
    EXPECT_EQ(version(), known);
    steps.push_back("ALTER TABLE course ADD COLUMN since INTEGER; UPDATE course SET since = 7;");
    steps.push_back("CREATE TABLE half (a); INSERT INTO nowhere VALUES (1);");
    EXPECT_THROW(migrate(), EnvironmentError);
    EXPECT_EQ(version(), known);  // the sound step before the broken one was taken back too
    {
        Database database(file, Database::Opening::kExisting);
        EXPECT_FALSE(database.query("SELECT 1 FROM sqlite_master WHERE name = 'half'").next());
        EXPECT_THROW(database.query("SELECT since FROM course"), EnvironmentError);
    }
    steps.back() = "CREATE TABLE whole (a);";
    migrate();
    EXPECT_EQ(version(), known + 2);
    Database database(file, Database::Opening::kExisting);
    Rows rows = database.query("SELECT value, since FROM course");
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(rows.text(0), "Signals");
    EXPECT_EQ(rows.integer(1), 7);
    EXPECT_THROW(migrate_course(database, Database::Opening::kExisting, "k"), EnvironmentError);  // made by a newer one
    migrate();
    EXPECT_EQ(version(), known + 2);
}

// oracle: the fourth version's rows; who opens the store finds no seed that they could be computed from
TEST(course_migration, of_a_fourth_version_keeps_pairs_and_pseudonyms_without_the_seed) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "course.db";
    Database database(file, Database::Opening::kNew);
    const std::vector<const char*>& steps = course_steps();
    migrate_course(database, Database::Opening::kNew, "k", {steps.begin(), steps.begin() + 4});
    for (const int id : {1, 2}) database.run("INSERT INTO groups VALUES (?, ?, 0, NULL, NULL)", id, std::to_string(id));
    database.run(
        "INSERT INTO assignments (id, name, kind, lesson, first_due, grace, reviews, seed, made_at) VALUES "
        "(1, 'a', 'report', '', 100, 10, 1, 4711, 5)");
    database.run("INSERT INTO allocations VALUES (1, 1, 4711, 6, 'why')");
    database.run("INSERT INTO pairs (id, allocation, assignment, reviewer, author) VALUES (1, 1, 1, 2, 1)");
    database.run("INSERT INTO pseudonyms VALUES (1, 1, 'author', 17), (1, 2, 'reviewer', 64)");
    migrate_course(database, Database::Opening::kExisting, "k");
    const auto reported = [&](const std::string& query) {
        Rows rows = database.query(query);
        return rows.next() ? rows.text(0) : std::string();
    };
    EXPECT_EQ(reported("SELECT allocation || ' ' || reviewer || ' ' || author FROM pairs"), "1 2 1");
    EXPECT_EQ(reported("SELECT group_concat(number) FROM pseudonyms"), "17,64");
    EXPECT_EQ(reported("SELECT name || ' ' || reviews || ' ' || made_at FROM assignments"), "a 1 5");
    EXPECT_EQ(reported("SELECT made_at || ' ' || explanation FROM allocations"), "6 why");
    for (const char* table : {"assignments", "allocations"})
        EXPECT_THROW(database.query(std::string("SELECT seed FROM ") + table), EnvironmentError) << table;
    EXPECT_FALSE(database.query("PRAGMA foreign_key_check").next());
}

// oracle: the first version's tables and their content
TEST(course_migration, of_a_first_version_keeps_its_students) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "course.db";
    Database database(file, Database::Opening::kNew);
    migrate_course(database, Database::Opening::kNew, "k", {course_steps().front()});
    EXPECT_THROW(database.query("SELECT * FROM former_names"), EnvironmentError);
    database.run("INSERT INTO students VALUES ('s1', 'Ada King', '', '', '')");
    migrate_course(database, Database::Opening::kExisting, "k");
    database.run("INSERT INTO former_names VALUES ('s1', 'Ada Byron', '', 7)");
    EXPECT_THROW(database.run("INSERT INTO former_names VALUES ('s2', 'Bo Ek', '', 7)"), EnvironmentError);
    Rows rows = database.query("SELECT name FROM students");
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(rows.text(0), "Ada King");
}

// oracle: what came in time, came again or came late, by hand
TEST(course_migration, of_a_third_version_keeps_the_valid_versions) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "course.db";
    Database database(file, Database::Opening::kNew);
    const std::vector<const char*>& steps = course_steps();
    migrate_course(database, Database::Opening::kNew, "k", {steps.begin(), steps.begin() + 3});
    database.run("INSERT INTO groups VALUES (1, 'g1', 0, NULL, NULL)");
    database.run(
        "INSERT INTO assignments (id, name, kind, lesson, first_due, grace, reviews, seed, made_at) VALUES "
        "(1, 'a', 'report', '', 100, 10, 0, 0, 0)");
    for (const char* hash : {"x", "y", "z"}) database.run("INSERT INTO files VALUES (?, 1, 0)", hash);
    const auto version = [&](std::int64_t number, const char* hash, std::int64_t at) {
        database.run(
            "INSERT INTO versions (assignment, group_id, stage, part, number, hash, name, received_at, "
            "due_at, late, findings, signature) VALUES (1, 1, 'first', 'report', ?, ?, '', ?, 100, 0, '', '')",
            number, hash, at);
    };
    version(1, "x", 90), version(2, "y", 105), version(3, "y", 130), version(4, "x", 140), version(5, "z", 150);
    const auto late = [&] {
        std::vector<std::int64_t> all;
        for (Rows rows = database.query("SELECT late FROM standing ORDER BY number"); rows.next();)
            all.push_back(rows.integer(0));
        return all;
    };
    migrate_course(database, Database::Opening::kExisting, "k");
    EXPECT_EQ(late(), (std::vector<std::int64_t>{0, 0, 0, 0, 50}));
}

}  // namespace test_course_faults
}  // namespace dynlab::test
