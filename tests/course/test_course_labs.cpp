#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "base/reader.h"
#include "course/corrections/corrections.h"
#include "course/course_bench.h"
#include "course/export/reminders.h"
#include "course/office/course_totals.h"
#include "course/office/course_work.h"
#include "course/office/deadline_import.h"
#include "course/office/receive.h"
#include "course/office/recognized_file.h"
#include "course/office/who.h"
#include "course/store/inspection.h"
#include "course/store/marks.h"
#include "course/store/newest_versions.h"
#include "course/store/store_check.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"

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
        set_assignment(course_, lab);
    }
    Course& course() { return course_; }
    Instant at(const std::string& time) const { return course_.clock().parse(time, "time"); }
    Assignment lab() { return assignment_named(course_, "lab4"); }
    std::int64_t group(int i) { return group_named(course_, CourseBench::group(i)).id; }

    /// A script of a group as it is in the store; returns the version's id.
    std::int64_t submit(int i, const std::string& time, int number = 1, const std::string& part = "script") {
        const std::string hash = course_.keep(CourseBench::group(i) + time);
        Transaction transaction(course_.database());
        course_.register_file(hash, 1, at(time));
        course_.database().run(
            "INSERT INTO versions (assignment, group_id, stage, part, number, hash, name, received_at, due_at, late, "
            "findings, signature) VALUES (?, ?, 'first', ?, ?, ?, 'analysis.lua', ?, ?, 0, '', '')",
            lab().id, group(i), part, std::int64_t{number}, hash, at(time), lab().first_due);
        const std::int64_t id = course_.database().getLastInsertRowid();
        transaction.commit();
        return id;
    }
    /// Files by their names as they come in together.
    ReceiveOutcome take(const std::vector<std::pair<std::string, std::string>>& files, const std::string& time,
                        const std::string& from = "") {
        ReceiveRequest request;
        std::set<std::string> given;
        for (const auto& [name, content] : files) {
            bench_.bench().write(name, content);
            if (given.insert(name.substr(0, name.find('/'))).second)
                request.files.push_back(bench_.bench().path(name.substr(0, name.find('/'))));
        }
        request.assignment = "lab4", request.at = at(time), request.from = from, request.checks = false;
        return receive(course_, request);
    }
    /// A folder of a group with nothing but a link in it.
    void take_link(int i, const std::string& time) {
        const auto folder = bench_.bench().path(CourseBench::group(i));
        std::filesystem::create_directories(folder);
        std::filesystem::create_symlink("/etc/passwd", folder / "analysis.lua");
        ReceiveRequest request;
        request.files = {folder};  // called after its sender
        request.assignment = "lab4", request.at = at(time), request.checks = false;
        receive(course_, request);
    }
    /// Of checks x and y with 4 and 6 points.
    void grade(std::int64_t version, double x, double y, bool y_graded = true) {
        Transaction transaction(course_.database());
        save_result(course_, {version, {{"x", 4, x, true}, {"y", 6, y, y_graded}}, "f"}, at("2026-03-02 12:00"));
        transaction.commit();
    }
    bool mark(const GivenMark& mark) {
        Transaction transaction(course_.database());
        const bool fresh = give_mark(course_, lab(), mark, at("2026-03-03 12:00"));
        transaction.commit();
        return fresh;
    }
    /// The student belongs to another group from then on.
    void move(const std::string& student, int to) {
        Transaction transaction(course_.database());
        course_.database().run("UPDATE memberships SET since = ?, until = ? WHERE student = ?", at("2026-01-01 12:00"),
                               at("2026-02-10 12:00"), student);
        course_.database().run("INSERT INTO memberships VALUES (?, ?, ?, NULL)", student, group(to),
                               at("2026-02-10 12:00"));
        transaction.commit();
    }
    void withdraw(std::int64_t version) {
        Transaction transaction(course_.database());
        course_.database().run("INSERT INTO withdrawals (version, withdrawn, reason, made_at) VALUES (?, 1, '', ?)",
                               version, at("2026-02-11 12:00"));
        transaction.commit();
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
    EXPECT_EQ(marks_in_force(course.course(), course.lab()).size(), 1u);
    course.mark({group, "s1", "*", 10, "did it alone"});
    EXPECT_EQ(course.earned(1), 9) << "of the group";
    EXPECT_EQ(lab_marks(course.course(), course.lab(), "s1").front().earned, 10);
    // What cannot be read was given no points, which says nothing of the checks.
    const std::int64_t unreadable = course.submit(2, "2026-02-01 12:00");
    Transaction transaction(course.course().database());
    save_result(course.course(), {unreadable, {}, "f"}, course.at("2026-03-02 13:00"));
    transaction.commit();
    EXPECT_EQ(max_points_of(course.course(), course.lab(), "*"), 10);
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
    const std::string csv = totals_csv(course_totals(course.course(), course.at("2026-02-20 12:00")));
    EXPECT_THAT(csv, AllOf(HasSubstr("lab4 percent (weight 3)"), HasSubstr("total percent"),
                           HasSubstr("s1,Student 1,,,,group-01,"), HasSubstr(",80,,\r\n"), HasSubstr(",,,lab4\r\n")));
}

