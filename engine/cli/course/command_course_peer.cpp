#include <fmt/format.h>

#include <iostream>

#include "base/reader.h"
#include "cli/course/course_commands.h"
#include "course/anonymity/anonymous_copy.h"
#include "course/export/returned_files.h"
#include "course/review/peer_review.h"
#include "numerics/error.h"
#include "platform/program_lookup.h"
#include "platform/terminal/aligned_table.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct PeerArguments {
    std::string assignment, at, reviewer, author, reason;
    std::vector<std::string> accepted;  ///< groups
    bool early = false, set = false, forbid = false, free = false;
};

int assign(const CourseArguments& where, const PeerArguments& args) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    const AssignOutcome done = assign_reviews(course, assignment, time_of(course, args.at), args.early);
    std::cout << message_text(Message("{}: {}, {}: {} new, {} withdrawn.", assignment.name,
                                      plural(done.groups, "{} group", "{} groups"),
                                      plural(done.pairs, "{} review", "{} reviews"), done.fresh, done.ended))
              << '\n';
    for (const Message& remark : done.remarks) std::cout << terminal_text(message_text(remark)) << '\n';
    if (done.remarks.empty())
        std::cout << "No group reviews its own report, a report twice, a report of a common member, or a report of its "
                     "reviewer.\n";
    return kDone;
}

int show_pairs(const CourseArguments& where, const PeerArguments& args) {
    Course course(where.folder);
    std::vector<std::vector<std::string>> rows;
    const Assignment assignment = assignment_named(course, args.assignment);
    refuse_without_reviews(assignment);
    for (const ReviewPair& pair : review_pairs(course, assignment)) {
        const char* const state = pair.released      ? "released"
                                  : pair.voluntary() ? "voluntary"
                                  : pair.written     ? "written"
                                  : pair.ended       ? "withdrawn"
                                  : pair.sent        ? "sent"
                                                     : "allotted";
        rows.push_back(
            {pair.reviewer_name, pair.report_pseudonym(), pair.author_name, pair.reviewer_pseudonym(), state});
    }
    std::cout << terminal_text(aligned_table({"reviewer", "report", "author", "reviewer as", "state"}, rows));
    return kDone;
}

Message with_page(const Issue& issue) {
    return issue.page > 0 ? Message("page {}: {}", issue.page, issue.what) : issue.what;
}

/// Copies are searched for everyone in the course; a certain hit stops the copy unless it is accepted.
AnonymousCopier anonymous_copier() {
    return [](const CopyRequest& request) {
        AnonymousCopySetup setup;
        for (const Student& student : request.people) setup.names.add(student, student.group == request.group);
        setup.names.add_cited(cited_authors());
        setup.accept = request.accept;
        setup.program = running_program();
        const AnonymousCopy copy =
            anonymous_copy(request.pack.empty() ? request.pdf : request.pack, request.copy, setup);
        CopyOutcome outcome{copy.made, {}, {}};
        for (const Issue& issue : copy.findings)
            (issue.severity == Severity::kRule ? outcome.hits : outcome.hints).push_back(with_page(issue));
        if (!copy.not_rebuilt.empty())
            outcome.hints.push_back(Message("{}; the submitted PDF was copied instead.", copy.not_rebuilt));
        if (!copy.made && outcome.hits.empty()) outcome.hits.push_back(copy.error_reason);
        return outcome;
    };
}

