#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include "base/reader.h"
#include "cli/commands.h"
#include "cli/course/grading_options.h"
#include "cli/course/grading_report.h"
#include "cli/course/part_options.h"
#include "cli/document_command.h"
#include "course/office/folder_grading.h"
#include "platform/program_lookup.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/read_number.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct GradeArguments {
    FolderRequest request;
    std::string submissions, out;
    PartOptions parts;
    int jobs = 0;
    bool no_pdf = false, answers = false;
};

/// In a task of Slurm the cores that it has; one of a part, as other parts have the others.
int jobs_for(const GradeArguments& args) {
    if (args.jobs > 0) return args.jobs;
    const char* const slurm = std::getenv("SLURM_CPUS_PER_TASK");
    if (const auto cores = slurm ? read_number<int>(slurm) : std::nullopt; cores && *cores > 0) return *cores;
    return args.parts.part.empty() ? static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) : 1;
}

FolderRequest request_of(const GradeArguments& args) {
    FolderRequest request = args.request;
    request.submissions = args.submissions, request.out = args.out;
    request.grading.setup.program = running_program();
    request.grading.setup.jobs = jobs_for(args);
    request.grading.pdf = !args.no_pdf;
    request.part = args.parts.chosen();
    return request;
}

int grade_part(const FolderGrading& grading, const WorkPart& part) {
    const GradingOutcome outcome = grading.grade_part();
    show_complaints(outcome);
    std::cout << fmt::format("part {}: {} graded now, {} unchanged, {} could not be graded\n", part.text(),
                             outcome.made, outcome.kept, outcome.failed);
    return outcome.failed == 0 ? kDone : kFailed;
}

int grade(const GradeArguments& args) {
    const FolderRequest request = request_of(args);
    FolderGrading grading(request);
    const GradingOptions& options = grading.options();
    if (options.setup.secret.empty())
        std::cerr << "dynlab: no --secret FILE: anyone who reads the project can compute the hidden data sets\n";
    const fs::path parts = options.out / "parts";
    if (request.part) {
        note_parts(parts, request.part->count);
        return grade_part(grading, *request.part);
    }
    const auto missing = [&](int count) { return grading.missing(count); };
    if (!args.parts.on.empty() && !done_on(args.parts.on, parts, missing)) return kDone;
    if (args.parts.join) refuse_missing_parts(missing(noted_parts(parts)).parts, noted_parts(parts));
    const GradingOutcome outcome = grading.grade();
    const int code = show_grading(outcome, options.setup.isolation, options.out, options.pdf);
    const fs::path answers = options.out / (options.pdf ? "model_answers.pdf" : "model_answers.md");
    if (args.answers) make_document(model_answers_of(options.setup.lesson, answers), false);
    return code;
}

}  // namespace