// oracle: the group of a student at its submission; work that was taken back is nobody else's work
TEST(course_labs, withdrawn_work_does_not_give_a_student_the_marks_of_a_later_group) {
    LabCourse course;
    course.grade(course.submit(2, "2026-02-01 12:00"), 4, 6);
    const std::int64_t own = course.submit(1, "2026-02-01 12:00");
    course.grade(own, 1, 1);
    course.move("s1", 2);
    const auto percent = [&] {
        return marks_of_students(course.course(), course.lab(), course.at("2026-03-05 12:00")).at("s1").percent;
    };
    EXPECT_EQ(percent(), 20);  // 2 of 10 points
    course.withdraw(own);
    EXPECT_EQ(percent(), 0) << "nothing was submitted by the group that the student was in";
}

// oracle: what the message says; the folder's name is taken by a file
TEST(course_labs, receipts_that_cannot_be_written_are_written_by_the_next_call) {
    LabCourse course;
    const auto place = course.course().folder() / "receipts";
    std::filesystem::remove_all(place);
    write_file_atomically(place, "");
    std::string said;
    try {
        course.take({{"group-01.lua", "-- work\n"}}, "2026-02-01 12:00");
    } catch (const std::exception& error) {
        said = message_text(message_of(error));
    }
    EXPECT_THAT(said, AllOf(HasSubstr("the files are stored, but the receipts were not written"),
                            HasSubstr("Run the command again")));
    std::filesystem::remove(place);
    const ReceiveOutcome again = course.take({{"group-01.lua", "-- work\n"}}, "2026-02-01 12:00");
    ASSERT_EQ(again.received.size(), 1u);
    EXPECT_TRUE(again.received.front().known);
    EXPECT_FALSE(std::filesystem::is_empty(place / "lab4"));
}

