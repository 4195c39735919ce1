#include <fmt/format.h>

#include <iostream>

#include "cli/course/course_commands.h"
#include "course/corrections/corrections.h"
#include "course/office/receive.h"
#include "course/store/answer_names.h"
#include "course/store/marks.h"
#include "course/store/receipts.h"
#include "numerics/error.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct CorrectionArguments {
    std::string assignment, time, reason, at, mark;
    SubmissionSelection requested;
    std::optional<std::int64_t> seen;
    bool end = false, alone = false;
};
using Correct = int (*)(Course&, const Assignment&, const CorrectionArguments&);

int correct_time(Course& course, const Assignment& a, const CorrectionArguments& args) {
    const auto versions = correct_arrival(course, a, args.requested, course.clock().parse(args.time, "TIME"),
                                          args.reason, time_of(course, args.at));
    for (const auto& file : write_receipts(course, versions))
        std::cout << terminal_text(fmt::format("Corrected receipt: {}\n", file.string()));
    return kDone;
}

int withdraw_mark(Course& course, const Assignment& a, const CorrectionArguments& args) {
    const std::string item = item_called(a, args.mark);
    const auto answers = group_of_answers(course, a, args.requested.group);
    const std::string who = answers ? answers->name : args.requested.group;
    Transaction transaction(course.database());
    if (args.seen && !args.alone)
        refuse_unseen_entry(course, a, group_named(course, who).id, args.requested.group, item, *args.seen);
    take_back_mark(course, a, who, args.alone, item, args.reason, time_of(course, args.at));
    transaction.commit();
    std::cout << terminal_text(
        fmt::format("{}: your mark of {} ({}) is withdrawn.\n", a.name, args.requested.group, args.mark));
    return kDone;
}

int print_withdrawn(Course& course, const Assignment& a, const CorrectionArguments& args, bool withdrawn) {
    if (!args.mark.empty()) return withdraw_mark(course, a, args);
    const auto versions = withdraw(course, a, args.requested, withdrawn, args.reason, time_of(course, args.at));
    for (const std::int64_t version : versions) {
        const Receipt receipt = receipt_of(course, version);
        std::cout << terminal_text(fmt::format("{}: {} v{} of {} {}.\n", a.name, receipt.part, receipt.version,
                                               receipt.group, withdrawn ? "is withdrawn" : "is reinstated"));
    }
    return kDone;
}

int withdraw_files(Course& course, const Assignment& a, const CorrectionArguments& args) {
    return print_withdrawn(course, a, args, true);
}
int restore_files(Course& course, const Assignment& a, const CorrectionArguments& args) {
    return print_withdrawn(course, a, args, false);
}

int extend_for_one(Course& course, const Assignment& a, const CorrectionArguments& args) {
    if (args.time.empty() != args.end)
        throw InvalidArgument("give the new deadline, or --end to return to the deadline of the class");
    std::optional<Instant> due;
    if (!args.end) due = course.clock().parse(args.time, "TIME");
    if (const Instant of_class = due_of_class(a, args.requested.stage); due && *due < of_class)
        throw InvalidArgument(
            "the new deadline, {}, is earlier than the deadline of the class, {}; give a later deadline",
            course.clock().show_exactly(*due), course.clock().show_exactly(of_class));
    extend(course, a, args.requested.group, args.requested.stage, due, args.reason, time_of(course, args.at));
    const Group group = group_named(course, args.requested.group);
    std::cout << fmt::format("{}: due for {} {}.\n", a.name, group.name,
                             course.clock().show_exactly(due_for(course, a, group.id, args.requested.stage)));
    return kDone;
}

int hold_back(Course& course, const Assignment& a, const CorrectionArguments& args) {
    hold(course, a, args.requested, !args.end, args.reason, time_of(course, args.at));
    std::cout << fmt::format("{}; run dynlab course {} {} to complete this.\n", args.end ? "Released" : "Withheld",
                             args.requested.stage == "review" ? "review release" : "review send", a.name);
    return kDone;
}

struct CorrectionCommand {
    CLI::App* app;
    std::shared_ptr<CorrectionArguments> args;
};

CorrectionCommand add_correction(CLI::App& course, const char* name, const char* about, CourseArguments& where,
                                 Action& action, Correct run) {
    auto args = std::make_shared<CorrectionArguments>();
    CLI::App* command = course.add_subcommand(name, about);
    command->add_option("ASSIGNMENT", args->assignment)->required();
    command->add_option("GROUP", args->requested.group)->required();
    command->callback([&where, args, run, &action] {
        action = [&where, args, run] {
            Course opened(where.folder);
            return run(opened, assignment_named(opened, args->assignment), *args);
        };
    });
    return {command, args};
}

