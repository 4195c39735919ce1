#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/review/score_sheet.h"
#include "course/store/course_schema.h"
#include "course/store/marks.h"
#include "course/store/receipts.h"
#include "course/store/store_check.h"

namespace dynlab::test {
namespace test_course_conversion {
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr std::size_t kBefore = 5;  ///< version of the tables of courses with reports and presentations only

std::vector<std::string> columns_of(Database& database, const std::string& table) {
    std::vector<std::string> columns;
    for (Rows rows = database.query("SELECT name FROM pragma_table_info(?) ORDER BY cid", table); rows.next();)
        columns.push_back(rows.text(0));
    return columns;
}

/// All rows of all tables of before, in the columns of before.
std::string content_of(Database& database, const std::map<std::string, std::vector<std::string>>& tables) {
    std::string text;
    for (const auto& [table, columns] : tables) {
        if (table == "seals") continue;
        text += table + "\n";
        for (Rows rows =
                 database.query(fmt::format("SELECT {} FROM {} ORDER BY 1, 2", fmt::join(columns, ", "), table));
             rows.next();) {
            for (std::size_t c = 0; c < columns.size(); ++c) text += rows.text(static_cast<int>(c)) + "|";
            text += "\n";
        }
    }
    return text;
}

/// Gives the course in `folder` the tables of before, with the same rows; returns what they hold.
std::map<std::string, std::vector<std::string>> make_old(const std::filesystem::path& folder) {
    std::map<std::string, std::vector<std::string>> tables;
    const std::vector<const char*>& steps = course_steps();
    {
        Database old(folder / "old.db", Database::Opening::kNew);
        migrate_course(old, Database::Opening::kNew, "old", {steps.begin(), steps.begin() + kBefore});
        for (const std::string& table : course_tables())
            if (auto columns = columns_of(old, table); !columns.empty()) tables[table] = std::move(columns);
        old.run("ATTACH ? AS now", (folder / "course.db").string());
        for (const std::string& table : course_tables()) {
            if (!tables.contains(table)) continue;
            const std::string columns = fmt::format("{}", fmt::join(tables[table], ", "));
            std::string read = columns;
            if (table == "assignments") read.replace(read.find("kind"), 4, "replace(kind, 'talk', 'presentation')");
            old.execute(fmt::format("INSERT INTO {} ({}) SELECT {} FROM now.{}", table, columns, read, table));
        }
        old.execute("DETACH now");
        old.execute("PRAGMA journal_mode = DELETE");
    }
    for (const char* rest : {"course.db-wal", "course.db-shm"}) std::filesystem::remove(folder / rest);
    std::filesystem::rename(folder / "old.db", folder / "course.db");
    return tables;
}

/// The copy of the store as it was.
std::string kept_name() {
    return fmt::format("course.db.before-version-{}", course_steps().size());
}

std::int64_t version_of(Database& database) {
    Rows rows = database.query("PRAGMA user_version");
    rows.next();
    return rows.integer(0);
}

// oracle: the rows of before, all of them, and the store's own check
TEST(course_conversion, keeps_the_full_history_and_the_old_file) {
    CourseBench bench(3, 1);
    const auto done = [&](std::vector<std::string> words) { CourseBench::expect_done(bench.course(std::move(words))); };
    done({"assignment", "slides", "--kind", "talk", "--first", "2026-04-01 12:00", "--costs", "late-day:10"});
    for (int i = 1; i <= 3; ++i) {
        const std::string file = CourseBench::group(i) + ".pdf";
        CourseBench::expect_done(
            bench.submit_file(file, small_pdf(file), "2026-02-27 12:00", {"--assignment", "crane", "--no-checks"}));
    }
    done({"review", "assign", "crane", "--at", "2026-03-02 10:00"});
    done({"extend", "crane", "group-02", "2026-03-20 12:00", "--stage", "final", "--reason", "illness"});
    done({"mark", "crane", "group-03", "work", "60", "--reason", "on paper"});
    const std::filesystem::path folder = bench.bench().path("k"), kept = folder / kept_name();
    const auto tables = make_old(folder);
    std::string before;
    {
        Database old(folder / "course.db", Database::Opening::kExisting);
        ASSERT_EQ(version_of(old), static_cast<std::int64_t>(kBefore));
        before = content_of(old, tables);
    }
    ASSERT_THAT(before, HasSubstr("|presentation|"));
    ASSERT_THAT(before, HasSubstr("illness"));
    {
        Course course(folder);
        std::string after = content_of(course.database(), tables);
        const std::size_t kind = after.find("|talk|");
        ASSERT_NE(kind, std::string::npos);
        after.replace(kind, 6, "|presentation|");
        EXPECT_EQ(after, before);
        EXPECT_THAT(check_store(course).error_list, IsEmpty());
        EXPECT_TRUE(assignment_named(course, "slides").is_talk());
        EXPECT_EQ(assignment_named(course, "slides").costs.late_day, 10);
        EXPECT_EQ(assignment_named(course, "crane").weight, 1);
    }
    {
        Database old(kept, Database::Opening::kExisting);
        EXPECT_EQ(version_of(old), static_cast<std::int64_t>(kBefore));
        EXPECT_EQ(content_of(old, tables), before);
    }
    // It is kept once: what is done later does not touch it.
    const auto written = std::filesystem::last_write_time(kept);
    done({"extend", "crane", "group-01", "2026-03-20 12:00", "--stage", "final", "--reason", "later"});
    EXPECT_EQ(std::filesystem::last_write_time(kept), written);
    done({"verify"});
}

// oracle: the rows of the former tables
TEST(course_conversion, scores_and_overrides_of_all_kinds_become_marks) {
    CourseBench bench(3, 1);
    const auto done = [&](std::vector<std::string> words) { CourseBench::expect_done(bench.course(std::move(words))); };
    done({"assignment", "slides", "--kind", "talk", "--first", "2026-04-01 12:00"});
    for (int i = 1; i <= 3; ++i)
        CourseBench::expect_done(bench.submit_file(CourseBench::group(i) + ".pdf", small_pdf(std::to_string(i)),
                                                   "2026-02-27 12:00", {"--assignment", "crane", "--no-checks"}));
    done({"review", "assign", "crane", "--at", "2026-03-02 10:00"});
    const std::filesystem::path folder = bench.bench().path("k");
    make_old(folder);
    {
        Database old(folder / "course.db", Database::Opening::kExisting);
        old.execute(
            "INSERT INTO scores VALUES (1, 0, 10, 3), (1, 0, 11, 4), (1, 2, 10, 1);"
            "INSERT INTO instructor_scores SELECT id, 2, 'first', 0, 10, 2 FROM assignments WHERE name = 'crane';"
            "INSERT INTO instructor_scores SELECT id, 2, 'final', 1, 10, 5 FROM assignments WHERE name = 'crane';"
            "INSERT INTO overrides SELECT 1, id, 3, 'work', 60, 'on paper', 12 FROM assignments WHERE name = 'crane';"
            "INSERT INTO overrides SELECT 2, id, 3, 'reviews', 70, 'kind', 12 FROM assignments WHERE name = 'crane';"
            "INSERT INTO oral_scores SELECT id, 1, 3, 10, 2.5 FROM assignments WHERE name = 'slides';"
            "INSERT INTO student_scores SELECT id, 's1', 0, 10, 4 FROM assignments WHERE name = 'slides';"
            "INSERT INTO oral_comments SELECT 1, id, 1, 's1', 'clear', 10 FROM assignments WHERE name = 'slides'");
    }
    Course course(folder);
    const auto marks_of_assignment = [&](const char* name) {
        std::vector<std::string> all;
        for (const GivenMark& mark : marks_in_force(course, assignment_named(course, name)))
            all.push_back(fmt::format("{} {} {} {} {} {}", mark.pair, mark.pair == 0 ? mark.group : 0, mark.student,
                                      mark.stage, mark.item, *mark.points));
        return all;
    };
    EXPECT_THAT(marks_of_assignment("crane"),
                UnorderedElementsAre("1 0  first data 4", "1 0  first conclusions 1", "0 2  first data 2",
                                     "0 2  final steps 5", "0 3  first * 60", "0 3  first reviews 70"));
    EXPECT_THAT(marks_of_assignment("slides"),
                UnorderedElementsAre("0 1  first answers 2.5", "0 1 s1 first content 4"));
    EXPECT_EQ(oral_comments(course, assignment_named(course, "slides")).students.at("s1"), "clear");
}

// oracle: the course that was exported, in the tables of before
TEST(course_conversion, export_of_an_earlier_version_is_imported) {
    CourseBench bench(2, 1);
    CourseBench::expect_done(bench.course({"mark", "crane", "group-01", "60", "--reason", "on paper"}));
    const std::filesystem::path folder = bench.bench().path("k");
    make_old(folder);
    const auto row = [](Database& database, const std::string& table) {
        std::string text;
        for (Rows rows = database.query("SELECT * FROM " + table); rows.next();) {
            text += text.empty() ? "{" : ", {";
            for (int c = 0; c < rows.getColumnCount(); ++c) {
                const std::string value = rows.getColumn(c).isInteger() || rows.getColumn(c).isFloat()
                                              ? rows.text(c)
                                              : "\"" + rows.text(c) + "\"";
                text += fmt::format("{}\"{}\": {}", c > 0 ? ", " : "", rows.getColumnName(c),
                                    rows.isColumnNull(c) ? "null" : value);
            }
            text += "}";
        }
        return fmt::format("\"{}\": [{}]", table, text);
    };
    std::vector<std::string> tables;
    {
        Database old(folder / "course.db", Database::Opening::kExisting);
        old.execute("INSERT INTO overrides SELECT 1, id, 1, 'work', 60, 'on paper', 12 FROM assignments");
        for (const char* table :
             {"course", "groups", "students", "memberships", "assignments", "criteria", "files", "overrides"})
            tables.push_back(row(old, table));
    }
    bench.bench().write("old.json", fmt::format("{{\"dynlab course\": 1, \"tables version\": {}, \"tables\": {{{}}}}}",
                                                kBefore, fmt::join(tables, ", ")));
    CourseBench::expect_done(bench.bench().dynlab({"course", "import", "old.json", "copy", "--from", "k"}));
    EXPECT_THAT(bench.bench().dynlab({"course", "--course", "copy", "marks", "crane"}).output,
                HasSubstr("60.0 (yours)"));
    EXPECT_THAT(bench.bench().dynlab({"course", "--course", "copy", "verify"}).output, HasSubstr("complete"));
}

// oracle: other users must not read the names in a copy of the store
TEST(course_conversion, old_file_is_its_owners_alone) {
    CourseBench bench(2, 1);
    const std::filesystem::path folder = bench.bench().path("k");
    make_old(folder);
    Course course(folder);
    EXPECT_EQ(std::filesystem::status(folder / kept_name()).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

}  // namespace test_course_conversion
}  // namespace dynlab::test