// oracle: what the store knows of the student
TEST(course_labs, who_reports_all_of_a_student_by_any_name) {
    LabCourse course;
    course.grade(course.submit(1, "2026-03-01 13:00"), 4, 6);
    course.mark({course.group(1), "", "x", 1, "see me"});
    course.take({{"group-01.rar", "Rar!\x1A\x07"}}, "2026-02-28 12:00");
    const Instant now = course.at("2026-03-05 12:00");
    for (const char* name : {"Student 1", "s1", "Group 1"})
        EXPECT_THAT(
            who_text(course.course(), name, now),
            AllOf(HasSubstr("Student 1 (s1)"), HasSubstr("first script v1"), HasSubstr("late by 1 h"),
                  HasSubstr("group-01.rar: The file is a RAR archive"), HasSubstr("mark of Student 1: 63 percent"),
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
    EXPECT_THAT(message_text(done.complaints.front()),
                HasSubstr("the row of \"group-9\": the group \"group-9\" does not exist"));
    EXPECT_EQ(course.lab().costs.late_day, 20);
    EXPECT_EQ(course.earned(1), 6);  // two days begun
    EXPECT_EQ(course.earned(2), 10);
    EXPECT_EQ(course.earned(3), 10);
    const DeadlineImport again = import_deadlines(course.course(), course.lab(), file, now);
    EXPECT_EQ(again.extended + again.corrected, 0);
}

// oracle: the file that came, and what was taken later
TEST(course_labs, file_of_unknown_sender_is_named_until_it_is_taken) {
    LabCourse course;
    const auto not_taken = [&] { return files_not_taken(course.course(), course.lab()).size(); };
    for (int i = 0; i < 2; ++i)
        course.take({{"Mallory.lua", "print(1)"}, {"group-01.lua", "print(2)"}}, "2026-02-28 12:00");
    EXPECT_EQ(not_taken(), 1u);
    course.take({{"Mallory.lua", "print(1)"}}, "2026-02-28 13:00", "group-02");
    EXPECT_EQ(not_taken(), 0u);
}

// oracle: the files that came: each one is in the store with its name, taken or not
TEST(course_labs, every_file_of_a_folder_leaves_a_trace) {
    LabCourse course;
    course.take({{"in/group-01/analysis.lua", "print(1)"},
                 {"in/group-01/notes.txt", "notes"},
                 {"in/group-01/report.pdf", small_pdf("report")},
                 {"in/group-01/empty.csv", ""},
                 {"in/stranger/analysis.lua", "print(2)"}},
                "2026-02-28 12:00");
    std::set<std::string> traces;
    for (Rows rows = course.course().database().query("SELECT part, name FROM versions"); rows.next();)
        traces.insert(rows.text(0) + " " + rows.text(1));
    EXPECT_THAT(traces, ::testing::UnorderedElementsAre("pack group-01.zip", "unreadable analysis.lua"));
    Rows pack = course.course().database().query("SELECT hash FROM versions WHERE part = 'pack'");
    ASSERT_TRUE(pack.next());
    const TemporaryFolder folder;
    unpack_submission(course.course().file(pack.text(0)), folder.path() / "p", Isolation::kProcess, DYNLAB_PROGRAM);
    for (const char* name : {"analysis.lua", "notes.txt", "report.pdf", "empty.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "p" / name)) << name;
    const SubmittedParts parts = newest_versions(course.course(), course.lab())[course.group(1)]["first"];
    EXPECT_EQ(parts.size(), 1u) << "what lies beside the script needs nobody";
    EXPECT_TRUE(check_store(course.course()).error_list.empty());
}

// oracle: the files that came: each is a version, in the order of their times; the same files again add none
TEST(course_labs, scripts_of_both_partners_are_versions) {
    LabCourse course;
    for (const bool known : {false, true}) {
        const ReceiveOutcome taken =
            course.take({{"in/group-01.lua", "print(1)"}, {"in/Student 1.lua", "print(2)"}}, "2026-02-28 12:00");
        EXPECT_TRUE(taken.refused.empty());
        ASSERT_EQ(taken.received.size(), 2u);
        for (const Received& one : taken.received) {
            EXPECT_EQ(one.part, "script");
            EXPECT_EQ(one.known, known) << one.version;
        }
        EXPECT_NE(taken.received[0].version, taken.received[1].version);
    }
}

// oracle: the names that dynlab grade takes as analysis.lua (test_unusual_submissions.cpp)
TEST(course_labs, script_under_a_changed_name_is_taken) {
    LabCourse course;
    for (const char* name : {"Analysis.lua", "analysis.lua.txt", "my%20analysis.lua", "analysis (1).LUA"}) {
        const ReceiveOutcome taken = course.take(
            {{name + std::string(" in/group-01/") + name, std::string("print('") + name + "')"}}, "2026-02-28 12:00");
        ASSERT_EQ(taken.received.size(), 1u) << name;
        EXPECT_EQ(taken.received[0].part, "script") << name;
    }
}

// oracle: the first bytes of the file; what can be read replaces it
TEST(course_labs, unreadable_file_is_graded_as_unreadable_until_another_comes) {
    LabCourse course;
    course.take({{"in/group-01/lab4.zip", "Rar!\x1A\x07"}}, "2026-02-28 12:00");
    const CourseWork before(course.course(), course.lab());
    ASSERT_EQ(before.work().items.size(), 1u);
    EXPECT_EQ(before.work().items[0].submission.name, "group-01 unreadable");
    EXPECT_EQ(before.work().items[0].students.size(), 1u);
    EXPECT_THAT(message_text(before.work().items[0].unreadable), HasSubstr("RAR archive"));
    const auto reminders = reminders_of(course.course(), course.lab(), course.at("2026-03-02 12:00"), false);
    ASSERT_EQ(reminders.size(), 3u);
    EXPECT_THAT(message_text(reminders[0].missing.at(0)), HasSubstr("cannot be read"));
    EXPECT_THAT(message_text(reminders[1].missing.at(0)), Not(HasSubstr("cannot be read")));
    course.take({{"again/group-01/analysis.lua", "print(1)"}}, "2026-02-28 13:00");
    const CourseWork after(course.course(), course.lab());
    ASSERT_EQ(after.work().items.size(), 1u);
    EXPECT_EQ(after.work().items[0].submission.name, "group-01");
    EXPECT_EQ(after.work().items[0].unreadable, Message());
    // A link is unreadable where its sender gave nothing else.
    EXPECT_EQ(newest_versions(course.course(), course.lab())[course.group(2)]["first"].size(), 0u);
    course.take_link(2, "2026-02-28 12:00");
    EXPECT_EQ(newest_versions(course.course(), course.lab())[course.group(2)]["first"].at(kUnreadable).error_reason,
              "other-kind");
}

// oracle: the roster: both students of group 1 are called Petit, and each of two groups has a Moser
TEST(course_labs, surname_of_one_group_s_members_is_enough) {
    CourseBench bench(3);
    bench.bench().write("roster.csv",
                        "id,name,group\np1,Luc Petit,group-01\np2,Lea Petit,group-01\nm1,Hans Moser,group-02\nm2,Julia "
                        "Moser,group-03\n");
    CourseBench::expect_done(bench.course({"import", "roster.csv"}));
    const ChildResult taken = bench.submit_file("Petit.pdf", small_pdf("one"), "2026-03-01 10:00", {"--no-checks"});
    CourseBench::expect_done(taken);
    EXPECT_THAT(taken.output, HasSubstr("group-01"));
    const ChildResult asked = bench.submit_file("Moser.pdf", small_pdf("two"), "2026-03-01 10:00", {"--no-checks"});
    EXPECT_EQ(asked.exit_code, 1);
    EXPECT_THAT(asked.error_output, AllOf(HasSubstr("group-02"), HasSubstr("group-03")));
}

// oracle: a talk consists of slides and a script: a script beside them does not replace slides that cannot be read
TEST(course_labs, unreadable_slides_beside_a_script_are_asked_for_again) {
    CourseBench bench(2);
    CourseBench::expect_done(bench.course({"assignment", "talk", "--kind", "talk", "--first", "2026-06-01 12:00"}));
    bench.bench().write("in/group-01/slides.pptx", "PK\x03\x04 slides");
    bench.bench().write("in/group-01/script.lua", "print(1)\n");
    const ChildResult taken = bench.course({"submit", "in", "--assignment", "talk", "--at", "2026-06-01 10:00"});
    EXPECT_THAT(taken.output, HasSubstr("ask the group for a readable file"));
    EXPECT_THAT(bench.course({"status", "talk"}).output, HasSubstr("ask for a readable file"));
}

// oracle: the format of zip: a file may be stored in it as it is
TEST(course_labs, zip_that_stores_pdfs_as_they_are_is_a_pack) {
    const TemporaryFolder folder;
    const auto zip = folder.path() / "report.zip";
    write_file_atomically(zip, "PK\x03\x04" + std::string(26, '\0') + "a.pdf" + small_pdf("one"));
    EXPECT_EQ(kind_of_file_at("report.zip", zip), "pack");
    EXPECT_EQ(kind_of_file_at("report.pdf", zip), "");
    const auto pdf = folder.path() / "report.pdf";
    write_file_atomically(pdf, "\n\n" + small_pdf("one"));
    EXPECT_EQ(kind_of_file_at("report.zip", pdf), "pdf");
}

// oracle: the bytes that came: six groups submit the same ones
TEST(course_labs, many_groups_with_the_same_file_are_counted) {
    CourseBench bench(6);
    for (int i = 1; i <= 6; ++i) bench.bench().write("in/" + CourseBench::group(i) + ".pdf", small_pdf("one"));
    CourseBench::expect_done(bench.course({"submit", "in", "--at", "2026-03-01 10:00", "--no-checks"}));
    EXPECT_THAT(
        bench.course({"status", "crane"}).output,
        AllOf(HasSubstr("the same file as group-02 and group-03 and 3 others"), Not(HasSubstr("group-04 and"))));
}

// oracle: hidden data sets drawn from an empty secret are not secret
TEST(course_labs, empty_secret_is_refused_at_once) {
    CourseBench bench(2);
    bench.bench().write("empty.txt", "");
    const ChildResult refused = bench.course({"assignment", "lab9", "--kind", "lab", "--lesson", "04", "--first",
                                              "2026-03-01 12:00", "--secret", "empty.txt"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, HasSubstr("is empty"));
    EXPECT_THAT(bench.course({"status"}).output, Not(HasSubstr("lab9")));
}

// oracle: what a lab consists of
TEST(course_labs, pdf_of_a_lab_is_no_report) {
    LabCourse course;
    const ReceiveOutcome taken = course.take({{"group-01.pdf", small_pdf("report")}}, "2026-02-28 12:00");
    EXPECT_EQ(taken.received.at(0).part, kUnreadable);
    EXPECT_EQ(taken.received.at(0).error_reason, "other-kind");
    SubmissionSelection expected;
    expected.group = "group-01", expected.part = "report";
    try {
        withdraw(course.course(), course.lab(), expected, true, "wrong file", course.at("2026-02-28 13:00"));
        FAIL() << "a lab has no report";
    } catch (const InvalidArgument& error) {
        EXPECT_EQ(message_text(error.message()), "lab4 has no part report; the parts are script, pack");
    }
}

// oracle: the order in which they came
TEST(course_labs, corrections_are_of_the_script_or_pack_that_came_last) {
    LabCourse course;
    course.submit(1, "2026-02-01 12:00");
    const std::int64_t pack = course.submit(1, "2026-02-02 12:00", 1, "pack");
    SubmissionSelection expected;
    expected.group = "group-01";
    EXPECT_THAT(correct_arrival(course.course(), course.lab(), expected, course.at("2026-02-03 12:00"), "log",
                                course.at("2026-02-04 12:00")),
                ::testing::ElementsAre(pack));
    EXPECT_THAT(withdraw(course.course(), course.lab(), expected, true, "wrong file", course.at("2026-02-04 12:00")),
                ::testing::ElementsAre(pack));
}

}  // namespace test_course_labs
}  // namespace dynlab::test
