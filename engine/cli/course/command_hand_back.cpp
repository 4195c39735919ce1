#include <iostream>
#include <memory>

#include "base/reader.h"
#include "cli/commands.h"
#include "course/export/handed_back.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct HandBackArguments {
    std::string marks, roster, worksheet, assignment;
    bool all = false, delivered = false;
};

int hand_back_marks(const HandBackArguments& words) {
    if (words.delivered) {
        const std::int64_t fresh = record_delivery(words.marks);
        std::cout << message_text(
                         plural(fresh, "{} file is recorded as delivered", "{} files are recorded as delivered"))
                  << '\n';
        return kDone;
    }
    HandBackRequest request;
    request.marks = words.marks;
    request.assignment = words.assignment;
    request.all = words.all;
    if (!words.roster.empty()) request.roster = words.roster;
    if (!words.worksheet.empty()) request.worksheet = words.worksheet;
    const HandedBack back = hand_back(request);
    for (const Message& note : back.notes) std::cerr << "dynlab: note: " << terminal_text(message_text(note)) << '\n';
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
        ->add_option("--worksheet", words->worksheet,
                     "Moodle's grading worksheet or Canvas's gradebook as downloaded, to be filled in")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--assignment", words->assignment, "The assignment's column in Canvas, such as \"Lab 4 (1234)\"")
        ->type_name("NAME");
    command->add_flag("--all", words->all, "Put feedback that was delivered before into the zip, too");
    command->add_flag("--delivered", words->delivered, "Record the files of the last run as delivered");
    command->footer(
        "In OUT/handed_back: moodle-grades.csv (upload as grading worksheet), moodle-feedback.zip (upload as feedback\n"
        "files), canvas-grades.csv (import into the gradebook), and mail.csv, which lists what is new for each "
        "student.\n"
        "--worksheet keeps the language, columns, separator and order of the platform's own file and fills in marks "
        "and\n"
        "comments, also of a partner who submitted nothing. Without it, numbers of participants come from the names "
        "of\n"
        "the submissions, else from the roster's columns moodle and canvas. Moodle numbers participants for each\n"
        "assignment: a number in a submission's name takes precedence over the roster's.\n"
        "Feedback stays new until --delivered; the zip has new feedback only, --all all of it.\n"
        "Example:  dynlab hand-back marks --roster roster.csv --worksheet Grades-Lab4.csv\n"
        "Exit codes: 0 done, 1 somebody with marks could not be entered (nobody could where neither platform has a\n"
        "file), 2 wrong usage.");
    command->callback([words, &action] { action = [words] { return hand_back_marks(*words); }; });
}

}  // namespace dynlab::inline cli
