#include <fmt/format.h>

#include <iostream>

#include "cli/course/course_commands.h"
#include "course/issues/issues_report.h"
#include "course/office/stored_issues.h"
#include "course/review/review_pairs.h"
#include "numerics/error.h"
#include "platform/terminal/terminal_output.h"

namespace dynlab::inline cli {
namespace {

struct IssuesArguments {
    std::string group, assignment, stage = "first";
    std::optional<std::int64_t> version;
};

std::string stage_in_words(const std::string& stage) {
    return stage == "first" ? "first version" : stage == "review" ? "reviews" : "final version";
}

/// Reports whether anonymized copies for others are missing. The anonymity check runs when such copies are made, so the
/// findings do not contain its results.
void report_missing_copies(Course& course, const Assignment& assignment, const Group& group,
                           const IssuesArguments& args) {
    if (!assignment.is_report() || args.stage == "final" || args.version) return;
    const bool reviews = args.stage == "review";
    bool others = false, missing = false;
    for (const ReviewPair& pair : review_pairs(course, assignment)) {
        if (pair.ended) continue;
        const bool out = reviews ? pair.released && !pair.newer_review : pair.sent && !pair.newer_report;
        const bool own = (reviews ? pair.reviewer : pair.author) == group.id && (!reviews || pair.written);
        others = others || (out && !own);
        missing = missing || (own && !out);
    }
    if (others && missing)
        std::cout << fmt::format("No copy of {} was sent to others yet: run dynlab course {} {} to see why\n",
                                 reviews ? "a review" : "it", reviews ? "review release" : "review send",
                                 assignment.name);
}

int show_issues(const CourseArguments& where, const IssuesArguments& args) {
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    const Group group = group_named(course, args.group);
    const auto found = loaded_issues(course, assignment, group, args.stage, args.version);
    if (found.empty())
        throw args.version
            ? InvalidArgument("{} has submitted no {} for {} with the version number {}", group.name,
                              stage_in_words(args.stage), assignment.name, *args.version)
            : InvalidArgument("{} has submitted no {} for {}", group.name, stage_in_words(args.stage), assignment.name);
    bool passed = true;
    for (const StoredIssues& one : found) {
        std::cout << fmt::format("{}, {}: {}{} v{}, received {}\n", group.name, stage_in_words(args.stage), one.part,
                                 one.about.empty() ? "" : " of " + one.about, one.version,
                                 course.clock().show(one.received_at));
        std::cout << (one.result ? issues_as_text(*one.result, in_color()) : "not checked\n") << '\n';
        passed = passed && (!one.result || one.result->passed());
    }
    report_missing_copies(course, assignment, group, args);
    return passed ? kDone : kFailed;
}

}  // namespace

void add_issues_command(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<IssuesArguments>();
    CLI::App* command = course.add_subcommand("issues", "Show the issues found in a group's files at their receipt");
    command->add_option("GROUP", args->group)->required();
    command->add_option("--assignment", args->assignment, "Assignment. Required if there are several.")
        ->type_name("NAME");
    command->add_option("--stage", args->stage, "Version of the submission")
        ->type_name("first|review|final")
        ->capture_default_str()
        ->check(CLI::IsMember({"first", "review", "final"}));
    command->add_option("--version", args->version, "Number of an earlier submission. Default: the newest.")
        ->type_name("N");
    command->footer(
        "The output has the format of dynlab check.\nExample:  dynlab course issues group-07 --stage review\nExit "
        "codes: 0 no rule is violated, 1 a rule is violated, or nothing was received.");
    command->callback([&where, args, &action] { action = [&where, args] { return show_issues(where, *args); }; });
}

}  // namespace dynlab::inline cli
