#include <fmt/format.h>

#include <iostream>

#include "cli/course_commands.h"
#include "course/names/anonymous_copy.h"
#include "course/review/peer_review.h"
#include "course/store/aligned_table.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct PeerArguments {
    std::string assignment, at;
    bool early = false;
};

int assign(const CourseArguments& where, const PeerArguments& words) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, words.assignment);
    const AssignOutcome done = assign_reviews(course, assignment, time_of(course, words.at), words.early);
    std::cout << fmt::format("{}: {} groups, {} reviews (seed {}): {} new, {} taken back.\n", assignment.name,
                             done.groups, done.pairs, assignment.seed, done.fresh, done.ended);
    for (const std::string& remark : done.remarks) std::cout << terminal_text(remark) << '\n';
    if (done.remarks.empty())
        std::cout << "Nobody reviews their own report, one twice, one of a common member, or each other.\n";
    return kDone;
}

int show_pairs(const CourseArguments& where, const PeerArguments& words) {
    Course course(where.folder);
    std::vector<std::vector<std::string>> rows;
    const Assignment assignment = assignment_named(course, words.assignment);
    refuse_without_reviews(assignment);
    for (const ReviewPair& pair : review_pairs(course, assignment)) {
        const char* const state = pair.released  ? "released"
                                  : pair.written ? "written"
                                  : pair.ended   ? "taken back"
                                  : pair.sent    ? "sent"
                                                 : "allotted";
        rows.push_back(
            {pair.reviewer_name, pair.report_pseudonym(), pair.author_name, pair.reviewer_pseudonym(), state});
    }
    std::cout << terminal_text(aligned_table({"reviewer", "reads", "written by", "who knows them as", "state"}, rows));
    return kDone;
}

std::string in_words(const Finding& finding) {
    return fmt::format("{}{}", finding.page > 0 ? fmt::format("page {}: ", finding.page) : "", finding.what);
}

/// Copies are searched for everybody in the course; a name that is certain stops one.
AnonymousCopier anonymous_copier() {
    return [](const CopyRequest& request) {
        AnonymousCopySetup setup;
        for (const Student& student : request.people) setup.names.add(student, student.group == request.group);
        setup.program = std::filesystem::read_symlink("/proc/self/exe");
        const AnonymousCopy copy =
            anonymous_copy(request.pack.empty() ? request.pdf : request.pack, request.copy, setup);
        CopyOutcome outcome{copy.made, {}, {}};
        for (const Finding& finding : copy.findings)
            (finding.severity == Severity::kRule ? outcome.hits : outcome.hints).push_back(in_words(finding));
        if (!copy.made && outcome.hits.empty()) outcome.hits.push_back(copy.trouble);
        return outcome;
    };
}

int send(const CourseArguments& where, const PeerArguments& words, Way way) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, words.assignment);
    const SendOutcome done =
        send_copies(course, assignment, way, time_of(course, words.at), anonymous_copier(), words.early);
    for (const auto* lines : {&done.hits, &done.hints})
        for (const std::string& line : *lines) std::cerr << "dynlab: " << terminal_text(line) << '\n';
    std::cout << fmt::format("{}: {} sent now, {} before, {} stopped, {} not come yet; in {}\n", assignment.name,
                             done.sent, done.before, done.stopped, done.waiting, done.folder.string());
    return done.stopped == 0 ? kDone : kFailed;
}

int send_reports(const CourseArguments& where, const PeerArguments& words) {
    return send(where, words, Way::kToReviewers);
}
int release(const CourseArguments& where, const PeerArguments& words) {
    return send(where, words, Way::kToAuthors);
}

CLI::App* add_one(CLI::App& parent, const char* name, const char* about, CourseArguments& where, Action& action,
                  int (*run)(const CourseArguments&, const PeerArguments&)) {
    auto words = std::make_shared<PeerArguments>();
    CLI::App* command = parent.add_subcommand(name, about);
    command->add_option("ASSIGNMENT", words->assignment, "Needed when there are several");
    add_time_option(*command, words->at);
    if (run == assign) command->add_flag("--early", words->early, "Although first versions may still come");
    if (run == release) command->add_flag("--early", words->early, "Although reviews may still come");
    command->callback([&where, words, run, &action] { action = [&where, words, run] { return run(where, *words); }; });
    return command;
}

}  // namespace

void add_peer_commands(CLI::App& course, CourseArguments& where, Action& action) {
    CLI::App* peer = course.add_subcommand("peer", "Who reviews whom");
    peer->require_subcommand(1);
    add_one(*peer, "assign", "Allocate the reviews at random, or adjust them after late-comers and drop-outs", where,
            action, assign)
        ->footer(
            "Each group writes, and gets, the same number of reviews; what is written or sent stays. May be repeated.\n"
            "Example:  dynlab course peer assign crane");
    add_one(*peer, "send", "Make anonymous copies of the reports for their reviewers", where, action, send_reports)
        ->footer(
            "A name found in a copy stops that copy, and you are told where it is. Repeated, it makes only what is new."
            "\n"
            "Example:  dynlab course peer send crane");
    add_one(course, "release", "Make anonymous copies of the reviews for the authors", where, action, release)
        ->footer(
            "A review that names somebody is stopped, like a report. Repeated, it makes what is new only.\n"
            "Example:  dynlab course release crane");
    add_one(*peer, "show", "The pairs with their pseudonyms; for your eyes only", where, action, show_pairs)
        ->footer("Example:  dynlab course peer show crane");
}

}  // namespace dynlab::inline cli
