// Changes to a course that bypass dynlab are reported. Oracle: the change itself, made with the program sqlite3.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"

namespace dynlab::test {
namespace test_store_seal {
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Three groups whose reports are on their way to reviewers, and a mark of the instructor's.
class store_seal : public testing::Test {
  protected:
    static const CourseBench& begun() {
        static const CourseBench bench = [] {
            const CourseBench made(3, 1);
            for (int i = 1; i <= 3; ++i)
                CourseBench::expect_done(made.submit_file(CourseBench::group(i) + ".pdf",
                                                          small_pdf("report " + std::to_string(i)), "2026-03-01 10:00",
                                                          {"--no-checks"}));
            CourseBench::expect_done(made.course({"review", "assign", "--at", "2026-03-02 10:00"}));
            CourseBench::expect_done(made.course({"review", "send", "--at", "2026-03-02 11:00"}));
            CourseBench::expect_done(made.course({"mark", "crane", "group-01", "work", "60", "--reason", "paper"}));
            return made;
        }();
        return bench;
    }
    ChildResult shell(const std::string& command) { return course_.bench().shell(command); }
    std::string errors_after(const std::string& sql) {
        CourseBench::expect_done(shell("rm -rf whole && cp -r k whole && sqlite3 k/course.db \"" + sql + "\""));
        const ChildResult reported = course_.course({"verify"});
        EXPECT_EQ(reported.exit_code, 1) << sql;
        CourseBench::expect_done(shell("rm -r k && cp -r whole k"));
        return reported.error_output;
    }

    CourseBench course_{begun()};
};

TEST_F(store_seal, an_untouched_course_is_whole) {
    const ChildResult reported = course_.course({"verify"});
    EXPECT_EQ(reported.exit_code, 0) << reported.error_output;
    // Nothing new, no seal.
    const std::string before = shell("sqlite3 k/course.db 'SELECT count(*) FROM seals'").output;
    CourseBench::expect_done(course_.course({"review", "assign", "--at", "2026-03-02 10:00"}));
    EXPECT_EQ(shell("sqlite3 k/course.db 'SELECT count(*) FROM seals'").output, before);
}

TEST_F(store_seal, what_was_taken_away_or_changed_is_reported) {
    EXPECT_THAT(errors_after("DELETE FROM sendings; DELETE FROM versions WHERE id = 3"),
                AllOf(HasSubstr("the table versions was changed by another program: it has 2 rows, but had 3"),
                      HasSubstr("is genuine, but its file is no longer in the store")));
    EXPECT_THAT(errors_after("UPDATE pairs SET author = reviewer % 3 + 1 WHERE id = 1 AND author <> reviewer % 3 + 1; "
                             "UPDATE pairs SET ended_at = 1 WHERE id = 2"),
                HasSubstr("the table pairs was changed"));
    EXPECT_THAT(errors_after("UPDATE marks SET points = 99"), HasSubstr("the table marks was changed"));
    EXPECT_THAT(errors_after("UPDATE pseudonyms SET number = number + 1000"), HasSubstr("the table pseudonyms"));
    EXPECT_THAT(errors_after("UPDATE assignments SET first_due = first_due + 9"), HasSubstr("the table assignments"));
    EXPECT_THAT(errors_after("DELETE FROM journal WHERE id = 2"), HasSubstr("the table journal"));
    EXPECT_THAT(errors_after("UPDATE memberships SET group_id = 2 WHERE student = 's1'"), HasSubstr("memberships"));
    EXPECT_THAT(errors_after("CREATE TRIGGER t AFTER INSERT ON pairs BEGIN DELETE FROM marks; END"),
                HasSubstr("(tables themselves)"));
    EXPECT_THAT(errors_after("DELETE FROM seals WHERE id = 2"), HasSubstr("or one before it is missing"));
    EXPECT_THAT(errors_after("UPDATE seals SET at = at + 1 WHERE id = 1"), HasSubstr("seal 1"));
    EXPECT_THAT(errors_after("DELETE FROM seals"), HasSubstr("no seals"));
}

TEST_F(store_seal, a_copy_that_was_swapped_for_the_original_is_not_sent) {
    CourseBench::expect_done(shell(
        "sqlite3 k/course.db \"UPDATE sendings SET hash = (SELECT hash FROM versions WHERE id = sendings.version)\" "
        "&& rm -r k/outbox/crane"));
    const ChildResult sent = course_.course({"review", "send", "--at", "2026-03-02 12:00"});
    EXPECT_EQ(sent.exit_code, 1);
    EXPECT_THAT(sent.error_output, HasSubstr("was altered after dynlab created it; no further copies were sent"));
    EXPECT_EQ(shell("find k/outbox -name '*.pdf' | wc -l").output, "0\n");
    EXPECT_THAT(course_.course({"verify"}).error_output, HasSubstr("the table sendings was changed"));
}

TEST_F(store_seal, a_course_is_its_owner_s_alone) {
    CourseBench::expect_done(course_.bench().dynlab({"course", "init", "new"}));
    EXPECT_EQ(shell("stat -c %a new new/course.db new/files").output, "700\n600\n700\n");
}

TEST_F(store_seal, an_import_is_whole_or_not_at_all) {
    CourseBench::expect_done(course_.course({"export", "--json", "-o", "all.json"}));
    shell("sed 's/\"way\": \"to reviewer\"/\"way\": \"nowhere\"/' all.json > bad.json");
    const ChildResult bad = course_.bench().dynlab({"course", "import", "bad.json", "copy", "--from", "k"});
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(bad.error_output, HasSubstr("nothing was created"));
    EXPECT_EQ(shell("ls -d copy* 2>/dev/null | wc -l").output, "0\n");
    CourseBench::expect_done(course_.bench().dynlab({"course", "import", "all.json", "copy", "--from", "k"}));
    const ChildResult whole = course_.bench().dynlab({"course", "--course", "copy", "verify"});
    EXPECT_EQ(whole.exit_code, 0) << whole.error_output;
}

}  // namespace test_store_seal
}  // namespace dynlab::test