int send(const CourseArguments& where, const PeerArguments& args, Way way) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    const SendOutcome done = send_copies(course, assignment, way, time_of(course, args.at), anonymous_copier(),
                                         args.early, {args.accepted, args.reason});
    for (const auto* lines : {&done.hits, &done.hints})
        for (const Message& line : *lines) std::cerr << "dynlab: " << terminal_text(message_text(line)) << '\n';
    std::cout << fmt::format("{}: {} sent now{}, {} before, {} stopped, {} outstanding{}; in {}\n", assignment.name,
                             done.sent, done.again > 0 ? fmt::format(" ({} in a newer version)", done.again) : "",
                             done.before, done.stopped, done.waiting,
                             done.held > 0 ? fmt::format(", {} withheld", done.held) : "", done.folder.string());
    if (!done.unreviewed.empty())
        std::cout << terminal_text(
                         message_text(Message("Groups without a review of their report: {}.", listed(done.unreviewed))))
                  << '\n';
    if (!done.reviewed_once.empty())
        std::cout << terminal_text(message_text(
                         Message("Groups with only one review of their report: {}.", listed(done.reviewed_once))))
                  << '\n';
    for (const std::string& file : done.removed)
        std::cout << terminal_text(fmt::format("Removed from the folder: {}\n", file));
    return done.stopped == 0 ? kDone : kFailed;
}

int constraint(const CourseArguments& where, const PeerArguments& args, const char* requested) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    constrain_pair(course, assignment, args.reviewer, args.author, requested, args.reason, time_of(course, args.at));
    std::cout << fmt::format("Recorded; run dynlab course review assign {} to apply it.\n", assignment.name);
    return kDone;
}

/// The pairs, or what the instructor has to say about one.
int pairs(const CourseArguments& where, const PeerArguments& args) {
    const int constraints = args.set + args.forbid + args.free;
    if (constraints == 0 && args.reviewer.empty()) return show_pairs(where, args);
    if (constraints != 1 || args.author.empty() || args.reason.empty())
        throw InvalidArgument(
            "specify a pair, an action (--set, --forbid or --free) and --reason, as in: dynlab course review pairs "
            "ASSIGNMENT REVIEWER AUTHOR --forbid --reason \"...\"");
    return constraint(where, args, args.set ? "set" : args.forbid ? "forbid" : "free");
}

int send_reports(const CourseArguments& where, const PeerArguments& args) {
    return send(where, args, Way::kToReviewers);
}
int release(const CourseArguments& where, const PeerArguments& args) {
    return send(where, args, Way::kToAuthors);
}

struct ReturnArguments {
    std::string assignment, out, at, worksheet;
    bool moodle = false, all = false;
};

int give_back(const CourseArguments& where, const ReturnArguments& args) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    const ReturnOutcome done = return_files(
        course, assignment,
        {args.out, args.moodle || !args.worksheet.empty(), args.worksheet, args.all, time_of(course, args.at)});
    if (done.other_numbers > 0)
        std::cerr << "dynlab: note: "
                  << message_text(plural(done.other_numbers,
                                         "{} participant number in the roster's column \"moodle\" belongs to another "
                                         "assignment; dynlab uses the number of this assignment",
                                         "{} participant numbers in the roster's column \"moodle\" belong to another "
                                         "assignment; dynlab uses the numbers of this assignment"))
                  << '\n';
    for (const auto& [group, files] : done.files)
        std::cout << terminal_text(fmt::format("{}: {}\n", group, fmt::join(files, ", ")));
    std::cout << message_text(done.files.empty()
                                  ? Message("No new files to deliver.")
                                  : plural(static_cast<std::int64_t>(done.files.size()), "Files for {} group are in {}",
                                           "Files for {} groups are in {}", args.out))
              << '\n';
    if (!done.without_mail.empty())
        std::cerr << "dynlab: "
                  << terminal_text(
                         message_text(Message("no email address is known for {}; add the missing addresses to "
                                              "the column \"mail\" of the roster",
                                              listed(done.without_mail))))
                  << '\n';
    if (!done.without_number.empty())
        std::cerr << terminal_text(
            fmt::format("dynlab: not in moodle.zip, because their Moodle numbers are unknown: {}; give Moodle's "
                        "grading worksheet with --worksheet\n",
                        fmt::join(done.without_number, ", ")));
    return done.without_number.empty() ? kDone : kFailed;
}

