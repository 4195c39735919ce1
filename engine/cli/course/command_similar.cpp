#include <iostream>
#include <memory>

#include "base/reader.h"
#include "cli/commands.h"
#include "course/similarity/class_similarity.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct SimilarArguments {
    std::string submissions, lesson, out;
    std::vector<std::string> others;
    double line = 60;
};

int compare(const SimilarArguments& args) {
    SimilarityRequest request;
    request.lesson = find_lesson(args.lesson);
    request.submissions = args.submissions;
    request.out = args.out;
    request.others.assign(args.others.begin(), args.others.end());
    request.line = args.line / 100;
    request.isolation = strongest_isolation();
    request.program = running_program();
    const SimilarityOutcome outcome = compare_class(request);
    for (const Message& complaint : outcome.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    const Message pairs = plural(static_cast<std::int64_t>(outcome.pairs), "{} pair", "{} pairs"),
                  groups =
                      plural(static_cast<std::int64_t>(outcome.groups), "{} group of copies", "{} groups of copies");
    std::cout << message_text(plural(static_cast<std::int64_t>(outcome.scripts), "{} script compared: {}, {}",
                                     "{} scripts compared: {}, {}", groups, pairs))
              << '\n'
              << (request.out / "similarity.md").string() << '\n';
    return outcome.complaints.empty() ? kDone : kFailed;
}

}  // namespace

void add_similar(CLI::App& app, Action& action) {
    auto args = std::make_shared<SimilarArguments>();
    CLI::App* command = app.add_subcommand("similar", "List similar scripts in a class for you to review");
    command
        ->add_option("FOLDER", args->submissions,
                     "Submissions: folders, packs, zip files, or an export of Moodle or Canvas")
        ->required()
        ->check(CLI::ExistingPath);
    command->add_option("--lesson", args->lesson, "Lesson. Code of its starter does not count.")
        ->type_name("NN")
        ->required();
    command->add_option("--out", args->out, "Folder for similarity.md and similarity.csv")
        ->type_name("OUT")
        ->required();
    command->add_option("--compare", args->others, "Submissions or scripts of an earlier year; may be repeated")
        ->type_name("FOLDER")
        ->check(CLI::ExistingPath);
    command
        ->add_option("--line", args->line,
                     "Minimum of common code for the list, in percent of the shorter script's own code")
        ->type_name("P")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 100.0));
    command->footer(
        "Comments, layout and chosen names do not count, and code that many scripts share counts little. dynlab also "
        "compares\n"
        "the scripts with the lesson's reference solution. Copies of one script form one group. The list shows both "
        "sides of\n"
        "the common code. Similarity does not prove copying.\n"
        "Example:  dynlab similar Lab4.zip --lesson 04 --out marks --compare 2025/submissions\n"
        "Exit codes: 0 all scripts were compared, 1 some could not be compared, 2 wrong usage.");
    command->callback([args, &action] { action = [args] { return compare(*args); }; });
}

}  // namespace dynlab::inline cli
