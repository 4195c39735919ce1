// Messages for what is missing. Oracle: what was received and when it was due.
#include "course/export/reminders.h"

#include <gmock/gmock.h>

#include "course/course_bench.h"
#include "course/office/receive.h"

namespace dynlab::test {
namespace test_reminders {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class reminders : public testing::Test {
  protected:
    void take(const std::string& file, const std::string& content) {
        bench_.bench().write(file, content);
        ReceiveRequest request;
        request.files = {bench_.bench().path(file)};
        request.assignment = "crane", request.at = at("2026-03-01 10:00"), request.checks = false;
        receive(course_, request);
    }
    Instant at(const std::string& time) const { return course_.clock().parse(time, "time"); }
    std::string missing(const std::string& time, bool early = false) {
        std::string text;
        for (const Reminder& one : reminders_of(course_, crane(), at(time), early))
            for (const Message& clause : one.missing) text += one.group.name + ": " + message_text(clause) + "\n";
        return text;
    }
    Assignment crane() { return assignment_named(course_, "crane"); }
    CourseBench bench_{3, 1};
    Course course_{bench_.bench().path("k")};
};

TEST_F(reminders, name_what_is_missing_once_it_is_due) {
    take("group-01.pdf", small_pdf("one"));
    take("group-02.rar", "Rar!\x1A\x07");
    EXPECT_EQ(
        missing("2026-03-01 11:00"),
        "group-02: the first version, due 2026-03-01 12:00: the submitted file cannot be read; submit it again\n");
    EXPECT_THAT(missing("2026-03-01 12:11"), HasSubstr("group-03: the first version, due 2026-03-01 12:00\n"));
    EXPECT_THAT(missing("2026-03-01 11:00", true),
                AllOf(HasSubstr("group-01: the final version, due 2026-03-15 12:00\n"),
                      HasSubstr("group-03: the first version, due 2026-03-01 12:00\n")));
    EXPECT_THAT(missing("2026-03-08 12:11"), Not(HasSubstr("final version")));
    EXPECT_THAT(missing("2026-03-15 12:11"), HasSubstr("group-01: the final version, due 2026-03-15 12:00\n"));
}

TEST_F(reminders, are_messages_with_address_subject_and_text) {
    const std::vector<Reminder> all = reminders_of(course_, crane(), at("2026-03-01 13:00"));
    const TextTable mails = reminder_mails(course_, crane(), all);
    EXPECT_EQ(mails.names, (std::vector<std::string>{"to", "subject", "text", "id", "name", "group"}));
    ASSERT_EQ(mails.rows.size(), 3u);
    EXPECT_EQ(mails.rows[1][1], "k, crane: please submit the missing parts");
    EXPECT_EQ(mails.rows[1][2],
              "Hello Student 2,\n\nthe following parts of the submission of group-02 for crane are missing (k):\n\n* "
              "the first version, "
              "due 2026-03-01 12:00\n\nPlease submit them now, or reply to this message.\n");
    EXPECT_EQ(mails.rows[1][3], "s2");
}

TEST_F(reminders, are_in_the_student_s_language) {
    const std::vector<Reminder> all = reminders_of(course_, crane(), at("2026-03-01 13:00"));
    Student student;
    student.name = "Élise Lefèvre", student.language = "fr";
    const Mail mail = mail_of(all.at(0), student, crane(), "Signaux");
    EXPECT_THAT(mail.text, AllOf(StartsWith("Bonjour Élise Lefèvre,"), HasSubstr("la première version"),
                                 Not(HasSubstr("missing"))));
    EXPECT_THAT(mail.subject, Not(HasSubstr("missing")));
}

// oracle: the file that the command writes
TEST_F(reminders, the_command_writes_mail_csv) {
    const ChildResult done = bench_.course({"remind", "crane", "--at", "2026-03-01 13:00"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_THAT(done.error_output, HasSubstr("no email address is known for s1, s2"));
    EXPECT_THAT(bench_.bench().read("mail.csv"), StartsWith("to,subject,text,id,name,group\r\n"));
    EXPECT_THAT(bench_.course({"remind", "--at", "2026-02-01 13:00"}).output, HasSubstr("Nothing is missing."));
}

}  // namespace test_reminders
}  // namespace dynlab::test