void add_grade(CLI::App& app, Action& action) {
    auto args = std::make_shared<GradeArguments>();
    CLI::App* command = app.add_subcommand("grade", "Grade the submissions of a class: marks, feedback, summary");
    command
        ->add_option("FOLDER", args->submissions,
                     "Submissions: folders, packs, zip files, or an export of Moodle or Canvas")
        ->required();
    command
        ->add_option("--lesson", args->request.lesson,
                     "Lesson that provides the checks. Required for a new results folder.")
        ->type_name("NN");
    command->add_option("--out", args->out, "Results folder. A later call adds to the folder and uses its options")
        ->type_name("OUT")
        ->required();
    command
        ->add_option("--checks", args->request.checks, "Folder with your own checks (*.lua), which students never see")
        ->type_name("FOLDER");
    command->add_option("--secret", args->request.secret, "File that determines the hidden data sets")
        ->type_name("FILE")
        ->check(CLI::ExistingFile | CLI::IsMember({kNoFile}));
    command
        ->add_option(
            "--roster", args->request.roster,
            "CSV with the columns id, name, group (also language: en or fr): adds a row of marks for each student")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--owners", args->request.owners,
                     "CSV mapping unmatched submissions to groups (columns: submission and group or id)")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--keep", args->request.keep, "Which of several submissions of one student counts. Default: best")
        ->type_name("best|newest")
        ->check(CLI::IsMember({"best", "newest"}));
    command
        ->add_option("--deadlines", args->request.deadlines,
                     "CSV with the columns submission (a group, an id, or *), deadline, extra, grace, ...")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--times", args->request.times,
                     "Times of submission: Moodle's grading worksheet or another CSV (column id, identifier, group, "
                     "name or mail, and time). Default: the times of the files")
        ->type_name("CSV")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--timezone", args->request.timezone,
                     "Time zone of deadlines and of times in zip files. Default: the zone of this machine")
        ->type_name("ZONE");
    command
        ->add_option("--only", args->request.grading.only,
                     "Grade only this submission, given by its name, group, id or student; may be repeated")
        ->type_name("NAME");
    command->add_flag("--again", args->request.again,
                      "Grade all submissions with the new inputs if OUT was made with other inputs");
    args->parts.add_to(*command);
    CLI::Option* const regrade = command->add_flag("--regrade", args->request.grading.regrade,
                                                   "Grade submissions again that have a result; manual marks are kept");
    for (const char* option : {"--part", "--join", "--on"}) regrade->excludes(command->get_option(option));
    command->add_option("--jobs", args->jobs, "Number of parallel jobs. Default: number of cores.")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    command
        ->add_option("--timeout", args->request.timeout,
                     "Processor time of each run of a script, in seconds; the elapsed time may be 20 times as long. "
                     "Default: 60")
        ->type_name("S")
        ->check(CLI::Range(1, 3600));
    command
        ->add_option("--isolation", args->request.isolation,
                     "full: separate file system, network and processes. Default: full")
        ->type_name("full|process")
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag(
        "--answers", args->answers,
        "Create OUT/model_answers.pdf with the text of the reference solution; dynlab export-grades adds it for all");
    command->add_flag("--force", args->request.grading.above_maximum,
                      "Accept marks in marks.csv above the maximum points of their check");
    command->add_flag("--accept-late", args->request.accept_late, "Apply penalties of half the points or more");
    command->add_flag("--no-pdf", args->no_pdf, "Write feedback and summary as Markdown only");
    command->footer(
        "Each submission runs in its own sandbox and cannot affect the others. An interrupted run resumes where it "
        "stopped.\nManual marks in OUT/marks.csv (who,check,points,reason) survive every regrade: who is a group, an "
        "id, a name or a\nsubmission, check is a check or * for the complete submission. dynlab adds rows for checks "
        "that need a manual mark,\nand never removes rows.\nIn OUT: gradebook.csv, summary.pdf, and for each "
        "submission results/NAME/results.json (Gradescope),\nfeedback.md and feedback.pdf.\nExample:  dynlab grade "
        "submissions --lesson 04 --out marks --secret secret.txt --roster roster.csv\nOUT/course keeps every version "
        "of each submission, the roster, deadlines, owners and options: a later call needs\nonly FOLDER and --out. "
        "dynlab refuses other checks, secrets and deadlines unless you give --again; --checks none and\n--secret none "
        "remove them. dynlab keeps the results of the scripts, so --again takes seconds.\nA script that exceeds "
        "--timeout in processor time is stopped. Answers that it submitted before count. A script that\nexceeds 20 "
        "times --timeout in elapsed time leaves its submission ungraded.\nDeadlines: submission, deadline, and "
        "optionally extra (\"2 d\" after the deadline of *) and "
        "received; in the row of *\nalso grace (\"15 min\"), percent_per_day and most_percent, for all.\nA penalty of "
        "half the points or more is applied only after --accept-late was given once, or if the row "
        "contains\nreceived.\nA submission that cannot be read (a single PDF, a .rar, another lesson's script) is "
        "\"unreadable\": it has no marks\nuntil you enter some in marks.csv. The output and the summary list what "
        "needs attention: unreadable and unmatched\nsubmissions, scripts that stop, late submissions with a penalty, "
        "several submissions of one student.\nExit codes: 0 all submissions are graded, 1 some are ungraded, "
        "unreadable, unconfirmed or unmatched, 2 wrong usage.");
    command->callback([args, &action] {
        if (args->request.lesson.empty() && !is_graded_folder(args->out)) throw CLI::RequiredError("--lesson");
        action = [args] { return grade(*args); };
    });
}

}  // namespace dynlab::inline cli
