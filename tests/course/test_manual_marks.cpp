#include "course/grading/manual_marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "course/grading/feedback.h"
#include "course/grading_bench.h"
#include "course/intake/staging.h"
#include "course/office/marks_join.h"
#include "course/office/receive_class.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_manual_marks {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A class of four submissions in a course: of two groups, of a student alone, and of two people of one name.
class MarkedClass {
  public:
    MarkedClass() : course_(created(out() / "course")) {
        write_file_atomically(out() / "roster.csv",
                              "id,name,group,email,moodle\n221,Nguyễn Thị Minh Anh,group-01,a@uni.eu,901\n222,Max "
                              "Mustermann,group-01,,\n223,Íñigo Úbeda,group-02,,\n224,Wei Li,,,\n225,Wei Li,,,\n");
        import_roster(course_, out() / "roster.csv", true);
        Assignment lab;
        lab.name = "lab", lab.kind = "lab", lab.lesson = "04";
        set_assignment(course_, lab);
        for (const char* name : {"Anh_901_assignsubmission_file_", "group_2_final", "weili-224", "weili-225"}) {
            std::filesystem::create_directories(out() / "in" / name);
            write_file_atomically(out() / "in" / name / "analysis.lua", std::string("-- of ") + name + "\n");
        }
        const std::filesystem::path anh = out() / "in/Anh_901_assignsubmission_file_";  // submits an archive
        zip_submission({"", anh}, anh.string() + ".zip", {});
        std::filesystem::remove_all(anh);
        const ClassSubmissions submissions(out() / "in", Isolation::kProcess, DYNLAB_PROGRAM);
        work_.emplace(course_, this->lab(), receive_class(course_, this->lab(), submissions, {}, CourseClock::now()));
    }
    std::filesystem::path out() const { return folder_.path(); }
    void write(const std::string& rows) const {
        write_file_atomically(out() / kMarksFile, "who,check,points,reason\n" + rows);
    }
    /// As `dynlab course mark` does.
    void give(const std::string& group, const std::string& check, double points) {
        GivenMark mark;
        mark.group = group_named(course_, group).id, mark.item = check, mark.points = points;
        give_mark(course_, lab(), mark, CourseClock::now());
    }
    /// The complaints about rows that cannot be taken, a line each. The checks x and y have 4 and 6 points.
    std::string join(double most_of_y = 6) {
        std::string text;
        for (const Message& sentence :
             join_marks_file(course_, lab(), *work_, {{"x", 4}, {"y", most_of_y}, {kWholeItem, 10}}, out(), true))
            text += message_text(sentence) + "\n";
        work_->take_marks(course_, lab());
        return text;
    }
    /// The marks of a submission as the feedback has them, and the gradebook too: "x 3.5 reason; y 2 ".
    std::string given(const std::string& submission) {
        join();
        std::string text;
        for (const WorkItem& item : work_->work().items)
            if (item.submission.name == submission)
                for (const auto& [check, mark] : item.given)
                    text += (text.empty() ? "" : "; ") + check + " " + points_text(mark.points) + " " + mark.reason;
        return text;
    }

  private:
    static std::filesystem::path created(const std::filesystem::path& folder) {
        Course::create(folder, "a class", "UTC");
        return folder;
    }
    Assignment lab() { return assignment_named(course_, "lab"); }

    TemporaryFolder folder_;
    Course course_;
    std::optional<CourseWork> work_;
};

// oracle: the roster of the class; every unique identifier gives the same mark
TEST(manual_marks, are_given_by_any_unique_identifier) {
    MarkedClass marked;
    for (const char* who :
         {"group-01", "Group 1", "221", "Nguyễn Thị Minh Anh", "Minh Anh Nguyen Thi", "a@uni.eu", "Max Mustermann",
          "901", "Anh_901_assignsubmission_file_", "Anh_901_assignsubmission_file_.zip"}) {
        marked.write(std::string(who) + ",x,3.5,good\n");
        EXPECT_EQ(marked.join(), "") << who;
        EXPECT_EQ(marked.given("Anh_901_assignsubmission_file_"), "x 3.5 good") << who;
        EXPECT_EQ(marked.given("group_2_final"), "") << who;
    }
}

