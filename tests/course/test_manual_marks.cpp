#include "course/grading/manual_marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "course/checks/check_session.h"
#include "course/grading_bench.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_manual_marks {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A class of four submissions: of two groups, of a student alone, and of two people of one name.
class MarkedClass {
  public:
    MarkedClass() {
        work_.roster = true;
        work_.students = {{"221", "Nguyễn Thị Minh Anh", "group-01", {}, "a@uni.eu", "901", ""},
                          {"222", "Max Mustermann", "group-01", {}, "", "", ""},
                          {"223", "Íñigo Úbeda", "group-02", {}, "", "", ""},
                          {"224", "Wei Li", "", {}, "", "", ""},
                          {"225", "Wei Li", "", {}, "", "", ""}};
        add("Anh_901_assignsubmission_file_", "group-01", {0, 1});
        add("02-final", "group-02", {2});
        add("weili-224", "Wei Li", {3});
        add("weili-225", "Wei Li", {4});
    }
    const ClassWork& work() const { return work_; }
    std::filesystem::path out() const { return folder_.path(); }
    void write(const std::string& rows) const {
        write_file_atomically(out() / kMarksFile, "who,check,points,reason\n" + rows);
    }
    ManualMarks marks(bool above_maximum = false) const {
        CheckDescription x, y;
        x.id = "x", x.points = 4, y.id = "y", y.points = 6;
        return {out(), work_, {x, y}, above_maximum};
    }
    /// The points of a submission on which both checks gave one point.
    double points(const std::string& submission) const { return marks().applied(graded(submission)).earned(); }
    std::string complaints() const {
        std::string text;
        const ManualMarks given = marks();
        for (const Message& sentence : given.complaints()) text += message_text(sentence) + "\n";
        return text;
    }
    static Grade graded(const std::string& submission) {
        Grade grade;
        grade.submission = submission;
        for (const auto& [id, max_points] : {std::pair("x", 4.0), std::pair("y", 6.0)}) {
            CheckGrade check;
            check.id = id, check.points = max_points, check.earned = 1;
            grade.checks.push_back(check);
        }
        return grade;
    }

  private:
    void add(const std::string& name, const std::string& owner, std::vector<std::size_t> students) {
        WorkItem item;
        item.submission.name = name;
        item.submission.path = "in/" + name + ".zip";
        item.students = std::move(students);
        item.addressee = owner;
        work_.items.push_back(std::move(item));
    }

    TemporaryFolder folder_;
    ClassWork work_;
};

// oracle: the roster of the class; every unique identifier gives the same mark
TEST(manual_marks, are_given_by_any_unique_identifier) {
    const MarkedClass marked;
    for (const char* who :
         {"group-01", "Group 1", "221", "Nguyễn Thị Minh Anh", "Minh Anh Nguyen Thi", "a@uni.eu", "Max Mustermann",
          "901", "Anh_901_assignsubmission_file_", "Anh_901_assignsubmission_file_.zip"}) {
        marked.write(std::string(who) + ",x,3.5,\n");
        EXPECT_EQ(marked.points("Anh_901_assignsubmission_file_"), 4.5) << who;
        EXPECT_EQ(marked.points("02-final"), 2) << who;
        EXPECT_EQ(marked.complaints(), "") << who;
    }
}

// oracle: no student gets a mark that may belong to another one
TEST(manual_marks, of_doubtful_rows_are_complained_of_with_their_line) {
    const MarkedClass marked;
    marked.write("group-02,x,2,\nWei Li,x,3,\ngroup-7,x,1,\n221,z,1,\ngroup-01,y,7,\n");
    EXPECT_THAT(marked.complaints(),
                AllOf(HasSubstr("marks.csv, line 3: \"Wei Li\" is ambiguous"),
                      HasSubstr("marks.csv, line 4: no submission, group or student is named \"group-7\""),
                      HasSubstr("marks.csv, line 5: unknown check \"z\" (for \"221\")"),
                      HasSubstr("line 6: \"group-01\" gets 7 points for the check \"y\", but the maximum is 6")));
    EXPECT_EQ(marked.points("02-final"), 3);
    EXPECT_EQ(marked.points("weili-224"), 2);
    EXPECT_EQ(marked.points("Anh_901_assignsubmission_file_"), 2);
    EXPECT_EQ(marked.marks(true).applied(MarkedClass::graded("Anh_901_assignsubmission_file_")).earned(), 8);
}

