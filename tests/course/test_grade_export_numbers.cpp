// Whose row of a platform's table is whose, and what is new. Oracle: Moodle numbers participants for each assignment;
// the names of the folders that it exports.
#include <gmock/gmock.h>

#include "course/export/grade_export.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_grade_export_numbers {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Marks of Élise and her partner Ravi, who submitted nothing himself, and of Zoë, whose archive cannot be read.
class grade_export_numbers : public testing::Test {
  protected:
    grade_export_numbers() {
        add("Lefèvre Élise_99345_assignsubmission_file_", "well done");
        add("Zoë K_99400_assignsubmission_file_", "cannot be read");
        write("gradebook.csv",
              "id,name,submission,state,points,possible\n"
              "s1,Élise Lefèvre,Lefèvre Élise_99345_assignsubmission_file_,graded,13,17\n"
              "s2,Ravi Rao,Lefèvre Élise_99345_assignsubmission_file_,graded,13,17\n"
              "s3,Zoë K,Zoë K_99400_assignsubmission_file_,unreadable,,\n");
        write("roster.csv",
              "id,name,group,email,moodle\ns1,Élise Lefèvre,g1,e@u.example,12345\ns2,Ravi Rao,g1,,12346\ns3,Zoë "
              "K,g2,,99400\n");
        request_.marks = folder_.path(), request_.roster = folder_.path() / "roster.csv";
    }
    void write(const std::string& name, const std::string& text) const {
        write_file_atomically(folder_.path() / name, text);
    }
    void add(const std::string& submission, const std::string& feedback) const {
        std::filesystem::create_directories(folder_.path() / "results" / submission);
        write("results/" + submission + "/feedback.md", feedback);
    }
    std::string read(const std::string& name) const { return read_file(folder_.path() / "handed_back" / name); }
    std::string in_zip() const {
        const std::string zip = (folder_.path() / "handed_back/moodle-feedback.zip").string();
        return Workbench()
            .shell("python3 -c \"import zipfile; print('\\n'.join(zipfile.ZipFile('" + zip + "').namelist()))\"")
            .output;
    }
    static std::string reported(const std::vector<Message>& messages) {
        std::string text;
        for (const Message& message : messages) text += message_text(message) + "\n";
        return text;
    }
    TemporaryFolder folder_;
    GradeExportRequest request_;
};

TEST_F(grade_export_numbers, the_number_in_the_folder_s_name_takes_precedence) {
    const GradeExport back = write_grade_export(request_);
    EXPECT_THAT(read("moodle-grades.csv"), AllOf(HasSubstr("Participant 99345,Élise Lefèvre,13,17"),
                                                 Not(HasSubstr("12345")), Not(HasSubstr("12346"))));
    EXPECT_THAT(reported(back.notes), HasSubstr("1 participant number in the roster's column \"moodle\" differs"));
    // The partner's number in the roster is of the same other assignment.
    EXPECT_THAT(reported(back.complaints), AllOf(HasSubstr("Ravi Rao is missing"), HasSubstr("--worksheet")));
}

TEST_F(grade_export_numbers, a_worksheet_has_the_partner_s_number_too) {
    write("sheet.csv",
          "Identifiant;Nom complet;Adresse de courriel;Note;Note maximale;Dernière modification (note);Feedback par "
          "commentaires\nParticipant 99345;Élise Lefèvre;e@u.example;;17,00;-;\nParticipant 99999;Rao "
          "Ravi;;;17,00;-;\nParticipant 99400;Zoë K;;;17,00;-;\nParticipant 1;Nobody Else;;5,00;17,00;-;\n");
    request_.worksheet = folder_.path() / "sheet.csv";
    const GradeExport back = write_grade_export(request_);
    EXPECT_THAT(back.complaints, IsEmpty());
    EXPECT_THAT(reported(back.notes), HasSubstr("1 row of"));
    EXPECT_EQ(
        read("moodle-grades.csv"),
        "Identifiant;Nom complet;Adresse de courriel;Note;Note maximale;Dernière modification (note);Feedback par "
        "commentaires\nParticipant 99345;Élise Lefèvre;e@u.example;13;17,00;-;\nParticipant 99999;Rao "
        "Ravi;;13;17,00;-;\nParticipant 99400;Zoë K;;;17,00;-;\nParticipant 1;Nobody Else;;5,00;17,00;-;\n");
    EXPECT_THAT(in_zip(), AllOf(HasSubstr("Ravi Rao_99999_assignfeedback_file_/feedback.md"),
                                HasSubstr("Élise Lefèvre_99345_assignfeedback_file_/feedback.md"),
                                HasSubstr("Zoë K_99400_assignfeedback_file_/feedback.md")));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "handed_back/canvas-grades.csv"));
    EXPECT_THAT(reported(back.notes), Not(HasSubstr("maximum grade")));
}

