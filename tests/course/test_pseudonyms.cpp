// What a group can learn of who reviews whom from what it sees: its own number, those of the reports that it reviews,
// those of its reviewers. Real random numbers; the bounds have a false alarm in fewer than 10^-9 of all runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "course/course_bench.h"
#include "course/review/allocation.h"
#include "course/review/peer_review.h"
#include "support/equal_frequencies.h"

namespace dynlab::test {
namespace test_pseudonyms {
using ::testing::HasSubstr;
using ::testing::Not;

/// Every group has a report.
void submit_all(CourseBench& bench, int groups) {
    for (int i = 1; i <= groups; ++i)
        bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("report " + std::to_string(i)));
    CourseBench::expect_done(bench.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
}

/// Numbers by role and group, and pairs.
struct Secrets {
    std::map<std::pair<std::string, std::int64_t>, std::int64_t> numbers;
    std::set<std::pair<std::int64_t, std::int64_t>> pairs;
};
Secrets secrets_of(Course& course) {
    Secrets all;
    for (Rows rows = course.database().query("SELECT role, group_id, number FROM pseudonyms"); rows.next();)
        all.numbers[{rows.text(0), rows.integer(1)}] = rows.integer(2);
    for (Rows rows = course.database().query("SELECT reviewer, author FROM pairs"); rows.next();)
        all.pairs.emplace(rows.integer(0), rows.integer(1));
    return all;
}

// oracle: chance. The second course is a copy of the first one, with its key, names, order and times; whatever pairs
// could be computed from would give the same pairs. Of 2 n numbers of 99 or 3 n, 12 agree (of 24: 8), or four fifths of
// the pairs, with a probability below 10^-10.
TEST(pseudonyms, a_copy_of_a_course_draws_other_numbers_and_pairs) {
    for (const int groups : {12, 30, 60}) {
        CourseBench bench(groups);
        submit_all(bench, groups);
        bench.bench().shell("cp -r k twin");
        const std::filesystem::path folder = bench.bench().path();
        std::vector<Secrets> drawn;
        for (const char* name : {"k", "twin"}) {
            Course course(folder / name);
            assign_reviews(course, assignment_named(course, "crane"), course.clock().parse("2026-03-02 10:00", "t"),
                           false);
            drawn.push_back(secrets_of(course));
        }
        const auto total = static_cast<std::size_t>(2 * groups);
        ASSERT_EQ(drawn[0].numbers.size(), total);
        ASSERT_EQ(drawn[0].pairs.size(), total);
        std::size_t numbers = 0, pairs = 0;
        for (const auto& [whose, number] : drawn[0].numbers) numbers += drawn[1].numbers.at(whose) == number;
        for (const auto& pair : drawn[0].pairs) pairs += drawn[1].pairs.contains(pair);
        EXPECT_LT(numbers, groups == 12 ? 8u : 12u) << groups;
        EXPECT_LT(5 * pairs, 4 * total) << groups;
    }
}

// oracle: the uniform distribution over all sets of two authors, whichever the reviewer
TEST(pseudonyms, any_two_reports_are_as_likely_for_a_reviewer) {
    constexpr int kGroups = 12, kDraws = 20'000;
    const AllocationProblem problem{kGroups, 2, std::vector<bool>(kGroups, true), {}, {}, {}};
    std::vector<std::map<std::set<int>, int>> counts(2);
    for (int i = 0; i < kDraws; ++i) {
        std::vector<std::set<int>> read(kGroups);
        for (const auto& [reviewer, author] : allocate_reviews(problem, secure_below).pairs)
            read[static_cast<std::size_t>(reviewer)].insert(author);
        ++counts[0][read[0]], ++counts[1][read[kGroups - 1]];
    }
    for (const auto& kinds : counts) {
        std::vector<int> all;
        for (const auto& [authors, count] : kinds) all.push_back(count);
        ASSERT_EQ(all.size(), 55u);  // of 11 groups
        expect_equal_frequencies(all);
    }
}

// oracle: the uniform distribution; a group's own number says nothing of another group's, or of its number as a
// reviewer
TEST(pseudonyms, numbers_are_equally_frequent_and_independent) {
    CourseBench bench(12);
    submit_all(bench, 12);
    Course course(bench.bench().path() / "k");
    Database& db = course.database();
    db.execute("PRAGMA synchronous = OFF");
    const Assignment crane = assignment_named(course, "crane");
    const auto third = [](std::int64_t number) { return static_cast<std::size_t>((number - 1) / 33); };
    std::vector<int> own(9), roles(9), neighbors(9);
    for (int i = 0; i < 1000; ++i) {
        db.execute(
            "DELETE FROM pairs; DELETE FROM allocations; DELETE FROM pseudonyms; DELETE FROM journal; DELETE FROM "
            "seals");
        assign_reviews(course, crane, course.clock().parse("2026-03-02 10:00", "t"), false);
        const Secrets drawn = secrets_of(course);
        const auto number = [&](const char* role, std::int64_t group) { return drawn.numbers.at({role, group}); };
        ++own[static_cast<std::size_t>((number("author", 5) - 1) / 11)];
        ++roles[3 * third(number("author", 5)) + third(number("reviewer", 5))];
        ++neighbors[3 * third(number("author", 1)) + third(number("reviewer", 2))];
    }
    for (const auto* counts : {&own, &roles, &neighbors}) expect_equal_frequencies(*counts);
}

// oracle: the words and the tables themselves
TEST(pseudonyms, no_seed_is_stored_printed_or_accepted) {
    CourseBench bench(3, 1);
    submit_all(bench, 3);
    std::string reported;
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"review", "assign", "--at", "2026-03-02 10:00"},
                                               {"review", "send", "--at", "2026-03-02 11:00"},
                                               {"review", "pairs"},
                                               {"status"},
                                               {"history"},
                                               {"assignment", "--help"},
                                               {"export", "--json"}}) {
        const ChildResult result = bench.course(words);
        reported += result.output + result.error_output;
    }
    reported += bench.dump() + bench.bench().shell("cat k/receipts/*/*").output;
    EXPECT_THAT(reported, HasSubstr("3 groups, 3 reviews: 3 new"));
    EXPECT_THAT(reported, Not(HasSubstr("seed")));
    EXPECT_EQ(
        bench.course({"assignment", "next", "--kind", "talk", "--first", "2026-04-01 12:00", "--seed", "7"}).exit_code,
        2);
}

