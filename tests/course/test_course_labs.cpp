#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "course/course_bench.h"
#include "course/office/course_totals.h"
#include "course/office/deadline_import.h"
#include "course/office/who.h"
#include "course/store/marks.h"
#include "course/store/refusals.h"
#include "numerics/error.h"

namespace dynlab::test {
namespace test_course_labs {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A course of three groups of one student each with a lab, due at noon on 1 March 2026, that costs 10 percent a day,
/// 25 at most.
class LabCourse {
  public:
    explicit LabCourse(const std::string& keep = "best") : course_(bench_.bench().path("k")) {
        Assignment lab;
        lab.name = "lab4", lab.kind = "lab", lab.lesson = "04", lab.keep = keep, lab.weight = 3;
        lab.first_due = at("2026-03-01 12:00");
        lab.costs = costs_of("late-day:10,late-most:25");
        add_assignment(course_, lab);
    }
    Course& course() { return course_; }
    Instant at(const std::string& time) const { return course_.clock().parse(time, "time"); }
    Assignment lab() { return assignment_named(course_, "lab4"); }
    std::int64_t group(int i) { return group_named(course_, CourseBench::group(i)).id; }

    /// A script of a group as it is in the store; returns the version's id.
    std::int64_t submit(int i, const std::string& time, int number = 1) {
        const std::string hash = course_.keep(CourseBench::group(i) + time);
        Transaction transaction(course_.database());
        course_.record_file(hash, 1, at(time));
        course_.database().run(
            "INSERT INTO versions (assignment, group_id, stage, part, number, hash, name, received_at, due_at, late, "
            "findings, signature) VALUES (?, ?, 'first', 'script', ?, ?, 'analysis.lua', ?, ?, 0, '', '')",
            lab().id, group(i), std::int64_t{number}, hash, at(time), lab().first_due);
        const std::int64_t id = course_.database().getLastInsertRowid();
        transaction.commit();
        return id;
    }
    /// Of checks x and y with 4 and 6 points.
    void grade(std::int64_t version, double x, double y, bool y_graded = true) {
        Transaction transaction(course_.database());
        record_result(course_, {version, {{"x", 4, x, true}, {"y", 6, y, y_graded}}, "f"}, at("2026-03-02 12:00"));
        transaction.commit();
    }
    bool mark(const GivenMark& mark) {
        Transaction transaction(course_.database());
        const bool fresh = give_mark(course_, lab(), mark, at("2026-03-03 12:00"));
        transaction.commit();
        return fresh;
    }
    std::optional<double> earned(int i) {
        for (const LabMark& mark : lab_marks(course_, lab()))
            if (mark.group == group(i)) return mark.earned;
        return {};
    }

