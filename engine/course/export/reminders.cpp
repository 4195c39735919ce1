#include "course/export/reminders.h"

#include <algorithm>
#include <map>

#include "base/languages.h"
#include "base/reader.h"
#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/inspection.h"
#include "course/store/newest_versions.h"

namespace dynlab::inline course {
namespace {

/// "2026-03-01 12:00": without the weekday, which is English.
std::string date_of(const CourseClock& clock, Instant instant) {
    const std::string shown = clock.show(instant);
    return shown.substr(shown.find(' ') + 1);
}

/// Collects what one group lacks.
class Gaps {
  public:
    Gaps(Course& course, const Assignment& assignment, const Group& group, Instant now, bool early)
        : course_(course), assignment_(assignment), group_(group), now_(now), early_(early) {}

    void document(const char* stage, const SubmittedParts& parts, const Message& what) {
        const auto found = parts.find(parts_of(assignment_, stage).front()), unread = parts.find(kUnreadable);
        const Message due = Message("due {}", date_of(course_.clock(), due_of(stage)));
        const bool replaced =
            unread != parts.end() && (found == parts.end() || found->second.received_at < unread->second.received_at);
        if (replaced || (found != parts.end() && !found->second.error_reason.empty()))
            missing_.push_back(Message("{}, {}: the submitted file cannot be read; submit it again", what, due));
        else if (found == parts.end() && parts.contains("pack"))
            missing_.push_back(Message("{}, {}: the submitted pack contains no PDF", what, due));
        else if (found == parts.end() && is_requested(stage))
            missing_.push_back(Message("{}, {}", what, due));
    }

    void script(const SubmittedParts& parts) {
        if (!parts.contains("script") && !parts.contains("pack") && is_requested("first"))
            missing_.push_back(Message("the script, due {}", date_of(course_.clock(), due_of("first"))));
    }

    void reviews(const std::vector<ReviewPair>& pairs) {
        if (!assignment_.review_due) return;
        for (const ReviewPair& pair : pairs)
            if (pair.reviewer == group_.id && pair.sent && !pair.ended && !pair.written && is_requested("review"))
                missing_.push_back(Message("the review of {}, due {}", pair.report_pseudonym(),
                                           date_of(course_.clock(), due_of("review"))));
    }

    std::vector<Message> found() { return std::move(missing_); }

  private:
    Instant due_of(const char* stage) { return due_for(course_, assignment_, group_.id, stage); }
    bool is_requested(const char* stage) { return early_ || now_ > due_of(stage) + assignment_.grace; }

    Course& course_;
    const Assignment& assignment_;
    const Group& group_;
    const Instant now_;
    const bool early_;
    std::vector<Message> missing_;
};

}  // namespace

std::vector<Reminder> reminders_of(Course& course, const Assignment& assignment, Instant now, bool early,
                                   const std::set<std::int64_t>& only) {
    auto versions = newest_versions(course, assignment);
    std::vector<ReviewPair> pairs;
    if (assignment.is_report()) pairs = review_pairs(course, assignment);
    std::vector<Reminder> reminders;
    for (const Group& group : groups_of_authors(course, assignment)) {
        if (group.dropped_out || (!only.empty() && !only.contains(group.id))) continue;
        auto& stages = versions[group.id];
        Gaps gaps(course, assignment, group, now, early);
        if (assignment.is_report()) {
            gaps.document("first", stages["first"], Message("the first version"));
            gaps.reviews(pairs);
            if (assignment.final_due) gaps.document("final", stages["final"], Message("the final version"));
        } else {
            gaps.document("first", stages["first"],
                          assignment.is_lab() ? Message("the script") : Message("the slides"));
            if (!assignment.is_lab()) gaps.script(stages["first"]);
        }
        if (std::vector<Message> missing = gaps.found(); !missing.empty())
            reminders.push_back({group, std::move(missing)});
    }
    return reminders;
}

Mail mail_of(const Reminder& reminder, const Student& student, const Assignment& assignment,
             const std::string& course) {
    const Reader reader{catalog_of(student.language.empty() ? "en" : student.language)};
    const std::string& name = student.name.empty() ? student.id : student.name;
    std::string text = message_text(Message("Hello {},", name), reader) + "\n\n";
    text += message_text(Message("the following parts of the submission of {} for {} are missing ({}):",
                                 reminder.group.name, assignment.name, course),
                         reader) +
            "\n\n";
    for (const Message& one : reminder.missing) text += "* " + message_text(one, reader) + "\n";
    text += "\n" + message_text(Message("Please submit them now, or reply to this message."), reader) + "\n";
    return {message_text(Message("{}, {}: please submit the missing parts", course, assignment.name), reader), text};
}

TextTable reminder_mails(Course& course, const Assignment& assignment, const std::vector<Reminder>& reminders) {
    std::map<std::string, Student> students;
    for (Student& student : students_of(course)) students[student.id] = std::move(student);
    TextTable table;
    table.names = {"to", "subject", "text", "id", "name", "group"};
    for (const Reminder& reminder : reminders)
        for (const std::string& id : reminder.group.members) {
            const Student& student = students[id];
            const Mail mail = mail_of(reminder, student, assignment, course.name());
            table.rows.push_back({student.mail, mail.subject, mail.text, id, student.name, reminder.group.name});
        }
    return table;
}

}  // namespace dynlab::inline course