// oracle: the pairs as the earlier version stored and showed them
TEST(pseudonyms, of_a_store_with_a_seed_stay_as_they_were_drawn) {
    CourseBench bench(6);
    submit_all(bench, 6);
    CourseBench::expect_done(bench.course({"review", "assign", "--at", "2026-03-02 10:00"}));
    const std::string before = bench.course({"review", "pairs"}).output;
    CourseBench::expect_done(bench.bench().shell(
        "for table in assignments allocations; do\n"
        "sqlite3 k/course.db \"ALTER TABLE $table ADD COLUMN seed INTEGER NOT NULL DEFAULT 4711\"; done\n"
        "sqlite3 k/course.db 'DROP TABLE marks; DROP TABLE results; DROP TABLE stops; " +
        std::string(CourseBench::kTablesOfScores) + CourseBench::kTablesOfOralMarks +
        "ALTER TABLE "
        "students DROP "
        "COLUMN "
        "own_data; ALTER TABLE students DROP COLUMN language; PRAGMA user_version = 4'"));
    EXPECT_EQ(bench.course({"review", "pairs"}).output, before);
    EXPECT_THAT(bench.dump(), Not(HasSubstr("seed")));
    EXPECT_THAT(bench.course({"review", "assign", "--at", "2026-03-02 11:00"}).output, HasSubstr("0 new, 0 withdrawn"));
    EXPECT_EQ(bench.course({"review", "pairs"}).output, before);
    EXPECT_EQ(bench.course({"verify"}).exit_code, 0);
}

}  // namespace test_pseudonyms
}  // namespace dynlab::test