// oracle: the mark that was written, of all points of the lesson
TEST(manual_marks, of_the_whole_submission_replace_those_of_the_checks) {
    const MarkedClass marked;
    marked.write("group-02,*,7.5,shown at the desk\n");
    Grade grade = MarkedClass::graded("02-final");
    grade.unreadable = true, grade.penalty = 2;
    for (CheckGrade& check : grade.checks) check.graded = false;
    const Grade whole = marked.marks().applied(grade);
    EXPECT_EQ(whole.earned(), 7.5);
    EXPECT_EQ(whole.possible(), 10);
    EXPECT_TRUE(whole.whole());
    EXPECT_FALSE(whole.without_marks());
    marked.write("group-02,*,11,\n");
    EXPECT_THAT(marked.complaints(), HasSubstr("gets 11 points for the check \"*\", but the maximum is 10"));
}

// oracle: issue found in a term: the next run deleted 28 marks that the instructor had typed in
TEST(manual_marks, a_filled_row_is_never_lost) {
    const MarkedClass marked;
    const MarksFile::Row open{0, "02-final", "x", {}, ""};
    MarksFile(marked.out()).add({open, {0, "weili-224", "x", {}, ""}}, {{"4", "Question 3", "two reasons"}});
    EXPECT_EQ(read_file(marked.out() / kMarksFile),
              "who,check,points,reason,of,about,rubric\r\n02-final,x,,,4,Question 3,two reasons\r\n"
              "weili-224,x,,,,,\r\n");
    // The instructor completes the file, with additional columns, semicolons and a decimal comma.
    write_file_atomically(marked.out() / kMarksFile,
                          "note;who;check;points;reason\nmine;02-final;x;2,5;good\n;group-01;y;5;\n;;;;\n");
    const std::string before = read_file(marked.out() / kMarksFile);
    MarksFile(marked.out()).add({open});
    EXPECT_EQ(read_file(marked.out() / kMarksFile), before) << "nothing is new";
    EXPECT_EQ(marked.points("02-final"), 3.5);
    MarksFile(marked.out()).add({open, {0, "weili-225", "x", {}, ""}});
    EXPECT_THAT(read_file(marked.out() / kMarksFile),
                AllOf(HasSubstr("mine,02-final,x,\"2,5\",good\r\n"), HasSubstr(",group-01,y,5,\r\n"),
                      HasSubstr(",weili-225,x,,\r\n")));
    EXPECT_EQ(marked.points("02-final"), 3.5);
    EXPECT_EQ(marked.points("Anh_901_assignsubmission_file_"), 6);
}

// oracle: the files of earlier versions; what is in marks.csv already stays
TEST(manual_marks, of_earlier_versions_are_taken_in_once) {
    const MarkedClass marked;
    const auto write = [&](const char* file, const std::string& text) {
        write_file_atomically(marked.out() / file, text);
    };
    write("manual.csv", "submission,check,points,reason\n02-final,x,3,old\nweili-224,y,,not yet\n");
    write("by_hand.csv", "submission,check,points,comment,of,about,rubric\nweili-225,x,2,typed here,4,Q,\n");
    EXPECT_EQ(marked.points("02-final"), 4);
    EXPECT_EQ(marked.points("weili-225"), 3);
    EXPECT_FALSE(std::filesystem::exists(marked.out() / "manual.csv"));
    EXPECT_TRUE(std::filesystem::exists(marked.out() / "manual.csv.imported"));
    EXPECT_THAT(read_file(marked.out() / "by_hand.csv.imported"), HasSubstr("typed here"));
    write("manual.csv", "submission,check,points,reason\n02-final,x,1,later\n02-final,y,5,later\n");
    EXPECT_EQ(marked.points("02-final"), 8) << "x stays";
    EXPECT_TRUE(std::filesystem::exists(marked.out() / "manual.csv.imported-2"));
    write("manual.csv", "submission,check,points\n02-final,x,many\n");
    EXPECT_THROW(marked.marks(), EnvironmentError);
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
    }
}

}  // namespace test_manual_marks
}  // namespace dynlab::test
