#pragma once
#include <set>
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "data_io/text_table.h"

namespace dynlab::inline course {

/// What a group has not submitted yet, or not so that it can be read.
struct Reminder {
    Group group;
    std::vector<Message> missing;  ///< clauses: "the first version, due 2026-03-01 12:00"
};

/// Of an assignment: what is missing though its deadline is over, or with `early` whatever its deadline, and files that
/// cannot be read. Groups that dropped out need no reminder.
/// `only`: ids of groups; all where there are none.
std::vector<Reminder> reminders_of(Course& course, const Assignment& assignment, Instant now, bool early = false,
                                   const std::set<std::int64_t>& only = {});

/// Subject and text of a message to one student, in their language (Student::language, else English).
struct Mail {
    std::string subject, text;
};
Mail mail_of(const Reminder& reminder, const Student& student, const Assignment& assignment, const std::string& course);

/// mail.csv: a row for each member of these groups, with the columns to, subject, text, id, name and group.
TextTable reminder_mails(Course& course, const Assignment& assignment, const std::vector<Reminder>& reminders);

}  // namespace dynlab::inline course
