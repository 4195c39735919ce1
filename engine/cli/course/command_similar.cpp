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

int compare(const SimilarArguments& words) {
    SimilarityRequest request;
    request.lesson = find_lesson(words.lesson);
    request.submissions = words.submissions;
    request.out = words.out;
    request.others.assign(words.others.begin(), words.others.end());
    request.line = words.line / 100;
    request.isolation = strongest_isolation();
    request.program = running_program();
    const SimilarityOutcome outcome = compare_class(request);
    for (const Message& complaint : outcome.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    const Message pairs = plural(outcome.pairs, "{} pair", "{} pairs");
    std::cout << message_text(plural(outcome.scripts, "{} script compared: {} above the line",
                                     "{} scripts compared: {} above the line", pairs))
              << '\n'
              << (request.out / "similarity.md").string() << '\n';
    return outcome.complaints.empty() ? kDone : kFailed;
}

}  // namespace

void add_similar(CLI::App& app, Action& action) {
    auto words = std::make_shared<SimilarArguments>();
    CLI::App* command = app.add_subcommand("similar", "List scripts of a class that look alike, for your eye");
    command->add_option("FOLDER", words->submissions, "Submissions, as dynlab grade takes them")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->add_option("--lesson", words->lesson, "The lesson: what its starter gives counts for nothing")
        ->type_name("NN")
        ->required();
    command->add_option("--out", words->out, "Folder for similarity.md and similarity.csv")
        ->type_name("OUT")
        ->required();
    command->add_option("--compare", words->others, "Submissions or scripts of a former year; may be repeated")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory);
    command
        ->add_option("--line", words->line, "Least code in common that is told, in percent of the shorter script's own")
        ->type_name("P")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 100.0));
    command->footer(
        "Comments, layout and chosen names are left out before scripts are compared, also with the lesson's worked\n"
        "solution; what many have counts little. The list shows both sides of what two have in common. It is no\n"
        "verdict: there may be good reasons.\n"
        "Example:  dynlab similar handed-in --lesson 04 --out marks --compare 2025/handed-in\n"
        "Exit codes: 0 all were compared, 1 some could not be, 2 wrong usage.");
    command->callback([words, &action] { action = [words] { return compare(*words); }; });
}

}  // namespace dynlab::inline cli
