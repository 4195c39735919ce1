#include <iostream>
#include <memory>

#include "base/reader.h"
#include "cli/commands.h"
#include "course/export/grade_export.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct ExportGradesArguments {
    std::string marks, roster, worksheet, assignment;
    bool all = false, delivered = false;
};

int export_grades(const ExportGradesArguments& args) {
    if (args.delivered) {
        const std::int64_t fresh = log_delivery(args.marks);
        std::cout << message_text(
                         plural(fresh, "{} file is recorded as delivered", "{} files are recorded as delivered"))
                  << '\n';
        return kDone;
    }
    GradeExportRequest request;
    request.marks = args.marks;
    request.assignment = args.assignment;
    request.all = args.all;
    if (!args.roster.empty()) request.roster = args.roster;
    if (!args.worksheet.empty()) request.worksheet = args.worksheet;
    const GradeExport back = write_grade_export(request);
    for (const Message& note : back.notes) std::cerr << "dynlab: note: " << terminal_text(message_text(note)) << '\n';
    for (const Message& platform : back.unwritten)
        std::cerr << "dynlab: " << terminal_text(message_text(platform)) << '\n';
    for (const Message& complaint : back.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    for (const auto& file : back.files) std::cout << terminal_text(file.string()) << '\n';
    return back.complaints.empty() ? kDone : kFailed;
}

}  // namespace

void add_export_grades(CLI::App& app, Action& action) {
    auto args = std::make_shared<ExportGradesArguments>();
    CLI::App* command =
        app.add_subcommand("export-grades", "Export marks for Moodle and Canvas: grades, comments, feedback files");
    command->add_option("OUT", args->marks, "Folder that dynlab grade --out wrote")
        ->required()
        ->check(CLI::ExistingDirectory);
    command
        ->add_option(
            "--roster", args->roster,
            "Roster, for groups, addresses and the numbers of the platforms. Default: the roster in OUT/course.")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--worksheet", args->worksheet,
                     "Moodle's grading worksheet or Canvas's gradebook as downloaded, to be filled in")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--assignment", args->assignment, "Column of the assignment in Canvas, such as \"Lab 4 (1234)\"")
        ->type_name("NAME");
    command->add_flag("--all", args->all, "Include feedback in the zip file that was delivered before");
    command->add_flag("--delivered", args->delivered, "Mark the files of the last run as delivered");
    command->footer(
        "In OUT/handed_back: moodle-grades.csv (upload as grading worksheet), moodle-feedback.zip (upload as "
        "feedback\nfiles), canvas-grades.csv (import into the gradebook), and mail.csv, which lists new files for each "
        "student.\n--worksheet keeps the language, columns, separator and order of the platform's file and fills in "
        "marks and\ncomments, also for a partner who submitted nothing. Without this option, participant numbers come "
        "from the names of\nthe submissions, or else from the roster's columns moodle and canvas. Moodle numbers "
        "participants for each\nassignment: a number in a submission's name takes precedence over the "
        "roster.\nFeedback remains new until you give --delivered. The zip file contains only new feedback; --all "
        "includes the rest.\nExample:  dynlab export-grades marks --roster roster.csv --worksheet "
        "Grades-Lab4.csv\nExit codes: 0 done, 1 some marks could not be entered (none, if neither platform has a "
        "file), 2 wrong usage.");
    command->callback([args, &action] { action = [args] { return export_grades(*args); }; });
}

}  // namespace dynlab::inline cli