void add_return(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<ReturnArguments>();
    CLI::App* command =
        course.add_subcommand("deliver", "Deliver new files to each student: copies to review, reviews, receipts");
    command->add_option("ASSIGNMENT", args->assignment, "Assignment. Required if there are several.");
    command->add_option("-o,--out", args->out, "New folder, with a folder for each group and mail.csv")
        ->type_name("DIR")
        ->required();
    command->add_flag("--moodle", args->moodle, "Also write moodle.zip, for Moodle's upload of feedback files");
    command
        ->add_option("--worksheet", args->worksheet,
                     "Moodle's grading worksheet of this assignment, for the participants' numbers; implies --moodle")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command->add_flag("--all", args->all, "Include files that were delivered before");
    add_time_option(*command, args->at);
    command->footer(
        "Use this command after review send and release. mail.csv has a row for each student: id, name, group, mail, "
        "files,\n"
        "new. dynlab keeps a list of the delivered files; newer versions are new again.\n"
        "Example:  dynlab course deliver crane --out monday --moodle");
    command->callback([&where, args, &action] { action = [&where, args] { return give_back(where, *args); }; });
}

CLI::App* add_one(CLI::App& parent, const char* name, const char* about, CourseArguments& where, Action& action,
                  int (*run)(const CourseArguments&, const PeerArguments&)) {
    auto args = std::make_shared<PeerArguments>();
    CLI::App* command = parent.add_subcommand(name, about);
    command->add_option("ASSIGNMENT", args->assignment, "Assignment. Required if there are several.");
    if (run == pairs) {
        command->add_option("REVIEWER", args->reviewer, "A group");
        command->add_option("AUTHOR", args->author, "Another group");
        command->add_flag("--set", args->set, "Let the group review the report of the other group");
        command->add_flag("--forbid", args->forbid, "Prevent the two groups from reviewing each other");
        command->add_flag("--free", args->free, "Undo --set or --forbid");
        command->add_option("--reason", args->reason, "Reason; recorded in the history");
    }
    add_time_option(*command, args->at);
    if (run == assign) command->add_flag("--early", args->early, "Do not wait for further first versions");
    if (run == release) command->add_flag("--early", args->early, "Do not wait for further reviews");
    if (run == send_reports || run == release) {
        auto* const accept =
            command->add_option("--accept", args->accepted, "Send this group's document although it contains names");
        auto* const reason =
            command->add_option("--reason", args->reason, "Reason; recorded in the history")->type_name("TEXT");
        accept->type_name("GROUP")->needs(reason);
        reason->needs(accept);
    }
    command->callback([&where, args, run, &action] { action = [&where, args, run] { return run(where, *args); }; });
    return command;
}

}  // namespace

void add_peer_commands(CLI::App& course, CourseArguments& where, Action& action) {
    CLI::App* peer = course.get_subcommand("review");
    add_one(*peer, "assign", "Allocate the reviews at random, or adjust them after late submissions and drop-outs",
            where, action, assign)
        ->footer(
            "Each group writes and receives the same number of reviews. Existing reviews and sent copies are kept. You "
            "can repeat\nthe command.\nExample:  dynlab course review assign crane");
    add_one(*peer, "send", "Create anonymized copies of the reports for their reviewers", where, action, send_reports)
        ->footer(
            "A copy that contains a name is not sent; dynlab prints where the name is. If the text does not refer to a "
            "person,\n--accept sends the copy. If you repeat the command, it creates only new copies.\nExamples:  "
            "dynlab course review send crane\n           dynlab course review send crane --accept group-01 --reason "
            "\"Page is a word there\"");
    add_one(*peer, "release", "Create anonymized copies of the reviews for the authors", where, action, release)
        ->footer(
            "A review that contains a name is not sent. If you repeat the command, it creates only new "
            "copies.\nExample:  dynlab course review release crane");
    add_return(course, where, action);
    add_one(*peer, "pairs", "Show the pairs with their pseudonyms (confidential), or set or forbid a pair", where,
            action, pairs)
        ->footer(
            "If a forbidden review is not written yet, the next review assign gives it to another group.\n"
            "Examples:\n"
            "  dynlab course review pairs crane\n"
            "  dynlab course review pairs crane group-02 group-07 --forbid --reason \"they share a flat\"");
}

}  // namespace dynlab::inline cli
