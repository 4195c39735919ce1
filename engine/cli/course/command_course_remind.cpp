#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <set>

#include "base/reader.h"
#include "cli/course/course_commands.h"
#include "course/export/reminders.h"
#include "platform/atomic_file.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct RemindArguments {
    std::string assignment, out = "mail.csv", at;
    std::vector<std::string> only;
    bool early = false;
};

int remind(const CourseArguments& where, const RemindArguments& args) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    std::set<std::int64_t> only;
    for (const std::string& name : args.only) only.insert(group_named(course, name).id);
    const Instant now = time_of(course, args.at);
    const std::vector<Reminder> reminders = reminders_of(course, assignment, now, args.early, only);
    if (reminders.empty()) {
        std::cout << message_text(Message("Nothing is missing.")) << '\n';
        return kDone;
    }
    const TextTable mails = reminder_mails(course, assignment, reminders);
    write_file_atomically(args.out, csv_text(mails));
    std::vector<std::string> reminded;
    for (const Reminder& reminder : reminders) reminded.push_back(reminder.group.name);
    Transaction transaction(course.database());
    course.note(fmt::format("{}: reminders written for {}", assignment.name, fmt::join(reminded, ", ")), now);
    transaction.commit();
    for (const Reminder& reminder : reminders)
        std::cout << terminal_text(message_text(
                         Message("{}: {}", reminder.group.name, MessageList{reminder.missing, Join::kSemicolon})))
                  << '\n';
    std::vector<std::string> without;
    for (const auto& row : mails.rows)
        if (row[0].empty()) without.push_back(row[3]);
    std::cout << terminal_text(
                     message_text(plural(std::ssize(mails.rows), "{} message in {}", "{} messages in {}", args.out)))
              << '\n';
    if (!without.empty())
        std::cerr
            << "dynlab: "
            << terminal_text(message_text(Message(
                   "no email address is known for {}; add the missing addresses to the column \"mail\" of the roster",
                   listed(without))))
            << '\n';
    return without.empty() ? kDone : kFailed;
}

}  // namespace

void add_remind_command(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<RemindArguments>();
    CLI::App* command = course.add_subcommand("remind", "Write reminders for missing or unreadable work");
    command->add_option("ASSIGNMENT", args->assignment, "Assignment. Default: the only one");
    command->add_option("-o,--out", args->out, "File to write")->type_name("CSV")->capture_default_str();
    command->add_option("--only", args->only, "Group or student; may be repeated")->type_name("NAME");
    command->add_flag("--early", args->early, "Include work that is not due yet");
    add_time_option(*command, args->at);
    command->footer(
        "The file has a row for each student: to, subject, text, id, name, group, for the mail merge of any mail "
        "program. The\n"
        "column language of the roster sets the language of subject and text. Missing work is a first version, review, "
        "final\n"
        "version, slides or script after its deadline, or a file that cannot be read.\n"
        "Example:  dynlab course remind crane\n"
        "Exit codes: 0 done, 1 an address is unknown, 2 wrong usage.");
    command->callback([&where, args, &action] { action = [&where, args] { return remind(where, *args); }; });
}

}  // namespace dynlab::inline cli