// oracle: no student gets a mark that may belong to another one
TEST(manual_marks, of_doubtful_rows_are_complained_of_with_their_line) {
    MarkedClass marked;
    marked.write("group-02,x,2,\nWei Li,x,3,\ngroup-7,x,1,\n221,z,1,\ngroup-01,y,7,\n");
    EXPECT_THAT(marked.join(),
                AllOf(HasSubstr("marks.csv, line 3: \"Wei Li\" is ambiguous"),
                      HasSubstr("marks.csv, line 4: no submission, group or student is named \"group-7\""),
                      HasSubstr("marks.csv, line 5: unknown check \"z\" (for \"221\")"),
                      HasSubstr("line 6: \"group-01\" gets 7 points for the check \"y\", but the maximum is 6")));
    EXPECT_EQ(marked.given("group_2_final"), "x 2 ");
    EXPECT_EQ(marked.given("weili-224"), "");
    EXPECT_EQ(marked.given("Anh_901_assignsubmission_file_"), "");
    EXPECT_THAT(marked.join(7), Not(HasSubstr("line 6")));
    EXPECT_EQ(marked.given("Anh_901_assignsubmission_file_"), "y 7 ");
    EXPECT_THAT(marked.join(), Not(HasSubstr("line 6"))) << "the course has it already";
}

// oracle: the checks of the class; before the first grading the course does not know them
TEST(manual_marks, of_the_course_for_an_unknown_check_are_complained_of) {
    MarkedClass marked;
    marked.give("group-02", "z", 2);
    marked.give("group-02", "x", 3);
    EXPECT_THAT(marked.join(), HasSubstr("\"group_2_final\" has for the unknown check \"z\" does not count"));
    EXPECT_EQ(marked.given("group_2_final"), "x 3 ");
    EXPECT_THAT(read_text(marked.out() / kMarksFile), Not(HasSubstr(",z,")));
}

// oracle: the maximum of both checks
TEST(manual_marks, of_the_whole_submission_are_held_against_the_sum_of_all_checks) {
    MarkedClass marked;
    marked.write("group-02,*,7.5,shown at the desk\n");
    EXPECT_EQ(marked.given("group_2_final"), "* 7.5 shown at the desk");
    marked.write("group-02,*,11,\n");
    EXPECT_THAT(marked.join(), HasSubstr("gets 11 points for the check \"*\", but the maximum is 10"));
}

// oracle: the mark that was written, of all points of the lesson; nothing is taken off
TEST(manual_marks, of_the_whole_submission_replace_those_of_the_checks) {
    Grade grade;
    for (const double max_points : {4.0, 6.0}) {
        CheckGrade check;
        check.points = max_points, check.earned = 1, check.graded = false;
        grade.checks.push_back(check);
    }
    grade.unreadable = true, grade.penalty = 2;
    EXPECT_TRUE(grade.without_marks());
    grade.whole_mark = 7.5;
    EXPECT_EQ(grade.earned(), 7.5);
    EXPECT_EQ(grade.possible(), 10);
    EXPECT_TRUE(grade.whole());
    EXPECT_FALSE(grade.without_marks());
}

// oracle: issue found in a term: the next run deleted 28 marks that the instructor had typed in
TEST(manual_marks, a_filled_row_is_never_lost) {
    MarkedClass marked;
    const MarksFile::Row open{0, "group_2_final", "x", {}, ""};
    MarksFile(marked.out()).add({open, {0, "weili-224", "x", {}, ""}}, {{"4", "Question 3", "two reasons"}});
    EXPECT_EQ(read_file(marked.out() / kMarksFile),
              "who,check,points,reason,of,about,rubric\r\ngroup_2_final,x,,,4,Question 3,two reasons\r\n"
              "weili-224,x,,,,,\r\n");
    // The instructor completes the file, with additional columns, semicolons and a decimal comma.
    write_file_atomically(marked.out() / kMarksFile,
                          "note;who;check;points;reason\nmine;group_2_final;x;2,5;good\n;group-01;y;5;\n;;;;\n");
    const std::string before = read_file(marked.out() / kMarksFile);
    MarksFile(marked.out()).add({open});
    EXPECT_EQ(read_file(marked.out() / kMarksFile), before) << "nothing is new";
    EXPECT_EQ(marked.given("group_2_final"), "x 2.5 good");
    MarksFile(marked.out()).add({open, {0, "weili-225", "x", {}, ""}});
    EXPECT_THAT(read_file(marked.out() / kMarksFile),
                AllOf(HasSubstr("mine,group_2_final,x,\"2,5\",good\r\n"), HasSubstr(",group-01,y,5,\r\n"),
                      HasSubstr(",weili-225,x,,\r\n")));
    EXPECT_EQ(marked.given("group_2_final"), "x 2.5 good");
    EXPECT_EQ(marked.given("Anh_901_assignsubmission_file_"), "y 5 ");
}