void add_reason(const CorrectionCommand& command) {
    command.app->add_option("--reason", command.args->reason, "Reason; recorded in the history")->required();
    add_time_option(*command.app, command.args->at);
}

void add_stage(const CorrectionCommand& command) {
    command.app->add_option("--stage", command.args->requested.stage, "Version of the submission")
        ->type_name("first|review|final")
        ->capture_default_str()
        ->check(CLI::IsMember({"first", "review", "final"}));
}

void add_file_options(const CorrectionCommand& command) {
    add_stage(command);
    command.app->add_option("--of", command.args->requested.report, "For a review: the reviewed report")
        ->type_name("report-NN");
    command.app
        ->add_option("--part", command.args->requested.part,
                     "File to change. Default: the document and all files submitted with it.")
        ->check(CLI::IsMember({"report", "slides", "script", "review", "pack", "unreadable"}));
    command.app
        ->add_option("--version", command.args->requested.number, "Number of the submission. Default: the newest.")
        ->type_name("N");
}

int show_history(const CourseArguments& where) {
    Course course(where.folder);
    for (const JournalLine& line : journal_of(course))
        std::cout << terminal_text(fmt::format("{}  {}\n", course.clock().show_exactly(line.at), line.what));
    return kDone;
}

void add_withdrawals(CLI::App& course, CourseArguments& where, Action& action) {
    const auto away =
        add_correction(course, "withdraw", "Withdraw a submitted file or a manual mark", where, action, withdraw_files);
    add_file_options(away);
    away.app->add_option("--mark", away.args->mark,
                         "Withdraw a manual mark instead of a file: work or reviews; for a lab, a check or *");
    away.app
        ->add_flag("--alone", away.args->alone, "Withdraw the mark of this student only, set by course mark --alone")
        ->needs("--mark");
    add_after_option(*away.app, away.args->seen);
    away.app->get_option("--after")->needs("--mark");
    add_reason(away);
    away.app->footer(
        "Afterwards the previous version counts, if there is one. The file, its receipt and this entry are kept.\n"
        "Examples:\n"
        "  dynlab course withdraw crane group-05 --reason \"group-06's file by mistake\"\n"
        "  dynlab course withdraw crane group-05 --stage review --of report-17 --reason \"empty form\"\n"
        "  dynlab course withdraw crane group-05 --mark work --reason \"the paper was found\"");
    const auto back = add_correction(course, "restore", "Reinstate a withdrawn file", where, action, restore_files);
    add_file_options(back);
    add_reason(back);
    back.app->footer("Example:  dynlab course restore crane group-05 --reason \"it was the right one\"");
}

}  // namespace

void add_correction_commands(CLI::App& course, CourseArguments& where, Action& action) {
    const auto time =
        add_correction(course, "set-received", "Correct the time of receipt of a file", where, action, correct_time);
    time.app
        ->add_option("TIME", time.args->time,
                     "Time of receipt, such as \"2026-03-01 17:30\", in the course's time zone")
        ->required();
    add_file_options(time);
    add_reason(time);
    time.app->footer(
        "dynlab updates the lateness, and the group gets another signed receipt. The first receipt is kept.\nExample:  "
        "dynlab course set-received crane group-05 \"2026-02-28 12:55\" --reason \"Moodle's log\"");
    add_withdrawals(course, where, action);

    const auto longer =
        add_correction(course, "extend", "Set another deadline for one group", where, action, extend_for_one);
    longer.app->add_option("TIME", longer.args->time, "Deadline of the group");
    add_stage(longer);
    longer.app->add_flag("--end", longer.args->end, "Return to the deadline of the class");
    add_reason(longer);
    longer.app->footer(
        "The deadline also applies to files that were received before. The grace of the assignment is added.\nExample: "
        " dynlab course extend crane group-05 \"2026-03-03 13:00\" --reason \"illness\"");

    const auto kept =
        add_correction(course, "withhold", "Withhold a report from its reviewers, or a review from the authors", where,
                       action, hold_back);
    add_stage(kept);
    kept.app->add_option("--of", kept.args->requested.report, "For a review: the reviewed report")
        ->type_name("report-NN");
    kept.app->add_flag("--end", kept.args->end, "Stop withholding");
    add_reason(kept);
    kept.app->footer(
        "Example:  dynlab course withhold crane group-05 --stage review --of report-17 --reason \"insulting\"");

    CLI::App* history = course.add_subcommand("history", "Show all actions of the course, with their reasons");
    history->footer("Example:  dynlab course history");
    history->callback([&where, &action] { action = [&where] { return show_history(where); }; });
}

}  // namespace dynlab::inline cli
