#include <iostream>
#include <memory>

#include "base/reader.h"
#include "cli/commands.h"
#include "course/export/handed_back.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct HandBackArguments {
    std::string marks, roster, assignment = "dynlab";
};

int hand_back_marks(const HandBackArguments& words) {
    HandBackRequest request;
    request.marks = words.marks;
    request.assignment = words.assignment;
    if (!words.roster.empty()) request.roster = words.roster;
    const HandedBack back = hand_back(request);
    for (const Message& platform : back.unwritten)
        std::cerr << "dynlab: " << terminal_text(message_text(platform)) << '\n';
    for (const Message& complaint : back.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    for (const auto& file : back.files) std::cout << terminal_text(file.string()) << '\n';
    return back.complaints.empty() ? kDone : kFailed;
}

}  // namespace

void add_hand_back(CLI::App& app, Action& action) {
    auto words = std::make_shared<HandBackArguments>();
    CLI::App* command =
        app.add_subcommand("hand-back", "Make of marks what Moodle and Canvas take: grades, comments, feedback files");
    command->add_option("OUT", words->marks, "The folder that dynlab grade --out wrote")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->add_option("--roster", words->roster, "The roster, for addresses and the numbers of the platforms")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--assignment", words->assignment, "The assignment's column in Canvas, such as \"Lab 4 (1234)\"")
        ->type_name("NAME")
        ->capture_default_str();
    command->footer(
        "In OUT/handed_back: moodle-grades.csv (upload as grading worksheet), moodle-feedback.zip (upload as feedback\n"
        "files), canvas-grades.csv (import into the gradebook), and mail.csv, which tells what is new for whom since\n"
        "the last time. Numbers of participants come from the names of the submissions or from the roster's columns\n"
        "moodle and canvas. What nobody has a number for is not written, and is told.\n"
        "Example:  dynlab hand-back marks --roster roster.csv\n"
        "Exit codes: 0 done, 1 somebody with marks could not be entered (nobody could where neither platform has a\n"
        "file), 2 wrong usage.");
    command->callback([words, &action] { action = [words] { return hand_back_marks(*words); }; });
}

}  // namespace dynlab::inline cli
