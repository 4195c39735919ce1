#include <filesystem>
#include <iostream>

#include "base/reader.h"
#include "cli/course/course_commands.h"
#include "course/review/version_changes.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct ChangesArguments {
    std::vector<std::string> groups;
    std::string assignment, out, isolation = "full";
};

int changes(const CourseArguments& where, const ChangesArguments& args) {
    const Isolation level = args.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    if (const auto obstacle = obstacle_to(level)) throw EnvironmentError(*obstacle);
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, args.assignment);
    ChangesRequest request;
    request.groups = args.groups;
    request.level = level;
    request.program = running_program();
    WorkBar comparing("comparing the versions"), writing("writing the documents");
    request.progress = comparing.progress();
    const std::vector<GroupChanges> all = version_changes(course, assignment, request);
    comparing.finish();
    std::cout << terminal_text(changes_table(assignment, all));
    if (args.out.empty()) return kDone;
    const SandboxedDocuments documents(request.level, request.program);
    const std::size_t written = write_changes(all, course, assignment, args.out, documents, writing.progress());
    writing.finish();
    std::cout << message_text(plural(static_cast<std::int64_t>(written), "{} document as PDF and Markdown in {}",
                                     "{} documents as PDF and Markdown in {}", args.out))
              << '\n';
    return kDone;
}

}  // namespace

CLI::App* add_changes(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<ChangesArguments>();
    CLI::App* command = course.add_subcommand("changes", "Compare first and final versions word by word");
    command->add_option("GROUP", args->groups, "Groups. Default: all groups.");
    command->add_option("--assignment", args->assignment, "Assignment. Required if there are several.")
        ->type_name("NAME");
    command->add_option("--out", args->out, "Folder for GROUP.pdf and GROUP.md of each final version")
        ->type_name("DIR");
    command->add_option("--isolation", args->isolation, "Isolation while the groups' files are processed")
        ->type_name("full|process")
        ->capture_default_str()
        ->check(CLI::IsMember({"full", "process"}));
    command->footer(
        "Compares each final version with the version that its reviewers read. If both versions have a pack with "
        "an\nanalysis that runs, dynlab compares report.md; otherwise, it compares the text of the PDFs. The documents "
        "show\ndeleted and inserted words, the changed values, answers and table cells, and the released "
        "reviews.\nExamples:\n  dynlab course changes --assignment crane\n  dynlab course changes group-03 group-07 "
        "--assignment crane --out changes");
    command->callback([&where, args, &action] { action = [&where, args] { return changes(where, *args); }; });
    return command;
}

}  // namespace dynlab::inline cli