// oracle: the files of earlier versions; what is in marks.csv already stays
TEST(manual_marks, of_earlier_versions_are_taken_in_once) {
    MarkedClass marked;
    const auto write = [&](const char* file, const std::string& text) {
        write_file_atomically(marked.out() / file, text);
    };
    write("manual.csv", "submission,check,points,reason\ngroup_2_final,x,3,old\nweili-224,y,,not yet\n");
    write("by_hand.csv", "submission,check,points,comment,of,about,rubric\nweili-225,x,2,typed here,4,Q,\n");
    EXPECT_EQ(marked.given("group_2_final"), "x 3 old");
    EXPECT_EQ(marked.given("weili-225"), "x 2 typed here");
    EXPECT_FALSE(std::filesystem::exists(marked.out() / "manual.csv"));
    EXPECT_TRUE(std::filesystem::exists(marked.out() / "manual.csv.imported"));
    EXPECT_THAT(read_file(marked.out() / "by_hand.csv.imported"), HasSubstr("typed here"));
    write("manual.csv", "submission,check,points,reason\ngroup_2_final,x,1,later\ngroup_2_final,y,5,later\n");
    EXPECT_EQ(marked.given("group_2_final"), "x 3 old; y 5 later") << "x stays";
    EXPECT_TRUE(std::filesystem::exists(marked.out() / "manual.csv.imported-2"));
    write("manual.csv", "submission,check,points\ngroup_2_final,x,many\n");
    EXPECT_THROW(marked.join(), EnvironmentError);
    EXPECT_TRUE(std::filesystem::exists(marked.out() / "manual.csv")) << "to be corrected";
}

// oracle: what the student reads and the gradebook has, for a work that only its author could show
TEST(manual_marks, of_an_unreadable_work_reach_feedback_and_gradebook) {
    GradingBench bench("--   x: number\n",
                       "check{id = 'x', points = 2, test = function(a) return near(a.x, 42) end}\n"
                       "check{id = 'y', points = 3, test = function(a) return near(a.x, 42) end}\n",
                       "answer('x', 42)\n");
    const Workbench& work = bench.bench();
    work.write("in/group-9.rar", "Rar!");
    work.write("out/marks.csv", "who,check,points,reason\ngroup-9.rar,x,1,\n");
    bench.grade();
    const auto feedback = [&] { return work.read("out/results/group-9.rar/feedback.md"); };
    EXPECT_THAT(feedback(), AllOf(HasSubstr("no marks yet"), Not(HasSubstr("of 2 points"))));
    work.write("out/marks.csv", "who,check,points,reason\ngroup-9.rar,*,4,shown at the desk\n");
    bench.grade();
    EXPECT_THAT(feedback(),
                AllOf(HasSubstr("4 of 5 points"), HasSubstr("shown at the desk"), Not(HasSubstr("no marks yet"))));
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr(",group-9.rar,graded,4,5,0,"));
}

// oracle: the roster; the number that the platform gave Anna is in the name of her folder
TEST(manual_marks, of_students_on_the_roster_reach_the_gradebook_by_any_name) {
    GradingBench bench("--   x: number\n", "check{id = 'x', points = 5, test = function(a) return near(a.x, 42) end}\n",
                       "answer('x', 42)\n");
    const Workbench& work = bench.bench();
    work.write("roster.csv", "id,name,group\n1,Anna Lovelace,\n9,Bo Linwood,group-9\n");
    bench.submit_file("Anna Lovelace_900001_assignsubmission_file_", "answer('x', 1)\n");
    work.write("in/group-9.rar", "Rar!");
    // The instructor writes the complete file again each time, with other names for the same work.
    for (const auto& [anna, bo] : {std::pair("900001", "9"),
                                   {"Anna Lovelace", "group-9.rar"},
                                   {"1", "Group 9"},
                                   {"Anna Lovelace_900001_assignsubmission_file_", "group-9.rar"}}) {
        work.write("out/marks.csv", std::string("who,check,points,reason\n") + anna + ",x,3,\n" + bo + ",*,4,desk\n");
        bench.grade({"--roster", "roster.csv"});
        EXPECT_THAT(work.read("out/gradebook.csv"),
                    AllOf(HasSubstr("1,Anna Lovelace,Anna Lovelace_900001_assignsubmission_file_,graded,3,5,"),
                          HasSubstr("9,Bo Linwood,group-9.rar,graded,4,5,")))
            << anna << " " << bo;
        EXPECT_THAT(work.read("out/results/Anna Lovelace_900001_assignsubmission_file_/feedback.md"),
                    AllOf(HasSubstr("3 of 5 points"), HasSubstr("Marked by the instructor.")))
            << anna;
    }
}

}  // namespace test_manual_marks
}  // namespace dynlab::test