TEST_F(grade_export_numbers, a_worksheet_with_another_maximum_gets_scaled_points_and_a_note) {
    write("sheet.csv",
          "Identifier,Full name,Grade,Maximum grade,Feedback comments\nParticipant 99345,Élise Lefèvre,,100,\n"
          "Participant 99999,Ravi Rao,,100,\n");
    request_.worksheet = folder_.path() / "sheet.csv";
    const GradeExport back = write_grade_export(request_);
    EXPECT_THAT(read("moodle-grades.csv"), HasSubstr("Participant 99345,Élise Lefèvre,76.47,100,"));  // 13 / 17
    EXPECT_THAT(reported(back.notes),
                AllOf(HasSubstr("scaled from 17 points to the maximum grade"), HasSubstr("sheet.csv, which is 100\n")));
}

// oracle: nothing was delivered
TEST_F(grade_export_numbers, a_worksheet_without_the_students_is_not_reported_as_delivered_feedback) {
    write("sheet.csv", "Identifier,Full name,Grade,Maximum grade,Feedback comments\nParticipant 7,Ben Nye,,17,\n");
    request_.worksheet = folder_.path() / "sheet.csv";
    const GradeExport back = write_grade_export(request_);
    EXPECT_THAT(reported(back.notes), AllOf(HasSubstr("no student has both feedback and a known participant number"),
                                            Not(HasSubstr("already delivered"))));
}

TEST_F(grade_export_numbers, unreadable_submissions_get_their_feedback_through_moodle) {
    write_grade_export(request_);
    EXPECT_THAT(in_zip(), HasSubstr("Zoë K_99400_assignfeedback_file_/feedback.md"));
    EXPECT_THAT(read("moodle-grades.csv"), Not(HasSubstr("99400")));
}

TEST_F(grade_export_numbers, a_look_leaves_feedback_new_until_it_is_delivered) {
    const auto new_ones = [&] {
        const TextTable mail = read_text_table(folder_.path() / "handed_back/mail.csv");
        return std::ranges::count_if(mail.rows, [&](const auto& row) { return row[*mail.column("new")] == "yes"; });
    };
    EXPECT_THROW(log_delivery(folder_.path()), EnvironmentError);
    for (int i = 0; i < 2; ++i) {
        write_grade_export(request_);
        EXPECT_EQ(new_ones(), 3);
    }
    EXPECT_EQ(log_delivery(folder_.path()), 3);
    const GradeExport again = write_grade_export(request_);
    EXPECT_EQ(new_ones(), 0);
    EXPECT_THAT(reported(again.notes), HasSubstr("all feedback was already delivered"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "handed_back/moodle-feedback.zip"));
    add("Zoë K_99400_assignsubmission_file_", "opened after all");
    write_grade_export(request_);
    EXPECT_EQ(new_ones(), 1);
    EXPECT_EQ(in_zip(), "Zoë K_99400_assignfeedback_file_/feedback.md\n");
    request_.all = true;
    write_grade_export(request_);
    EXPECT_THAT(in_zip(), HasSubstr("99345"));
}

}  // namespace test_grade_export_numbers
}  // namespace dynlab::test
