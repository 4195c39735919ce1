// Platforms' own tables, filled in. Oracles: the columns that Moodle's grading worksheet (mod/assign/gradingtable.php)
// and Canvas's gradebook export have; every byte that is no grade and no comment.
#include "course/export/platform_sheet.h"

#include <gmock/gmock.h>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_platform_sheet {
using ::testing::HasSubstr;

class platform_sheet : public testing::Test {
  protected:
    PlatformSheet sheet(const std::string& text, const std::string& assignment = "") const {
        write_file_atomically(file_, text);
        return PlatformSheet(file_, assignment);
    }
    std::string refusal(const std::string& text, const std::string& assignment = "") const {
        try {
            sheet(text, assignment);
        } catch (const EnvironmentError& error) {
            return error.what();
        }
        return "accepted";
    }
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "sheet.csv";
};

TEST_F(platform_sheet, moodle_keeps_every_other_byte) {
    const std::string before =
        "Identifier,\"Full name\",\"ID number\",\"Email address\",Status,Grade,\"Maximum Grade\",\"Last modified "
        "(submission)\",\"Last modified (grade)\",\"Feedback comments\"\n"
        "\"Participant 99345\",\"Élise Lefèvre\",s1,elise@u.example,Submitted,,20.00,\"Monday, 9 March 2026, 5:50 "
        "PM\",-,\n"
        "\"Participant 99346\",\"Zoë, K.\",s2,zoe@u.example,\"No submission\",7.00,20.00,-,\"Monday, 2 March 2026, "
        "5:50 "
        "PM\",\"old, \"\"kept\"\"\"\n";
    PlatformSheet moodle = sheet(before);
    EXPECT_EQ(moodle.text(), before);
    ASSERT_EQ(moodle.people().size(), 2u);
    const PlatformSheet::Person& elise = moodle.people()[0];
    EXPECT_EQ(elise.number, "99345");
    EXPECT_EQ(elise.id, "s1");
    EXPECT_EQ(elise.mail, "elise@u.example");
    EXPECT_EQ(elise.name, "Élise Lefèvre");
    moodle.set_grade(elise, "13.5");
    moodle.set_comment(elise, "13.5 of 20, see \"x\"");
    std::string expected = before;
    expected.replace(expected.find("Submitted,,20.00"), 16, "Submitted,13.5,20.00");
    expected.replace(expected.find("-,\n"), 3, "-,\"13.5 of 20, see \"\"x\"\"\"\n");
    EXPECT_EQ(moodle.text(), expected);
}

TEST_F(platform_sheet, moodle_in_french_keeps_semicolons_commas_and_byte_order_mark) {
    const std::string before =
        "\xEF\xBB\xBFIdentifiant;Nom complet;Statut;Note;Note maximale;Dernière modification (travail remis);Dernière "
        "modification (note);Feedback par commentaires\r\nParticipant 7;Anna Müller;Remis;;20,00;-;-;\r\n";
    PlatformSheet moodle = sheet(before);
    EXPECT_TRUE(moodle.unrecognized().empty());
    moodle.set_grade(moodle.people()[0], "1.5");
    moodle.set_comment(moodle.people()[0], "bien; oui");
    std::string expected = before;
    expected.replace(expected.find(";;20,00"), 7, ";1,5;20,00");
    expected.replace(expected.rfind(";\r\n"), 3, ";\"bien; oui\"\r\n");
    EXPECT_EQ(moodle.text(), expected);
}

// oracle: a header in an unlisted language, and the positions of Moodle's columns
TEST_F(platform_sheet, columns_of_an_unknown_language_are_found_by_their_content) {
    PlatformSheet moodle = sheet(
        "Αναγνωριστικό,Όνομα,Βαθμός,Μέγιστος,Σχόλια\nΣυμμετέχων 12,Ada L,,10.00,\n"
        "Συμμετέχων 13,Bo M,,10.00,\n");
    ASSERT_EQ(moodle.people().size(), 2u);
    EXPECT_EQ(moodle.people()[1].number, "13");
    EXPECT_EQ(moodle.people()[1].name, "Bo M");
    ASSERT_EQ(moodle.unrecognized().size(), 1u);
    EXPECT_THAT(message_text(moodle.unrecognized()[0]),
                HasSubstr("the column for feedback comments is not recognized"));
    moodle.set_grade(moodle.people()[1], "9");
    EXPECT_THAT(moodle.text(), HasSubstr("Συμμετέχων 13,Bo M,9,10.00,\n"));
}

// oracle: the header; with one row every number is the same in all rows
TEST_F(platform_sheet, a_number_of_a_single_row_is_no_maximum) {
    PlatformSheet moodle = sheet("Αναγνωριστικό,Όνομα,Αριθμός,Βαθμός,Μέγιστος\nΣυμμετέχων 12,Ada L,1001,,10.00\n");
    moodle.set_grade(moodle.people().at(0), "9");
    EXPECT_THAT(moodle.text(), HasSubstr("12,Ada L,1001,9,10.00\n"));
    EXPECT_THAT(refusal("Αναγνωριστικό,Όνομα,Αριθμός,Βαθμός,Μέγιστος\nΣυμμετέχων 12,Ada L,1001,7,10.00\n"),
                HasSubstr("a column for grades, such as \"Grade\", is required"));
}

TEST_F(platform_sheet, canvas_fills_the_column_of_the_assignment) {
    const std::string before =
        "Student,ID,SIS User ID,SIS Login ID,Section,Lab 3 (1233),Lab 4 (1234),Current Score\n"
        "    Points Possible,,,,,10,10,(read only)\n\"Lovelace, Ada\",31,s1,ada@u.example,A,8,,80\n";
    PlatformSheet canvas = sheet(before, "Lab 4");
    EXPECT_EQ(canvas.platform(), PlatformSheet::Platform::kCanvas);
    ASSERT_EQ(canvas.people().size(), 1u);
    EXPECT_EQ(canvas.people()[0].number, "31");
    EXPECT_EQ(canvas.people()[0].id, "s1");
    canvas.set_grade(canvas.people()[0], "9.5");
    std::string expected = before;
    expected.replace(expected.find("A,8,,80"), 7, "A,8,9.5,80");
    EXPECT_EQ(canvas.text(), expected);
    EXPECT_THAT(refusal(before), AllOf(HasSubstr("specify the column to fill in"), HasSubstr("Lab 3 (1233)")));
}

TEST_F(platform_sheet, what_is_not_recognized_is_named) {
    EXPECT_THAT(refusal("group,mark\n1,2\n"), AllOf(HasSubstr("expected Moodle's"), HasSubstr("group, mark")));
    EXPECT_THAT(refusal("Identifier,Status\nParticipant 1,x\n"),
                HasSubstr("a column for grades, such as \"Grade\", is required; the columns are Identifier, Status"));
    EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
    EXPECT_THAT(refusal("Identifier,\"Grade\nParticipant 1,2\n"), HasSubstr("quotation mark is not closed"));
}

// oracle: a spreadsheet computes what begins with =
TEST_F(platform_sheet, comments_do_not_become_formulas) {
    PlatformSheet moodle = sheet("Identifier,Grade,Feedback comments\nParticipant 1,,\n");
    moodle.set_comment(moodle.people()[0], "=cmd()");
    EXPECT_THAT(moodle.text(), HasSubstr(",'=cmd()\n"));
}

}  // namespace test_platform_sheet
}  // namespace dynlab::test
