#include <filesystem>
#include <iostream>

#include "base/reader.h"
#include "cli/course/course_commands.h"
#include "course/review/final_changes.h"
#include "course/review/final_changes_document.h"
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

int changes(const CourseArguments& where, const ChangesArguments& words) {
    const Isolation level = words.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    if (const auto obstacle = obstacle_to(level)) throw EnvironmentError(*obstacle);
    Course course(where.folder);
    const Assignment assignment = assignment_named(course, words.assignment);
    FinalChangesRequest request;
    request.groups = words.groups;
    request.level = level;
    request.program = running_program();
    WorkBar comparing("comparing the versions"), writing("writing the documents");
    request.progress = comparing.progress();
    const std::vector<GroupChanges> all = final_changes(course, assignment, request);
    comparing.finish();
    std::cout << terminal_text(final_changes_table(assignment, all));
    if (words.out.empty()) return kDone;
    const BoxedDocuments documents(request.level, request.program);
    const std::size_t written =
        write_change_documents(all, course, assignment, words.out, documents, writing.progress());
    writing.finish();
    std::cout << message_text(plural(static_cast<std::int64_t>(written), "{} document as PDF and Markdown in {}",
                                     "{} documents as PDF and Markdown in {}", words.out))
              << '\n';
    return kDone;
}

}  // namespace

void add_final_changes(CLI::App& final, CourseArguments& where, Action& action) {
    auto words = std::make_shared<ChangesArguments>();
    CLI::App* command =
        final.add_subcommand("changes", "What groups changed after their reviews, and what became of each remark");
    command->add_option("GROUP", words->groups, "All unless given");
    command->add_option("--assignment", words->assignment, "Which; needed when there are several")->type_name("NAME");
    command->add_option("--out", words->out, "Write GROUP.pdf and GROUP.md for each final version into this folder")
        ->type_name("DIR");
    command->add_option("--isolation", words->isolation, "How far the work on the groups' files is kept apart")
        ->type_name("full|process")
        ->capture_default_str()
        ->check(CLI::IsMember({"full", "process"}));
    command->footer(
        "Each final version is compared with the version that the reviewers read: pages, sections, sentences and, "
        "where\n"
        "both came as packs, the values that the analysis reports. Changes that share uncommon words with a remark of "
        "a\n"
        "released review, or are at a place that it names, are its traces. They are found by words; you decide.\n"
        "Examples:\n"
        "  dynlab course final changes --assignment crane\n"
        "  dynlab course final changes group-03 group-07 --assignment crane --out changes");
    command->callback([&where, words, &action] { action = [&where, words] { return changes(where, *words); }; });
}

}  // namespace dynlab::inline cli