  private:
    CourseBench bench_{3};
    Course course_;
};

// oracle: 10 percent of the points for each day or part of a day, 25 at most
TEST(course_labs, late_submissions_lose_points_up_to_the_maximum) {
    LabCourse course;
    course.grade(course.submit(1, "2026-03-01 12:00"), 4, 6);
    course.grade(course.submit(2, "2026-03-01 12:01"), 4, 6);
    course.grade(course.submit(3, "2026-03-20 12:00"), 4, 6);
    EXPECT_EQ(course.earned(1), 10);
    EXPECT_EQ(course.earned(2), 9);
    EXPECT_EQ(course.earned(3), 7.5);
    for (const auto& [late, percent] : {std::pair(0, 0.0), {1, 10.0}, {86400, 10.0}, {86401, 20.0}, {259200, 25.0}})
        EXPECT_EQ(late_percent(course.lab().costs, late), percent) << late;
}

// oracle: the setting of the assignment
TEST(course_labs, best_or_newest_version_counts) {
    for (const auto& [keep, points] : {std::pair("best", 9.0), {"newest", 3.0}}) {
        LabCourse course(keep);
        course.grade(course.submit(1, "2026-02-01 12:00"), 4, 5);
        course.grade(course.submit(1, "2026-02-02 12:00", 2), 1, 2);
        EXPECT_EQ(course.earned(1), points) << keep;
    }
}

// oracle: the marks that were given, the newest of which are in force
TEST(course_labs, marks_by_hand_replace_points_and_can_be_taken_back) {
    LabCourse course;
    course.grade(course.submit(1, "2026-02-01 12:00"), 4, 0, false);
    EXPECT_EQ(course.earned(1), std::nullopt) << "y needs a mark";
    const std::int64_t group = course.group(1);
    EXPECT_TRUE(course.mark({group, "", "y", 5, "good"}));
    EXPECT_FALSE(course.mark({group, "", "y", 5, "good"}));
    EXPECT_EQ(course.earned(1), 9);
    course.mark({group, "", "*", 2, "copied"});
    EXPECT_EQ(course.earned(1), 2);
    course.mark({group, "", "*", {}, "not copied"});
    EXPECT_EQ(course.earned(1), 9);
    EXPECT_EQ(marks_ever_given(course.course(), course.lab()).size(), 3u);
    EXPECT_EQ(marks_in_force(course.course(), course.lab()).size(), 1u);
    course.mark({group, "s1", "*", 10, "did it alone"});
    EXPECT_EQ(course.earned(1), 9) << "of the group";
    EXPECT_EQ(lab_marks(course.course(), course.lab(), "s1").front().earned, 10);
    // A work that only its author could show has no version.
    course.mark({course.group(3), "", "*", 5, "shown at the desk"});
    EXPECT_EQ(course.earned(3), 5);
}

// oracle: the weighted mean by hand; what is missing after its deadline counts 0, what is open does not count
TEST(course_labs, total_weighs_the_assignments) {
    LabCourse course;
    course.grade(course.submit(1, "2026-02-01 12:00"), 4, 4);
    course.submit(2, "2026-02-01 12:00");
    const auto marks = marks_of_students(course.course(), course.lab(), course.at("2026-03-05 12:00"));
    EXPECT_EQ(marks.at("s1").percent, 80);
    EXPECT_TRUE(marks.at("s2").open);
    EXPECT_EQ(marks.at("s2").percent, std::nullopt);
    EXPECT_TRUE(marks.at("s3").missing);
    EXPECT_EQ(marks.at("s3").percent, 0);
    EXPECT_FALSE(marks_of_students(course.course(), course.lab(), course.at("2026-02-05 12:00")).at("s3").missing);
    const std::vector<Assignment> all = {course.lab(), assignment_named(course.course(), "crane")};
    EXPECT_EQ(weighted_total(all, {{80, false, false}, {40, false, false}}), 70);  // (3 * 80 + 1 * 40) / 4
    EXPECT_EQ(weighted_total(all, {{80, false, false}, {{}, false, true}}), 80);
    EXPECT_EQ(weighted_total(all, {{{}, false, true}, {{}, false, true}}), std::nullopt);
    const std::string csv = totals_csv(course.course(), course.at("2026-02-20 12:00"));
    EXPECT_THAT(csv, AllOf(HasSubstr("lab4 percent (weight 3)"), HasSubstr("total percent"),
                           HasSubstr("s1,Student 1,,,,group-01,"), HasSubstr(",80,,\r\n"), HasSubstr(",,,lab4\r\n")));
}

// oracle: what the store knows of the student
TEST(course_labs, who_tells_all_of_a_student_by_any_name) {
    LabCourse course;
    course.grade(course.submit(1, "2026-03-01 13:00"), 4, 6);
    course.mark({course.group(1), "", "x", 1, "see me"});
    {
        Transaction transaction(course.course().database());
        record_refused(course.course(), course.lab(),
                       {course.group(1), "first", "lab4.rar", "", "cannot be opened", course.at("2026-02-28 12:00")});
        transaction.commit();
    }
    const Instant now = course.at("2026-03-05 12:00");
    for (const char* name : {"Student 1", "s1", "Group 1"})
        EXPECT_THAT(who_text(course.course(), name, now),
                    AllOf(HasSubstr("Student 1 (s1)"), HasSubstr("first script v1"), HasSubstr("late by 1 h"),
                          HasSubstr("not taken: lab4.rar"), HasSubstr("mark of Student 1: 63 percent"),
                          HasSubstr("group-01 has 1 points for x; reason: see me")))
            << name;
    EXPECT_THAT(who_text(course.course(), "s2", now), Not(HasSubstr("see me")));
    EXPECT_THROW(who_text(course.course(), "Mallory", now), InvalidArgument);
}

// oracle: the rows of the table; the same table again changes nothing
TEST(course_labs, table_of_deadlines_becomes_extensions_and_times_of_receipt) {
    LabCourse course;
    course.grade(course.submit(1, "2026-03-02 11:00"), 4, 6);
    course.grade(course.submit(2, "2026-03-02 11:00"), 4, 6);
    course.grade(course.submit(3, "2026-03-02 11:00"), 4, 6);
    const TemporaryFolder folder;
    const auto file = folder.path() / "deadlines.csv";
    write_file_atomically(file,
                          "submission,deadline,extra,received,percent_per_day\n*,2026-03-01 10:00,,,20\n"
                          "Student 2,,2 d,,\ngroup 3,,,2026-03-01 09:00,\ngroup-9,2026-03-05 12:00,,,\n");
    const Instant now = course.at("2026-03-04 12:00");
    const DeadlineImport done = import_deadlines(course.course(), course.lab(), file, now);
    EXPECT_EQ(done.extended, 1);
    EXPECT_EQ(done.corrected, 1);
    ASSERT_EQ(done.complaints.size(), 1u);
    EXPECT_THAT(message_text(done.complaints.front()), HasSubstr("the row of \"group-9\": there is no group"));
    EXPECT_EQ(course.lab().costs.late_day, 20);
    EXPECT_EQ(course.earned(1), 6);  // two days begun
    EXPECT_EQ(course.earned(2), 10);
    EXPECT_EQ(course.earned(3), 10);
    const DeadlineImport again = import_deadlines(course.course(), course.lab(), file, now);
    EXPECT_EQ(again.extended + again.corrected, 0);
}

// oracle: the file that came and was not taken
TEST(course_labs, refused_files_are_open_until_something_is_taken) {
    LabCourse course;
    const RefusedFile file{course.group(2), "first", "lab4.rar", "", "cannot be opened", course.at("2026-02-28 12:00")};
    for (int i = 0; i < 2; ++i) {
        Transaction transaction(course.course().database());
        record_refused(course.course(), course.lab(), file);
        transaction.commit();
    }
    EXPECT_EQ(refused_files(course.course(), course.lab(), true).size(), 1u);
    course.submit(2, "2026-02-28 13:00");
    EXPECT_EQ(refused_files(course.course(), course.lab(), true).size(), 0u);
    EXPECT_EQ(refused_files(course.course(), course.lab()).size(), 1u);
}

// oracle: what came from somebody unknown was taken when the instructor said whose it is
TEST(course_labs, refused_file_that_is_taken_later_is_not_open) {
    LabCourse course;
    const std::string time = "2026-02-28 13:00";
    const std::string hash = course.course().keep(CourseBench::group(2) + time);  // what submit() gives
    course.course().settle({hash});
    {
        Transaction transaction(course.course().database());
        record_refused(course.course(), course.lab(), {{}, "first", "x.lua", hash, "of nobody", course.at(time)});
        transaction.commit();
    }
    EXPECT_EQ(refused_files(course.course(), course.lab(), true).size(), 1u);
    course.submit(2, time);
    EXPECT_EQ(refused_files(course.course(), course.lab(), true).size(), 0u);
}

}  // namespace test_course_labs
}  // namespace dynlab::test
